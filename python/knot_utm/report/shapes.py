"""The rod as it lay over the time of a test: from its shapes.csv, else the final shape alone."""
import os
from collections import namedtuple

import numpy as np

from knot_utm.report.commands import CannotReport
from knot_utm.report.run import read_table, read_text, require_keys

# `time` of the test [s]; `points`: the nodes [m]. `tension`: of each edge [N]; `twist`: of each node [rad/m]; `contact_force`: that
# presses on each node, per length [N/m]. None: not known. `cuts`: edges between one rope and the next, which are no rope.
Shape = namedtuple("Shape", "time points tension twist contact_force cuts", defaults=[None] * 3 + [()])


class Series:
    """Shapes in order of their `times` [s]; `shape(i)` gives one."""

    def __init__(self, times, shape):
        self.times, self.shape = np.asarray(times, dtype=float), shape

    def __len__(self):
        return len(self.times)

    def at(self, time, broke=None):
        """The shape nearest to a time; of a time before the rod `broke` one from before that."""
        return self.shape(nearest(self.times, time, broke))


def ropes(shape):
    """Slices of the nodes of its ropes."""
    ends = [0, *(edge + 1 for edge in shape.cuts), len(shape.points)]
    return [slice(a, b) for a, b in zip(ends[:-1], ends[1:])]


def cuts_of(columns):
    """Edges between nodes of which the ropes have other numbers."""
    return tuple(np.flatnonzero(np.diff(columns["rope"])).tolist()) if "rope" in columns else ()


def lengths(shape):
    return np.linalg.norm(np.diff(shape.points, axis=0), axis=1)


def series_of(run):
    """All shapes that the folder of a run has, and what is to be said of them: a line, or nothing."""
    file = os.path.join(run.folder, "shapes.csv")
    if os.path.exists(file):
        return series_of_csv(file), ""
    shape = final_shape(run)
    return Series([shape.time], lambda _: shape), "There is no shapes.csv, so only the final shape is shown, without tensions."


def shapes_at(series, times, broke=None, final=None):
    """The shape nearest to each time, in the order of `times`, or the only one that there is. Of a time before the rod
    `broke` a shape that is from before that, of a later one the `final` shape where none is from behind it."""
    if len(series) == 1:
        return [series.shape(0)]
    found = [series.at(time, broke) for time in times]
    return [final if broke is not None and final and shape.time <= broke < time else shape for shape, time in zip(found, times)]


def series_of_csv(file):
    names, _, *rows = read_text(file).splitlines() + 2 * [""]
    try:  # which may be long, and holds nothing but numbers
        columns = dict(zip(names.split(","), np.loadtxt(filter(None, rows), delimiter=",", comments=None, ndmin=2).T))
    except ValueError as why:
        raise CannotReport(f"{file}: {why}") from why
    require_keys(file, columns, ("time", "node", "x", "y", "z", "tension", "twist", "contact_force"), "column")
    begins = np.flatnonzero(columns["node"] == 0)
    if not len(begins):
        raise CannotReport(f"{file}: it holds no shape")
    ends = [*begins[1:], len(columns["node"])]

    def shape(i):
        rows = slice(begins[i], ends[i])
        points = np.column_stack([columns[name][rows] for name in ("x", "y", "z")])
        cuts = cuts_of({name: column[rows] for name, column in columns.items() if name == "rope"})
        tension, twist = columns["tension"][rows][:-1].copy(), columns["twist"][rows]
        tension[list(cuts)] = 0.0
        found = Shape(float(columns["time"][begins[i]]), points, known(tension), contact_force=known(columns["contact_force"][rows]), cuts=cuts)
        return found._replace(twist=known(np.concatenate([filled(twist[rope]) for rope in ropes(found)])))

    return Series(columns["time"][begins], shape)


def filled(twist):
    """It is measured between two edges: the end nodes of a rope have that of their neighbours."""
    return np.concatenate([twist[1:2], twist[1:-1], twist[-2:-1]]) if len(twist) > 2 else twist


def known(values):
    return values if np.isfinite(values).all() else None


def final_shape(run):
    file = os.path.join(run.folder, "final_shape.csv")
    columns = read_table(file, ("x", "y", "z"))
    points = np.column_stack([columns[name] for name in ("x", "y", "z")])
    return Shape(run.curve["time"][-1] if len(run.curve) else 0.0, points, cuts=cuts_of(columns))


def nearest(seconds, time, broke):
    i = int(np.argmin(np.abs(seconds - time)))
    return i - 1 if broke is not None and i > 0 and time <= broke < seconds[i] else i
