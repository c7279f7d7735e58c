"""The work on a study's runs: some at a time, until it is done or stopped."""
import contextlib
import errno
import os
import signal
import subprocess
import threading
from concurrent.futures import ThreadPoolExecutor, as_completed

from tqdm import tqdm

from knot_utm import tool
from knot_utm.errors import Interrupted, WrongInput
from knot_utm.yaml_text import load, text_of

DISK_IS_FULL = [os.strerror(code).lower() for code in (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)]
INTERRUPTED = "interrupted"  # the reason of a run that may go on


class Work:
    """What is done for a study, until it is done or stopped."""

    def __init__(self, study, folder):
        self.study, self.folder = study, folder
        self.stopped = None  # why
        self._live = set()
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

    @contextlib.contextmanager
    def stopping(self):
        """What cannot be written stops it; it goes on when there is room again."""
        try:
            yield
        except OSError as error:
            self.stop(f"{error.filename or self.folder.path}: {(error.strerror or str(error)).lower()}")

    def require_all(self):
        if self.stopped:
            raise Interrupted(self.stopped)

    def check(self, points, jobs):
        """Raises WrongInput where tensile_test would refuse one of them."""
        refused = [(point, why) for point, why in zip(points.values(), self._each(self._refusal, points, jobs, "checked")) if why]
        self.require_all()
        if refused:
            point, why = refused[0]
            more = f"; {len(refused)} of {len(points)} runs would be refused" if len(refused) > 1 else ""
            raise WrongInput(f"{self.study.file}: the run with {described(point)} would be refused: {why}{more}")

    def run(self, points, jobs):
        """Makes each of them."""
        self._each(self._make, points, jobs, "run")

    def _each(self, do, points, jobs, what):
        """`do(run, point)` for all, some at a time; what each returned, in their order."""
        with ThreadPoolExecutor(jobs) as pool, tqdm(total=len(points), desc=what, unit="run", disable=None) as bar:
            futures = [pool.submit(do, run, point) for run, point in points.items()]
            try:
                for future in as_completed(futures):
                    future.result()
                    bar.update()
            except BaseException as error:
                self.stop(str(error))
                raise
            return [future.result() for future in futures]

    def _refusal(self, _run, point):
        return None if self.stopped else tool.refusal(self.study.method, point)

    def _make(self, run, point):
        """One run, to the end or until it is stopped."""
        if self.stopped:
            return
        with self.stopping(), self.folder.making(run) as part:
            code, said = self._wait(self._start(point, part))
            if not self.stopped:
                self._keep(part, run, point, code, said.replace(part, self.folder.of(run)))

    def _start(self, point, part):
        # Not in the terminal's group, whose Ctrl-C is for the sweep; and it dies with the sweep.
        process = subprocess.Popen(["setpriv", "--pdeathsig", "KILL", *tool.command(self.study.method, point, part, "--quiet")],
                                   cwd=os.path.dirname(self.study.method), text=True, errors="replace", process_group=0,
                                   stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        self._live.add(process)
        if self.stopped:  # between the question and the start
            process.kill()
        return process

    def _wait(self, process):
        _, stderr = process.communicate()
        self._live.discard(process)
        return process.returncode, tool.said_by(stderr)

    def _keep(self, part, run, point, code, said):
        """What became of a run that ended by itself, or was ended by another than the sweep."""
        reason = reason_of(part)
        if code > 0 and reason is None and any(text in said.lower() for text in DISK_IS_FULL):
            self.stop(said.partition(";")[0])
            return
        if reason in (None, INTERRUPTED):
            self.folder.empty(part)  # there is nothing in it to rely on
        error = None if code == 0 else f"killed by {signal.Signals(-code).name}" if code < 0 else reason or said
        record = {"exit_code": code if code >= 0 else 128 - code, "error": error, "set": point, "version": tool.version()}
        self.folder.finish(part, run, record)


def reason_of(folder):
    """Why a run ended, as its result.yaml says; None where there is none, or it is not whole."""
    with contextlib.suppress(WrongInput):
        result = load(os.path.join(folder, "result.yaml"))
        if isinstance(result, dict) and "specification_failed" in result:
            return result["reason"]
    return None


def described(point):
    return ", ".join(f"{key}={text_of(value)}" for key, value in point.items())
