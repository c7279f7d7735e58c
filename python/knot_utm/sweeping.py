"""A study, run by run, on all cores; and its parts, for those who start the runs in another way."""
import contextlib
import os
import shutil
import signal
import threading

from tqdm.contrib.concurrent import thread_map

from knot_utm import tool
from knot_utm.address import addresses
from knot_utm.arguments import folder_of, jobs_of
from knot_utm.errors import Interrupted, refuse_if, WrongInput
from knot_utm.plots import require_plottable, write_plots
from knot_utm.study import Study, load_study
from knot_utm.sweep_folder import SweepFolder, result_of
from knot_utm.table import SPECIMEN, Table
from knot_utm.yaml_text import described

INTERRUPTED = "interrupted"  # the reason of a run that may go on


def sweep(study, out=None, jobs=None, plots=(), readings=None):
    """Runs a study's file and returns its table, a pandas.DataFrame with its units in `.attrs["units"]`.

    `out`: the folder, unless given out/ and the study's name; runs that are there are not run again. `jobs`: runs at a
    time, unless given as many as there are cores. `plots`: keys of result.yaml, of each of which a picture is made. `readings`:
    "plateau" ends each test once its sliding force is known. Raises WrongInput where the study or one of its runs would be
    refused, before anything is written; Interrupted where it was cut short: the same call goes on."""
    return Sweep(study, out, plots, readings).all(jobs_of(jobs))


class Sweep:
    """A study, or the file of one, in its folder. `runs`: {name: {key: value}}, each once."""

    def __init__(self, study, out=None, plots=(), readings=None):
        """`readings`: the word of tensile_test's option; None: all of them."""
        require_plottable(plots)
        self.study = study if isinstance(study, Study) else load_study(os.fspath(study))
        self.plots, self.readings = plots, readings
        self.folder = SweepFolder(folder_of(out, os.path.join("out", self.study.name)))
        self.names = addresses(self.study.method, self.study.settings)
        self.runs = dict(zip(self.names, self.study.settings))
        self._options = ("--readings", readings) if readings else ()
        self._stopped, self._live = None, set()  # why; the runs in flight

    def all(self, jobs):
        """Checks, runs what is open, writes the table and returns it."""
        self.check(jobs)
        with self._may_be_stopped(), self.folder.claimed():
            self._each(self._make, self._open(), jobs, "run")
            return self._written()

    def make(self, jobs):
        """Makes the runs that are open, unchecked and without a table."""
        with self._may_be_stopped(), self.folder.claimed():
            self._each(self._make, self._open(), jobs, "run")

    def check(self, jobs):
        """Raises WrongInput where one of the runs that are open would be refused, or the runs that are there were made for other
        readings: one table has one kind."""
        self._require_same_readings()
        points = self._open()
        with self._may_be_stopped():
            reasons = self._each(lambda _, point: None if self._stopped else tool.refusal(self.study.method, point, *self._options),
                                 points, jobs, "checked")
        refused = [(point, why) for point, why in zip(points.values(), reasons) if why]
        if refused:
            point, why = refused[0]
            more = f"; {len(refused)} of {len(points)} runs would be refused" if len(refused) > 1 else ""
            raise WrongInput(f"{self.study.file}: the run with {described(point)} would be refused: {why}{more}")

    def some(self, part):
        """The open runs FIRST..LAST in the order of their names, one at a time, beside others of other processes."""
        first, _, last = part.partition("..")
        for run in filter(None, (first, last)):
            refuse_if(run not in self.runs, f"{run} is no run of {self.study.file}")
        self._require_same_readings()
        with self._may_be_stopped(), self.folder.shared():
            points = self._open()
            self._each(self._make, {run: points[run] for run in sorted(points) if first <= run <= (last or run)}, 1, "run")

    def table(self):
        """The table of the runs that are there."""
        with self._may_be_stopped(), self.folder.shared():
            return self._written()

    def _open(self):
        return {run: point for run, point in self.runs.items() if not self.folder.is_done(run)}

    def _require_same_readings(self):
        done = next((run for run in self.runs if self.folder.is_done(run)), None)
        if done is None or (had := self.folder.record(done).get("readings")) == self.readings:
            return
        what = f"with --readings {had}: give it again" if had else "without --readings: leave it out"
        raise WrongInput(f"the runs in {self.folder.path} were made {what}, or choose another folder")

    # ---- to the end, or until it is stopped ----

    @contextlib.contextmanager
    def _may_be_stopped(self):
        """By a signal, a full disk or a mistake. Raises Interrupted where it was."""
        self._stopped, handlers = None, {}
        if threading.current_thread() is threading.main_thread():
            for code in (signal.SIGINT, signal.SIGTERM):
                handlers[code] = signal.signal(code, lambda *_: self._stop("it was interrupted"))
        try:
            yield
        finally:
            for code, handler in handlers.items():
                signal.signal(code, handler)
        if self._stopped:
            done = sum(self.folder.is_done(run) for run in self.runs)
            raise Interrupted(f"{self._stopped}, with {done:,} of {len(self.runs):,} runs done")

    def _stop(self, why):
        """No run begins any more, and those in flight are lost."""
        self._stopped = self._stopped or why
        for process in list(self._live):
            process.kill()

    @contextlib.contextmanager
    def _stopped_by_a_full_disk(self):
        """What cannot be written stops it; it goes on when there is room again."""
        try:
            yield
        except OSError as error:
            self._stop(f"{error.filename or self.folder.path}: {(error.strerror or str(error)).lower()}")

    def _each(self, do, points, jobs, what):
        """`do(run, point)` for all points, some at a time; what each returned, in their order."""
        def done(run, point):
            try:
                return do(run, point)
            except BaseException as error:
                self._stop(str(error))
                raise

        return thread_map(done, points.keys(), points.values(), max_workers=jobs, desc=what, unit="run", disable=None)

    def _make(self, run, point):
        if self._stopped:
            return
        with self._stopped_by_a_full_disk(), self.folder.making(run) as part:
            one_job = ("--jobs", "1") if self.study.repeat > 1 else ()
            process = tool.start(self.study.method, point, part, *self._options, *one_job)
            self._live.add(process)
            if self._stopped:  # between the question and the start
                process.kill()
            _, stderr = process.communicate()
            self._live.discard(process)
            if not self._stopped:
                self._keep(part, run, point, process.returncode, tool.said_by(stderr).replace(part, self.folder.of(run)))

    def _keep(self, part, run, point, code, said):
        """What became of a run that ended by itself, or was ended by another than the sweep."""
        result = result_of(part)
        if code > 0 and result is None and tool.is_of_a_full_disk(said):
            self._stop(said.partition(";")[0])
            return
        if result is None or result.get("reason") == INTERRUPTED:
            shutil.rmtree(part)  # there is nothing in it to rely on
            os.mkdir(part)
        why = result.get("reason") if result else None
        error = None if code == 0 else f"killed by {signal.Signals(-code).name}" if code < 0 else why or said
        record = {"exit_code": code if code >= 0 else 128 - code, "error": error, "set": point, "version": tool.version(),
                  **({"readings": self.readings} if self.readings else {})}
        self.folder.finish(part, run, record)

    # ---- the table ----

    def _written(self):
        study = self.study
        known = tool.key_units(study.method, study.points[0])
        units = {key: known.get(key, "-") for key in study.keys}
        table = Table({**units, SPECIMEN: "-"} if study.repeat > 1 else units)
        for run, point in zip(self.names, study.points):
            if (record := self.folder.record(run)) is not None:
                self._add(table, point, run, record)
        frame = table.frame()
        with self._stopped_by_a_full_disk():
            table.write(self.folder.path)
            for result in self.plots if table.rows else ():
                write_plots(frame, study, result, self.folder.path, self.folder)
        return frame

    def _add(self, table, point, run, record):
        """A row for a run, or for each specimen of its batch."""
        if self.study.repeat == 1:
            table.add(point, run, record["exit_code"], record["error"], self.folder.result(run))
            return
        rejected = self.folder.rejected(run)
        for number in range(1, self.study.repeat + 1):
            specimen = f"{run}/specimen_{number:03d}"
            result = self.folder.result(specimen)
            error = rejected.get(number) if result else record["error"]
            code = int(error is not None) if result else record["exit_code"]
            table.add({**point, SPECIMEN: number}, specimen, code, error, result)
