"""Numbers as a person reads them: the label, unit and digits of every key of result.yaml, also of those not known here, and the
units of a page. Files are in SI; a page is in what its reader measures with."""
import math
import re
from collections import namedtuple

from knot_utm import tool
from knot_utm.yaml_text import is_number

FORCES = {"N": 1.0, "kN": 1e-3, "lbf": 1.0 / 4.4482216152605}
LENGTHS = {"mm": 1e3, "in": 1.0 / 0.0254, "m": 1.0}


# A value in SI times `scale` has the unit `name`.
Unit = namedtuple("Unit", "name scale", defaults=[1.0])
# How a key is shown. `kind`: of its unit, as Units.of takes it.
Quantity = namedtuple("Quantity", "label kind", defaults=[""])


class Units:
    def __init__(self, force="N", length="mm"):
        self.force, self.length = Unit(force, FORCES[force]), Unit(length, LENGTHS[length])
        self.stiffness = Unit(f"{force}/{length}", self.force.scale / self.length.scale)
        self.speed = Unit(f"{length}/s", self.length.scale)
        self.force_rate = Unit(f"{force}/s", self.force.scale)
        self.rate = Unit(f"{length}/min", 60.0 * self.length.scale)
        self.memory = Unit("MB", 1e-6)
        self.percent = Unit("%", 100.0)
        self.are_default = (force, length) == ("N", "mm")

    def of(self, kind):
        """`kind`: one of the quantities above, else the name of a unit that every page uses."""
        return getattr(self, kind) if kind in ("force", "length", "stiffness", "speed", "force_rate", "memory",
                                               "percent") else Unit(kind)


def units_of(report):
    """The units that `report` of a method asks for."""
    asked = report.get("units") or {}
    return Units(asked.get("force", "N"), asked.get("length", "mm"))


# How a unit of a reading is shown, where the page has one of its own for it.
KINDS = {"N": "force", "m": "length", "N/m": "stiffness", "m/s": "speed", "bytes": "memory", "-": "", "0 to 1": "", "of the radius": "",
         "of the gauge length": "percent", "of the strength without a knot": "percent"}
# Groups that are no table of results: what they hold has another place on the page.
HEAD, CERTIFICATE = "head", "certificate"


KNOWN, GROUPS = {}, {}  # quantities by key; keys by group
for row in tool.listing("results"):
    KNOWN[row["key"]] = Quantity(row["meaning"], KINDS.get(row["unit"], row["unit"]))
    GROUPS.setdefault(row["group"], []).append(row["key"])
# The titles of the tables in their order.
TABLES = [title for place, title in sorted({(int(row["table"]), row["group"]) for row in tool.listing("results")}) if place > 0]


def quantity_of(key):
    """A key that is not known here has no unit."""
    return KNOWN.get(key) or Quantity(key.replace("_", " ").capitalize())


NOTHING = 1e-12  # of a reading in SI: what is smaller is rounding
# What is left of another reading, such as the elongation that an elastic rod keeps: below a millionth of it is none.
LEFT_OF = {"hysteresis": "energy_to_peak", "elongation_residual": "elongation_total"}


def is_rounding(key, value_of):
    """`value_of`: the number of a key, or None."""
    value, whole = value_of(key), value_of(LEFT_OF.get(key, key))
    if not is_number(value):
        return False
    return abs(value) < NOTHING or (key in LEFT_OF and is_number(whole) and abs(value) < 1e-6 * abs(whole))


def shown(value, scale=1.0, error=None):
    """A value of any kind as text. A number has four digits, or as many as its error leaves meaningful."""
    if value is None:
        return "–"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, int) and scale == 1.0:
        return str(value)
    if isinstance(value, (int, float)):
        return "0" if abs(value) < NOTHING else number(value * scale, None if error is None else error * scale)
    if isinstance(value, dict):
        return ", ".join(f"{name.replace('_', ' ')} {shown(part)}" for name, part in value.items()) or "–"
    if isinstance(value, (list, tuple)):
        return "; ".join(shown(part, scale) for part in value) or "–"
    return str(value)


def number(value, error=None):
    if not math.isfinite(value):
        return "–"
    if value == 0.0:
        return "0"
    decimals = decimals_of(value, 4)
    if error is not None and is_number(error) and error > 0.0:
        decimals = decimals_of(error, 2)
    if -3 < decimals <= 7 or (error is not None and decimals <= 7):
        text = f"{value:.{max(decimals, 0)}f}"
        text = without_zeros(text, value) if error is None else text
        return text.replace("-", "–" if float(text) else "")  # never "–0.00"
    mantissa, exponent = f"{value:.3e}".split("e")
    raised = str(int(exponent)).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))
    return f"{without_zeros(mantissa, value / 10.0 ** int(exponent))} · 10{raised}".replace("-", "–")


def decimals_of(value, digits):
    """Behind the point, where so many digits are given. A 9.97 of two digits is 10."""
    return digits - 1 - int(f"{value:.{digits - 1}e}".split("e")[1])


def without_zeros(text, value):
    """Zeros at the end say nothing of what was given, such as 250 mm; in 103.0, a reading of 103.04 mm, they do."""
    return text.rstrip("0").rstrip(".") if "." in text and math.isclose(float(text), value, rel_tol=1e-9) else text


def error_shown(error, scale):
    """With two digits. A value beside it ends at the same decimal place."""
    if not is_number(error):
        return ""
    rounded = float(f"{error * scale:.1e}")
    return number(rounded, rounded if 1e-4 <= rounded < 1e4 else None)


def percent(share):
    return number(float(f"{100.0 * share:.3g}")) + " %" if is_number(share) else ""


def with_unit(value, unit, error=None):
    return f"{shown(value, unit.scale, error)} {unit.name}".strip()


# ---- sentences of the program, which speaks of newtons and metres ----

NUMBER = r"-?\d+(?:\.\d+)?(?:e[-+]?\d+)?"
# "0.41 N", "from 5 to 2.5 N", "0.41 and 0.067 N"; no number that is a part of a word, and no unit that goes on.
VALUES = re.compile(rf"(?<![\w.])({NUMBER})(?:( and | to )({NUMBER}))? (N/m|m/s|N|m)(?![\w/²³^])")


def in_units(text, units):
    def replaced(found):
        unit = units.of(KINDS[found[4]])
        values = [number(float(value) * unit.scale) for value in (found[1], found[3]) if value]
        return f"{(found[2] or '').join(values)} {unit.name}"

    return VALUES.sub(replaced, text)


def all_in_units(texts, units):
    return [in_units(text, units) for text in texts]
