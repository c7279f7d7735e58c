"""The points of a test that its curve and its pictures have in common: a, b, c …, and where the load was largest."""
from collections import namedtuple
from dataclasses import dataclass

import numpy as np

from knot_utm.report.quantities import shown
from knot_utm.report.run import PULLING


# What is marked besides the start, the largest load and the end: by the key that has its extension.
REACHED = {"jump_extension": "a knot jumped open", "lock_extension": "lock", "break_extension": "break"}


@dataclass
class Mark:
    """`names`: what happened there; several where they fall together. Time [s], extension [m], load [N]."""

    names: list
    time: float
    extension: float
    load: float
    letter: str = "a"

    def title(self):
        return ", ".join(self.names)


def mark_at(rows, i, *names, letter="a"):
    return Mark(list(names), *(float(rows[column][i]) for column in ("time", "extension", "load")), letter)


def end_of(curve):
    """The mark at the end, and the only one of a test that ended before anything was pulled."""
    return mark_at(curve, -1, "end of the test")


def marks_of(run):
    """Start of the pull, a knot's jump, lock, largest load, break and end, in order of time; none where nothing was tested."""
    tested, pull, largest = run.curve.tested(), run.curve.pull(), largest_load(run)
    if not len(tested):
        return []
    marks = [mark_at(pull, 0, "start of the pull") if len(pull) else mark_at(tested, 0, "start")]
    marks += [mark_at(largest.rows, largest.row, largest.name)] if largest else []
    marks += [mark_at(pull, int(np.argmin(np.abs(pull["extension"] - run.value(key)))), name)
              for key, name in REACHED.items() if len(pull) and run.value(key) is not None]
    marks.append(end_of(tested))
    return together(marks, 0.01 * (tested["time"][-1] - tested["time"][0]), 0.05 * float(np.abs(tested["load"]).max()))


def together(marks, soon, near):
    """Marks within `soon` [s] and `near` [N] of the one before become one with it, at the later time. Then they get their letters."""
    merged = []
    for mark in sorted(marks, key=lambda mark: mark.time):
        if merged and mark.time - merged[-1].time <= soon and abs(mark.load - merged[-1].load) <= near:
            mark.names = merged.pop().names + mark.names
        merged.append(mark)
    for number, mark in enumerate(merged):
        mark.letter = chr(ord("a") + number)
    return merged


# The largest load is a peak of the curve only where the load fell behind it.
NEAR = 0.01  # of the pull: a largest load within this of its end was reached there

# How a test ended that nobody and no program stopped.
NOT_STOPPED = {"solver": "the physics gave up", "untangled": "the knot came undone", "operator": "the operator stopped the test",
               "not yet": "the record ends", "interrupted": "the test was cut off"}


# `rows`, `row`: where it is. `name`: of its mark. `where`: the rest of a sentence that begins with its value. `is_peak`: the load fell
# behind it.
LargestLoad = namedtuple("LargestLoad", "rows row name where is_peak")


def largest_load(run):
    """None: nothing was pulled."""
    pulled, read = (curve.where(np.isin(curve.phase, PULLING)) for curve in (run.curve, run.readings))
    if run.value("peak_force") is None or not len(pulled):
        return None
    broke, rows = run.value("break_extension"), read if len(read) else pulled
    row = int(np.argmax(rows["load"]))
    if broke is not None and in_length(run, rows["extension"][row]) == in_length(run, broke):
        return LargestLoad(rows, row, "peak", f"where the rod parted, at {in_length(run, broke)}", True)
    place, end = float(rows["extension"][row]), float(pulled["extension"].max())
    if row < len(rows) - 1 and end - place > NEAR * float(np.ptp(pulled["extension"])):
        return LargestLoad(rows, row, "peak", f"at an extension of {in_length(run, place)}", True)
    where = f"at {in_length(run, place)}, "
    if broke is not None:
        return LargestLoad(rows, row, "peak", where + "before the rod parted", True)
    if set(pulled.phase) == {"cycle"}:
        return LargestLoad(rows, row, "largest load", where + "at the upper turning point of the cycles", False)
    where += "where " if in_length(run, place) == in_length(run, end) else "before "
    # Why the load went no higher.
    where += ("the pull ended" if run.curve["time"][-1] > pulled["time"][-1] else
              NOT_STOPPED.get(run.result.get("ended_by"), "the test was stopped"))
    return LargestLoad(rows, row, "largest load", where, False)


def in_length(run, metres):
    unit = run.units.length
    return f"{shown(float(metres), unit.scale)} {unit.name}"
