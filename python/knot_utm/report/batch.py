"""A batch of specimens as tensile_test left it in a folder: specimens.csv, statistics.yaml, a folder for each specimen."""
import os

import numpy as np

from knot_utm.report.certificate import certificate, specification_checks
from knot_utm.report.commands import CannotReport
from knot_utm.report.marks import largest_load
from knot_utm.report.quantities import all_in_units, in_units, is_number, units_of
from knot_utm.report.run import numbers, read_table, read_yaml, Run, texts_of

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


class Tested:
    """What the page shows of the folder of one specimen. `pull`: extension [m] and load [N], up to the break."""

    def __init__(self, number, run):
        pull = run.pull()
        self.number, self.pull = number, (pull["extension"], pull["load"])
        self.largest = largest_load(run)
        self.warnings = all_in_units(run.result.get("warnings") or [], run.units)
        self.checks = certificate(run.result, run.has_knot(), run.is_soft())
        self.asked = specification_checks(run.method, run.result, run.units)
        self.version, self.given, self.not_predicted = run.result.get("version"), run.given_strength(), run.not_predicted()


class Batch:
    def __init__(self, folder):
        self.folder = folder
        method = os.path.join(folder, "method.yaml")
        self.method, self.report = read_yaml(method), texts_of(method, "report")
        self.units = units_of(self.report)
        self.specimens, _ = read_specimens(folder)
        file = os.path.join(folder, "statistics.yaml")
        self.facts = read_yaml(file)
        for key in ("specimens", "rejected", "motion_pattern"):
            if key not in self.facts:
                raise CannotReport(f"{file}: no key {key}")
        self.reasons = {one["specimen"]: in_units(one["reason"], self.units) for one in self.facts["rejected"]}
        self.counted = [specimen for specimen in self.specimens if not specimen.rejected]
        self.tested = [Tested(one.number, Run(self.folder_of(one.number))) for one in self.counted]

    def folder_of(self, number):
        return os.path.join(self.folder, f"specimen_{number:03d}")

    def statistics(self, key):
        """mean, sd, cv, low, high, minimum, maximum and n, of which some are None; None: no specimen has the reading."""
        found = self.facts.get(key)
        return found if isinstance(found, dict) and found.get("n") else None

    def mean(self, key):
        found = self.statistics(key)
        return found["mean"] if found else None

    def common_mean(self, key):
        """None: not every specimen that counts has the reading."""
        found = self.statistics(key)
        return found["mean"] if found and found["n"] == len(self.counted) else None

    def means(self):
        """The means by key, as a result that a single test could have."""
        return {key: self.mean(key) for key in self.facts}

    def largest(self):
        """Of a specimen whose load rose to the end, where there is one: then the largest loads are no peaks."""
        found = [one.largest for one in self.tested if one.largest]
        return min(found, key=lambda largest: largest.is_peak, default=None)

    def spread(self, key):
        """The standard deviation of what was drawn."""
        return float(np.std([one.drawn[key] for one in self.specimens], ddof=1)) if len(self.specimens) > 1 else 0.0
