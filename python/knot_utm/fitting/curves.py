"""A pull, as load over extension, of a record or of a run."""
import os
import subprocess
import tempfile

import numpy as np
import pandas as pd

from knot_utm import tool
from knot_utm.errors import WrongInput

OWN = ("time", "phase", "extension", "load", "end_to_end")  # columns of a curve.csv
PULLS = ("pull", "cycle", "follow")  # the phases of curve.csv in which the specimen is pulled
SAME_ZERO = 1e-9                     # [m]
AT_ONCE = 0.03                       # of the extension, within which a rod that parts lets go of its load


class Pull:
    """Rows that reach a new largest extension of the crosshead, as `compare` takes them beside raw data."""

    def __init__(self, extension, load):
        """Both in order of time; [m], [N]."""
        highest = np.maximum.accumulate(np.concatenate([[-np.inf], extension]))[:-1]
        extension, load = extension[extension > highest], load[extension > highest]
        end = _end(extension, load)
        self.extension, self.load = extension[:end], load[:end]

    def at(self, extension):
        """Load there, straight from point to point; beyond the last one with the slope of the last tenth."""
        s, load = self.extension, self.load
        inside = np.interp(extension, s, load)
        last = s >= s[-1] - 0.1 * (s[-1] - s[0])
        slope = np.polyfit(s[last], load[last], 1)[0] if last.sum() > 1 else 0.0
        return inside + np.maximum(extension - s[-1], 0.0) * slope


def _end(extension, load):
    """How many rows there are up to the break: the load falls from its peak below half of it, at once, and does not rise
    again."""
    peak = int(np.argmax(load)) if len(load) else 0
    at_once = len(load) and extension[-1] - extension[peak] < AT_ONCE * (extension[-1] - extension[0])
    return peak + 1 if at_once and load[-1] < 0.5 * load[peak] else len(load)


def pull_of_table(table):
    """Of curve.csv or curve_full.csv, with the row before the first pull as origin: a balance makes it zero. None where
    nothing is pulled."""
    rows = np.flatnonzero(table["phase"].isin(PULLS))
    if len(rows) < 2:
        return None
    travel = "crosshead_travel" if "crosshead_travel" in table else "extension"
    extension, load = (table[name].to_numpy(float)[rows] for name in (travel, "load"))
    if rows[0] > 0:
        before, first = (table.iloc[row] for row in (rows[0] - 1, rows[0]))
        zeros = [row["end_to_end"] - row["extension"] for row in (before, first)]
        balanced = abs(zeros[1] - zeros[0]) > SAME_ZERO
        extension = np.concatenate([[0.0 if balanced else before[travel]], extension])
        load = np.concatenate([[0.0 if balanced else before["load"]], load])
    finite = np.isfinite(extension) & np.isfinite(load)
    pull = Pull(extension[finite], load[finite])
    return pull if len(pull.extension) > 1 else None


def is_own(file):
    """Whether a file is a curve.csv, by its first line. Raises WrongInput where it cannot be read."""
    try:
        with open(file, encoding="utf-8", errors="replace") as lines:
            return set(OWN) <= set(lines.readline().strip().split(","))
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


def _known(file, pull):
    if pull is None:
        raise WrongInput(f"{file}: nothing is pulled in it, or it has fewer than two readings of a pull")
    return pull
