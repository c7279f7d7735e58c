"""The log of a LineScale 3, a load cell in a line without a machine: loads alone, at the rate that its head says.

Its form is that of the program linescaleGUI (src/logfile/logfile.cpp): the device, date, time, LogNo, Unit, Mode, RelZero, Speed, Trig, Stop,
Pre, Catch and Total in a line each, and a load in each line behind them. Owners find the true rate 0.9 of the one that is said, with some
firmwares (PyLS3, TimingCorrectionFactor)."""
import math
import re

from knot_utm.errors import WrongInput
from knot_utm.importing.names import QUANTITIES
from knot_utm.importing.text import mark_of_decimals, number, shown

KEY = re.compile(r"([A-Za-z]+) *[=:] *(\S*)")
FORCE = QUANTITIES[2]


def load_cell_of(text, file, rate):
    """([times, extensions, loads], notes) of such a log; None of another file. `rate`: instead of that of the head, unless 0. Raises WrongInput."""
    rows = [(i + 1, row.strip("\r\t ;,\"")) for i, row in enumerate(text.split("\n"))]
    said = [(i, found[1], found[2]) for i, row in rows[:40] if (found := KEY.fullmatch(row))]
    head = {key: value for _, key, value in said}
    if not {"LogNo", "Unit", "Mode", "Speed"} <= head.keys():
        return None
    size, speed, cells = FORCE.si(head["Unit"]), number(head["Speed"], "."), [(i, row) for i, row in rows if row and i > said[-1][0]]
    mark = mark_of_decimals(cell for _, cell in cells)[0] or "."
    wrong = next((f"row {i} is \"{shown(cell)}\", but must be a load" for i, cell in cells if number(cell, mark) is None), "")
    if not size or not (rate or speed) or wrong or not cells:
        raise WrongInput(f"{shown(file)}: " + (wrong or f"Unit is {shown(head['Unit'])} and Speed is {shown(head['Speed'])}, but must be "
                                               f"{FORCE.allowed}, and readings per second, with loads below"))
    notes = [f"{len(cells)} loads of a LineScale in {head['Unit']}, {rate or speed:g} a second, and no travel"]
    notes += [] if rate else [f"with some firmwares the true rate is 0.9 of that which the head says: --rate {0.9 * speed:g} takes that"]
    notes += [f"its loads are relative to {head.get('RelZero')} {head['Unit']}"] if head["Mode"] == "REL" else []
    loads = [number(cell, mark) * size for _, cell in cells]
    return [[i / (rate or speed) for i in range(len(loads))], [math.nan] * len(loads), loads], notes
