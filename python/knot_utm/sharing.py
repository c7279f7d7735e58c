"""Which runs share all that comes before a step of their program, so that it need be computed only once."""
import json
from collections import Counter
from dataclasses import dataclass

from knot_utm.yaml_text import load

# Sections that say what is made of a test, and when it ends, but not what is done to the specimen.
AFTERWARDS = ("ends", "analysis", "report", "specification")
AT_ONCE = "balance"  # a step that takes no time


@dataclass(frozen=True)
class Beginning:
    """Of several runs: one of them up to `step`, before which it stops."""

    point: dict   # {key: value} of the first of them
    step: int     # of the program
    shared: dict  # those of the keys that the beginning depends on


def beginnings(method, points):
    """[Beginning or None], one for each of `points`, up to the latest step before which some of them are the same. None of a
    run that shares nothing, or nothing that takes time. `tensile_test` has the last word on what can be shared."""
    steps = _steps(load(method))
    places = {key: _place(key, steps) for key in points[0]}
    if "program" in places or None in places.values():
        return [None] * len(points)
    varied = {places[key] for key in places if len({_text(point[key]) for point in points}) > 1}
    for step in sorted(varied, reverse=True):
        if 0 <= step < len(steps) and set(steps[:step]) - {AT_ONCE}:
            shared = [{key: value for key, value in point.items() if places[key] < step} for point in points]
            groups = Counter(map(_text, shared))
            if len(groups) < len(points):
                first = {}
                for point, part in zip(points, shared):
                    first.setdefault(_text(part), Beginning(point, step, part))
                return [first[_text(part)] if groups[_text(part)] > 1 else None for part in shared]
    return [None] * len(points)


def _steps(method):
    """The names of the program's steps."""
    program = method.get("program") if isinstance(method, dict) else None
    return [next(iter(step), "") if isinstance(step, dict) else "" for step in program] if isinstance(program, list) else []


def _place(key, steps):
    """The step from which on a key matters; -1 of those that matter from the start; None where that cannot be told."""
    first, *further = key.split(".")
    if first in AFTERWARDS:
        return len(steps)
    if first != "program":
        return -1
    if not further:
        return None
    if further[0].isdigit():
        return int(further[0]) if int(further[0]) < len(steps) else None
    return steps.index(further[0]) if steps.count(further[0]) == 1 else None


def _text(value):
    return json.dumps(value, sort_keys=True, default=str)
