"""The folder of a sweep: which runs are in it, whole."""
import contextlib
import fcntl
import math
import os
import shutil
import tempfile

import pandas as pd
import yaml

from knot_utm.arguments import make_folder
from knot_utm.errors import WrongInput
from knot_utm.groups import rod_of
from knot_utm.yaml_text import load

RECORD = "run.yaml"  # beside what tensile_test wrote: how the run ended
RESULT = "result.yaml"
STATISTICS = "statistics.yaml"  # of a batch of specimens
CURVE = "curve_full.csv"
CURVE_COLUMNS = ("time", "extension", "load", "knot_distance", "phase")
METHOD = "method.yaml"
TABLES = ("table.csv", "table.h5")  # of all runs


class SweepFolder:
    """A run is made in a hidden folder, and gets its name when it has ended: one with a name is whole."""

    def __init__(self, path):
        self.path = path
        self.runs = os.path.join(path, "runs")
        if not os.path.isdir(self.runs) and (taken := [name for name in TABLES if os.path.lexists(os.path.join(path, name))]):
            raise WrongInput(f"{os.path.join(path, taken[0])} exists already and is not of a sweep: choose another folder")

    @contextlib.contextmanager
    def claimed(self):
        """For one sweep alone; what a killed one left is cleared away. Raises WrongInput where others are at work."""
        with self._locked(fcntl.LOCK_EX):
            for name in os.listdir(self.runs):
                if name.startswith(".") and "." in name[1:]:  # of `making`
                    shutil.rmtree(os.path.join(self.runs, name), ignore_errors=True)
            yield

    def shared(self):
        """For several that make a run each. Raises WrongInput where a sweep is at work."""
        return self._locked(fcntl.LOCK_SH)

    @contextlib.contextmanager
    def _locked(self, kind):
        make_folder(self.runs)
        with open(os.path.join(self.path, ".lock"), "w", encoding="utf-8") as lock:
            try:
                fcntl.flock(lock, kind | fcntl.LOCK_NB)
            except BlockingIOError as error:
                raise WrongInput(f"another sweep is at work in {self.path}") from error
            yield

    def of(self, run, *name):
        """The folder of a run, or a file in it."""
        return os.path.join(self.runs, run, *name)

    def record(self, run):
        """{exit_code, error, set, version} of a run that has ended, and readings where they are not all; None of any other."""
        return self._read(run, RECORD)

    def is_done(self, run):
        """Whether it has ended and left a result; those that left none are tried again."""
        has_record, *has_result = (os.path.exists(self.of(run, name)) for name in (RECORD, RESULT, STATISTICS))
        return has_record and any(has_result)

    def result(self, run):
        """The result.yaml of a run that has ended; empty where it left none."""
        return self._read(run, RESULT) or {}

    def rejected(self, run):
        """{specimen: reason} of a batch."""
        return {entry["specimen"]: entry["reason"] for entry in (self._read(run, STATISTICS) or {}).get("rejected", ())}

    def curve(self, run):
        """Its curve_full.csv, a pandas.DataFrame without units; empty where it left none."""
        file = self.of(run, CURVE)
        return pd.read_csv(file, skiprows=[1]) if os.path.exists(file) else pd.DataFrame(columns=CURVE_COLUMNS)

    def rod(self, run):
        """(k_b, h) of a run that left a result, else NaN."""
        method = self._read(run, METHOD)
        return rod_of(method) if method else (math.nan, math.nan)

    def _read(self, run, name):
        """What a YAML file of a run says; None where it is not there."""
        file = self.of(run, name)
        return load(file) if os.path.exists(file) else None

    @contextlib.contextmanager
    def making(self, run):
        """A hidden folder in which to make a run; gone in the end where that was not kept."""
        part = tempfile.mkdtemp(prefix=f".{run}.", dir=self.runs)
        try:
            yield part
        finally:
            shutil.rmtree(part, ignore_errors=True)

    def finish(self, part, run, record):
        """Keeps a run that was made, instead of one that may be there."""
        with open(os.path.join(part, RECORD), "w", encoding="utf-8") as file:
            yaml.safe_dump(record, file, sort_keys=False, allow_unicode=True)
        os.chmod(part, 0o755)  # mkdtemp's are for nobody else
        shutil.rmtree(self.of(run), ignore_errors=True)
        os.rename(part, self.of(run))


def result_of(folder):
    """result.yaml of a run that has ended, or statistics.yaml of a batch; None where there is none, or it is not whole."""
    with contextlib.suppress(WrongInput):
        if os.path.exists(os.path.join(folder, STATISTICS)):
            return load(os.path.join(folder, STATISTICS))
        result = load(os.path.join(folder, RESULT))
        if isinstance(result, dict) and "specification_failed" in result:
            return result
    return None
