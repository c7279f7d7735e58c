"""The runs of a fit: many at a time, each read and thrown away."""
import os
import shutil
import tempfile
from dataclasses import dataclass

import pandas as pd

from knot_utm import tool
from knot_utm.errors import Interrupted, WrongInput
from knot_utm.fitting.curves import pull_of_table
from knot_utm.runner import Runner
from knot_utm.yaml_text import load

# The model tells what the specimen bears; the errors of the cell are counted with those of the record.
EXACT_CELL = {f"machine.load_cell.{key}": 0 for key in ("accuracy", "noise", "resolution", "floor")}


@dataclass(frozen=True)
class Model:
    """What one run says. `pull`: None where there is none to speak of, because the run failed."""

    pull: object
    result: dict


class Runs(Runner):
    """Runs of a method in a folder of its own, which is gone in the end. A context."""

    def __init__(self, method, jobs):
        super().__init__()
        self.method, self.jobs = method, jobs

    def __enter__(self):
        self.folder = tempfile.mkdtemp(prefix="knot_utm_fit.")
        return self

    def __exit__(self, *_):
        shutil.rmtree(self.folder, ignore_errors=True)

    def models(self, asked):
        """[Model] of [settings], in their order."""
        return self.each(self._run, [(settings,) for settings in asked], self.jobs, "fit")

    def whole(self, settings, *more):
        """The folder of a run that is not thrown away before the end. Raises WrongInput where refused."""
        out = tempfile.mkdtemp(dir=self.folder)
        code, said = self._wait(settings, out, *more)
        if code == tool.REFUSED:
            raise WrongInput(said)
        return out

    def _run(self, settings):
        out = tempfile.mkdtemp(dir=self.folder)
        try:
            code, _ = self._wait({**settings, **EXACT_CELL}, out, "--specimens", "1")
            return read_model(out) if code in (0, 1) else Model(None, {})
        finally:
            shutil.rmtree(out, ignore_errors=True)

    def _wait(self, settings, out, *more):
        if self.stopped:
            raise Interrupted(self.stopped)
        code, said = self.wait(self.method, settings, out, "--overwrite", *more)
        if code > 0 and tool.is_of_a_full_disk(said):
            raise RuntimeError(said)
        return code, said


def read_model(folder):
    """What a run left, as a Model."""
    try:
        result = load(os.path.join(folder, "result.yaml"))
        pull = pull_of_table(pd.read_csv(os.path.join(folder, "curve_full.csv"), skiprows=[1]))
    except (WrongInput, OSError, ValueError):
        return Model(None, {})
    return Model(pull, result)
