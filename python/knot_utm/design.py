"""The points of a study: which values its varied keys take, run by run."""
import itertools
import math
import warnings

import numpy as np
from scipy import stats

from knot_utm.errors import WrongInput
from knot_utm.yaml_text import is_number, text_of

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


class Drawn:
    """A key that takes the values of a distribution."""

    def __init__(self, distribution):
        self.distribution = distribution

    def at(self, shares):
        """The quantiles; a share of 0 would be infinitely far out for some."""
        return self.distribution.ppf(np.clip(shares, 2.0**-31, 1.0 - 2.0**-31)).tolist()


def varied(key, given, map_of="vary"):
    """What the study says of one key, as Listed or Drawn, in the unit that it gives. Raises WrongInput."""
    where = f"{map_of}.{key}"
    if isinstance(given, list) and given:
        return Listed(given)
    if not isinstance(given, dict):
        raise WrongInput(f"{where} is {text_of(given)}, but must be a list of values, a range {RANGE}, or a draw {DRAW}")
    given = {part: value for part, value in given.items() if part != "unit"}
    if "values" in given:
        return _values(where, given)
    return _drawn(where, given) if "draw" in given else _range(where, given)


def points(kinds, design, runs=None, seed=1):
    """[{key: value}] of every run. `kinds`: {key: Listed or Drawn}; `runs`: of the designs that draw."""
    made = {"grid": _grid, "one_at_a_time": _one_at_a_time, "list": _list, "sobol": _sobol}[design](kinds, runs, seed)
    return [dict(zip(kinds, values)) for values in made]


def combinations(kinds, where="vary", what="a grid"):
    """[{key: value}] of every combination, the last key fastest. `where` and `what` are for messages."""
    _require_listed(kinds, where, what)
    count = math.prod(len(kind.values) for kind in kinds.values())
    if count > MOST_RUNS:
        raise WrongInput(f"{where} asks for {count} runs, but must ask for at most {MOST_RUNS}")
    return [dict(zip(kinds, values)) for values in itertools.product(*(kind.values for kind in kinds.values()))]


def _require_listed(kinds, where, what):
    for key, kind in kinds.items():
        if isinstance(kind, Drawn):
            raise WrongInput(f"{where}.{key} is drawn or has no steps, but {what} needs values: give steps, or design: list or "
                             "sobol")


def _grid(kinds, _runs, _seed):
    return [point.values() for point in combinations(kinds)]


def _one_at_a_time(kinds, _runs, _seed):
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
        if length != wanted:
            raise WrongInput(f"vary.{key} has {length} values, but must have {wanted} in this design: list, or one")
    count = runs or next(iter(lengths.values()), None)
    if count is None and any(isinstance(kind, Drawn) for kind in kinds.values()):
        raise WrongInput("runs is missing: give how many are drawn")
    count = count or 1
    columns = []
    for kind, stream in zip(kinds.values(), np.random.SeedSequence(seed).spawn(len(kinds))):
        if isinstance(kind, Drawn):
            columns.append(kind.at(np.random.default_rng(stream).random(count)))
        else:
            columns.append(kind.values * count if len(kind.values) == 1 else kind.values)
    return zip(*columns)


def _sobol(kinds, runs, seed):
    """Quantiles at Sobol's points, scrambled by the seed."""
    if runs is None:
        raise WrongInput("runs is missing: give how many points, best a power of two")
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", message="The balance properties")
        shares = stats.qmc.Sobol(len(kinds), seed=seed).random(runs)
    return zip(*(kind.at(column) for kind, column in zip(kinds.values(), shares.T)))


def _values(where, given):
    """A list in a map, where it may have a unit."""
    _only(where, given, ("values",), VALUES)
    values = given["values"]
    if not isinstance(values, list) or not values or not all(is_number(value) for value in values):
        raise WrongInput(f"{where}.values is {text_of(values)}, but must be a list of numbers")
    return Listed(values)


def _range(where, given):
    _only(where, given, ("from", "to", "steps", "scale"), RANGE)
    low, high = _number(where, given, "from"), _number(where, given, "to")
    scale = given.get("scale", "linear")
    if scale not in ("linear", "log"):
        raise WrongInput(f"{where}.scale is {text_of(scale)}, but must be linear or log")
    if scale == "log":
        _require_positive(where, low, high)
    if "steps" not in given:
        return Drawn(_between(where, low, high, scale == "log"))
    steps = given["steps"]
    if not isinstance(steps, int) or isinstance(steps, bool) or not 2 <= steps <= MOST_RUNS:
        raise WrongInput(f"{where}.steps is {text_of(steps)}, but must be an integer from 2 to {MOST_RUNS}")
    return Listed((np.geomspace if scale == "log" else np.linspace)(low, high, steps).tolist())


def _drawn(where, given):
    name = given["draw"]
    if not isinstance(name, str) or name not in DRAWS:
        raise WrongInput(f"{where}.draw is {text_of(name)}, but must be " + ", ".join(DRAWS))
    _only(where, given, ("draw", *DRAWS[name]), DRAW)
    first, second = (_number(where, given, part) for part in DRAWS[name])
    if name == "normal":
        if second <= 0:
            raise WrongInput(f"{where}.sd is {text_of(second)}, but must be above 0")
        return Drawn(stats.norm(first, second))
    if name == "log_uniform":
        _require_positive(where, first, second)
    return Drawn(_between(where, first, second, name == "log_uniform"))


def _between(where, low, high, log):
    if not low < high:
        raise WrongInput(f"{where}.to is {text_of(high)}, but must be above from, {text_of(low)}")
    return stats.loguniform(low, high) if log else stats.uniform(low, high - low)


def _require_positive(where, *values):
    for part, value in zip(("from", "to"), values):
        if value <= 0:
            raise WrongInput(f"{where}.{part} is {text_of(value)}, but must be above 0 on a logarithmic scale")


def _only(where, given, parts, meant):
    for part in given:
        if part not in parts:
            raise WrongInput(f"{where}.{part} is no key of {meant}")


def _number(where, given, part):
    if part not in given:
        raise WrongInput(f"{where}.{part} is missing: give a number")
    value = given[part]
    if not is_number(value):
        raise WrongInput(f"{where}.{part} is {text_of(value)}, but must be a number")
    return float(value)
