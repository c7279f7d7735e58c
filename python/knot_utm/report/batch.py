"""A batch of specimens as tensile_test left it in a folder: specimens.csv, statistics.yaml, a folder for each specimen."""
import os

from knot_utm.report.commands import CannotReport
from knot_utm.report.quantities import is_number
from knot_utm.report.run import numbers, read_table

# What stands in a row of specimens.csv before the readings, and behind what was drawn.
OUTCOME = ("rejected", "ended_by", "motion_pattern")


class Specimen:
    """A row of specimens.csv. `drawn`, `readings`: by key, in SI; a reading that the test does not have is None."""

    def __init__(self, number, outcome, drawn, readings):
        self.number, self.drawn, self.readings = number, drawn, readings
        self.rejected, self.ended_by, self.motion_pattern = outcome[0] == "true", outcome[1], outcome[2]


def read_specimens(folder):
    """The specimens in order, and the units of the columns by name."""
    file = os.path.join(folder, "specimens.csv")
    columns, units = read_table(file)
    for name in ("specimen", *OUTCOME):
        if name not in columns:
            raise CannotReport(f"{file}: no column {name}")
    if not columns["specimen"]:
        raise CannotReport(f"{file}: no specimens")
    names = list(columns)
    drawn, readings = names[1:names.index(OUTCOME[0])], names[names.index(OUTCOME[-1]) + 1:]
    values = {name: numbers(file, name, columns[name]).tolist() for name in ("specimen", *drawn, *readings)}

    def row(keys, i):
        return {key: values[key][i] if is_number(values[key][i]) else None for key in keys}

    return [Specimen(int(number), [columns[name][i] for name in OUTCOME], row(drawn, i), row(readings, i))
            for i, number in enumerate(values["specimen"])], units
