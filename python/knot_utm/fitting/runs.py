"""The runs of a fit: many at a time, each read and thrown away."""
import contextlib
import os
import shutil
import tempfile
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import dataclass

import pandas as pd
from tqdm import tqdm

from knot_utm import tool
from knot_utm.errors import Interrupted, WrongInput
from knot_utm.fitting.curves import pull_of_table
from knot_utm.yaml_text import load

# The model tells what the specimen bears; the errors of the cell are counted with those of the record.
EXACT_CELL = {f"machine.load_cell.{key}": 0 for key in ("accuracy", "noise", "resolution", "floor")}


@dataclass(frozen=True)
class Model:
    """What one run says. `pull`: None where there is none to speak of, because the run failed."""

    pull: object
    result: dict


class Runs:
    """Runs tensile_test in a folder of its own, which is gone in the end. A context."""

    def __init__(self, jobs):
        self.jobs = jobs
        self.made = 0
        self._live = set()
        self._stopped = False

    def __enter__(self):
        self.folder = tempfile.mkdtemp(prefix="knot_utm_fit.")
        self.bar = tqdm(total=0, desc="fit", unit="run", disable=None)
        return self

    def __exit__(self, *_):
        self.bar.close()
        shutil.rmtree(self.folder, ignore_errors=True)

    def expect(self, more):
        """So many runs are to come beyond those that have been made."""
        self.bar.total = self.made + more
        self.bar.refresh()

    def all(self, asked):
        """[Model] of [(method, settings)], in their order."""
        with ThreadPoolExecutor(self.jobs) as pool:
            futures = [pool.submit(self._run, method, settings) for method, settings in asked]
            try:
                for future in as_completed(futures):
                    future.result()
                    self.made += 1
                    self.bar.update()
            except BaseException as error:
                self._stop()
                raise Interrupted("it was interrupted") if isinstance(error, KeyboardInterrupt) else error
            return [future.result() for future in futures]

    def whole(self, method, settings, *more):
        """The folder of a run that is not thrown away before the end. Raises WrongInput where refused."""
        out = tempfile.mkdtemp(dir=self.folder)
        code, said = self._wait(method, settings, out, more)
        if code == tool.REFUSED:
            raise WrongInput(said)
        return out

    def _run(self, method, settings):
        out = tempfile.mkdtemp(dir=self.folder)
        try:
            code, _ = self._wait(method, {**settings, **EXACT_CELL}, out, ("--specimens", "1"))
            return read_model(out) if code in (0, 1) else Model(None, {})
        finally:
            shutil.rmtree(out, ignore_errors=True)

    def _wait(self, method, settings, out, more):
        if self._stopped:
            raise Interrupted("it was interrupted")
        process = tool.start(method, settings, out, "--overwrite", *more)
        self._live.add(process)
        if self._stopped:
            process.kill()
        _, stderr = process.communicate()
        self._live.discard(process)
        said = tool.said_by(stderr)
        if process.returncode > 0 and tool.is_of_a_full_disk(said):
            raise RuntimeError(said)
        return process.returncode, said

    def _stop(self):
        self._stopped = True
        for process in list(self._live):
            with contextlib.suppress(ProcessLookupError):
                process.kill()


def read_model(folder):
    """What a run left, as a Model."""
    try:
        result = load(os.path.join(folder, "result.yaml"))
        pull = pull_of_table(pd.read_csv(os.path.join(folder, "curve_full.csv"), skiprows=[1]))
    except (WrongInput, OSError, ValueError):
        return Model(None, {})
    return Model(pull, result)
