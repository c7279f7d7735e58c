"""Two curves beside each other, as `compare --report` left them in a folder."""
import os

import numpy as np

from failure import CannotReport
from is_number import is_number
from run import numbers, printable, read_columns, read_yaml

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

    def number(self, key):
        value = self.facts.get(key)
        return value if is_number(value) else None

    def ends_at_its_largest_load(self, name):
        """Whether the curve has no peak: its load was still rising where it ends."""
        load = {"a": self.a, "b": self.b}[name].load
        return int(np.argmax(load)) >= len(load) - 2

    def difference(self):
        """Extensions that both have, and load of B less that of A there: both straight from point to point."""
        low, high = self.facts["common_extension"]
        s = np.union1d(self.a.extension, self.b.extension)
        s = np.concatenate([[low], s[(s > low) & (s < high)], [high]])
        return s, np.interp(s, self.b.extension, self.b.load) - np.interp(s, self.a.extension, self.a.load)


def run_beside(file):
    """Method and result of the run that a curve is from; None where it is from none."""
    folder = os.path.dirname(file) or "."
    if os.path.basename(file) not in ("curve.csv", "curve_full.csv", "test.bag", "saved.bag"):
        return None
    try:
        return read_yaml(os.path.join(folder, "method.yaml")), read_yaml(os.path.join(folder, "result.yaml"))
    except CannotReport:
        return None
