"""The folder of a sweep: which runs are in it, whole."""
import contextlib
import fcntl
import os
import shutil
import tempfile

import yaml

from knot_utm.errors import WrongInput
from knot_utm.yaml_text import load

RECORD = "run.yaml"  # beside what tensile_test wrote: how the run ended


class SweepFolder:
    """A run is made in a hidden folder, and gets its name when it is whole: one with a name needs no second look."""

    def __init__(self, path):
        self.path = path
        self.runs = os.path.join(path, "runs")
        self._lock = None

    def claim(self):
        """Makes it, keeps other sweeps out, and clears away what a killed one left. Raises WrongInput."""
        try:
            os.makedirs(self.runs, exist_ok=True)
        except (FileExistsError, NotADirectoryError, PermissionError) as error:
            raise WrongInput(f"cannot make the folder {error.filename}: {error.strerror.lower()}") from error
        self._lock = open(os.path.join(self.path, ".lock"), "w", encoding="utf-8")  # closed with the process, if killed
        try:
            fcntl.flock(self._lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError as error:
            self.release()
            raise WrongInput(f"another sweep is at work in {self.path}") from error
        for name in os.listdir(self.runs):
            if name.startswith("."):
                shutil.rmtree(os.path.join(self.runs, name), ignore_errors=True)

    def release(self):
        self._lock.close()

    def of(self, run):
        return os.path.join(self.runs, run)

    def record(self, run):
        """{exit_code, error, set, version} of a run that is whole; None of any other."""
        try:
            return load(os.path.join(self.of(run), RECORD))
        except WrongInput:
            return None

    def result(self, run):
        return load(os.path.join(self.of(run), "result.yaml"))

    @contextlib.contextmanager
    def making(self, run):
        """A folder in which to make a run; gone in the end where the run was not finished."""
        part = tempfile.mkdtemp(prefix=f".{run}.", dir=self.runs)
        try:
            yield part
        finally:
            shutil.rmtree(part, ignore_errors=True)

    def finish(self, part, run, record):
        """Keeps what was made there."""
        with open(os.path.join(part, RECORD), "w", encoding="utf-8") as file:
            yaml.safe_dump(record, file, sort_keys=False, allow_unicode=True)
        os.chmod(part, 0o755)  # mkdtemp's are for nobody else
        os.rename(part, self.of(run))
