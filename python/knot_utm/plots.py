"""The pictures of a sweep, and the numbers that stand in them: a number of result.yaml against the keys that were varied, and the
curves of the runs, a panel for each combination of the keys of for_each. pattern_plots.py has those of the motion pattern."""
import os

import numpy as np
import pandas as pd
from matplotlib import cm

from knot_utm import axes, pattern_plots, trends
from knot_utm.errors import WrongInput
from knot_utm.groups import dimensionless, scale, UNITS
from knot_utm.report.curves import draw
from knot_utm.table import NUMBERS, result_columns

SPECIMEN = "specimen"  # the column that tells repeats apart
# {column of curve_full.csv: (what it is drawn over, the phase from which on)}
ACROSS = {"load": ("extension", "pull"), "knot_distance": ("time", "release")}
UNIT_OF = {"load": "N", "extension": "m", "knot_distance": "m", "time": "s"}
FLOOR = 1e-3  # of the largest load: smaller ones are at the foot of a logarithmic axis
INSTANTS = (0.0, 5.0, 10.0, 15.0)  # after the knots were let go, those of the paper's Fig. 8 [s]


def require_plottable(results):
    """Raises WrongInput where one of these can not be drawn."""
    numbers = [name for name, _, kind in result_columns().values() if kind in NUMBERS]
    for result in results:
        if result not in (*numbers, pattern_plots.PATTERN, *ACROSS):
            raise WrongInput(f"--plot is {result}, but must be a number of result.yaml, such as plateau_force, or "
                             + ", ".join((pattern_plots.PATTERN, *ACROSS)))


def write_plots(table, study, result, folder, runs):
    """RESULT.png in the folder, the same in the units of the rod (RESULT_in_groups.png), and but for loads what stands in
    them (RESULT.csv). `runs`: the SweepFolder."""
    path = os.path.join(folder, result)
    rods = [runs.rod(name) for name in table["run"]]
    in_groups = dimensionless(table, rods)
    for end, shown, of in (("", table, None), ("_in_groups", in_groups, rods)):
        figure(shown, study.keys, result, study.cases, runs, of).savefig(path + end + ".png", dpi=150, bbox_inches="tight")
    said = numbers_of(table, study, result, in_groups, runs)
    if said is not None:
        said.to_csv(path + ".csv", index=False)


def figure(table, keys, result, cases=(), runs=None, rods=None):
    """`table`: of knot_utm.sweep, in the units of the picture."""
    if result == pattern_plots.PATTERN:
        return pattern_plots.figure(table, keys, cases)
    if result in ACROSS:
        return figure_of_curves(table, keys, result, cases, runs, rods)
    return figure_of_number(table, keys, result, cases)


def numbers_of(table, study, result, in_groups, runs):
    """What stands in a picture, as a table; None of loads over extensions and of too few runs."""
    if result == pattern_plots.PATTERN:
        return pattern_plots.numbers_of(table, study.keys, study.cases)
    if result == "knot_distance":
        return numbers_of_curves(table, study.keys, study.cases, runs)
    if result in ACROSS:
        return None
    return numbers_of_number(table, study, result, in_groups)


# ---- numbers ----


def figure_of_number(table, keys, result, cases=()):
    """Two numbers in a grid make maps, one for each combination of the words that were varied too; anything else is a panel for
    each number, with a colour for each such combination."""
    numbers, words = axes.numbers_and_words(table, keys, cases)
    groups = axes.parts(table, words)
    if len(numbers) == 2 and all(_is_grid(rows, numbers) for _, rows in groups):
        return _maps(table, groups, numbers, result)
    return _panels(table, groups, numbers or words[:1] or keys[:1], result)


def numbers_of_number(table, study, result, in_groups):
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


# ---- curves ----


def figure_of_curves(table, keys, result, cases, runs, rods=None):
    """`runs.curve(name)`: curve_full.csv of a run; `rods`: (k_b, h) of the rows, by whose units they are drawn."""
    across, phase = ACROSS[result]
    numbers, words = axes.numbers_and_words(table, keys, cases)
    groups = axes.parts(table, words)
    drawn, panels = axes.panels(len(groups), 4.0, 3.2)
    shades = _shades(table, numbers)
    rod_of = dict(zip(table["run"], rods)) if rods else {}
    for panel, (name, rows) in zip(panels, groups):
        named = set()
        for run, (shade, value) in zip(rows["run"], shades(rows)):
            x, y = _from(runs.curve(run), phase, across, result)
            if len(x):
                draw(panel, x / _unit(across, rod_of.get(run)), y / _unit(result, rod_of.get(run)), color=shade, linewidth=0.8,
                     label=None if value in named else value)
            named.add(value)
        panel.set_title(name, fontsize="small")
        panel.set_xlabel(f"{across} [{_unit_name(across, rods)}]")
        panel.set_ylabel(f"{result} [{_unit_name(result, rods)}]")
        if result == "load" and panel.has_data():
            most = panel.dataLim.y1
            panel.set_yscale("symlog", linthresh=max(FLOOR * most, 1e-12))
    if numbers:
        panels[0].legend(title=numbers[0], fontsize="x-small", title_fontsize="x-small")
    return drawn


def numbers_of_curves(table, keys, cases, runs):
    """The knot distance at INSTANTS after the knots were let go: mean and scatter of the specimens."""
    numbers, words = axes.numbers_and_words(table, keys, cases)
    at = pd.concat([_at_instants(row, runs.curve(row["run"])) for _, row in table.iterrows()], ignore_index=True)
    return trends.levels(at, words + numbers + ["time"], "knot_distance")


def _at_instants(row, curve):
    time, distance = _from(curve, *(ACROSS["knot_distance"][i] for i in (1, 0)), "knot_distance")
    seen = np.array([t for t in INSTANTS if len(time) and t <= time[-1]])
    return pd.DataFrame({**{key: [row[key]] * len(seen) for key in row.index}, "time": seen,
                         "knot_distance": np.interp(seen, time, distance) if len(seen) else seen})


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


def _of_the_rod(column):
    return next((name for name, (si, _, _) in UNITS.items() if si == UNIT_OF[column]), None)


def _unit(column, rod):
    return scale(_of_the_rod(column), rod) if rod and _of_the_rod(column) else 1.0


def _unit_name(column, rods):
    return (_of_the_rod(column) if rods else None) or UNIT_OF[column]
