"""What a laboratory says of a test by a standard, beside what the user gives: gauge length, speed and specimens."""
from knot_utm.report.is_number import is_number
from knot_utm.report.quantities import number
from knot_utm.report.run import PULLING


def particulars(report, method, gauge_length, units, specimens=""):
    """[(key, label, text)]; empty where `report` names no standard."""
    if not report.get("standard"):
        return []
    found = [("gauge_length", "Gauge length", in_units(gauge_length, units.length)),
             ("speed", "Speed of the crosshead", in_units(speed_of(method), units.rate)),
             ("specimens", "Specimens", specimens)]
    return [row for row in found if row[2]]


def in_units(value, unit):
    return f"{number(value * unit.scale)} {unit.name}" if is_number(value) else ""


def speed_of(method):
    """Of the last step that pulls [m/s]; None where the load decides it, or where nothing pulls."""
    steps = [keys or {} for step in method.get("program", []) for name, keys in step.items() if name in PULLING]
    return None if not steps or is_number(steps[-1].get("load_rate")) else steps[-1].get("speed")


def counted(tested, rejected):
    return f"{tested} tested, {tested - rejected} count, {rejected} discarded"
