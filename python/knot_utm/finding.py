"""A fit: the values of a method's keys with which it produces a measured curve (doc/fits.md)."""
import itertools
import os
import shutil

from knot_utm import method_keys, tool
from knot_utm.errors import WrongInput
from knot_utm.fitting.curves import is_own, read_other, read_own
from knot_utm.fitting.errors import require_known
from knot_utm.fitting.files import WRITTEN, write_fit, write_report
from knot_utm.fitting.keys import method_key, offset_key, parse_free
from knot_utm.fitting.records import Record
from knot_utm.fitting.runs import EXACT_CELL, Runs, read_model
from knot_utm.fitting.scatter import SPECIMENS, Batch
from knot_utm.fitting.search import Case, Search
from knot_utm.fitting.verdict import judge, short
from knot_utm.yaml_text import described, value_of

WITHIN = 0.4321  # a place within a range, where a whole number is unlikely


def fit(measured, method, free, out=None, settings=None, also=(), jobs=None, command=None, report=True, reading=(),
        overwrite=False):
    """Finds the values of the free keys and returns them as fitting.verdict.Fitted.

    `measured`: a curve.csv, or what else `compare` reads; `free`: ["KEY" or "KEY=low:high"]; `settings`: {key: value} over the
    method; `also`: [(measured, {key: value})], more records and what is other for them; `out`: the folder for fit.yaml,
    method.yaml and, with `report`, report.html, unless given out/ and the name of the measured file; `command`: that the page
    names; `reading`: options of `compare` with which raw data are read, such as ["--units", "load=lbf"]; `overwrite`: whether
    another fit in the folder is replaced. Raises WrongInput where it cannot be fitted, before anything is written; Interrupted where it was cut short."""
    name = os.path.splitext(os.path.basename(os.fspath(measured)))[0]
    out = os.path.abspath(out or os.path.join("out", name + "_fit"))
    method = tool.find_method(os.fspath(method), os.getcwd())
    _require_room(out, [os.fspath(measured), *(os.fspath(file) for file, _ in also), method], overwrite)
    asked = [(os.fspath(measured), dict(settings or {}))]
    asked += [(os.fspath(file), {**(settings or {}), **more}) for file, more in also]
    with Runs(jobs or len(os.sched_getaffinity(0))) as runs:
        fitted = _Fit(runs, method, asked, [parse_free(word) for word in free], reading).go()
    write_fit(out, fitted, [fitted_method(method, given, fitted) for _, given in asked])
    if report:
        write_report(out, command or "knot_utm.fit in Python")
    return fitted


class _Fit:
    def __init__(self, runs, method, asked, free, reading):
        self.runs = runs
        self.reading = reading
        self.method = method
        if not free:
            raise WrongInput("--free is missing: say which keys may move")
        names = [name for name, _ in free]
        for name in names:
            if names.count(name) > 1:
                raise WrongInput(f"--free has {name} twice")
        if all(name.startswith("record.") for name in names):
            raise WrongInput("--free has nothing but offsets of the record: a fit needs a key of the method")
        for file, given in asked[1:]:
            for name in names:
                if name in given and given[name] != asked[0][1].get(name):
                    raise WrongInput(f"--also {file}: {name} is set, but it is free, and free keys are the same for all records")
        _require_keys(names, asked)
        self.methods = [value_of(tool.resolved(method, given)) for _, given in asked]
        keys = {name: self._method_key(name, limits, asked[0][1]) for name, limits in free if not name.startswith("record.")}
        self._require_allowed(list(keys.values()), [given for _, given in asked])
        self.records = self._read(asked)
        keys |= {name: offset_key(name, limits, self.records) for name, limits in free if name not in keys}
        self.keys = [keys[name] for name in names]

    def _method_key(self, name, limits, given):
        if name in EXACT_CELL:
            raise WrongInput(f"--free: {name} is an error of the cell, which is one of the errors that a fit goes by")
        return method_key(name, limits, self.methods[0], tool.key_units(self.method, given))

    def _require_allowed(self, keys, settings):
        """All corners of the ranges, and a place within them, for all records: before the first run."""
        places = [*itertools.product((0.0, 1.0), repeat=len(keys)), [WITHIN] * len(keys)]
        for given in settings:
            for place in places:
                free = {key.name: short(key.value(at)) for key, at in zip(keys, place)}
                if refused := tool.refusal(self.method, {**given, **free}):
                    raise WrongInput(f"--free: a run with {described(free)} would be refused: {refused}")

    def _read(self, asked):
        """The records, each beside a run of the method as it stands."""
        pulls = [read_own(file) if is_own(file) else None for file, _ in asked]
        records = []
        for (file, given), pull in zip(asked, pulls):
            folder = self.runs.whole(self.method, given, "--specimens", "1")
            notes = []
            if pull is None:
                pull, notes = read_other(file, os.path.join(folder, "curve.csv"), self.reading)
            record = Record(file, pull, given, notes)
            record.require_producible(read_model(folder))
            records.append(record)
            shutil.rmtree(folder)
        return records

    def go(self):
        inputs = sum(key.offset is None for key in self.keys)
        self.runs.expect(len(self.records) * Search.most_runs(len(self.keys), inputs))
        batches = [self._batch(record.settings) for record in self.records]
        cells = [method["machine"]["load_cell"] for method in self.methods]
        self.cases = [Case(record, number, self.keys, cell, batch)
                      for number, (record, cell, batch) in enumerate(zip(self.records, cells, batches), start=1)]
        for case in self.cases:
            scatter, _ = case.scatter()
            require_known(case.record, case.cell, scatter)
        search = Search(self.cases, self.keys, self._run, self._renew)
        search.go()
        return judge(search)

    def _batch(self, given):
        """Specimens, where they scatter."""
        folder = self.runs.whole(self.method, {**given, **EXACT_CELL}, "--specimens", str(SPECIMENS), "--jobs",
                                 str(self.runs.jobs))
        batch = Batch(folder)
        shutil.rmtree(folder)
        return batch if batch.draws[0] else None

    def _renew(self, best):
        for case in self.cases:
            if case.batch:
                free = {key.name: float(key.value(at)) for key, at in zip(self.keys, best) if key.offset is None}
                case.renew(self._batch({**case.record.settings, **free}))

    def _run(self, places, first):
        asked = [(self.method, case.settings(place, first + i)) for case in self.cases for i, place in enumerate(places)]
        models = self.runs.all(asked)
        count = len(places)
        made = [models[k * count:(k + 1) * count] for k in range(len(self.cases))]
        for case, of_case in zip(self.cases, made):
            if not case.models and not any(case.record.is_reached(model) for model in of_case):
                raise WrongInput(f"{case.record.name}: no run in the ranges of the free keys reaches as far as the record: narrow "
                                 "the ranges")
        return made


def fitted_method(method, given, fitted):
    """The text of the method with the values that were found."""
    values = {key: one.value for key, one in fitted.found.items() if not key.startswith("record.")}
    return tool.resolved(method, {**given, **values})


def _require_keys(free, asked):
    """Raises WrongInput where a key is mistyped. `free`: names; `asked`: [(file, {key: value})] of the records."""
    method_keys.require_known([name for name in free if not name.startswith("record.")], "--free: ")
    (_, settings), *more = asked
    method_keys.require_known(settings, "--set: ")
    for file, given in more:
        method_keys.require_known(given, f"--also {file}: ")


def _require_room(out, inputs, overwrite):
    if os.path.exists(os.path.join(out, "result.yaml")):
        raise WrongInput(f"{out} holds a run: choose another folder")
    for file in (os.path.join(out, name) for name in WRITTEN):
        if not os.path.exists(file):
            continue
        if any(os.path.exists(one) and os.path.samefile(file, one) for one in inputs):
            raise WrongInput(f"{file} is an input, and would be written over: choose another folder")
        if not overwrite:
            raise WrongInput(f"{file} exists already: choose another folder, or --overwrite")
    try:
        os.makedirs(os.path.dirname(out), exist_ok=True)
        if os.path.exists(out) and not os.path.isdir(out):
            raise FileExistsError(0, "file exists", out)
    except (FileExistsError, NotADirectoryError, PermissionError) as error:
        raise WrongInput(f"cannot make the folder {error.filename}: {error.strerror.lower()}") from error
