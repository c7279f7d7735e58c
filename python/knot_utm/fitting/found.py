"""What a fit found, in numbers and in words, and what it leaves in its folder."""
import os
import subprocess
import sys
from dataclasses import dataclass

import numpy as np
import pandas as pd
import yaml
from scipy import stats

from knot_utm import tool
from knot_utm.fitting import profiles
from knot_utm.fitting.profiles import KNOWN_TOGETHER

WRITTEN = ("fit.yaml", "curves.csv", "profiles.csv", "method.yaml", "method_2.yaml", "report.html", "report.pdf")
LEAST_PROBABILITY = 1e-3  # of residuals as large as these, below which the curve does not fit
AT_THE_END = 1e-3         # of the range
DIGITS = 6                # that a number keeps: more would be of the machine, and not of the fit
SIDES = {"low": -1, "high": 1}


@dataclass(frozen=True)
class Found:
    """Of one key: its value and 95 % interval; an end that the data do not tell is None. `unconfirmed`: those of "low" and "high"
    that runs beyond them do not confirm."""

    value: float
    low: object
    high: object
    identifiable: bool
    unconfirmed: list


@dataclass(frozen=True)
class Fitted:
    """All that a fit found. `found`: {key: Found}; `rms`: of measured less simulated means [N]; `notes`: in words."""

    found: dict
    rms: float
    correlation: dict
    chi_square: float
    degrees_of_freedom: int
    probability: float
    notes: list
    profiles: pd.DataFrame
    curves: pd.DataFrame
    records: list

    @property
    def fits(self):
        return self.probability >= LEAST_PROBABILITY

    def summary(self):
        """The map of fit.yaml."""
        return {**{key: dict(vars(one)) for key, one in self.found.items()}, "rms": short(self.rms), "correlation": self.correlation,
                "fits": self.fits, "chi_square": short(self.chi_square), "degrees_of_freedom": self.degrees_of_freedom,
                "records": self.records, "notes": self.notes}

    def write(self, folder, methods):
        """fit.yaml, curves.csv, profiles.csv, and method.yaml, of further records method_2.yaml and so on. `methods`: their texts."""
        os.makedirs(folder, exist_ok=True)
        texts = {"fit.yaml": yaml.safe_dump(self.summary(), sort_keys=False, allow_unicode=True, width=1000),
                 "curves.csv": _csv(self.curves, "-,m,N,N,N"), "profiles.csv": _csv(self.profiles, "-,as the method,-")}
        texts |= {"method.yaml" if i == 1 else f"method_{i}.yaml": text for i, text in enumerate(methods, start=1)}
        for name, text in texts.items():
            path = os.path.join(folder, name)
            with open(path + ".part", "w", encoding="utf-8") as file:
                file.write(text)
            os.replace(path + ".part", path)


def write_report(folder, command):
    """report.html and report.pdf, of the other files. Raises RuntimeError with a line where they cannot be made."""
    words = [sys.executable, "-m", "knot_utm.report", "--command", command, "--version", tool.version()]
    done = subprocess.run([*words, "--", folder], env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}, check=False,
                          text=True, errors="replace", stdin=subprocess.DEVNULL, capture_output=True)
    if done.returncode != 0:
        raise RuntimeError(tool.said_by(done.stderr) or "the report was not written")


def short(value):
    return float(f"{value:.{DIGITS}g}")


def _csv(table, units):
    """Row 1 names, row 2 units."""
    names, rows = table.to_csv(index=False, lineterminator="\n", float_format=f"%.{DIGITS}g").split("\n", 1)
    return f"{names}\n{units}\n{rows}"


def judge(search):
    """A search that has ended, as Fitted."""
    keys, best, likelihood, ends = search.keys, search.best, search.likelihood, search.ends
    found = {}
    for i, key in enumerate(keys):
        low, high = (None if (at := _end(ends, i, side)) is None else short(key.value(at)) for side in SIDES.values())
        unconfirmed = [name for name, side in SIDES.items() if (i, side) in ends.unconfirmed]
        found[key.name] = Found(short(key.value(best[i])), low, high, None not in (low, high), unconfirmed)
    matrix = profiles.correlations(likelihood, best, search.low, search.high)
    correlation = {a.name: {b.name: round(float(matrix[i, j]), 4) for j, b in enumerate(keys) if j != i} for i, a in enumerate(keys)}
    curves = pd.concat([pd.DataFrame({"record": number, "extension": one.record.centres, "measured": one.record.measured,
                                      "simulated": one.simulated(best), "error": one.errors})
                        for number, one in enumerate(likelihood.records, start=1)])
    drawn = pd.concat([pd.DataFrame({"key": key.name, "value": key.value(one.places), "rise": one.rises})
                       for key, one in zip(keys, ends.profiles)])
    chi_square, degrees = likelihood.chi_square(best), max(len(curves) - len(keys), 1)
    probability = float(stats.chi2.sf(chi_square, degrees))
    notes = [] if probability >= LEAST_PROBABILITY else [
        f"nothing fits within the errors: the sum of squares over them is {chi_square:.4g} with {degrees} degrees of freedom"]
    notes += [*_of_keys(keys, best, found), *_of_pairs(keys, matrix), *(note for case in search.cases for note in case.record.notes)]
    for case in search.cases:
        unlike = int(case.unlike(search.low, search.high).sum())
        for count, words in ((sum(case.lost), "left no whole curve"), (unlike, "left loads of quite another size, as where knots open")):
            if count:
                notes.append(f"{case.record.name}: {count} of {len(case.tried)} runs {words}; values around which these are "
                             "common count as unlikely")
    rms = float(np.sqrt(np.mean((curves["measured"] - curves["simulated"])**2)))
    return Fitted(found, rms, correlation, chi_square, degrees, probability, notes, drawn, curves,
                  [case.record.name for case in search.cases])


def _end(ends, key, side):
    """Of the interval of a key: where its profile ends, or where runs beyond that fit."""
    place = ends.unconfirmed.get((key, side))
    return ends.profiles[key].end(side) if place is None else place


def _of_keys(keys, best, found):
    """What the data do not tell of single keys, in words."""
    for at, key, one in zip(best, keys, found.values()):
        at_end = not AT_THE_END < at < 1.0 - AT_THE_END
        side = f"{key.name} is at the {'lower' if at < 0.5 else 'upper'} end of its range"
        if one.low is None and one.high is None:
            yield f"{key.name} is not identifiable: no value from {key.low:.6g} to {key.high:.6g} fits worse than the errors allow"
        elif not one.identifiable:
            end, limit = ("above", one.low) if one.high is None else ("below", one.high)
            told = f"the data only tell that it is {end} {limit:.4g}"
            yield f"{side}: {told}; give a wider range" if at_end else f"{key.name} is not identifiable: {told}"
        elif at_end:
            yield f"{side}: give a wider range"
        for name in one.unconfirmed:
            yield (f"{key.name}: runs do not confirm that its interval ends at {getattr(one, name):.4g}: take this as a bound that is not "
                   "known well")


def _of_pairs(keys, matrix):
    for i, j in zip(*np.nonzero(np.triu(np.abs(matrix) > KNOWN_TOGETHER, 1))):
        yield (f"{keys[i].name} and {keys[j].name} are only known together (correlation {matrix[i, j]:.4f}): "
               f"{'more' if matrix[i, j] > 0 else 'less'} of one goes with more of the other")
