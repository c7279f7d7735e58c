"""A fit, as scripts/fit left it in a folder."""
import os

import numpy as np

from knot_utm.report.failure import CannotReport
from knot_utm.report.is_number import is_number
from knot_utm.report.run import numbers, printable, read_columns, read_yaml

NOT_KEYS = ("rms", "correlation", "fits", "chi_square", "degrees_of_freedom", "notes", "records")


class Key:
    """A free key. `low`, `high`: None where the data do not tell that end; `unconfirmed`: those of the two that runs do not confirm."""

    def __init__(self, name, found, places, rises):
        self.name = name
        self.value, self.low, self.high = (found.get(part) if is_number(found.get(part)) else None
                                           for part in ("value", "low", "high"))
        self.is_identifiable = bool(found.get("identifiable"))
        self.unconfirmed = found.get("unconfirmed") or []
        self.places, self.rises = places, rises


class Curve:
    """A record: means of the load over parts of the extension, measured and simulated, and the error of their difference."""

    def __init__(self, name, extension, measured, simulated, error):
        self.name, self.extension, self.measured, self.simulated, self.error = name, extension, measured, simulated, error


class Fit:
    def __init__(self, folder):
        self.facts = read_yaml(os.path.join(folder, "fit.yaml"))
        self.correlation = self.facts.get("correlation") or {}
        self.notes = [printable(str(note)) for note in self.facts.get("notes") or []]
        profiles = read(folder, "profiles.csv", ("value", "rise"))
        curves = read(folder, "curves.csv", ("extension", "measured", "simulated", "error"))
        self.keys = [Key(name, found, *profiles.get(name, (np.zeros(0), np.zeros(0))))
                     for name, found in self.facts.items() if name not in NOT_KEYS and isinstance(found, dict)]
        self.curves = [Curve(printable(str(name)), *curves.get(str(number), [np.zeros(0)] * 4))
                       for number, name in enumerate(self.facts.get("records") or [], start=1)]


def read(folder, name, wanted):
    """{first column: the wanted ones, as numbers}."""
    file = os.path.join(folder, name)
    columns = read_columns(file)
    first = next(iter(columns))
    for column in wanted:
        if column not in columns:
            raise CannotReport(f"{file}: no column {column}")
    values = [numbers(file, column, columns[column]) for column in wanted]
    of = np.array(columns[first])
    return {str(one): tuple(column[of == one] for column in values) for one in dict.fromkeys(columns[first])}
