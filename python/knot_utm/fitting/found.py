"""What a fit found, in numbers and in words, and what it leaves in its folder."""
import itertools
import os
import subprocess
import sys
from dataclasses import dataclass

import numpy as np
import pandas as pd
import yaml
from scipy import stats

from knot_utm import tool

WRITTEN = ("fit.yaml", "curves.csv", "profiles.csv", "method.yaml", "method_2.yaml", "report.html", "report.pdf")
LEAST_PROBABILITY = 1e-3  # of residuals as large as these, below which the curve does not fit
AT_THE_END = 1e-3         # of the range
KNOWN_TOGETHER = 0.99     # correlation from which on two keys are known as a combination only
NEITHER_ALONE = 0.9       # the same, where the data bound neither of them
DIGITS = 6                # that a number keeps: more would be of the machine, and not of the fit


@dataclass(frozen=True)
class Found:
    """Of one key: its value and 95 % interval; an end that the data do not tell is None."""

    value: float
    low: object
    high: object
    identifiable: bool


class Fitted:
    """All that a search found, which has ended. `found`: {key: Found}; `rms`: of measured less simulated means [N]; `notes`: in words."""

    def __init__(self, search):
        keys, best, likelihood, records = search.keys, search.best, search.likelihood, search.records
        self.found = {}
        for key, at, profile in zip(keys, best, search.profiles):
            low, high = (None if (end := profile.end(side)) is None else short(key.value(end)) for side in (-1, 1))
            self.found[key.name] = Found(short(key.value(at)), low, high, None not in (low, high))
        matrix = search.correlation()
        self.correlation = {a.name: {b.name: round(float(matrix[i, j]), 4) for j, b in enumerate(keys) if j != i}
                            for i, a in enumerate(keys)}
        simulated = likelihood.surface.at(best[None])[0][0]
        number = np.repeat(np.arange(1, len(records) + 1), [len(record.centres) for record in records])
        self.curves = pd.DataFrame({"record": number, "extension": np.concatenate([record.centres for record in records]),
                                    "measured": search.measured, "simulated": simulated, "error": likelihood.errors})
        self.profiles = pd.concat([pd.DataFrame({"key": key.name, "value": key.value(one.places[:, i]), "rise": one.rises})
                                   for i, (key, one) in enumerate(zip(keys, search.profiles))])
        self.rms = float(np.sqrt(np.mean((search.measured - simulated)**2)))
        self.chi_square = likelihood.chi_square(best)
        self.degrees_of_freedom = max(len(search.measured) - len(keys), 1)
        self.fits = bool(stats.chi2.sf(self.chi_square, self.degrees_of_freedom) >= LEAST_PROBABILITY)
        self.records = [record.name for record in records]
        self.notes = [*([] if self.fits else [f"nothing fits within the errors: the sum of squares over them is {self.chi_square:.4g} "
                                              f"with {self.degrees_of_freedom} degrees of freedom"]),
                      *_of_keys(keys, best, self.found), *_of_pairs(self.found, matrix),
                      *(note for record in records for note in record.notes), *_of_runs(search)]

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


def _of_pairs(found, matrix):
    """Of keys with a correlation from which on only a combination is known: less of it will do where neither key is told alone."""
    names = list(found)
    for i, j in itertools.combinations(range(len(names)), 2):
        least = KNOWN_TOGETHER if any(found[names[k]].identifiable for k in (i, j)) else NEITHER_ALONE
        if abs(matrix[i, j]) > least:
            yield (f"{names[i]} and {names[j]} are only known together (correlation {matrix[i, j]:.4f}): "
                   f"{'more' if matrix[i, j] > 0 else 'less'} of one goes with more of the other")


def _of_runs(search):
    for count, words in ((search.is_lost.sum(), "left no whole curve"),
                         (search.is_unlike.sum(), "left loads of quite another size, as where knots open")):
        if count:
            yield f"{count} of {len(search.places)} runs {words}; values around which these are common count as unlikely"
