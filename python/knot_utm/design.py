"""The points of a study: which values its varied keys take, run by run."""
import itertools
import math
import warnings

import numpy as np
from scipy import stats

from knot_utm.errors import refuse_if
from knot_utm.yaml_text import is_number, is_whole, require, text_of

MOST_RUNS = 1_000_000
RANGE = "{from, to, steps, scale: linear or log}"
DRAW = "{draw: uniform or log_uniform, from, to} or {draw: normal, mean, sd}"
VALUES = "{values: [a, b, ...]}"
DRAWS = {"uniform": ("from", "to"), "log_uniform": ("from", "to"), "normal": ("mean", "sd")}


class Listed:
    """A key that takes the values of a list."""

    def __init__(self, values):
        self.values = values

    def at(self, shares):
        """Those at shares from 0 to 1 of the list."""
        return [self.values[min(int(share * len(self.values)), len(self.values) - 1)] for share in shares]


class Sampled:
    """A key that takes the values of a distribution."""

    def __init__(self, distribution):
        self.distribution = distribution

    def at(self, shares):
        """The quantiles; a share of 0 would be infinitely far out for some."""
        return self.distribution.ppf(np.clip(shares, 2.0**-31, 1.0 - 2.0**-31)).tolist()


def varied(key, given, map_of="vary"):
    """What the study says of one key, as Listed or Sampled, in the unit that it gives. Raises WrongInput."""
    where = f"{map_of}.{key}"
    if isinstance(given, list) and given:
        return Listed(given)
    require(isinstance(given, dict), where, given, f"a list of values, a range {RANGE}, or a draw {DRAW}")
    given = {part: value for part, value in given.items() if part != "unit"}
    if "values" in given:
        return _values(where, given)
    return _drawn(where, given) if "draw" in given else _range(where, given)


def points(kinds, design, runs=None, seed=1):
    """[{key: value}] of every run. `kinds`: {key: Listed or Sampled}; `runs`: of the designs that draw."""
    if design == "grid":
        return combinations(kinds)
    made = _one_at_a_time(kinds) if design == "one_at_a_time" else (_list if design == "list" else _sobol)(kinds, runs, seed)
    return [dict(zip(kinds, values)) for values in made]


def combinations(kinds, where="vary", what="a grid"):
    """[{key: value}] of every combination, the last key fastest. `where` and `what` are for messages."""
    _require_listed(kinds, where, what)
    count = math.prod(len(kind.values) for kind in kinds.values())
    refuse_if(count > MOST_RUNS, f"{where} asks for {count} runs, but must ask for at most {MOST_RUNS}")
    return [dict(zip(kinds, values)) for values in itertools.product(*(kind.values for kind in kinds.values()))]


def _require_listed(kinds, where, what):
    for key, kind in kinds.items():
        refuse_if(isinstance(kind, Sampled), f"{where}.{key} is drawn or has no steps, but {what} needs values: give steps, or design: list or "
                  "sobol")


def _one_at_a_time(kinds):
    """The first values of all keys, and then beside them each other value of each key."""
    _require_listed(kinds, "vary", "one_at_a_time")
    first = [kind.values[0] for kind in kinds.values()]
    changed = [[*first[:i], value, *first[i + 1:]] for i, kind in enumerate(kinds.values()) for value in kind.values[1:]]
    return [first, *changed]


def _list(kinds, runs, seed):
    """The values side by side; a list of one value stands beside every run."""
    lengths = {key: len(kind.values) for key, kind in kinds.items() if isinstance(kind, Listed) and len(kind.values) > 1}
    for key, length in lengths.items():
        wanted = runs or next(iter(lengths.values()))
        refuse_if(length != wanted, f"vary.{key} has {length} values, but must have {wanted} in this design: list, or one")
    count = runs or next(iter(lengths.values()), None)
    refuse_if(count is None and any(isinstance(kind, Sampled) for kind in kinds.values()), "runs is missing: give how many are drawn")
    count = count or 1
    columns = []
    for kind, stream in zip(kinds.values(), np.random.SeedSequence(seed).spawn(len(kinds))):
        if isinstance(kind, Sampled):
            columns.append(kind.at(np.random.default_rng(stream).random(count)))
        else:
            columns.append(kind.values * count if len(kind.values) == 1 else kind.values)
    return zip(*columns)


def _sobol(kinds, runs, seed):
    """Quantiles at Sobol's points, scrambled by the seed."""
    refuse_if(runs is None, "runs is missing: give how many points, best a power of two")
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", message="The balance properties")
        shares = stats.qmc.Sobol(len(kinds), seed=seed).random(runs)
    return zip(*(kind.at(column) for kind, column in zip(kinds.values(), shares.T)))


def _values(where, given):
    """A list in a map, where it may have a unit."""
    _only(where, given, ("values",), VALUES)
    values = given["values"]
    require(isinstance(values, list) and values and all(map(is_number, values)), f"{where}.values", values, "a list of numbers")
    return Listed(values)


def _range(where, given):
    _only(where, given, ("from", "to", "steps", "scale"), RANGE)
    low, high, scale, steps = *_numbers(where, given, "from", "to"), given.get("scale", "linear"), given.get("steps")
    require(scale in ("linear", "log"), f"{where}.scale", scale, "linear or log")
    if "steps" not in given:
        return _between(where, low, high, scale == "log")
    _require_positive(where, scale == "log", low, high)
    require(is_whole(steps, 2, MOST_RUNS), f"{where}.steps", steps, f"an integer from 2 to {MOST_RUNS}")
    return Listed((np.geomspace if scale == "log" else np.linspace)(low, high, steps).tolist())


def _drawn(where, given):
    name = given["draw"]
    require(isinstance(name, str) and name in DRAWS, f"{where}.draw", name, ", ".join(DRAWS))
    _only(where, given, ("draw", *DRAWS[name]), DRAW)
    first, second = _numbers(where, given, *DRAWS[name])
    if name != "normal":
        return _between(where, first, second, name == "log_uniform")
    require(second > 0, f"{where}.sd", second, "above 0")
    return Sampled(stats.norm(first, second))


def _between(where, low, high, log):
    _require_positive(where, log, low, high)
    require(low < high, f"{where}.to", high, f"above from, {text_of(low)}")
    return Sampled(stats.loguniform(low, high) if log else stats.uniform(low, high - low))


def _require_positive(where, log, *values):
    for part, value in zip(("from", "to"), values):
        require(not log or value > 0, f"{where}.{part}", value, "above 0 on a logarithmic scale")


def _only(where, given, parts, meant):
    for part in given:
        refuse_if(part not in parts, f"{where}.{part} is no key of {meant}")


def _numbers(where, given, *parts):
    for part in parts:
        refuse_if(part not in given, f"{where}.{part} is missing: give a number")
        require(is_number(given[part]), f"{where}.{part}", given[part], "a number")
    return [float(given[part]) for part in parts]
