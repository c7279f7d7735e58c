"""A fit: the values of a method's keys with which it produces a measured curve (doc/fits.md)."""
import itertools
import os
import tempfile
from collections.abc import Iterable

from knot_utm import method_keys, tool
from knot_utm.arguments import folder_of, jobs_of, make_folder, method_of, path_of, settings_map, shown
from knot_utm.errors import WrongInput
from knot_utm.fitting.found import WRITTEN, Fitted, short, write_report
from knot_utm.fitting.keys import method_key, offset_key, parse_free
from knot_utm.fitting.pulls import EXACT_CELL, Runs, read_model, read_other, read_own
from knot_utm.fitting.records import Record
from knot_utm.fitting.search import Search
from knot_utm.yaml_text import described, value_of

WITHIN = 0.4321  # a place within a range, where a whole number is unlikely


def fit(measured, method, free, out=None, settings=None, also=(), jobs=None, command=None, report=True, reading=(),
        overwrite=False):
    """Finds the values of the free keys and returns them as fitting.found.Fitted.

    `measured`: a curve.csv, or what else `compare` reads; `free`: ["KEY" or "KEY=low:high"]; `settings`: {key: value} over the
    method; `also`: [(measured, {key: value})], more records and what is other for them; `out`: the folder for fit.yaml,
    method.yaml and, with `report`, report.html, unless given out/ and the name of the measured file; `command`: that the page
    names; `reading`: options of `compare` with which raw data are read, such as ["--units", "load=lbf"]; `overwrite`: whether
    another fit in the folder is replaced. Raises WrongInput where it cannot be fitted, before anything is written; Interrupted where it
    was cut short."""
    measured, settings = path_of("measured", measured, "the file of a curve"), settings_map(settings)
    also = [(path_of("also", file, "files of curves"), settings_map(more)) for file, more in _pairs(also)]
    free = _words(free)
    out = folder_of(out, os.path.join("out", os.path.splitext(os.path.basename(measured))[0] + "_fit"))
    method, jobs = tool.find_method(method_of(method), os.getcwd()), jobs_of(jobs)
    _require_room(out, [measured, *(file for file, _ in also), method], overwrite)
    asked = [(measured, settings)] + [(file, {**settings, **more}) for file, more in also]
    free = [parse_free(word) for word in free]
    _require_free([name for name, _ in free], asked)
    with tempfile.TemporaryDirectory(prefix="knot_utm_fit.", ignore_cleanup_errors=True) as folder:
        runs = Runs(method, folder, jobs)
        fitted = Fitted(_searched(runs, method, asked, free, reading))
    values = {key: one.value for key, one in fitted.found.items() if not key.startswith("record.")}
    fitted.write(out, [tool.resolved(method, {**given, **values}) for _, given in asked])
    if report:
        write_report(out, command or "knot_utm.fit in Python")
    return fitted


def _words(free):
    words = list(free) if isinstance(free, Iterable) and not isinstance(free, str) else [None]
    if not all(isinstance(word, str) for word in words):
        raise WrongInput(f"free is {shown(free)}, but must be a list of words such as 'material.radius=0.001:0.002'")
    return words


def _pairs(also):
    pairs = list(also) if isinstance(also, Iterable) else [also]
    if isinstance(also, str) or not all(isinstance(pair, (tuple, list)) and len(pair) == 2 for pair in pairs):
        raise WrongInput(f"also is {shown(also)}, but must be a list of (file, settings)")
    return pairs


def _searched(runs, method, asked, free, reading):
    """A search that has ended."""
    methods = [value_of(tool.resolved(method, {**given, tool.COUNT: 2})) for _, given in asked]  # one specimen does not scatter
    numbers = tool.key_units(method, asked[0][1])
    keys = {name: method_key(name, limits, methods[0], numbers) for name, limits in free if not name.startswith("record.")}
    _require_allowed(method, list(keys.values()), [given for _, given in asked])
    records = _read(runs, asked, methods, reading)
    keys |= {name: offset_key(name, limits, records) for name, limits in free if name not in keys}
    keys = [keys[name] for name, _ in free]

    def run(places, first):
        values = [{key.name: float(key.value(at)) for key, at in zip(keys, place) if not key.offset} for place in places]
        models = runs.models([record.run_settings(at, (first + i) * len(records) + k) for k, record in enumerate(records)
                              for i, at in enumerate(values)])
        return [models[k * len(places):(k + 1) * len(places)] for k in range(len(records))]
    return Search(records, keys, run).go()


def _read(runs, asked, methods, reading):
    """The records, each beside a run of the method as it stands."""
    pulls = [read_own(file) for file, _ in asked]
    records = []
    for (file, given), method, pull in zip(asked, methods, pulls):
        folder, notes = runs.whole(given), []
        if pull is None:
            pull, notes = read_other(file, os.path.join(folder, "curve.csv"), reading)
        records.append(Record(file, pull, given, method, notes))
        records[-1].require_producible(read_model(folder))
        records[-1].require_errors()
    return records


def _require_allowed(method, keys, settings):
    """All corners of the ranges, and a place within them, for all records: before the first run."""
    places = [*itertools.product((0.0, 1.0), repeat=len(keys)), [WITHIN] * len(keys)]
    for given in settings:
        for place in places:
            free = {key.name: short(key.value(at)) for key, at in zip(keys, place)}
            if refused := tool.refusal(method, {**given, **free}):
                raise WrongInput(f"--free: a run with {described(free)} would be refused: {refused}")


def _require_free(names, asked):
    """Raises WrongInput where keys are mistyped, or cannot be free. `asked`: [(file, {key: value})] of the records."""
    if not names:
        raise WrongInput("--free is missing: say which keys may move")
    (_, settings), *more = asked
    for name in names:
        if names.count(name) > 1:
            raise WrongInput(f"--free has {name} twice")
        if name in EXACT_CELL:
            raise WrongInput(f"--free: {name} is an error of the cell, which is one of the errors that a fit goes by")
        for file, given in more:
            if name in given and given[name] != settings.get(name):
                raise WrongInput(f"--also {file}: {name} is set, but it is free, and free keys are the same for all records")
    of_method = [name for name in names if not name.startswith("record.")]
    if not of_method:
        raise WrongInput("--free has nothing but offsets of the record: a fit needs a key of the method")
    method_keys.require_known(of_method, "--free: ")
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
    was_there = os.path.isdir(out)
    make_folder(out)
    if not was_there:
        os.rmdir(out)  # nothing is written before it is known that it can be fitted
