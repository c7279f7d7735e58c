"""The work on a study's runs: some at a time, until it is done or stopped."""
import contextlib
import os
import signal
import threading
from concurrent.futures import ThreadPoolExecutor, as_completed

from tqdm import tqdm

from knot_utm import tool
from knot_utm.errors import Interrupted, WrongInput
from knot_utm.sweep_folder import RESULT, STATISTICS
from knot_utm.yaml_text import described, load

INTERRUPTED = "interrupted"  # the reason of a run that may go on


class Work:
    """What is done for a study, until it is done or stopped."""

    def __init__(self, study, folder, runs, readings=None):
        """`runs`: the names of all; `readings`: the word of tensile_test's option, or None."""
        self.stopped = None  # why
        self._live = set()
        self.study, self.folder, self.runs, self.readings = study, folder, runs, readings
        self._options = ("--readings", readings) if readings else ()
        self._handlers = {}

    def __enter__(self):
        if threading.current_thread() is threading.main_thread():
            for code in (signal.SIGINT, signal.SIGTERM):
                self._handlers[code] = signal.signal(code, lambda *_: self.stop("it was interrupted"))
        return self

    def __exit__(self, *_):
        for code, handler in self._handlers.items():
            signal.signal(code, handler)

    def stop(self, why):
        """No run begins any more, and those in flight are lost."""
        self.stopped = self.stopped or why
        for process in list(self._live):
            process.kill()

    def _each(self, do, points, jobs, what):
        """`do(*point)` for all points, some at a time; what each returned, in their order."""
        with ThreadPoolExecutor(jobs) as pool, tqdm(total=len(points), desc=what, unit="run", disable=None) as bar:
            futures = [pool.submit(do, *point) for point in points]
            try:
                for future in as_completed(futures):
                    future.result()
                    bar.update()
            except BaseException as error:
                self.stop("it was interrupted" if isinstance(error, KeyboardInterrupt) else str(error))
                raise Interrupted(self.stopped) if isinstance(error, KeyboardInterrupt) else error
            return [future.result() for future in futures]

    @contextlib.contextmanager
    def stopping(self):
        """What cannot be written stops it; it goes on when there is room again."""
        try:
            yield
        except OSError as error:
            self.stop(f"{error.filename or self.folder.path}: {(error.strerror or str(error)).lower()}")

    def require_all(self):
        if self.stopped:
            done = sum(self.folder.is_done(run) for run in self.runs)
            raise Interrupted(f"{self.stopped}, with {done:,} of {len(self.runs):,} runs done")

    def check(self, points, jobs):
        """Raises WrongInput where tensile_test would refuse one of them."""
        reasons = self._each(self._refusal, points.items(), jobs, "checked")
        refused = [(point, why) for point, why in zip(points.values(), reasons) if why]
        self.require_all()
        if refused:
            point, why = refused[0]
            more = f"; {len(refused)} of {len(points)} runs would be refused" if len(refused) > 1 else ""
            raise WrongInput(f"{self.study.file}: the run with {described(point)} would be refused: {why}{more}")

    def run(self, points, jobs):
        """Makes each of them."""
        self._each(self._make, points.items(), jobs, "run")

    def _refusal(self, _run, point):
        return None if self.stopped else tool.refusal(self.study.method, point, *self._options)

    def _make(self, run, point):
        """One run, to the end or until it is stopped."""
        if self.stopped:
            return
        with self.stopping(), self.folder.making(run) as part:
            code, said = self._wait(point, part)
            if not self.stopped:
                self._keep(part, run, point, code, said.replace(part, self.folder.of(run)))

    def _wait(self, point, part):
        """(exit code, the last line that it said) of a run that goes on to its end or until it is stopped."""
        process = tool.start(self.study.method, point, part, *self._options, *(("--jobs", "1") if self.study.repeat > 1 else ()))
        self._live.add(process)
        if self.stopped:  # between the question and the start
            process.kill()
        _, stderr = process.communicate()
        self._live.discard(process)
        return process.returncode, tool.said_by(stderr)

    def _keep(self, part, run, point, code, said):
        """What became of a run that ended by itself, or was ended by another than the sweep."""
        result = result_of(part)
        if code > 0 and result is None and tool.is_of_a_full_disk(said):
            self.stop(said.partition(";")[0])
            return
        if result is None or result.get("reason") == INTERRUPTED:
            self.folder.empty(part)  # there is nothing in it to rely on
        why = result.get("reason") if result else None
        error = None if code == 0 else f"killed by {signal.Signals(-code).name}" if code < 0 else why or said
        record = {"exit_code": code if code >= 0 else 128 - code, "error": error, "set": point, "version": tool.version(),
                  **({"readings": self.readings} if self.readings else {})}
        self.folder.finish(part, run, record)


def result_of(folder):
    """result.yaml of a run that has ended, or statistics.yaml of a batch; None where there is none, or it is not whole."""
    with contextlib.suppress(WrongInput):
        if os.path.exists(os.path.join(folder, STATISTICS)):
            return load(os.path.join(folder, STATISTICS))
        result = load(os.path.join(folder, RESULT))
        if isinstance(result, dict) and "specification_failed" in result:
            return result
    return None
