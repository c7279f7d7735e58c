"""A result of a sweep against the keys that were varied."""
import os

import numpy as np
from matplotlib.figure import Figure

from knot_utm.errors import WrongInput
from knot_utm.table import NUMBERS, result_columns

FAR = 20  # times the smallest value: the axis is then logarithmic


def require_plottable(results):
    """Raises WrongInput where one of these is no number of result.yaml."""
    numbers = [name for name, _, kind in result_columns().values() if kind in NUMBERS]
    for result in results:
        if result not in numbers:
            raise WrongInput(f"--plot is {result}, but must be a number of result.yaml, such as plateau_force")


def write_plot(table, keys, result, folder):
    """RESULT.png in the folder; its path."""
    path = os.path.join(folder, result + ".png")
    drawn = figure(table, keys, result)
    drawn.savefig(path, dpi=150)
    return path


def figure(table, keys, result):
    """`table`: of knot_utm.sweep. Two numbers in a grid make maps, one for each combination of the words that were varied
    too; anything else is a panel for each number, with a colour for each such combination."""
    varied = [key for key in keys if table[key].nunique() > 1]
    numbers = [key for key in varied if table[key].dtype.kind in "if"]
    words = [key for key in varied if key not in numbers]
    groups = list(table.groupby(words if len(words) > 1 else words[0], sort=False)) if words else [("", table)]
    if len(numbers) == 2 and all(_is_grid(rows, numbers) for _, rows in groups):
        return _maps(table, groups, numbers, result)
    return _panels(table, groups, numbers or words[:1] or keys[:1], result)


def _panels(table, groups, across, result):
    drawn, panels = _new(len(across))
    errors = result + "_error" if result + "_error" in table else None
    for panel, key in zip(panels, across):
        for name, rows in groups:
            rows = rows.sort_values(key, kind="stable") if len(across) == 1 else rows
            panel.errorbar(rows[key], rows[result], rows[errors] if errors else None, marker="o", markersize=4, capsize=2,
                           linestyle="-" if len(across) == 1 and rows[key].is_unique else "none", label=_label(name))
        _name(panel.set_xlabel, table, key)
        _name(panel.set_ylabel, table, result)
        if _spans_far(table[key]):
            panel.set_xscale("log")
    if len(groups) > 1:
        panels[0].legend()
    return drawn


def _maps(table, groups, numbers, result):
    drawn, panels = _new(len(groups))
    low, high = table[result].min(), table[result].max()
    for panel, (name, rows) in zip(panels, groups):
        cells = rows.pivot_table(result, numbers[1], numbers[0], dropna=False)
        shown = panel.pcolormesh(_edges(cells.columns), _edges(cells.index), np.ma.masked_invalid(cells.to_numpy(float)),
                                 vmin=low, vmax=high)
        panel.set_title(_label(name))
        for key, set_label, set_scale in ((numbers[0], panel.set_xlabel, panel.set_xscale),
                                          (numbers[1], panel.set_ylabel, panel.set_yscale)):
            _name(set_label, table, key)
            if _spans_far(table[key]):
                set_scale("log")
    _name(drawn.colorbar(shown, ax=panels).set_label, table, result)
    return drawn


def _new(count):
    drawn = Figure(figsize=(2 + 4.5 * count, 4), layout="constrained")
    return drawn, list(drawn.subplots(1, count, squeeze=False)[0])


def _is_grid(rows, keys):
    """Whether every combination of the values is there."""
    return len(rows[keys].drop_duplicates()) == np.prod([rows[key].nunique() for key in keys])


def _edges(values):
    """Of cells around values, half-way to the next, as the axis counts."""
    ahead, back = (np.log, np.exp) if _spans_far(values) else (np.asarray, np.asarray)
    places = ahead(values.to_numpy(float))
    middles = 0.5 * (places[1:] + places[:-1])
    return back(np.concatenate([[2 * places[0] - middles[0]], middles, [2 * places[-1] - middles[-1]]]))


def _spans_far(values):
    return values.dtype.kind in "if" and values.min() > 0 and values.max() > FAR * values.min()


def _label(name):
    return ", ".join(map(str, name)) if isinstance(name, tuple) else str(name)


def _name(set_label, table, column):
    unit = table.attrs["units"][column]
    set_label(column if unit == "-" else f"{column} [{unit}]")
