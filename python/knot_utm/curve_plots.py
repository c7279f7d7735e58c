"""The curves of a sweep's runs, a panel for each combination of the keys of for_each."""
import numpy as np
import pandas as pd
from matplotlib import cm

from knot_utm import axes, trends
from knot_utm.groups import UNITS, scale

# {column of curve_full.csv: (what it is drawn over, the phase from which on)}
ACROSS = {"load": ("extension", "pull"), "knot_distance": ("time", "release")}
UNIT_OF = {"load": "N", "extension": "m", "knot_distance": "m", "time": "s"}
FLOOR = 1e-3  # of the largest load: smaller ones are at the foot of a logarithmic axis
INSTANTS = (0.0, 5.0, 10.0, 15.0)  # after the knots were let go, those of the paper's Fig. 8 [s]


def figure(table, keys, result, cases, runs, rods=None):
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
            panel.plot(x / _unit(across, rod_of.get(run)), y / _unit(result, rod_of.get(run)), color=shade, linewidth=0.8,
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


def numbers_of(table, keys, cases, runs):
    """The knot distance at INSTANTS after the knots were let go: mean and scatter of the specimens."""
    numbers, words = axes.numbers_and_words(table, keys, cases)
    at = pd.concat([_at_instants(row, runs.curve(row["run"])) for _, row in table.iterrows()], ignore_index=True)
    return trends.levels(at, words + numbers + ["time"], "knot_distance")


def _at_instants(row, curve):
    time, distance = _from(curve, *(ACROSS["knot_distance"][i] for i in (1, 0)), "knot_distance")
    seen = np.array([t for t in INSTANTS if len(time) and t <= time[-1]])
    found = pd.DataFrame({"time": seen, "knot_distance": np.interp(seen, time, distance) if len(seen) else seen})
    return found.assign(**{key: [row[key]] * len(seen) for key in row.index if key not in found})


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
