"""A test as tensile_test or the recorder left it in a folder."""
import csv
import os
import re

import numpy as np
import yaml

from knot_utm import tool
from knot_utm.errors import refuse_if, WrongInput
from knot_utm.report.quantities import is_number, units_of, with_unit
from knot_utm.yaml_text import load, read_text


def phases(trait):
    """Names of the phases that have a trait."""
    return tuple(row["name"] for row in tool.listing("phases") if row[trait] == "1")


PULLING = phases("pulls")  # the specimen is pulled further than before
PREPARATION = phases("prepares")  # it is made, mounted and zeroed, before the test proper
FORMING = phases("forms")  # it is tied, or let go once it is tied


class Curve:
    """curve.csv or curve_full.csv: columns by name, SI, and the phase of every row."""

    def __init__(self, columns, phase):
        self.columns, self.phase = columns, phase

    def __getitem__(self, name):
        return self.columns[name]

    def __len__(self):
        return len(self.phase)

    def where(self, mask):
        return Curve({name: column[mask] for name, column in self.columns.items()}, self.phase[mask])

    def tested(self):
        """The rows of the test proper."""
        return self.where(~np.isin(self.phase, PREPARATION))

    def pull(self):
        """The rows that pull and reach a new largest extension: what the readings are of."""
        pulled = self.where(np.isin(self.phase, PULLING))
        if not len(pulled):
            return pulled
        before = np.concatenate([[-np.inf], np.maximum.accumulate(pulled["extension"])[:-1]])
        return pulled.where(pulled["extension"] > before)

    def has_compliant_frame(self):
        return "crosshead_extension" in self.columns


class Run:
    def __init__(self, folder):
        self.folder = folder
        self.method = read_yaml(os.path.join(folder, "method.yaml"))
        self.report = texts_of(os.path.join(folder, "method.yaml"), "report")
        self.units = units_of(self.report)
        result = os.path.join(folder, "result.yaml")
        self.result = read_yaml(result)
        # Why values are null, as the program says it behind them.
        self.reasons = dict(re.findall(r"^(\w+): null  # (.*)$", read_text(result), re.MULTILINE))
        self.readings = read_curve(os.path.join(folder, "curve.csv"))
        self.curve = read_curve(os.path.join(folder, "curve_full.csv"))

    def value(self, key):
        """A number of result.yaml; None where the test has none."""
        value = self.result.get(key)
        return value if is_number(value) else None

    def radii(self, shape):
        """The radii of the ropes of a shape [m]."""
        first, other = self.method["material"], self.method.get("other_material")
        return [(other if other and number else first)["radius"] for number in range(len(shape.cuts) + 1)]

    def thickest(self):
        """Radius of the thickest rope [m]."""
        return max(self.method[of]["radius"] for of in ("material", "other_material") if of in self.method)

    def is_soft(self):
        """Whether the rod's sections give."""
        return (self.method.get("material") or {}).get("section") == "soft"

    def has_knot(self):
        return self.reasons.get("knot_efficiency") != "there is no knot"

    def not_predicted(self):
        """Keys whose value would only repeat what was given."""
        return [key for key, why in self.reasons.items() if why.startswith("not predicted")]

    def words_at(self, time):
        """What happens at a time; no place before the test proper."""
        phase = self.curve.phase[min(int(np.searchsorted(self.curve["time"], time)), len(self.curve) - 1)]
        tested, said = self.curve.tested(), f"{phase}, {time:.2f} s"
        if not len(tested) or time < tested["time"][0]:
            return said
        place = [with_unit(float(np.interp(time, tested["time"], tested[name])), unit)
                 for name, unit in (("extension", self.units.length), ("load", self.units.force))]
        return f"{said}: s = {place[0]}, F = {place[1]}"

    def offset(self):
        """True force less load [N]."""
        return self.value("balance_offset") or 0.0

    def load_cell_floor(self):
        """Below this load the cell's error is no longer a share of the reading [N]; None: the method says nothing."""
        cell = self.method.get("machine", {}).get("load_cell")
        known = isinstance(cell, dict) and is_number(cell.get("floor")) and is_number(cell.get("capacity"))
        return cell["floor"] * cell["capacity"] or None if known else None


def read_yaml(file, *wanted, errors="strict"):
    """A map with the keys that are wanted."""
    content = load(file, errors)
    refuse_if(not isinstance(content, dict), f"{file}: a map is needed")
    require_keys(file, content, wanted)
    return content


def texts_of(file, key):
    """A map of a YAML file with every value as it is written: a specimen's name may be 0012, a date is what it says."""
    found = yaml.load(read_text(file), Loader=yaml.BaseLoader).get(key)
    return found if isinstance(found, dict) else {}


def read_table(file, wanted, words=()):
    """{column: numbers}, and texts of those columns that hold `words`; row 1 has names, row 2 units. Raises WrongInput where a
    `wanted` column is missing, or one holds no numbers."""
    rows = list(csv.reader(read_text(file).splitlines()))
    refuse_if(len(rows) < 2 or any(len(row) != len(rows[0]) for row in rows), f"{file}: not a table with a row of names and a row of units")
    columns = dict(zip(rows[0], zip(*rows[2:]) if len(rows) > 2 else [()] * len(rows[0])))
    require_keys(file, columns, (*wanted, *words), "column")
    try:
        return {name: np.array(column, dtype=str if name in words else float) for name, column in columns.items()}
    except ValueError as why:
        raise WrongInput(f"{file}: {why}") from why


def require_keys(file, content, keys, kind="key"):
    for key in keys:
        refuse_if(key not in content, f"{file}: no {kind} {key}")


def read_curve(file):
    columns = read_table(file, ("time", "extension", "load", "knot_distance", "end_to_end"), ("phase",))
    curve = Curve(columns, columns.pop("phase"))
    if "crosshead_travel" in columns:  # the frame is compliant
        travel = curve["crosshead_travel"]
        curve.columns["crosshead_extension"] = np.where(np.isfinite(travel), travel, curve["extension"])
    return curve
