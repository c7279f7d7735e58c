"""A batch: several specimens of one method, made and read."""
import functools
import os
import warnings
from dataclasses import dataclass

import pandas as pd

from knot_utm import tool
from knot_utm.errors import RunWarning, WrongInput
from knot_utm.readings import Readings, shown
from knot_utm.runs import make, read, read_table
from knot_utm.yaml_text import load

STATISTICS = "statistics.yaml"


@dataclass(frozen=True, eq=False, repr=False)
class Batch(Readings):
    """What a batch left in its folder (doc/results.md). `statistics`: a row for each reading with mean, sd, cv, low, high,
    minimum, maximum and n over the specimens that count; `specimens`: a row for each of them with what was drawn, how it ended
    and its readings. Both have their units in `.attrs["units"]`, by reading and column. `rejected`: {specimen: why}.

    A batch is a dict of its statistics, too: batch["peak_force"]["mean"]."""

    folder: str
    method: dict
    statistics: pd.DataFrame
    specimens: pd.DataFrame
    rejected: dict

    @functools.cached_property
    def runs(self):
        """[Run] of all specimens, in order."""
        return [read(os.path.join(self.folder, f"specimen_{number:03d}")) for number in self.specimens.index]

    @property
    def _readings(self):
        return self.statistics

    @property
    def warnings(self):
        """{specimen: [text]} of what the tests of specimens warned of, without those that had nothing to warn of."""
        return {number: run.warnings for number, run in zip(self.specimens.index, self.runs) if run.warnings}

    def plot(self, axes=None, **style):
        """Draws load over extension of all specimens that count. Returns the axes of Matplotlib."""
        for run, rejected in zip(self.runs, self.specimens["rejected"]):
            if not rejected:
                axes = run.plot(axes, **style)
        return axes

    def __repr__(self):
        count = len(self.specimens)
        peak = shown(self.statistics.loc["peak_force", "mean"], self.statistics.attrs["units"]["peak_force"])
        return f"<Batch {self.folder}: {count - len(self.rejected)} of {count} specimens count, mean largest load {peak}>"


def batch(method, out, specimens=8, jobs=None, overwrite=False, **overrides):
    """Tests so many specimens of a method's file, or of a shipped method by its name, and reads what they left in `out`.

    How they scatter, the method's key `specimens` says (doc/method.md). `jobs`: tests at a time, unless given as many as there are
    cores; the numbers are the same. `overwrite`, `overrides`, warnings and what it raises: as `run`; it raises RunFailed where no
    specimen counts."""
    if specimens < 2:
        raise WrongInput(f"specimens is {specimens}, but a batch has at least 2: knot_utm.run tests one")
    made = make(method, out, specimens, overrides, overwrite, *(["--jobs", str(jobs)] if jobs is not None else []))
    left = read_batch(out) if made.has(STATISTICS) else None
    for line in made.said if left else ():
        warnings.warn(line, RunWarning, stacklevel=2)
    made.require_success(left)
    return left


def read_batch(folder):
    """The batch in a folder, whoever made it. Raises WrongInput where there is none that has ended."""
    folder = os.path.abspath(folder)
    told = load(os.path.join(folder, STATISTICS))
    rejected = {one["specimen"]: one["reason"] for one in told["rejected"]}
    units = {row["key"]: row["unit"] for row in tool.result_keys()}
    statistics = pd.DataFrame.from_dict({key: told[key] for key in units if "mean" in (told.get(key) or ())}, orient="index",
                                        dtype=float).astype({"n": int})
    statistics.attrs["units"] = {key: units[key] for key in statistics.index}
    specimens = read_table(os.path.join(folder, "specimens.csv")).set_index("specimen")
    return Batch(folder, load(os.path.join(folder, "method.yaml")), statistics, specimens, rejected)
