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


def varied(key, given, map_of="vary"):
    """What the study says of one key: a list of values, or a distribution of scipy's, in the unit that it gives. Raises WrongInput."""
    where = f"{map_of}.{key}"
    if isinstance(given, list) and given:
        return given
    require(isinstance(given, dict), where, given, f"a list of values, a range {RANGE}, or a draw {DRAW}")
    given = {part: value for part, value in given.items() if part != "unit"}
    if "values" in given:
        return _values(where, given)
    return _drawn(where, given) if "draw" in given else _range(where, given)


def points(kinds, design, runs=None, seed=1):
    """[{key: value}] of every run. `kinds`: {key: list or distribution}; `runs`: of the designs that draw."""
    if design == "grid":
        return combinations(kinds)
    made = _one_at_a_time(kinds) if design == "one_at_a_time" else (_list if design == "list" else _sobol)(kinds, runs, seed)
    return [dict(zip(kinds, values)) for values in made]


def combinations(kinds, where="vary", what="a grid"):
    """[{key: value}] of every combination, the last key fastest. `where` and `what` are for messages."""
    _require_listed(kinds, where, what)
    count = math.prod(map(len, kinds.values()))
    refuse_if(count > MOST_RUNS, f"{where} asks for {count} runs, but must ask for at most {MOST_RUNS}")
    return [dict(zip(kinds, values)) for values in itertools.product(*kinds.values())]


def _require_listed(kinds, where, what):
    for key, kind in kinds.items():
        refuse_if(not isinstance(kind, list), f"{where}.{key} is drawn or has no steps, but {what} needs values: give steps, or design: list "
                  "or sobol")


def _one_at_a_time(kinds):
    """The first values of all keys, and then beside them each other value of each key."""
    _require_listed(kinds, "vary", "one_at_a_time")
    first = [values[0] for values in kinds.values()]
    return [first, *([*first[:i], value, *first[i + 1:]] for i, values in enumerate(kinds.values()) for value in values[1:])]


def _list(kinds, runs, seed):
    """The values side by side; a list of one value stands beside every run."""
    lengths = {key: len(kind) for key, kind in kinds.items() if isinstance(kind, list) and len(kind) > 1}
    count = runs or next(iter(lengths.values()), None)
    for key, length in lengths.items():
        refuse_if(length != count, f"vary.{key} has {length} values, but must have {count} in this design: list, or one")
    refuse_if(not count and not all(isinstance(kind, list) for kind in kinds.values()), "runs is missing: give how many are drawn")
    count, streams = count or 1, np.random.SeedSequence(seed).spawn(len(kinds))
    return zip(*((kind if len(kind) > 1 else kind * count) if isinstance(kind, list) else _at(kind, np.random.default_rng(stream).random(count))
                 for kind, stream in zip(kinds.values(), streams)))


def _sobol(kinds, runs, seed):
    """Sobol's points, scrambled by the seed."""
    refuse_if(runs is None, "runs is missing: give how many points, best a power of two")
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", message="The balance properties")
        shares = stats.qmc.Sobol(len(kinds), seed=seed).random(runs)
    return zip(*(_at(kind, column) for kind, column in zip(kinds.values(), shares.T)))


def _at(kind, shares):
    """The values of a list at shares of it from 0 to 1, or the quantiles of a distribution; one of 0 would be infinitely far out for some."""
    if isinstance(kind, list):
        return [kind[min(int(share * len(kind)), len(kind) - 1)] for share in shares]
    return kind.ppf(np.clip(shares, 2.0**-31, 1.0 - 2.0**-31)).tolist()


def _values(where, given):
    """A list in a map, where it may have a unit."""
    _only(where, given, ("values",), VALUES)
    values = given["values"]
    require(isinstance(values, list) and values and all(map(is_number, values)), f"{where}.values", values, "a list of numbers")
    return values


def _range(where, given):
    _only(where, given, ("from", "to", "steps", "scale"), RANGE)
    low, high, scale, steps = *_numbers(where, given, "from", "to"), given.get("scale", "linear"), given.get("steps")
    require(scale in ("linear", "log"), f"{where}.scale", scale, "linear or log")
    if "steps" not in given:
        return _between(where, low, high, scale == "log")
    _require_positive(where, scale == "log", low, high)
    require(is_whole(steps, 2, MOST_RUNS), f"{where}.steps", steps, f"an integer from 2 to {MOST_RUNS}")
    return (np.geomspace if scale == "log" else np.linspace)(low, high, steps).tolist()


def _drawn(where, given):
    name = given["draw"]
    require(isinstance(name, str) and name in DRAWS, f"{where}.draw", name, ", ".join(DRAWS))
    _only(where, given, ("draw", *DRAWS[name]), DRAW)
    first, second = _numbers(where, given, *DRAWS[name])
    if name != "normal":
        return _between(where, first, second, name == "log_uniform")
    require(second > 0, f"{where}.sd", second, "above 0")
    return stats.norm(first, second)


def _between(where, low, high, log):
    _require_positive(where, log, low, high)
    require(low < high, f"{where}.to", high, f"above from, {text_of(low)}")
    return stats.loguniform(low, high) if log else stats.uniform(low, high - low)


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
