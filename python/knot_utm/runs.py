"""One run of tensile_test: made, and read."""
import csv
import os
import subprocess
from dataclasses import dataclass

import pandas as pd

from knot_utm import tool
from knot_utm.errors import WrongInput
from knot_utm.yaml_text import load

OF_A_RUN = ("result.yaml", "statistics.yaml", "journal")  # where one of them is, tensile_test takes another folder


@dataclass(frozen=True)
class Run:
    """What a test left in its folder. `results` and `curve` have their units in `.attrs["units"]`, by key and column."""

    folder: str
    method: dict
    results: pd.Series
    curve: pd.DataFrame


def read(folder):
    """The run in a folder. Raises WrongInput where there is none."""
    folder = os.path.abspath(folder)
    results = pd.Series(load(os.path.join(folder, "result.yaml")), dtype=object)
    results.attrs["units"] = {row["key"]: row["unit"] for row in tool.result_keys()}
    return Run(folder, load(os.path.join(folder, "method.yaml")), results, read_table(os.path.join(folder, "curve.csv")))


def run(method, out, **overrides):
    """Tests one specimen of a method's file, or of a shipped method by its name, and reads what the test left in `out`.

    `overrides`: dotted keys of the method, as in run("tighten", "out/a", **{"specimen.preload": 20}). Raises WrongInput
    where tensile_test refuses, or `out` holds a run; RuntimeError where it leaves no result."""
    make(method, out, 1, "result.yaml", overrides)
    return read(out)


def make(method, out, specimens, result, overrides, *more):
    """Runs tensile_test to its end, with more words where they are given. Raises WrongInput where it refuses, or `out` holds a run;
    RuntimeError where it leaves no `result` there."""
    if tool.COUNT in overrides:
        raise WrongInput(f"{tool.COUNT} is {overrides[tool.COUNT]}, but run tests one specimen, and batch as many as its argument "
                         "specimens says")
    out = os.path.abspath(out)
    if any(os.path.exists(os.path.join(out, name)) for name in OF_A_RUN):
        raise WrongInput(f"{out} holds a run already: choose another folder")
    method = tool.find_method(os.fspath(method), os.getcwd())
    words = tool.command(method, overrides, out, "--quiet", "--specimens", str(specimens), *more)
    done = subprocess.run(words, check=False, text=True, errors="replace", stdin=subprocess.DEVNULL, capture_output=True)
    if done.returncode == tool.REFUSED:
        raise WrongInput(tool.said_by(done.stderr))
    if not os.path.exists(os.path.join(out, result)):
        raise RuntimeError(f"{out}: {tool.said_by(done.stderr) or f'tensile_test ended with {done.returncode}'}")


def read_table(path):
    """A table with names in row 1 and units in row 2, the latter in `.attrs["units"]`."""
    table = pd.read_csv(path, skiprows=[1], float_precision="round_trip", keep_default_na=False, na_values=["nan", ""])
    with open(path, encoding="utf-8", newline="") as file:
        names, units = (row for _, row in zip(range(2), csv.reader(file)))
    table.attrs["units"] = dict(zip(names, units))
    return table
