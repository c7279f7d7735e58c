"""A fit: the values of a method's keys with which it produces a measured curve (doc/fits.md)."""
import itertools
import math
import os
import re
import tempfile
from dataclasses import asdict, dataclass

import numpy as np
import pandas as pd
import yaml
from scipy import stats

from knot_utm import tool
from knot_utm.arguments import folder_of, jobs_of, make_folder, shown, write_whole
from knot_utm.errors import refuse_if
from knot_utm.fitting import Record, Search, pull_of_table, read_pull
from knot_utm.study import Study
from knot_utm.sweeping import Sweep
from knot_utm.yaml_text import described, is_number, text_of, value_at, value_of

WRITTEN = ("fit.yaml", "curves.csv", "profiles.csv", "method.yaml", "method_2.yaml", "report.html", "report.pdf")
OFFSET = re.compile(r"record(?:\.([1-9]\d*))?\.(force|extension)_offset")
# The model tells what the specimen bears; the errors of the cell are counted with those of the record.
EXACT_CELL = {f"machine.load_cell.{key}": 0 for key in ("accuracy", "noise", "resolution", "floor")}
WITHIN = 0.4321      # a place within a range, where a whole number is unlikely
AROUND = 3.0         # a range that is not given: from the method's value over this to that value times this
LOGARITHMIC = 5.0    # high over low, from where the range counts in factors
OFFSET_SHARE = 0.05  # a range of an offset that is not given: of the largest load, of the largest extension
LEAST_PROBABILITY = 1e-3  # of residuals as large as these, below which the curve does not fit
AT_THE_END = 1e-3    # of the range
KNOWN_TOGETHER = 0.99, 0.9  # correlation from which on two keys are known as a combination only; where the data bound neither alone


@dataclass(frozen=True)
class FreeKey:
    """One free key. Its place in the range goes from 0 (low) to 1 (high)."""

    name: str
    low: float
    high: float

    def value(self, place):
        if self.low > 0 and self.high > LOGARITHMIC * self.low:
            return self.low * (self.high / self.low) ** place
        return self.low + (self.high - self.low) * place

    @property
    def offset(self):
        """(number of the record, "force" or "extension") of an offset of a record; None of a key of the method."""
        match = OFFSET.fullmatch(self.name)
        return (int(match[1] or 1), match[2]) if match else None


@dataclass(frozen=True)
class Estimate:
    """The value of a key and its 95 % interval; an end that the data do not tell is None."""

    value: float
    low: object
    high: object
    identifiable: bool


def fit(measured, method, free, out=None, settings=None, also=(), jobs=None, command=None, report=True, overwrite=False):
    """Finds the values of the free keys and returns them as a Fitted.

    `measured`: a curve.csv; `free`: ["KEY" or "KEY=low:high"]; `settings`: {key: value} over the method; `also`: [(measured, {key:
    value})], more records and what is other for them; `out`: the folder for fit.yaml, method.yaml and, with `report`, report.html, unless
    given out/ and the name of the measured file; `command`: that the page names; `overwrite`: whether another fit in the folder is
    replaced. Raises WrongInput where it cannot be fitted, before anything is written; Interrupted where it was cut short."""
    measured, settings = os.fspath(measured), dict(settings or {})
    refuse_if(not isinstance(free, (tuple, list)) or not all(isinstance(word, str) for word in free),
              f"free is {shown(free)}, but must be a list of words such as 'material.radius=0.001:0.002'")
    asked = [(measured, settings)]
    asked += [(os.fspath(file), {**settings, **given}) for file, given in also]
    out = folder_of(out, os.path.join("out", os.path.splitext(os.path.basename(measured))[0] + "_fit"))
    method, jobs = tool.find_method(os.fspath(method), os.getcwd()), jobs_of(jobs)
    _require_room(out, [method, *(file for file, _ in asked)], overwrite)
    ranges = dict(_parsed(word, list(free)) for word in free)
    _require_free(list(ranges), asked)
    with tempfile.TemporaryDirectory(prefix="knot_utm_fit.", ignore_cleanup_errors=True) as folder:
        fitted = Fitted(_searched(method, lambda settings: _made(method, folder, jobs, settings), asked, ranges))
    values = {key: one.value for key, one in fitted.found.items() if not key.startswith("record.")}
    fitted.write(out, [tool.resolved(method, {**given, **values}) for _, given in asked])
    if report:  # which needs packages that a fit does not
        from knot_utm.report import fit as of_fit, page
        page.write(out, of_fit.report_on_fit(out, command or "knot_utm.fit in Python", tool.version()))
    return fitted


def _made(method, folder, jobs, settings):
    """[(pull, result)] of runs of a method, made as those of a sweep, for [{key: value}]; the pull is None where there is none to speak
    of."""
    points = [{**given, **EXACT_CELL} for given in settings]
    sweep = Sweep(Study("the fit", method, points, 1, (), "list", {}), folder)
    sweep.make(jobs)
    return [(pull_of_table(sweep.folder.curve(name)), sweep.folder.result(name)) for name in sweep.names]


def _searched(method, runs, asked, ranges):
    """A search that has ended. `runs`: what _made gives for settings."""
    methods = [value_of(tool.resolved(method, {**given, tool.COUNT: 2})) for _, given in asked]  # one specimen does not scatter
    numbers = tool.key_units(method, asked[0][1])
    keys = {name: _method_key(name, limits, methods[0], numbers) for name, limits in ranges.items() if not OFFSET.fullmatch(name)}
    for _, given in asked:  # all corners of the ranges, and a place within them, before the first run
        for place in [*itertools.product((0.0, 1.0), repeat=len(keys)), [WITHIN] * len(keys)]:
            free = {key.name: short(key.value(at)) for key, at in zip(keys.values(), place)}
            refuse_if(refused := tool.refusal(method, {**given, **free}), f"--free: a run with {described(free)} would be refused: {refused}")
    records = [Record(file, read_pull(file), given, resolved) for (file, given), resolved in zip(asked, methods)]
    for record, model in zip(records, runs([given for _, given in asked])):
        record.require_producible(*model)
    keys |= {name: _offset_key(name, limits, records) for name, limits in ranges.items() if name not in keys}
    keys = [keys[name] for name in ranges]

    def run(places, first):
        values = [{key.name: float(key.value(at)) for key, at in zip(keys, place) if not key.offset} for place in places]
        models = runs([record.run_settings(at, (first + i) * len(records) + k) for k, record in enumerate(records)
                              for i, at in enumerate(values)])
        return [models[k * len(places):(k + 1) * len(places)] for k in range(len(records))]
    return Search(records, keys, run).go()


class Fitted:
    """All that a search found, which has ended. `found`: {key: Estimate}; `rms`: of measured less simulated means [N]; `notes`: in words."""

    def __init__(self, search):
        keys, best, records = search.keys, search.best, search.records
        self.found = {}
        for key, at, (_, _, ends) in zip(keys, best, search.profiles):
            low, high = (None if end is None else short(key.value(end)) for end in ends)
            self.found[key.name] = Estimate(short(key.value(at)), low, high, None not in (low, high))
        params = search.solved.params.values()
        self.correlation = {key.name: {other.name: round(float((param.correl or {}).get(f"key_{j}", 0.0)), 4)
                                       for j, other in enumerate(keys) if other is not key} for key, param in zip(keys, params)}
        simulated = search.surface.at(best[None])[0][0]
        number = np.repeat(np.arange(1, len(records) + 1), [len(record.centres) for record in records])
        self.curves = pd.DataFrame({"record": number, "extension": np.concatenate([record.centres for record in records]),
                                    "measured": search.measured, "simulated": simulated, "error": search.errors})
        self.profiles = pd.concat([pd.DataFrame({"key": key.name, "value": key.value(places), "rise": rises})
                                   for key, (places, rises, _) in zip(keys, search.profiles)])
        self.rms = float(np.sqrt(np.mean((search.measured - simulated)**2)))
        self.chi_square, self.degrees_of_freedom = search.chi_square, max(len(search.measured) - len(keys), 1)
        self.fits = bool(stats.chi2.sf(self.chi_square, self.degrees_of_freedom) >= LEAST_PROBABILITY)
        self.records = [record.name for record in records]
        self.notes = [] if self.fits else [f"nothing fits within the errors: the sum of squares over them is {self.chi_square:.4g} with "
                                           f"{self.degrees_of_freedom} degrees of freedom"]
        self.notes += [*self._of_keys(keys, best), *self._of_pairs()]
        for which, words in ((search.is_lost, "left no whole curve"),
                             (search.is_unlike, "left loads of quite another size, as where knots open: values around these count as unlikely")):
            if which.any():
                self.notes.append(f"{which.sum()} of {len(search.places)} runs {words}")

    def write(self, folder, methods):
        """fit.yaml, curves.csv, profiles.csv, and method.yaml, of further records method_2.yaml and so on. `methods`: their texts."""
        said = {**{key: asdict(one) for key, one in self.found.items()}, "rms": short(self.rms), "correlation": self.correlation,
                "fits": self.fits, "chi_square": short(self.chi_square), "degrees_of_freedom": self.degrees_of_freedom,
                "records": self.records, "notes": self.notes}
        texts = {"fit.yaml": yaml.safe_dump(said, sort_keys=False, allow_unicode=True, width=1000),
                 "curves.csv": _csv(self.curves, "-,m,N,N,N"), "profiles.csv": _csv(self.profiles, "-,as the method,-"),
                 **{"method.yaml" if i == 1 else f"method_{i}.yaml": text for i, text in enumerate(methods, start=1)}}
        os.makedirs(folder, exist_ok=True)
        for name, text in texts.items():
            write_whole(os.path.join(folder, name), text.encode())

    def _of_keys(self, keys, best):
        """What the data do not tell of single keys, in words."""
        for at, key in zip(best, keys):
            low, high = self.found[key.name].low, self.found[key.name].high
            bounds = (f"no value from {key.low:.6g} to {key.high:.6g} fits worse than the errors allow" if low is high is None else
                    f"the data only tell that it is {f'above {low:.4g}' if high is None else f'below {high:.4g}'}")
            if not AT_THE_END < at < 1.0 - AT_THE_END:
                yield (f"{key.name} is at the {'lower' if at < 0.5 else 'upper'} end of its range: "
                       f"{bounds + '; ' if None in (low, high) else ''}give a wider range")
            elif None in (low, high):
                yield f"{key.name} is not identifiable: {bounds}"

    def _of_pairs(self):
        for one, other in itertools.combinations(self.found, 2):
            r = self.correlation[one][other]
            if abs(r) > KNOWN_TOGETHER[not (self.found[one].identifiable or self.found[other].identifiable)]:
                yield (f"{one} and {other} are only known together (correlation {r:.4f}): {'more' if r > 0 else 'less'} of one goes with "
                       "more of the other")


def short(value):
    """With six digits: more would be of the machine, and not of the fit."""
    return float(f"{value:.6g}")


def _csv(table, units):
    """Row 1 names, row 2 units."""
    names, rows = table.to_csv(index=False, lineterminator="\n", float_format="%.6g").split("\n", 1)
    return f"{names}\n{units}\n{rows}"


def _parsed(word, words):
    """(key, None or (low, high)) of `KEY` or `KEY=low:high`. Raises WrongInput."""
    name, given, limits = word.partition("=")
    refuse_if(not name, f"--free is {word}, but must be KEY or KEY=low:high")
    refuse_if([one.partition("=")[0] for one in words].count(name) > 1, f"--free has {name} twice")
    refuse_if(name.startswith("record.") and not OFFSET.fullmatch(name),
              f"--free: {name} is nothing of a record: it has record.force_offset and record.extension_offset")
    if not given:
        return name, None
    try:
        low, high = (float(limit) for limit in limits.split(":"))
    except ValueError:
        low = high = math.nan
    refuse_if(not (math.isfinite(low) and math.isfinite(high) and low < high),
              f"--free: the range of {name} is {limits}, but must be low:high, two numbers of which the second is larger")
    return name, (low, high)


def _offset_key(name, limits, records):
    number, kind = FreeKey(name, 0.0, 0.0).offset
    refuse_if(number > len(records), f"--free: {name} is of record {number}, but there are {len(records)}")
    most = OFFSET_SHARE * records[number - 1].largest[kind]
    return FreeKey(name, *(limits or (-most, most)))


def _method_key(name, limits, method, numbers):
    """`method`: as resolved; `numbers`: those of its keys that are numbers and act on the test."""
    value = value_at(method, name)
    said = "nothing" if value is None else "several values" if isinstance(value, (dict, list)) else text_of(value)
    refuse_if(name not in numbers, f"--free: {name} is {said}, but only a number that acts on the test may be free")
    refuse_if(not limits and (not is_number(value) or value <= 0),
              f"--free: the method has {said} at {name}, around which no range can be laid: give --free {name}=low:high")
    return FreeKey(name, *(limits or (value / AROUND, value * AROUND)))


def _require_free(names, asked):
    """Raises WrongInput where keys are mistyped, or cannot be free. `asked`: [(file, {key: value})] of the records."""
    refuse_if(not names, "--free is missing: say which keys may move")
    refuse_if(all(map(OFFSET.fullmatch, names)), "--free has nothing but offsets of the record: a fit needs a key of the method")
    for name in names:
        refuse_if(name in EXACT_CELL, f"--free: {name} is an error of the cell, which is one of the errors that a fit goes by")
        for file, given in asked[1:]:
            refuse_if(given.get(name) != asked[0][1].get(name),
                      f"--also {file}: {name} is set, but it is free, and free keys are the same for all records")


def _require_room(out, inputs, overwrite):
    refuse_if(os.path.exists(os.path.join(out, "result.yaml")), f"{out} holds a run: choose another folder")
    for file in (os.path.join(out, name) for name in WRITTEN):
        if os.path.exists(file):
            refuse_if(any(os.path.exists(one) and os.path.samefile(file, one) for one in inputs),
                      f"{file} is an input, and would be written over: choose another folder")
            refuse_if(not overwrite, f"{file} exists already: choose another folder, or --overwrite")
    if not os.path.isdir(out):
        make_folder(out)
        os.rmdir(out)  # nothing is written before it is known that it can be fitted
