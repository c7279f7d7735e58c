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

    def of(self, run):
        return os.path.join(self.runs, run)

    def record(self, run):
        """{exit_code, error, set, version} of a run that has ended, and readings where they are not all; None of any other."""
        file = self._file(run, RECORD)
        return load(file) if os.path.exists(file) else None

    def is_done(self, run):
        """Whether it has ended and left a result; those that left none are tried again."""
        return os.path.exists(self._file(run, RECORD)) and any(os.path.exists(self._file(run, name))
                                                               for name in (RESULT, STATISTICS))

    def result(self, run):
        """Of a run that has ended; empty where it left none."""
        file = self._file(run, RESULT)
        return load(file) if os.path.exists(file) else {}

    def rejected(self, run):
        """{specimen: reason} of a batch."""
        file = self._file(run, STATISTICS)
        return {entry["specimen"]: entry["reason"] for entry in load(file)["rejected"]} if os.path.exists(file) else {}

    def curve(self, run):
        """Its curve_full.csv, a pandas.DataFrame without units; empty where it left none."""
        file = self._file(run, CURVE)
        return pd.read_csv(file, skiprows=[1]) if os.path.exists(file) else pd.DataFrame(columns=CURVE_COLUMNS)

    def rod(self, run):
        """(k_b, h) of a run that left a result, else NaN."""
        file = self._file(run, METHOD)
        return rod_of(load(file)) if os.path.exists(file) else (math.nan, math.nan)

    def _file(self, run, name):
        return os.path.join(self.of(run), name)

    @contextlib.contextmanager
    def making(self, run):
        """A hidden folder in which to make a run; gone in the end where that was not kept."""
        part = tempfile.mkdtemp(prefix=f".{run}.", dir=self.runs)
        try:
            yield part
        finally:
            shutil.rmtree(part, ignore_errors=True)

    def empty(self, part):
        shutil.rmtree(part)
        os.mkdir(part)

    def finish(self, part, run, record):
        """Keeps a run that was made, instead of one that may be there."""
        with open(os.path.join(part, RECORD), "w", encoding="utf-8") as file:
            yaml.safe_dump(record, file, sort_keys=False, allow_unicode=True)
        os.chmod(part, 0o755)  # mkdtemp's are for nobody else
        shutil.rmtree(self.of(run), ignore_errors=True)
        os.rename(part, self.of(run))
