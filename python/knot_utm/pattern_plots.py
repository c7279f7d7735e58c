"""The motion pattern against the keys that were varied: the share of each pattern, or a map of several keys."""
import itertools

import numpy as np
import pandas as pd
from matplotlib.colors import to_rgb
from matplotlib.patches import Patch

from knot_utm import axes, trends

PATTERN = "motion_pattern"
OPENED = "jumped open"
UNTANGLING = "untangling"
FAILED = "no result"
COLOURS = {"sliding": "tab:blue", OPENED: "tab:cyan", "stretching": "tab:green", UNTANGLING: "tab:red", "none": "tab:gray",
           FAILED: "black"}
CELLS = 8       # of a map along each of its axes
SLICES = 3, 2   # of the keys beside them
FINE = 40       # places along an axis of a picture


def outcomes(table):
    """The motion pattern of each run. One whose knots jumped open, as it was mounted or pulled, and did not come undone is told
    apart. A run that the solver gave up has none."""
    mounted = table["opened_when_mounted"].notna() & (table[PATTERN] == UNTANGLING)
    opened = (table["jump_force"].notna() | mounted) & table["untangled_at"].isna()
    return [FAILED if ended in ("solver", "") or not pattern else OPENED if only_opened else pattern
            for pattern, ended, only_opened in zip(table[PATTERN].fillna(""), table["ended_by"].fillna(""), opened)]


def opened(table):
    """Whether a knot came undone or jumped open; of the runs that have a result."""
    return np.isin(outcomes(table), (UNTANGLING, OPENED))


def figure(table, keys, cases=()):
    numbers, words = axes.numbers_and_words(table, keys, cases)
    groups = axes.parts(table, words)
    if len(numbers) > 1:
        return _map(table, numbers)
    drawn, panels = axes.panels(len(groups), 3.4, 3.0)
    key = (numbers or words[:1] or keys[:1])[0]
    for panel, (name, rows) in zip(panels, groups):
        _bars(panel, rows, key)
        panel.set_title(name, fontsize="small")
        panel.set(xlabel=axes.with_unit(key, table), ylabel="share of the specimens")
    _legend(drawn, set(outcomes(table)))
    return drawn


def numbers_of(table, keys, cases):
    """Shares with their 95 % intervals, and the threshold of coming undone or jumping open; of a map its cells."""
    numbers, words = axes.numbers_and_words(table, keys, cases)
    if len(numbers) > 1:
        return cells(table, numbers)
    key = (numbers or words[:1] or keys[:1])[0]
    rows = []
    for name, part in axes.parts(table, words):
        threshold = numbers and _threshold(part, key) or (None, None, None)
        for value, at in part.groupby(key, sort=False):
            names = outcomes(at)
            rows += [(name, value, outcome, len(names), *trends.share(names.count(outcome), len(names)), *threshold)
                     for outcome in sorted(set(names))]
    return pd.DataFrame(rows, columns=["case", key, "outcome", "n", "share", "low", "high", "threshold", "threshold_low", "threshold_high"])


def cells(table, keys):
    """For each of a grid of cells over the keys the most frequent outcome among the runs nearest to the middle, its share and interval."""
    rows, near = _with_result(table, keys)
    sides = [CELLS, *(len(keys) - 2) * [SLICES[0]], CELLS]  # the first and the last are the axes of its picture
    middles = np.array(list(itertools.product(*((np.arange(n) + 0.5) / n for n in sides))))
    found = pd.DataFrame(near.values(middles), columns=keys)
    found[["outcome", "share", "low", "high"]] = near.majority(middles)
    found["n"] = near.count
    return found


def _threshold(rows, key):
    known = rows[[outcome != FAILED for outcome in outcomes(rows)]]
    return trends.threshold(known[key], opened(known)) if axes.spans_far(rows[key]) and len(known) else None


def _bars(panel, rows, key):
    values = sorted(rows[key].unique())
    foot = np.zeros(len(values))
    for outcome, colour in COLOURS.items():
        heights = np.array([np.mean([name == outcome for name in outcomes(rows[rows[key] == value])]) for value in values])
        panel.bar(range(len(values)), heights, 0.9, foot, color=colour)
        foot += heights
    panel.set_xticks(range(len(values)), [f"{value:.3g}" if isinstance(value, float) else str(value) for value in values],
                     rotation=60, fontsize="x-small")
    found = _threshold(rows, key) if rows[key].dtype.kind in "if" else None
    if found:
        places = np.interp(np.log([found.low, found.value, found.high]), np.log(values), range(len(values)))
        panel.axvline(places[1], color="black")
        panel.axvspan(places[0], places[2], color="black", alpha=0.2)


def _with_result(table, keys):
    names = outcomes(table)
    known = [name != FAILED for name in names]
    return table[known], trends.Neighbours(table[known], keys, [name for name in names if name != FAILED])


def _map(table, keys):
    """Slices: the last key along x, the first along y, panels for the two between them at the middles of equal parts. The colour
    is that of the most frequent pattern near by, paler where its share is smaller; dots are runs."""
    rows, near = _with_result(table, keys)
    across, up = len(keys) - 1, 0
    between = list(range(1, across))[:2]
    parts = [range(SLICES[place]) for place in range(len(between))]
    drawn, panels = axes.panels(int(np.prod([len(part) for part in parts])), 3.6, 3.4, SLICES[0])
    x, y = np.meshgrid(*(2 * [(np.arange(FINE) + 0.5) / FINE]))
    cube = near.tree.data
    for panel, slices in zip(panels, itertools.product(*reversed(parts))):
        places = np.full((x.size, len(keys)), 0.5)
        places[:, across], places[:, up] = x.ravel(), y.ravel()
        inside = np.ones(len(rows), bool)
        for place, part in zip(reversed(between), slices):
            count = len(parts[between.index(place)])
            places[:, place] = (part + 0.5) / count
            inside &= np.floor(np.minimum(cube[:, place], 1 - 1e-9) * count) == part
        _slice(panel, near, places, keys, (across, up), inside)
        middle = near.values(places[:1])[0]
        panel.set_title(", ".join(f"{axes.with_unit(keys[place], table).split('.')[-1]} {middle[place]:.3g}" for place in between), fontsize="small")
        axes.name_axes(panel, table, keys[across], keys[up])
    _legend(drawn, set(near.names))
    return drawn


def _slice(panel, near, places, keys, of, inside):
    """Each place in the colour of its outcome, as far from white as the share is from a third."""
    names, shares, *_ = zip(*near.majority(places))
    strength = 0.75 * np.clip((np.array(shares) - 1 / 3) / (2 / 3), 0.0, 1.0)[:, None]
    colours = 1.0 - strength * (1.0 - np.array([to_rgb(COLOURS[name]) for name in names]))
    corners = near.values(np.repeat((np.arange(FINE + 1) / FINE)[:, None], len(keys), axis=1))
    panel.pcolormesh(corners[:, of[0]], corners[:, of[1]], np.zeros((FINE, FINE))).set(array=None, facecolor=colours)
    runs = near.values(near.tree.data[inside])
    panel.scatter(runs[:, of[0]], runs[:, of[1]], s=7, c=[COLOURS[near.names[outcome]] for outcome in near.outcomes[inside]],
                  edgecolors="white", linewidths=0.3)


def _legend(drawn, names):
    shown = [Patch(color=colour, label=name) for name, colour in COLOURS.items() if name in names]
    drawn.legend(handles=shown, ncol=len(shown), loc="lower center", bbox_to_anchor=(0.5, 1.0))
