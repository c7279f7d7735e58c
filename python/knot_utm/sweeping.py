"""A study, run by run, on all cores; and its parts, for those who start the runs in another way."""
import os

from knot_utm import tool
from knot_utm.address import Addresses
from knot_utm.arguments import folder_of, jobs_of
from knot_utm.errors import WrongInput
from knot_utm.plots import require_plottable, write_plots
from knot_utm.study import Study, load_study
from knot_utm.sweep_folder import SweepFolder
from knot_utm.table import Table
from knot_utm.work import Work

SPECIMEN = "specimen"  # the column that tells repeats apart


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
        require_plottable(plots)
        self.study = study if isinstance(study, Study) else load_study(os.fspath(study))
        self.plots = plots
        self.readings = readings  # the word of tensile_test's --readings; None: all
        self.folder = SweepFolder(folder_of(out, os.path.join("out", self.study.name)))
        addresses = Addresses(self.study.method)
        self.names = [addresses.of(settings) for settings in self.study.settings]
        self.runs = dict(zip(self.names, self.study.settings))

    def all(self, jobs):
        """All parts: checks, runs what is open, writes the table and returns it."""
        self._require_same_readings()
        with self._work() as work:
            work.check(self._open(), jobs)
            with self.folder.claimed():
                work.run(self._open(), jobs)
                frame = self._written(work)
            work.require_all()
        return frame

    def make(self, jobs):
        """Makes the runs that are open, unchecked and without a table."""
        with self._work() as work, self.folder.claimed():
            work.run(self._open(), jobs)
            work.require_all()

    def check(self, jobs):
        """Raises WrongInput where one of the runs that are open would be refused."""
        self._require_same_readings()
        with self._work() as work:
            work.check(self._open(), jobs)

    def one(self, run):
        """That run alone, beside others of other processes."""
        if run not in self.runs:
            raise WrongInput(f"{run} is no run of {self.study.file}")
        self._require_same_readings()
        with self._work() as work, self.folder.shared():
            work.run({run: self.runs[run]} if run in self._open() else {}, 1)
            work.require_all()

    def table(self):
        """The table of the runs that are there."""
        with self._work() as work, self.folder.shared():
            frame = self._written(work)
            work.require_all()
        return frame

    def _work(self):
        return Work(self.study, self.folder, list(self.runs), self.readings)

    def _require_same_readings(self):
        """Raises WrongInput where the runs that are there were made for other readings: one table has one kind."""
        done = next((run for run in self.runs if self.folder.is_done(run)), None)
        if done is None or (had := self.folder.record(done).get("readings")) == self.readings:
            return
        what = f"with --readings {had}: give it again" if had else "without --readings: leave it out"
        raise WrongInput(f"the runs in {self.folder.path} were made {what}, or choose another folder")

    def _open(self):
        return {run: point for run, point in self.runs.items() if not self.folder.is_done(run)}

    def _written(self, work):
        study = self.study
        known = tool.key_units(study.method, study.points[0])
        units = {key: known.get(key, "-") for key in study.keys}
        table = Table({**units, SPECIMEN: "-"} if study.repeat > 1 else units)
        for run, point in zip(self.names, study.points):
            record = self.folder.record(run)
            if record is not None:
                self._add(table, point, run, record)
        frame = table.frame()
        with work.stopping():
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
