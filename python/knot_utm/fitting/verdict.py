"""What a fit found, in numbers and in words."""
from dataclasses import dataclass

import numpy as np
from scipy import stats

from knot_utm.fitting import profiles
from knot_utm.fitting.profiles import KNOWN_TOGETHER

LEAST_PROBABILITY = 1e-3  # of residuals as large as these, below which the curve does not fit
AT_THE_END = 1e-3         # of the range
SIDES = {"low": -1, "high": 1}
DIGITS = 6                # that a number keeps: more would be of the machine, and not of the fit


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
    profiles: dict
    curves: list  # [(record, simulated means, standard deviations)]

    @property
    def fits(self):
        return self.probability >= LEAST_PROBABILITY


def short(value):
    return float(f"{value:.{DIGITS}g}")


def judge(search):
    """A search that has ended, as Fitted."""
    keys, best, likelihood = search.keys, search.best, search.likelihood
    found, drawn = {}, {}
    for i, key in enumerate(keys):
        low, high = (_end(search.ends, i, side) for side in (-1, 1))
        ends = [None if place is None else short(key.value(place)) for place in (low, high)]
        unconfirmed = [name for name, side in SIDES.items() if (i, side) in search.ends.unconfirmed]
        found[key.name] = Found(short(key.value(best[i])), *ends, None not in ends, unconfirmed)
        drawn[key.name] = key.value(search.ends.profiles[i].places), search.ends.profiles[i].rises
    matrix = profiles.correlations(likelihood, best, search.low, search.high)
    correlation = {a.name: {b.name: float(matrix[i, j]) for j, b in enumerate(keys) if j != i} for i, a in enumerate(keys)}
    chi_square, means = likelihood.chi_square(best), sum(len(record.record.centres) for record in likelihood.records)
    degrees = max(means - len(keys), 1)
    curves = [(record.record, record.simulated(best), record.errors) for record in likelihood.records]
    rms = float(np.sqrt(sum(((record.measured - simulated)**2).sum() for record, simulated, _ in curves) / means))
    probability = float(stats.chi2.sf(chi_square, degrees))
    notes = _notes(keys, best, found, matrix)
    notes += [note for case in search.cases for note in case.record.notes]
    for case in search.cases:
        unlike = int(case.unlike(search.low, search.high).sum())
        for count, words in ((sum(case.lost), "left no whole curve"), (unlike, "left loads of quite another size, as where knots open")):
            if count:
                notes.append(f"{case.record.name}: {count} of {len(case.tried)} runs {words}; values around which these are "
                             "common count as unlikely")
    if probability < LEAST_PROBABILITY:
        notes.insert(0, f"nothing fits within the errors: the sum of squares over them is {chi_square:.4g} with {degrees} degrees "
                        "of freedom")
    return Fitted(found, rms, correlation, chi_square, degrees, probability, notes, drawn, curves)


def _end(ends, i, side):
    """Of the interval of a key: where its profile ends, or where runs beyond that fit."""
    place = ends.unconfirmed.get((i, side))
    return ends.profiles[i].end(side) if place is None else place


def _notes(keys, best, found, matrix):
    """What the data do not tell, in words."""
    notes = []
    for i, (key, one) in enumerate(zip(keys, found.values())):
        at_end = not AT_THE_END < best[i] < 1.0 - AT_THE_END
        at = f"{key.name} is at the {'lower' if best[i] < 0.5 else 'upper'} end of its range"
        if one.low is None and one.high is None:
            notes.append(f"{key.name} is not identifiable: no value from {key.low:.6g} to {key.high:.6g} fits worse than the "
                         "errors allow")
        elif not one.identifiable:
            end, limit = ("above", one.low) if one.high is None else ("below", one.high)
            told = f"the data only tell that it is {end} {limit:.4g}"
            notes.append(f"{at}: {told}; give a wider range" if at_end else f"{key.name} is not identifiable: {told}")
        elif at_end:
            notes.append(f"{at}: give a wider range")
        for side in one.unconfirmed:
            notes.append(f"{key.name}: runs do not confirm that its interval ends at {getattr(one, side):.4g}: take this as a bound that "
                         "is not known well")
        for j in range(i):
            if abs(matrix[i, j]) > KNOWN_TOGETHER:
                notes.append(f"{keys[j].name} and {key.name} are only known together (correlation {matrix[i, j]:.4f}): "
                             f"{'more' if matrix[i, j] > 0 else 'less'} of one goes with more of the other")
    return notes
