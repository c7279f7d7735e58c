"""The log of a LineScale 3, a load cell in a line without a machine: loads alone, at the rate that its head says.

Its form is that of the program linescaleGUI (src/logfile/logfile.cpp): thirteen lines with the device, date, time, LogNo, Unit, Mode, RelZero,
Speed, Trig, Stop, Pre, Catch and Total, and then a load in each line. Owners find the true rate 0.90 to 0.91 of the one that is said, with
some firmwares (PyLS3, TimingCorrectionFactor)."""
import re

from knot_utm.errors import WrongInput
from knot_utm.importing.names import QUANTITIES
from knot_utm.importing.text import mark_of_decimals, number, shown

KEYS = "LogNo", "Unit", "Mode", "Speed"
LONGEST = 40  # lines of a head


def load_cell_of(text, file, rate):
    """(times, loads, notes) of such a log; None of another file. `rate`: instead of that of the head, unless 0. Raises WrongInput."""
    rows = [row.strip("\r\t ;,\"") for row in text.split("\n")]
    head = {key: (i, value) for i, row in enumerate(rows[:LONGEST]) if len(parts := re.split(" *[=:;,\t] *", row, 1)) == 2
            for key, value in [parts]}
    if not all(key in head for key in KEYS):
        return None
    (_, unit), (_, speed) = head["Unit"], head["Speed"]
    size, said = QUANTITIES[2].si(unit), number(speed, ".")
    if size is None:
        raise WrongInput(f"{shown(file)}: Unit is {shown(unit)}, but must be {QUANTITIES[2].allowed}")
    if not rate and not said:
        raise WrongInput(f"{shown(file)}: Speed is {shown(speed)}, but must be readings per second: --rate gives them")
    cells = [(i, row) for i, row in enumerate(rows) if row and i > max(place for place, _ in head.values())]
    mark = mark_of_decimals(cell for _, cell in cells)[0] or "."
    loads = []
    for i, cell in cells:
        value = number(cell, mark)
        if value is None:
            raise WrongInput(f"{shown(file)}: row {i + 1} is \"{shown(cell)}\", but must be a load")
        loads.append(value * size)
    if not loads:
        raise WrongInput(f"{shown(file)}: no load follows the head")
    notes = [f"{len(loads)} loads of a LineScale in {unit}, {rate or said:g} a second, and no travel"]
    if not rate:
        notes.append(f"with some firmwares the true rate is 0.9 of that which the head says: --rate {0.9 * said:g} takes that")
    if head["Mode"][1] == "REL" and "RelZero" in head:
        notes.append(f"its loads are relative to {head['RelZero'][1]} {unit}")
    return [i / (rate or said) for i in range(len(loads))], loads, notes
