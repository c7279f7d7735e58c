"""A number of result.yaml against the keys that were varied."""
import numpy as np
import pandas as pd

from knot_utm import axes, trends

SPECIMEN = "specimen"  # the column that tells repeats apart


def figure(table, keys, result, cases=()):
    """Two numbers in a grid make maps, one for each combination of the words that were varied too; anything else is a panel for
    each number, with a colour for each such combination."""
    numbers, words = axes.numbers_and_words(table, keys, cases)
    groups = axes.parts(table, words)
    if len(numbers) == 2 and all(_is_grid(rows, numbers) for _, rows in groups):
        return _maps(table, groups, numbers, result)
    return _panels(table, groups, numbers or words[:1] or keys[:1], result)


def numbers_of(table, study, result, in_groups):
    """Of repeated specimens mean and scatter at each point, and of one number how the result grows with it; of a study that
    changes one key at a time the differences; of runs with several numbers anywhere the exponents `in_groups`, which is the table
    in the units of the rod."""
    if study.design == "one_at_a_time":
        return trends.differences(table, study.keys, study.cases, result)
    numbers, words = axes.numbers_and_words(table, study.keys, study.cases)
    if len(numbers) > 1 and study.design != "grid":
        return trends.powers(in_groups, [key for key in numbers if in_groups[key].nunique() > 1], result)
    found = trends.levels(table, words + numbers, result) if words + numbers else trends.levels(table, study.keys[:1], result)
    if len(numbers) == 1:
        powers = {name: trends.power(rows[numbers[0]], rows[result]) for name, rows in _grouped(table, words)}
        found = _with_powers(found, words, powers)
    return found


def _grouped(table, words):
    return table.groupby(words if len(words) > 1 else words[0], sort=False) if words else [((), table)]


def _with_powers(found, words, powers):
    """Columns exponent and exponent_error, the same in all rows of one combination of words."""
    of_rows = [powers[tuple(row) if len(words) > 1 else row[0] if words else ()] or (np.nan, np.nan)
               for row in found[words].itertuples(index=False)]
    return pd.concat([found, pd.DataFrame(of_rows, columns=["exponent", "exponent_error"])], axis=1)


def _panels(table, groups, across, result):
    drawn, panels = axes.panels(len(across))
    errors = result + "_error" if result + "_error" in table else None
    for panel, key in zip(panels, across):
        for name, rows in groups:
            if SPECIMEN in table:
                _repeated(panel, rows, key, result, name)
                continue
            rows = rows.sort_values(key, kind="stable") if len(across) == 1 else rows
            panel.errorbar(rows[key], rows[result], _bars(rows[errors]) if errors else None, marker="o", markersize=4, capsize=2,
                           linestyle="-" if len(across) == 1 and rows[key].is_unique else "none", label=name)
        axes.name_axis(panel.set_xlabel, table, key)
        axes.name_axis(panel.set_ylabel, table, result)
        axes.scale_axis(panel, "x", table[key])
        axes.scale_axis(panel, "y", table[result])
    if len(groups) > 1:
        panels[0].legend()
    return drawn


def _repeated(panel, rows, key, result, name):
    """Means with the standard deviation of single specimens."""
    at = trends.levels(rows, [key], result).sort_values(key, kind="stable")
    power = trends.power(rows[key], rows[result]) if rows[key].dtype.kind in "if" else None
    grows = f", exponent {power[0]:.2f} ± {power[1]:.2f}" if power and axes.spans_far(rows[key]) else ""
    panel.errorbar(at[key], at["mean"], _bars(at["sd"]), marker="o", markersize=4, capsize=2, label=name + grows)


def _bars(errors):
    """Matplotlib takes no bars of which none is known."""
    return errors if errors.notna().any() else None


def _maps(table, groups, numbers, result):
    drawn, panels = axes.panels(len(groups))
    low, high = table[result].min(), table[result].max()
    for panel, (name, rows) in zip(panels, groups):
        cells = rows.pivot_table(result, numbers[1], numbers[0], dropna=False)
        shown = panel.pcolormesh(axes.edges(cells.columns), axes.edges(cells.index), np.ma.masked_invalid(cells.to_numpy(float)),
                                 vmin=low, vmax=high)
        panel.set_title(name)
        for key, set_label, name in ((numbers[0], panel.set_xlabel, "x"), (numbers[1], panel.set_ylabel, "y")):
            axes.name_axis(set_label, table, key)
            axes.scale_axis(panel, name, table[key])
    axes.name_axis(drawn.colorbar(shown, ax=panels).set_label, table, result)
    return drawn


def _is_grid(rows, keys):
    """Whether every combination of the values is there."""
    return len(rows[keys].drop_duplicates()) == np.prod([rows[key].nunique() for key in keys])
