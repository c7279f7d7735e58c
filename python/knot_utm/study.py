"""A study: a method, the keys of it that are varied, and how (doc/studies.md)."""
import itertools
import os
from dataclasses import dataclass

from knot_utm import design, groups, tool
from knot_utm.errors import refuse_if, WrongInput
from knot_utm.yaml_text import is_number, is_whole, load, require, text_of, value_at

KEYS = ("method", "for_each", "vary", "below", "design", "runs", "repeat", "seed")
DESIGNS = ("grid", "one_at_a_time", "list", "sobol")
DRAWING = ("list", "sobol")
INTEGERS = {"runs": (1, design.MOST_RUNS, None), "seed": (0, 2**32 - 1, 1), "repeat": (1, 10_000, 1)}  # least, most, where none is given


@dataclass(frozen=True)
class Study:
    """One whole study: every run is the method with other values of the keys. With repeats a run is a batch of specimens."""

    file: str
    method: str    # path of the method's file
    points: list   # [{key: value}], one a run
    repeat: int
    cases: tuple   # the keys of for_each: with each of their combinations the design begins anew
    design: str
    below: dict    # {key: the key that it is below in all runs}

    @property
    def name(self):
        return os.path.splitext(os.path.basename(self.file))[0]

    @property
    def keys(self):
        return list(self.points[0])

    @property
    def settings(self):
        """[{key: value}] of every run, with all that it is told."""
        return [{**point, tool.COUNT: self.repeat} for point in self.points] if self.repeat > 1 else self.points


def load_study(file):
    """Reads a study's file. Raises WrongInput, which names file, key and value."""
    given = load(file)
    try:
        return _study(file, given)
    except WrongInput as wrong:
        raise WrongInput(f"{file}: {wrong}") from wrong


def _study(file, given):
    refuse_if(not isinstance(given, dict), "a study is a map with the keys " + ", ".join(KEYS))
    for key in given:
        refuse_if(key not in KEYS, f"{key} is no key of a study; its keys are " + ", ".join(KEYS))
    method = tool.find_method(_method(given), os.path.dirname(os.path.abspath(file)))
    refuse_if((count := value_at(load(method), tool.COUNT) or 1) != 1,
              f"method: {method} has specimens.count {text_of(count)}, but a run of a study is one specimen: give repeat")
    vary, cases = _keys(given, "vary"), _keys(given, "for_each") if "for_each" in given else {}
    kind = given.get("design", "grid")
    require(kind in DESIGNS, "design", kind, ", ".join(DESIGNS))
    runs, seed, repeat = (_integer(given, key, *limits) for key, limits in INTEGERS.items())
    for name in ("runs", "seed"):
        if name in given and kind not in DRAWING:
            raise WrongInput(f"{name} is {given[name]}, but has no effect in a {kind}")
    for key in cases:
        refuse_if(key in vary, f"vary has the key {key}, which stands in for_each, too")
    units = groups.asked({**cases, **vary})
    kinds = {key: design.varied(key, values) for key, values in vary.items()}
    made = design.points(kinds, kind, runs, seed)
    each = design.combinations({key: design.varied(key, values, "for_each") for key, values in cases.items()}, "for_each",
                               "for_each")
    points = _within(given, groups.in_si(method, [{**case, **point} for case in each for point in made], units))
    refuse_if(len(points) * repeat > design.MOST_RUNS, f"repeat is {repeat}: these are {len(points) * repeat} tests, of at most {design.MOST_RUNS}")
    return Study(file, method, points, repeat, tuple(cases), kind, given.get("below", {}))


def _within(given, points):
    """The points where each key of `below` is below the key that it names."""
    below = given.get("below", {})
    require(isinstance(below, dict), "below", below, "a map of a key that is varied and the key that it must be below")
    for key in itertools.chain(*below.items()):
        refuse_if(key not in points[0] or not all(is_number(point[key]) for point in points),
                  f"below has the key {text_of(key)}, but must have numbers that are varied")
    left = [point for point in points if all(point[low] < point[high] for low, high in below.items())]
    refuse_if(not left, f"below is {text_of(below)}: no run is left")
    return left


def _keys(given, name):
    """{key of the method: its values}."""
    keys = given.get(name)
    require(isinstance(keys, dict) and keys, name, keys, "a map of at least one key of the method and its values")
    for key in keys:
        refuse_if(key in (tool.COUNT, "specimens"), f"{name} has the key {key}, but a run of a study is one specimen: give repeat")
    return keys


def _method(given):
    method = given.get("method")
    refuse_if(method is None, "method is missing: give a file, from the folder of the study, or the name of a shipped method")
    require(isinstance(method, str) and method, "method", method, "a file or a name")
    return method


def _integer(given, key, low, high, usual):
    if key not in given:
        return usual
    require(is_whole(given[key], low, high), key, given[key], f"an integer from {low} to {high}")
    return given[key]
