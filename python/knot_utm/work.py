"""The work on a study's runs: some at a time, until it is done or stopped."""
import contextlib
import os
import signal
import threading
from collections import Counter

from knot_utm import tool
from knot_utm.errors import Interrupted, WrongInput
from knot_utm.runner import Runner
from knot_utm.sweep_folder import RESULT, STATISTICS
from knot_utm.yaml_text import described, load

INTERRUPTED = "interrupted"  # the reason of a run that may go on


class Work(Runner):
    """What is done for a study, until it is done or stopped."""

    def __init__(self, study, folder, runs, beginnings, readings=None):
        """`runs`: the names of all; `beginnings`: {run: (name, Beginning)} of those that share one; `readings`: the word of
        tensile_test's option, or None."""
        super().__init__()
        self.study, self.folder, self.runs, self.beginnings, self.readings = study, folder, runs, beginnings, readings
        self._options = ("--readings", readings) if readings else ()
        self.begun = []  # names of the beginnings that runs began with
        self._handlers = {}

    def __enter__(self):
        if threading.current_thread() is threading.main_thread():
            for code in (signal.SIGINT, signal.SIGTERM):
                self._handlers[code] = signal.signal(code, lambda *_: self.stop("it was interrupted"))
        return self

    def __exit__(self, *_):
        for code, handler in self._handlers.items():
            signal.signal(code, handler)

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
        reasons = self.each(self._refusal, points.items(), jobs, "checked")
        refused = [(point, why) for point, why in zip(points.values(), reasons) if why]
        self.require_all()
        if refused:
            point, why = refused[0]
            more = f"; {len(refused)} of {len(points)} runs would be refused" if len(refused) > 1 else ""
            raise WrongInput(f"{self.study.file}: the run with {described(point)} would be refused: {why}{more}")

    def run(self, points, jobs):
        """Makes each of them, and before that each beginning that several of them share."""
        shared = dict(self.beginnings[run] for run in points if run in self.beginnings)
        wanted = Counter(self.beginnings[run][0] for run in points if run in self.beginnings)
        self.each(self._tie, [(name, beginning) for name, beginning in shared.items()
                              if wanted[name] > 1 and not os.path.exists(self.folder.tied(name))], jobs, "tied")
        self.each(self._make, points.items(), jobs, "run")

    def _refusal(self, _run, point):
        return None if self.stopped else tool.refusal(self.study.method, point, *self._options)

    def _tie(self, name, beginning):
        """A beginning, up to the step before which it stops. Where it comes to nothing, the runs say why."""
        place = self.folder.tied(name)
        if self.stopped:
            return
        with self.stopping(), self.folder.making(place) as part:
            code, said = self._wait(beginning.point, part, "--stop-before", str(beginning.step))
            if code > 0 and tool.is_of_a_full_disk(said):
                self.stop(said.partition(";")[0].replace(part, place))
            elif code == 0 and not self.stopped and os.path.exists(os.path.join(part, "checkpoint")):
                self.folder.put(part, place)

    def _make(self, run, point):
        """One run, to the end or until it is stopped."""
        if self.stopped:
            return
        with self.stopping(), self.folder.making(self.folder.of(run)) as part:
            code, said = self._go_on(run, point, part) or self._wait(point, part, *self._options)
            if not self.stopped:
                self._keep(part, run, point, code, said.replace(part, self.folder.of(run)))

    def _go_on(self, run, point, part):
        """The same with the beginning that it shares; None where there is none that suits it."""
        name = self.beginnings[run][0] if run in self.beginnings else ""
        if not name or not os.path.exists(self.folder.tied(name)):
            return None
        code, said = self._wait(point, part, "--begin-with", self.folder.tied(name), *self._options)
        if code == tool.REFUSED:
            return None
        self.begun.append(name)
        return code, said

    def _wait(self, point, part, *more):
        return self.wait(self.study.method, point, part, *more, *(("--jobs", "1") if self.study.repeat > 1 else ()))

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
