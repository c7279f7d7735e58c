"""The keys that a fit may move, and the ranges in which it may."""
import math
import re
from dataclasses import dataclass

from knot_utm.errors import WrongInput
from knot_utm.yaml_text import is_number, text_of

OFFSET = re.compile(r"record(?:\.([1-9]\d*))?\.(force|extension)_offset")
AROUND = 3.0        # a range that is not given: from the method's value over this to that value times this
LOGARITHMIC = 5.0   # high over low, from where the range counts in factors
OFFSET_SHARE = 0.05  # a range of an offset that is not given: of the largest load, of the largest extension


@dataclass(frozen=True)
class FreeKey:
    """One free key. Its place in the range goes from 0 (low) to 1 (high)."""

    name: str
    low: float
    high: float

    def value(self, place):
        if self.low > 0 and self.high > LOGARITHMIC * self.low:
            return self.low * (self.high / self.low) ** place
        return self.low + (self.high - self.low) * place

    @property
    def offset(self):
        """(number of the record, "force" or "extension") of an offset of a record; None of a key of the method."""
        match = OFFSET.fullmatch(self.name)
        return (int(match[1] or 1), match[2]) if match else None


def parse_free(word):
    """`KEY` or `KEY=low:high`: (key, None or (low, high)). Raises WrongInput."""
    name, given, limits = word.partition("=")
    if not name:
        raise WrongInput(f"--free is {word}, but must be KEY or KEY=low:high")
    if name.startswith("record.") and not OFFSET.fullmatch(name):
        raise WrongInput(f"--free: {name} is nothing of a record: it has record.force_offset and record.extension_offset")
    if not given:
        return name, None
    try:
        low, high = (float(limit) for limit in limits.split(":"))
    except ValueError:
        low = high = math.nan
    if not (math.isfinite(low) and math.isfinite(high) and low < high):
        raise WrongInput(f"--free: the range of {name} is {limits}, but must be low:high, two numbers of which the second is "
                         "larger")
    return name, (low, high)


def offset_key(name, limits, records):
    """Of an offset of one of the records, with its range. Raises WrongInput."""
    number, kind = FreeKey(name, 0.0, 0.0).offset
    if number > len(records):
        raise WrongInput(f"--free: {name} is of record {number}, but there are {len(records)}")
    most = OFFSET_SHARE * (records[number - 1].largest_load if kind == "force" else records[number - 1].range)
    return FreeKey(name, *(limits or (-most, most)))


def method_key(name, limits, method, numbers):
    """Of a key of the method, with its range. `method`: as resolved; `numbers`: those of its keys that are numbers and act on the
    test. Raises WrongInput."""
    value = value_at(method, name)
    said = "nothing" if value is None else "several values" if isinstance(value, (dict, list)) else text_of(value)
    if name not in numbers:
        raise WrongInput(f"--free: {name} is {said}, but only a number that acts on the test may be free")
    if limits:
        return FreeKey(name, *limits)
    if not is_number(value) or value <= 0:
        raise WrongInput(f"--free: the method has {said} at {name}, around which no range can be laid: give --free "
                         f"{name}=low:high")
    return FreeKey(name, value / AROUND, value * AROUND)


def value_at(node, path):
    """Of a dotted key of a method; a step of a program is found by its name or its number. None where there is none."""
    name, _, rest = path.partition(".")
    if isinstance(node, list):
        found = next((step[name] for step in node if isinstance(step, dict) and name in step), None)
        if found is None and name.isdigit() and int(name) < len(node):
            found = node[int(name)]
    else:
        found = node.get(name) if isinstance(node, dict) else None
    return value_at(found, rest) if rest and found is not None else found
