"""Two curves beside each other, as `compare --report` left them in a folder."""
import os

import numpy as np

from knot_utm.report.failure import CannotReport
from knot_utm.report.is_number import is_number
from knot_utm.report.run import numbers, printable, read_columns, read_yaml, texts_of
from knot_utm.report.units import Units, units_of

READINGS = ("peak_force", "plateau_force", "plateau_force_low", "plateau_force_high", "plateau_force_slope",
            "breakaway_force", "largest_drop", "jump_force", "force_after_jump", "lock_extension_by_load",
            "locked_stiffness")


class Pull:
    def __init__(self, file):
        columns = read_columns(file)
        for name in ("extension", "load"):
            if name not in columns:
                raise CannotReport(f"{file}: no column {name}")
        self.extension, self.load = (numbers(file, name, columns[name]) for name in ("extension", "load"))


class Comparison:
    def __init__(self, folder):
        self.folder = folder
        self.facts = read_yaml(os.path.join(folder, "comparison.yaml"), errors="surrogateescape")
        self.a, self.b = (Pull(os.path.join(folder, name)) for name in ("a.csv", "b.csv"))
        for key in ("a", "b", "common_extension"):
            if key not in self.facts:
                raise CannotReport(f"{os.path.join(folder, 'comparison.yaml')}: no key {key}")
        self.files = {name: str(self.facts[name]) for name in ("a", "b")}
        self.facts.update({name: printable(file) for name, file in self.files.items()})
        self.runs = {name: run_beside(file) for name, file in self.files.items()}
        asked = [units_of(run.report) for run in self.runs.values() if run]
        self.units = next((units for units in asked if not units.are_default), Units())

    def number(self, key):
        value = self.facts.get(key)
        return value if is_number(value) else None

    def ends_at_its_largest_load(self, name):
        """Whether the curve has no peak: its load was still rising where it ends, and no rod parted there."""
        load, run = {"a": self.a, "b": self.b}[name].load, self.runs[name]
        if run and run.result.get("ended_by") == "break":
            return False
        return int(np.argmax(load)) >= len(load) - 2

    def difference(self):
        """Extensions that both have, and load of B less that of A there: both straight from point to point."""
        low, high = self.facts["common_extension"]
        s = np.union1d(self.a.extension, self.b.extension)
        s = np.concatenate([[low], s[(s > low) & (s < high)], [high]])
        return s, np.interp(s, self.b.extension, self.b.load) - np.interp(s, self.a.extension, self.a.load)


class Simulated:
    """The run that a curve is from: its method, its result, and what its method says of reports."""

    def __init__(self, folder):
        method = os.path.join(folder, "method.yaml")
        self.method, self.report = read_yaml(method), texts_of(method, "report")
        self.result = read_yaml(os.path.join(folder, "result.yaml"))


def run_beside(file):
    """The run that a curve is from; None where it is from none."""
    folder = os.path.dirname(file) or "."
    if os.path.basename(file) not in ("curve.csv", "curve_full.csv", "test.bag", "saved.bag"):
        return None
    try:
        return Simulated(folder)
    except CannotReport:
        return None
