"""Where the load was largest. It is a peak of the curve only where the load fell behind it: a test that was stopped
while the load rose has a largest load, but no peak."""
import numpy as np

from quantities import shown
from run import PULLING

NEAR = 0.01  # of the pull: a largest load within this of its end was reached there

# How a test ended that nobody and no program stopped.
NOT_STOPPED = {"solver": "at the end of the test, where the physics gave up",
               "untangled": "at the end of the test, where the knot came undone",
               "not yet": "at the end of what was recorded",
               "interrupted": "where the test was cut off"}


class LargestLoad:
    """`rows`, `row`: where it is. `name`: of its mark. `where`: the rest of a sentence that begins with its value.
    `is_peak`: the load fell behind it."""

    def __init__(self, rows, row, name, where, is_peak):
        self.rows, self.row, self.name, self.where, self.is_peak = rows, row, name, where, is_peak


def largest_load(run):
    """None: nothing was pulled."""
    tested = run.curve.tested()
    pulled = tested.where(np.isin(tested.phase, PULLING))
    if run.value("peak_force") is None or not len(pulled):
        return None
    row = int(np.argmax(pulled["load"]))
    if run.value("break_extension") is not None and is_near(pulled, row, run.value("break_extension")):
        return LargestLoad(pulled, row, "peak", "where the rod parted", True)
    if not is_near(pulled, row, float(pulled["extension"].max())):
        return LargestLoad(pulled, row, "peak", f"at an extension of {length(run, pulled['extension'][row])}", True)
    return LargestLoad(pulled, row, "largest load", end_of_pull(run, tested, pulled, row), False)


def is_near(pulled, row, extension):
    s = pulled["extension"]
    return abs(float(s[row]) - extension) <= NEAR * float(np.ptp(s))


def end_of_pull(run, tested, pulled, row):
    """Why the load went no higher."""
    place = length(run, pulled["extension"][row])
    if len(set(pulled.phase)) == 1 and pulled.phase[0] == "cycle":
        return "at the upper turning point of the cycles"
    if tested["time"][-1] > pulled["time"][-1]:
        return f"at the end of the pull, at {place}"
    ended_by = run.result.get("ended_by")
    if ended_by in NOT_STOPPED:
        return NOT_STOPPED[ended_by]
    stopped = "the operator stopped" if ended_by == "operator" else "was stopped"
    return f"at the end of the test, which {stopped} at {place}"


def length(run, metres):
    unit = run.units.length
    return f"{shown(float(metres), unit.scale)} {unit.name}"
