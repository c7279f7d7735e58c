"""One run of tensile_test, and a batch: several specimens of one method. Made, and read."""
import functools
import os
import subprocess
import warnings
from collections.abc import Mapping
from dataclasses import dataclass

import pandas as pd

from knot_utm import tool
from knot_utm.arguments import jobs_of, whole
from knot_utm.errors import refuse_if, RunFailed, RunWarning, WrongInput
from knot_utm.sweep_folder import RESULT, STATISTICS
from knot_utm.yaml_text import load

PULLS = ("pull", "cycle", "follow")  # the phases of curve.csv in which the specimen is pulled
OF_A_RUN = RESULT, STATISTICS, "samples.csv"  # where one of them is, tensile_test takes another folder


class Readings(Mapping):
    """A dict of readings that is only read. What derives from it has `_readings`, a pandas object with the keys as its index."""

    def __getitem__(self, key):
        if key not in self._readings.index:
            raise KeyError(f"there is no reading {key!r}{tool.hint(key, self._readings.index)}")
        return self._readings.loc[key]

    def __iter__(self):
        return iter(self._readings.index)

    def __len__(self):
        return len(self._readings.index)

    __hash__ = object.__hash__

    def __eq__(self, other):
        return self is other


def shown(value, unit):
    """With four digits."""
    return "none" if value is None or value != value else f"{value:.4g} {unit}".removesuffix(" -")


@dataclass(frozen=True, eq=False, repr=False)
class Run(Readings):
    """What a test left in its folder. `results` and `curve` have their units in `.attrs["units"]`, by key and column.

    A run is a dict of its readings, too: run["peak_force"], "peak_force" in run, run.items()."""

    folder: str
    method: dict
    results: pd.Series
    curve: pd.DataFrame

    @property
    def _readings(self):
        return self.results

    @property
    def warnings(self):
        """[text] of what the test warned of."""
        return list(self.results["warnings"])

    def plot(self, axes=None, **style):
        """Draws load [N] over extension [mm] of the pulls, into new axes of Matplotlib unless some are given. Returns the axes."""
        if axes is None:
            from matplotlib import pyplot
            axes = pyplot.subplots(layout="constrained")[1]
            axes.set(xlabel="extension [mm]", ylabel="load [N]")
        pulled = self.curve[self.curve["phase"].isin(PULLS)]
        axes.plot(1e3 * pulled["extension"], pulled["load"], **style)
        return axes

    def __repr__(self):
        peak, count = shown(self.results["peak_force"], self.results.attrs["units"]["peak_force"]), len(self.warnings)
        return f"<Run {self.folder}: ended by {self.results['ended_by']}, largest load {peak}, {count} warning{'' if count == 1 else 's'}>"


def read(folder):
    """The run in a folder. Raises WrongInput where there is none."""
    folder = os.path.abspath(folder)
    results = pd.Series(load(os.path.join(folder, "result.yaml")), dtype=object)
    results.attrs["units"] = {row["key"]: row["unit"] for row in tool.listing("results")}
    return Run(folder, load(os.path.join(folder, "method.yaml")), results, read_table(os.path.join(folder, "curve.csv")))


def run(method, out, overwrite=False, **overrides):
    """Tests one specimen of a method's file, or of a shipped method by its name, and reads what the test left in `out`.

    `overwrite`: takes the place of a run that `out` holds. `overrides`: dotted keys of the method, as in
    run("tighten", "out/a", **{"specimen.preload": 20}). What the test warns of is a RunWarning of Python. Raises WrongInput where
    tensile_test refuses, or `out` holds a run; RunFailed where the test ended without what it was to measure, with what there is
    as its `.run`."""
    return _made(read, RESULT, method, out, 1, overrides, overwrite)


def _made(reads, result, method, out, specimens, overrides, overwrite, *more):
    """What `reads` reads of the folder, which has the file `result`, once tensile_test has run to its end, with more words where they
    are given. Raises as `run` does."""
    if tool.COUNT in overrides:
        raise WrongInput(f"{tool.COUNT} is {overrides[tool.COUNT]}, but run tests one specimen, and batch as many as its argument "
                         "specimens says")
    out = os.path.abspath(out)
    if overwrite:
        more += ("--overwrite",)
    elif any(os.path.exists(os.path.join(out, name)) for name in OF_A_RUN):
        raise WrongInput(f"{out} holds a run already: choose another folder, or overwrite=True")
    method = tool.find_method(os.fspath(method), os.getcwd())
    words = tool.command(method, overrides, out, "--quiet", "--specimens", str(specimens), *more)
    done = subprocess.run(words, check=False, text=True, errors="replace", stdin=subprocess.DEVNULL, capture_output=True)
    said = tool.lines_of(done.stderr)
    refuse_if(done.returncode == tool.REFUSED, tool.said_by(done.stderr))
    left = reads(out) if os.path.exists(os.path.join(out, result)) else None
    for line in (said if isinstance(left, Batch) else left.warnings) if left is not None else ():
        warnings.warn(line, RunWarning, stacklevel=3)
    if done.returncode != 0 or left is None:
        reasons = [line for line in said if line.startswith(("the physics gave up", "the test failed", "the knot came undone"))]
        raise RunFailed(f"{out}: {next(reversed(reasons or said), f'tensile_test ended with {done.returncode}')}", left)
    return left


def read_table(path):
    """A table with names in row 1 and units in row 2, the latter in `.attrs["units"]`."""
    table = pd.read_csv(path, header=[0, 1], float_precision="round_trip", keep_default_na=False, na_values=["nan", ""])
    table.attrs["units"] = dict(table.columns)
    return table.set_axis(table.columns.get_level_values(0), axis="columns", copy=False)


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
    whole("specimens", specimens, 2, ": knot_utm.run tests one")
    at_a_time = ["--jobs", str(jobs_of(jobs))] if jobs is not None else []
    return _made(read_batch, STATISTICS, method, out, specimens, overrides, overwrite, *at_a_time)


def read_batch(folder):
    """The batch in a folder, whoever made it. Raises WrongInput where there is none that has ended."""
    folder = os.path.abspath(folder)
    written = load(os.path.join(folder, STATISTICS))
    rejected = {one["specimen"]: one["reason"] for one in written["rejected"]}
    units = {row["key"]: row["unit"] for row in tool.listing("results")}
    statistics = pd.DataFrame.from_dict({key: written[key] for key in units if "mean" in (written.get(key) or ())}, orient="index",
                                        dtype=float).astype({"n": int})
    statistics.attrs["units"] = {key: units[key] for key in statistics.index}
    specimens = read_table(os.path.join(folder, "specimens.csv")).set_index("specimen")
    return Batch(folder, load(os.path.join(folder, "method.yaml")), statistics, specimens, rejected)
