"""One run of tensile_test: made, and read."""
import csv
import os
import subprocess
import warnings
from dataclasses import dataclass

import pandas as pd

from knot_utm import tool
from knot_utm.errors import RunFailed, RunWarning, WrongInput
from knot_utm.readings import Readings, plot_curve, shown
from knot_utm.yaml_text import load

OF_A_RUN = ("result.yaml", "statistics.yaml", "samples.csv")  # where one of them is, tensile_test takes another folder


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
        """Draws load over extension of the pull. Returns the axes of Matplotlib."""
        return plot_curve(self.curve, axes, **style)

    def __repr__(self):
        peak = shown(self.results["peak_force"], self.results.attrs["units"]["peak_force"])
        return f"<Run {self.folder}: ended by {self.results['ended_by']}, largest load {peak}, {len(self.warnings)} warning{'' if len(self.warnings) == 1 else 's'}>"


def read(folder):
    """The run in a folder. Raises WrongInput where there is none."""
    folder = os.path.abspath(folder)
    results = pd.Series(load(os.path.join(folder, "result.yaml")), dtype=object)
    results.attrs["units"] = {row["key"]: row["unit"] for row in tool.result_keys()}
    return Run(folder, load(os.path.join(folder, "method.yaml")), results, read_table(os.path.join(folder, "curve.csv")))


def run(method, out, overwrite=False, **overrides):
    """Tests one specimen of a method's file, or of a shipped method by its name, and reads what the test left in `out`.

    `overwrite`: takes the place of a run that `out` holds. `overrides`: dotted keys of the method, as in
    run("tighten", "out/a", **{"specimen.preload": 20}). What the test warns of is a RunWarning of Python. Raises WrongInput where
    tensile_test refuses, or `out` holds a run; RunFailed where the test ended without what it was to measure, with what there is
    as its `.run`."""
    made = make(method, out, 1, overrides, overwrite)
    left = read(out) if made.has("result.yaml") else None
    for line in left.warnings if left else ():
        warnings.warn(line, RunWarning, stacklevel=2)
    made.require_success(left)
    return left


@dataclass(frozen=True)
class Made:
    """How tensile_test ended: what it left in `out`, its exit code, and the lines that it said."""

    out: str
    code: int
    said: list

    def has(self, name):
        return os.path.exists(os.path.join(self.out, name))

    def require_success(self, left):
        """Raises RunFailed with what it left, where it failed."""
        if self.code == 0 and left is not None:
            return
        told = [line for line in self.said if line.startswith(("the physics gave up", "the test failed", "the knot came undone"))]
        why = next(reversed(told or self.said), f"tensile_test ended with {self.code}")
        raise RunFailed(f"{self.out}: {why}", left)


def make(method, out, specimens, overrides, overwrite, *more):
    """Runs tensile_test to its end, with more words where they are given. Raises WrongInput where it refuses, or `out` holds a
    run that is not to be written over."""
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
    if done.returncode == tool.REFUSED:
        raise WrongInput(tool.said_by(done.stderr))
    return Made(out, done.returncode, tool.lines_of(done.stderr))


def read_table(path):
    """A table with names in row 1 and units in row 2, the latter in `.attrs["units"]`."""
    table = pd.read_csv(path, skiprows=[1], float_precision="round_trip", keep_default_na=False, na_values=["nan", ""])
    with open(path, encoding="utf-8", newline="") as file:
        names, units = (row for _, row in zip(range(2), csv.reader(file)))
    table.attrs["units"] = dict(zip(names, units))
    return table
