"""Where the load was largest: the place of the reading that peak_force of result.yaml is. It is a peak of the curve only
where the load fell behind it: a test that was stopped while the load rose has a largest load, but no peak."""
import numpy as np

from knot_utm.report.quantities import shown
from knot_utm.report.run import PULLING

NEAR = 0.01  # of the pull: a largest load within this of its end was reached there

# How a test ended that nobody and no program stopped.
NOT_STOPPED = {"solver": "the physics gave up", "untangled": "the knot came undone", "operator": "the operator stopped the test",
               "not yet": "the record ends", "interrupted": "the test was cut off"}


class LargestLoad:
    """`rows`, `row`: where it is. `name`: of its mark. `where`: the rest of a sentence that begins with its value.
    `is_peak`: the load fell behind it."""

    def __init__(self, rows, row, name, where, is_peak):
        self.rows, self.row, self.name, self.where, self.is_peak = rows, row, name, where, is_peak


def largest_load(run):
    """None: nothing was pulled."""
    value, pulled, read = run.value("peak_force"), pulled_of(run.tested()), pulled_of(run.tested(run.readings))
    if value is None or not len(pulled):
        return None
    broke, rows = run.value("break_extension"), read if len(read) else pulled
    row = int(np.argmax(rows["load"]))
    if broke is not None and (value > rows["load"][row] or length(run, rows["extension"][row]) == length(run, broke)):
        row = int(np.argmin(np.abs(pulled["extension"] - broke)))  # where it parted the load is read, too
        return LargestLoad(pulled, row, "peak", f"where the rod parted, at {length(run, broke)}", True)
    place, end = float(rows["extension"][row]), float(pulled["extension"].max())
    if row < len(rows) - 1 and end - place > NEAR * float(np.ptp(pulled["extension"])):
        return LargestLoad(rows, row, "peak", f"at an extension of {length(run, place)}", True)
    where = f"at {length(run, place)}, "
    if broke is not None:
        return LargestLoad(rows, row, "peak", where + "before the rod parted", True)
    if set(pulled.phase) == {"cycle"}:
        return LargestLoad(rows, row, "largest load", where + "at the upper turning point of the cycles", False)
    where += f"{'where' if length(run, place) == length(run, end) else 'before'} {end_of_pull(run, pulled)}"
    return LargestLoad(rows, row, "largest load", where, False)


def pulled_of(curve):
    return curve.where(np.isin(curve.phase, PULLING))


def end_of_pull(run, pulled):
    """Why the load went no higher."""
    if run.tested()["time"][-1] > pulled["time"][-1]:
        return "the pull ended"
    return NOT_STOPPED.get(run.result.get("ended_by"), "the test was stopped")


def length(run, metres):
    unit = run.units.length
    return f"{shown(float(metres), unit.scale)} {unit.name}"
