"""A pull, as load over extension, of a record or of a run; and the runs of a fit, many at a time, each read and thrown away."""
import os
import subprocess
import tempfile
from typing import NamedTuple

import numpy as np
import pandas as pd

from knot_utm import tool, yaml_text
from knot_utm.errors import Interrupted, WrongInput
from knot_utm.runner import Runner

OWN = {"time", "phase", "extension", "load", "end_to_end"}  # columns of a curve.csv
PULLS = ("pull", "cycle", "follow")  # the phases of curve.csv in which the specimen is pulled
SAME_ZERO = 1e-9                     # [m]
AT_ONCE = 0.03                       # of the extension, within which a rod that parts lets go of its load
# The model tells what the specimen bears; the errors of the cell are counted with those of the record.
EXACT_CELL = {f"machine.load_cell.{key}": 0 for key in ("accuracy", "noise", "resolution", "floor")}


class Pull:
    """Rows that reach a new largest extension of the crosshead, as `compare` takes them beside raw data."""

    def __init__(self, extension, load):
        """Both in order of time; [m], [N]."""
        highest = np.maximum.accumulate(np.concatenate([[-np.inf], extension]))[:-1]
        rows = np.flatnonzero(extension > highest)
        rows = rows[:_end(extension[rows], load[rows])]
        self.extension, self.load = extension[rows], load[rows]

    def at(self, extension):
        """Load there, straight from point to point; beyond the last one with the slope of the last tenth."""
        s = self.extension
        last = s >= s[-1] - 0.1 * (s[-1] - s[0])
        slope = np.polyfit(s[last], self.load[last], 1)[0] if last.sum() > 1 else 0.0
        return np.interp(extension, s, self.load) + np.maximum(extension - s[-1], 0.0) * slope


class Model(NamedTuple):
    """What one run says. `pull`: None where there is none to speak of, because the run failed."""

    pull: object
    result: dict


class Runs(Runner):
    """Runs of a method in a folder that is gone when the fit has ended."""

    def __init__(self, method, folder, jobs):
        super().__init__()
        self.method, self.folder, self.jobs = method, folder, jobs

    def models(self, asked):
        """[Model] of [settings], in their order."""
        return self.each(self._model, [(settings,) for settings in asked], self.jobs, "fit")

    def whole(self, settings):
        """The folder of a run that is not thrown away at once. Raises WrongInput where refused."""
        out = tempfile.mkdtemp(dir=self.folder)
        code, said = self._run(settings, out)
        if code == tool.REFUSED:
            raise WrongInput(said)
        return out

    def _model(self, settings):
        with tempfile.TemporaryDirectory(dir=self.folder) as out:
            code, _ = self._run({**settings, **EXACT_CELL}, out)
            return read_model(out) if code in (0, 1) else Model(None, {})

    def _run(self, settings, out):
        if self.stopped:
            raise Interrupted(self.stopped)
        code, said = self.wait(self.method, settings, out, "--overwrite", "--specimens", "1")
        if code > 0 and tool.is_of_a_full_disk(said):
            raise RuntimeError(said)
        return code, said


def read_model(folder):
    """What a run left, as a Model."""
    try:
        result = yaml_text.load(os.path.join(folder, "result.yaml"))
        return Model(pull_of_table(pd.read_csv(os.path.join(folder, "curve_full.csv"), skiprows=[1])), result)
    except (WrongInput, OSError, ValueError):
        return Model(None, {})


def pull_of_table(table):
    """Of curve.csv or curve_full.csv, with the row before the first pull as origin: a balance makes it zero. None where
    nothing is pulled."""
    rows = np.flatnonzero(table["phase"].isin(PULLS))
    if len(rows) < 2:
        return None
    taken = table.iloc[rows if rows[0] == 0 else [rows[0] - 1, *rows]]
    travel = "crosshead_travel" if "crosshead_travel" in table else "extension"
    extension, load = (taken[name].to_numpy(float, copy=True) for name in (travel, "load"))
    zeros = (taken["end_to_end"] - taken["extension"]).to_numpy(float)
    if rows[0] > 0 and abs(zeros[1] - zeros[0]) > SAME_ZERO:
        extension[0] = load[0] = 0.0
    finite = np.isfinite(extension) & np.isfinite(load)
    pull = Pull(extension[finite], load[finite])
    return pull if len(pull.extension) > 1 else None


def is_own(file):
    """Whether a file is a curve.csv, by its first line. Raises WrongInput where it cannot be read."""
    try:
        with open(file, encoding="utf-8", errors="replace") as lines:
            return OWN <= set(lines.readline().strip().split(","))
    except OSError as error:
        raise WrongInput(f"{file}: {error.strerror.lower()}") from error


def read_own(file):
    """Of a curve.csv. Raises WrongInput."""
    try:
        table = pd.read_csv(file, skiprows=[1])
        table = table.astype({name: float for name in ("extension", "load", "end_to_end")})
    except (ValueError, KeyError) as error:
        raise WrongInput(f"{file}: {' '.join(str(error).split())}") from error
    return _known(file, pull_of_table(table))


def read_other(file, curve_file, reading=()):
    """The pull of what else `compare` reads, raw data and bags, and what it says of them. It sets them to zero beside the curve of a
    run, and leaves the pull beside its page. `reading`: its options for raw data. Raises WrongInput."""
    compare = os.path.join(os.path.dirname(tool.tensile_test()), "compare")
    if not os.access(compare, os.X_OK):
        raise WrongInput(f"{compare} is not there, which reads such files as {file}: scripts/build compare makes it")
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, "beside")
        done = subprocess.run([compare, file, curve_file, "--report", out, *reading], check=False, text=True,
                              errors="replace", stdin=subprocess.DEVNULL, capture_output=True)
        table = os.path.join(out, "a.csv")
        if not os.path.exists(table):
            said = tool.said_by(done.stderr).removeprefix("compare: ")
            raise WrongInput(said or f"{file}: compare cannot read it")
        read = pd.read_csv(table, skiprows=[1])
    pull = Pull(read["extension"].to_numpy(float), read["load"].to_numpy(float)) if len(read) > 1 else None
    lines = [line.removeprefix("compare: ") for line in done.stderr.splitlines()]
    return _known(file, pull), [line for line in lines if line.startswith(f"{file}: ")]


def _end(extension, load):
    """How many rows there are up to the break: the load falls from its peak below half of it, at once, and does not rise
    again."""
    peak = int(np.argmax(load)) if len(load) else 0
    at_once = len(load) and extension[-1] - extension[peak] < AT_ONCE * (extension[-1] - extension[0])
    return peak + 1 if at_once and load[-1] < 0.5 * load[peak] else len(load)


def _known(file, pull):
    if pull is None:
        raise WrongInput(f"{file}: nothing is pulled in it, or it has fewer than two readings of a pull")
    return pull
