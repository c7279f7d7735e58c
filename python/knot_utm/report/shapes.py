"""The rod as it lay over the time of a test: from its shapes.csv, else the final shape alone."""
import os
from collections import namedtuple

import numpy as np

from knot_utm.errors import refuse_if, WrongInput
from knot_utm.report.run import read_table, require_keys
from knot_utm.yaml_text import read_text

# `time` of the test [s]; `points`: the nodes [m]. `tension`: of each edge [N]; `twist`: of each node [rad/m]; `contact_force`: that
# presses on each node, per length [N/m]. None: not known. `cuts`: edges between one rope and the next, which are no rope.
Shape = namedtuple("Shape", "time points tension twist contact_force cuts", defaults=[None] * 3 + [()])


def ropes(shape):
    """Slices of the nodes of its ropes."""
    ends = [0, *(edge + 1 for edge in shape.cuts), len(shape.points)]
    return [slice(a, b) for a, b in zip(ends[:-1], ends[1:])]


def cuts_of(columns):
    """Edges between nodes of which the ropes have other numbers."""
    return tuple(np.flatnonzero(np.diff(columns["rope"])).tolist()) if "rope" in columns else ()


def lengths(shape):
    return np.linalg.norm(np.diff(shape.points, axis=0), axis=1)


def shapes_of(run):
    """All that the folder of a run has, in order, and what is to be said of them: a line, or nothing."""
    file = os.path.join(run.folder, "shapes.csv")
    if os.path.exists(file):
        *shapes, last = shapes_in(file)
        return shapes if shapes and last.tension is None else [*shapes, last], ""  # of a rod that has just parted no tension is known
    return [final_shape(run)], "There is no shapes.csv (tensile_test --shapes), so only the final shape is shown, without tensions."


def shapes_in(file):
    names, _, *rows = read_text(file).splitlines() + 2 * [""]
    try:  # which may be long, and holds nothing but numbers
        table = dict(zip(names.split(","), np.loadtxt(filter(None, rows), delimiter=",", comments=None, ndmin=2).T))
    except ValueError as why:
        raise WrongInput(f"{file}: {why}") from why
    require_keys(file, table, ("time", "node", "x", "y", "z", "tension", "twist", "contact_force"), "column")
    begins = np.flatnonzero(table["node"] == 0)
    refuse_if(not len(begins), f"{file}: it holds no shape")
    found = []
    for begin, end in zip(begins, [*begins[1:], len(table["node"])]):
        columns = {name: column[begin:end] for name, column in table.items()}
        cuts, tension = cuts_of(columns), columns["tension"][:-1].copy()
        tension[list(cuts)] = 0.0
        points = np.column_stack([columns[name] for name in ("x", "y", "z")])
        shape = Shape(float(columns["time"][0]), points, known(tension), contact_force=known(columns["contact_force"]), cuts=cuts)
        found.append(shape._replace(twist=known(np.concatenate([filled(columns["twist"][rope]) for rope in ropes(shape)]))))
    return found


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


def nearest(shapes, time):
    return min(shapes, key=lambda shape: abs(shape.time - time))
