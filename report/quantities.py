"""Numbers as a person reads them: label, unit and digits of every key of result.yaml, also of those not known here."""
import math

from is_number import is_number
from key_tables import table


class Quantity:
    """How a key is shown. `kind`: of its unit, as units.Units.of takes it."""

    def __init__(self, label, kind=""):
        self.label, self.kind = label, kind


# How a unit of result_keys.csv is shown, where the page has one of its own for it.
KINDS = {"N": "force", "m": "length", "N/m": "stiffness", "m/s": "speed", "bytes": "memory", "-": "", "0 to 1": "", "of the radius": "",
         "of the gauge length": "percent", "of the strength without a knot": "percent"}
# Groups that are no table of results: what they hold has another place on the page.
HEAD, BESIDE, CERTIFICATE = "head", "beside", "certificate"


def keys_of_results():
    """Quantities by group and key, and the titles of the tables in their order. The program writes the file:
    tensile_test --list-results."""
    groups, tables = {}, {}
    for row in table("result_keys.csv"):
        quantity = Quantity(row["meaning"], KINDS.get(row["unit"], row["unit"]))
        groups.setdefault(row["group"], {})[row["key"]] = quantity
        tables[int(row["table"])] = row["group"]
    return groups, [tables[place] for place in sorted(tables) if place > 0]


GROUPS, TABLES = keys_of_results()
KNOWN = {key: quantity for group in GROUPS.values() for key, quantity in group.items()}

# The unit of a key that is not known here, by how it ends: names of quantities are the field's.
ENDINGS = [("_force", "force"), ("_load", "force"), ("_extension", "length"), ("_distance", "length"),
           ("_length", "length"), ("_displacement", "length"), ("_stiffness", "stiffness"), ("_energy", "J"),
           ("_work", "J"), ("_loss", "J"), ("_time", "s"), ("_at", "s"), ("_duration", "s")]


def quantity_of(key):
    if key in KNOWN:
        return KNOWN[key]
    label = key.replace("_", " ").capitalize()
    for ending, kind in ENDINGS:
        if ("_" + key).endswith(ending):
            return Quantity(label, kind)
    return Quantity(label)


NOTHING = 1e-12  # of a reading in SI: what is smaller is rounding


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
    decimals = 3 - math.floor(math.log10(abs(value)))
    if error is not None and is_number(error) and error > 0.0:
        decimals = 1 - math.floor(math.log10(error))
    if -3 < decimals <= 7 or (error is not None and decimals <= 7):
        text = f"{value:.{max(decimals, 0)}f}"
        text = text.rstrip("0").rstrip(".") if error is None and "." in text else text
        return text.replace("-", "–" if float(text) else "")  # never "–0.00"
    mantissa, exponent = f"{value:.3e}".split("e")
    return f"{mantissa.rstrip('0').rstrip('.')} · 10{superscript(int(exponent))}".replace("-", "–")


def superscript(exponent):
    return str(exponent).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))


def error_shown(error, scale):
    """With two digits."""
    return number(float(f"{error * scale:.1e}")) if is_number(error) else ""


def percent(share):
    return number(float(f"{100.0 * share:.3g}")) + " %" if is_number(share) else ""


def with_unit(value, unit, error=None):
    return f"{shown(value, unit.scale, error)} {unit.name}".strip()
