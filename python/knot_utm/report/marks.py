"""The points of a test that its curve and its pictures have in common: a, b, c …"""
import numpy as np

from knot_utm.report.largest_load import largest_load


class Mark:
    """`names`: what happened there; several where they fall together. Time [s], extension [m], load [N]; NaN: none is
    known, behind a break."""

    def __init__(self, names, time, extension, load):
        self.names, self.time, self.extension, self.load = names, time, extension, load
        self.letter = ""

    def title(self):
        return ", ".join(self.names)


def time_of_break(marks):
    """[s]; None: the rod is whole."""
    return next((mark.time for mark in marks if "break" in mark.names), None)


def marks_of(run):
    """Start of the pull, a knot's jump, lock, largest load, break and end, in order of time; none where nothing was tested."""
    tested = run.tested()
    if not len(tested):
        return []
    pull = run.pull()
    begin = pull if len(pull) else tested
    found = [("start of the pull" if len(pull) else "start", begin, 0)]
    found += reached(pull, "a knot jumped open", run.value("jump_extension"))
    found += reached(pull, "lock", run.value("lock_extension"))
    largest = largest_load(run)
    if largest:
        found.append((largest.name, largest.rows, largest.row))
    found += reached(pull, "break", run.value("break_extension"))
    all_marks = [Mark([name], rows["time"][i], rows["extension"][i], rows["load"][i]) for name, rows, i in found]
    all_marks.append(end_of(run.curve.tested()))
    if run.time_of_break() is not None:
        all_marks[-1].load = np.nan
    return together(all_marks, 0.01 * (tested["time"][-1] - tested["time"][0]), 0.05 * float(np.abs(tested["load"]).max()))


def end_of(curve):
    """The mark at the end, and the only one of a test that ended before anything was pulled."""
    mark = Mark(["end of the test"], curve["time"][-1], curve["extension"][-1], curve["load"][-1])
    mark.letter = "a"
    return mark


def reached(pull, name, extension):
    """The row of the pull that is nearest to an extension; none where there is none."""
    if extension is None or not len(pull):
        return []
    return [(name, pull, int(np.argmin(np.abs(pull["extension"] - extension))))]


def together(marks, soon, near):
    """Marks within `soon` [s] and `near` [N] of the one before become one with it, at the later time; a break lies
    between others. Then they get their letters."""
    merged = []
    for mark in sorted(marks, key=lambda mark: mark.time):
        if merged and mark.time - merged[-1].time <= soon and abs(mark.load - merged[-1].load) <= near:
            mark.names = merged.pop().names + mark.names
        merged.append(mark)
    for number, mark in enumerate(merged):
        mark.letter = chr(ord("a") + number)
    return merged
