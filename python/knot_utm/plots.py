"""The pictures of a sweep, and the numbers that stand in them: a number of result.yaml against the keys that were varied, and the
curves of the runs, a panel for each combination of the keys of for_each. pattern_plots.py has those of the motion pattern."""
import os

import numpy as np
import pandas as pd
from matplotlib import cm

from knot_utm import axes, pattern_plots, trends
from knot_utm.errors import refuse_if
from knot_utm.groups import dimensionless, scale, UNITS
from knot_utm.table import NUMBERS, result_columns, SPECIMEN

# {column of curve_full.csv: (what it is drawn over, the phase from which on)}
ACROSS = {"load": ("extension", "pull"), "knot_distance": ("time", "release")}
UNIT_OF = {"load": "N", "extension": "m", "knot_distance": "m", "time": "s"}
FLOOR = 1e-3  # of the largest load: smaller ones are at the foot of a logarithmic axis
INSTANTS = (0.0, 5.0, 10.0, 15.0)  # after the knots were let go, those of the paper's Fig. 8 [s]


def require_plottable(results):
    """Raises WrongInput where one of these can not be drawn."""
    numbers, others = [name for name, _, kind in result_columns().values() if kind in NUMBERS], (pattern_plots.PATTERN, *ACROSS)
    for result in results:
        refuse_if(result not in (*numbers, *others),
                  f"--plot is {result}, but must be a number of result.yaml, such as plateau_force, or {', '.join(others)}")


def write_plots(table, study, result, folder, runs):
    """RESULT.png in the folder, the same in the units of the rod (RESULT_in_groups.png), and but for loads what stands in
    them (RESULT.csv). `runs`: the SweepFolder."""
    path, keys, cases = os.path.join(folder, result), study.keys, study.cases
    rods = [runs.rod(name) for name in table["run"]]
    in_groups = dimensionless(table, rods)
    if result == pattern_plots.PATTERN:
        draws, numbers = lambda shown, _: pattern_plots.figure(shown, keys, cases), pattern_plots.numbers_of(table, keys, cases)
    elif result in ACROSS:
        draws = lambda shown, of: figure_of_curves(shown, keys, result, cases, runs, of)
        numbers = numbers_of_curves(table, keys, cases, runs) if result == "knot_distance" else None
    else:
        draws, numbers = lambda shown, _: figure_of_number(shown, keys, result, cases), numbers_of_number(table, study, result, in_groups)
    for end, shown, of in (("", table, None), ("_in_groups", in_groups, rods)):
        draws(shown, of).savefig(path + end + ".png", dpi=150, bbox_inches="tight")
    if numbers is not None:  # too few runs tell nothing
        numbers.to_csv(path + ".csv", index=False)


# ---- numbers ----


def figure_of_number(table, keys, result, cases=()):
    """Two numbers in a grid make maps, one for each combination of the words that were varied too; anything else is a panel for
    each number, with a colour for each such combination."""
    numbers, words = axes.numbers_and_words(table, keys, cases)
    groups = axes.parts(table, words)
    if len(numbers) == 2 and all(len(rows[numbers].drop_duplicates()) == rows[numbers].nunique().prod() for _, rows in groups):
        return _maps(table, groups, numbers, result)
    return _panels(table, groups, numbers or words[:1] or keys[:1], result)


def numbers_of_number(table, study, result, in_groups):
    """Mean and scatter of repeated specimens at each point, and how the result grows with one number; the differences of a study that
    changes one key at a time; the exponents of runs with several numbers anywhere, `in_groups`, which is the table in the units of the
    rod."""
    if study.design == "one_at_a_time":
        return trends.differences(table, study.keys, study.cases, result)
    numbers, words = axes.numbers_and_words(table, study.keys, study.cases)
    if len(numbers) > 1 and study.design != "grid":
        return trends.powers(in_groups, [key for key in numbers if in_groups[key].nunique() > 1], result)
    found = trends.levels(table, words + numbers or study.keys[:1], result)
    if len(numbers) != 1:
        return found
    powers = pd.DataFrame([(*values, *(trends.power(rows[numbers[0]], rows[result]) or (np.nan, np.nan)))
                           for values, rows in axes.combinations(table, words)], columns=[*words, "exponent", "exponent_error"])
    return found.merge(powers, "left", words) if words else found.merge(powers, "cross")


def _panels(table, groups, across, result):
    drawn, panels = axes.panels(len(across))
    for panel, key in zip(panels, across):
        for name, rows in groups:
            if SPECIMEN in table:
                _repeated(panel, rows, key, result, name)
                continue
            rows = rows.sort_values(key, kind="stable") if len(across) == 1 else rows
            panel.errorbar(rows[key], rows[result], _bars(rows.get(result + "_error")), marker="o", markersize=4, capsize=2,
                           linestyle="-" if len(across) == 1 and rows[key].is_unique else "none", label=name)
        axes.name_axes(panel, table, key, result)
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
    return errors if errors is not None and errors.notna().any() else None


def _maps(table, groups, numbers, result):
    drawn, panels = axes.panels(len(groups))
    low, high = table[result].min(), table[result].max()
    for panel, (name, rows) in zip(panels, groups):
        cells = rows.pivot_table(result, numbers[1], numbers[0], dropna=False)
        shown = panel.pcolormesh(axes.edges(cells.columns), axes.edges(cells.index), np.ma.masked_invalid(cells.to_numpy(float)),
                                 vmin=low, vmax=high)
        panel.set_title(name)
        axes.name_axes(panel, table, *numbers)
    drawn.colorbar(shown, ax=panels, label=axes.with_unit(result, table))
    return drawn


# ---- curves ----


def figure_of_curves(table, keys, result, cases, runs, rods=None):
    """`runs.curve(name)`: curve_full.csv of a run; `rods`: (k_b, h) of the rows, by whose units they are drawn."""
    across, phase = ACROSS[result]
    numbers, words = axes.numbers_and_words(table, keys, cases)
    groups = axes.parts(table, words)
    drawn, panels = axes.panels(len(groups), 4.0, 3.2)
    shades = _shades(table, numbers)
    rod_of = dict(zip(table["run"], rods or len(table) * [None]))
    for panel, (name, rows) in zip(panels, groups):
        named = set()
        for run, (shade, value) in zip(rows["run"], shades(rows)):
            units = [_unit(column, rod_of[run]) for column in (across, result)]
            x, y = _from(runs.curve(run), phase, across, result)
            if len(x):
                panel.plot(x / units[0][1], y / units[1][1], color=shade, linewidth=0.8, label=None if value in named else value)
            named.add(value)
        panel.set_title(name, fontsize="small")
        panel.set(xlabel=f"{across} [{units[0][0]}]", ylabel=f"{result} [{units[1][0]}]")
        if result == "load" and panel.has_data():
            most = panel.dataLim.y1
            panel.set_yscale("symlog", linthresh=max(FLOOR * most, 1e-12))
    if numbers:
        panels[0].legend(title=numbers[0], fontsize="x-small", title_fontsize="x-small")
    return drawn


def numbers_of_curves(table, keys, cases, runs):
    """The knot distance at INSTANTS after the knots were let go: mean and scatter of the specimens."""
    numbers, words = axes.numbers_and_words(table, keys, cases)
    across, phase = ACROSS["knot_distance"]
    rows = []
    for _, row in table.iterrows():
        time, distance = _from(runs.curve(row["run"]), phase, across, "knot_distance")
        rows += [{**row, "time": t, "knot_distance": np.interp(t, time, distance)} for t in INSTANTS if len(time) and t <= time[-1]]
    return trends.levels(pd.DataFrame(rows, columns=[*table, "time", "knot_distance"]), words + numbers + ["time"], "knot_distance")


def _from(curve, phase, across, result):
    """From where that phase begins; time counts from there."""
    at = np.flatnonzero((curve["phase"] == phase).to_numpy())
    if not len(at):
        return np.array([]), np.array([])
    x, y = (curve[name].to_numpy(float)[at[0]:] for name in (across, result))
    return (x - x[0] if across == "time" else x), y


def _shades(table, numbers):
    """[(a shade for the value of the first number that was varied, the value as text)] of rows."""
    if not numbers:
        return lambda rows: [("tab:blue", None)] * len(rows)
    order = {value: place for place, value in enumerate(sorted(table[numbers[0]].unique()))}
    return lambda rows: [(cm.viridis(order[value] / max(1, len(order) - 1)), f"{value:.3g}") for value in rows[numbers[0]]]


def _unit(column, rod):
    """(name, size in SI) of the unit of a column: where a rod is given, its own."""
    of_the_rod = next((name for name, (si, _, _) in UNITS.items() if rod and si == UNIT_OF[column]), None)
    return (of_the_rod, scale(of_the_rod, rod)) if of_the_rod else (UNIT_OF[column], 1.0)
