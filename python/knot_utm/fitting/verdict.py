"""What a fit found, in numbers and in words."""
from dataclasses import dataclass

import numpy as np
from scipy import stats

from knot_utm.fitting import profiles
from knot_utm.fitting.profiles import KNOWN_TOGETHER

LEAST_PROBABILITY = 1e-3  # of residuals as large as these, below which the curve does not fit
AT_THE_END = 1e-3         # of the range
DIGITS = 6                # that a number keeps: more would be of the machine, and not of the fit


@dataclass(frozen=True)
class Found:
    """Of one key: its value and 95 % interval; an end that the data do not tell is None."""

    value: float
    low: object
    high: object
    identifiable: bool


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
    found, drawn, doubted = {}, {}, []
    for i, key in enumerate(keys):
        low, high, beyond = _interval(search, i)
        ends = [None if place is None else short(key.value(place)) for place in (low, high)]
        found[key.name] = Found(short(key.value(best[i])), *ends, None not in ends)
        drawn[key.name] = key.value(search.profiles[i].places), search.profiles[i].rises
        doubted += [(key, place) for place in beyond]
    matrix = profiles.correlations(likelihood, best, search.low, search.high)
    correlation = {a.name: {b.name: float(matrix[i, j]) for j, b in enumerate(keys) if j != i} for i, a in enumerate(keys)}
    chi_square, means = likelihood.chi_square(best), sum(len(record.record.centres) for record in likelihood.records)
    degrees = max(means - len(keys), 1)
    curves = [(record.record, record.simulated(best), record.errors) for record in likelihood.records]
    rms = float(np.sqrt(sum(((record.measured - simulated)**2).sum() for record, simulated, _ in curves) / means))
    probability = float(stats.chi2.sf(chi_square, degrees))
    notes = _notes(keys, best, found, matrix)
    notes += [f"{key.name}: runs with {key.value(at):.4g} fit, although those around them say that they should not; the interval "
              "goes on to there" for key, at in doubted]
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


def _interval(search, i):
    """(low, high, places to which an end was moved) of a key. An end that is doubted is where runs fit that are beyond it."""
    profile = search.profiles[i]
    # Places beyond these were given up because they are much less likely.
    first, last = (around[i] for around in search.around())
    low = profile.low if profile.low is not None or first <= 0.0 else first
    high = profile.high if profile.high is not None or last >= 1.0 else last
    places = [place[i] for key, place in search.doubted if key == i]
    below = [place for place in places if low is not None and place < low]
    above = [place for place in places if high is not None and place > high]
    return min([low, *below]) if below else low, max([high, *above]) if above else high, below + above


def _notes(keys, best, found, matrix):
    """What the data do not tell, in words."""
    notes = []
    for i, (key, one) in enumerate(zip(keys, found.values())):
        if one.low is None and one.high is None:
            notes.append(f"{key.name} is not identifiable: no value from {key.low:.6g} to {key.high:.6g} fits worse than the "
                         "errors allow")
        elif not one.identifiable:
            end, limit = ("above", one.low) if one.high is None else ("below", one.high)
            notes.append(f"{key.name} is not identifiable: the data only tell that it is {end} {limit:.4g}")
        elif not AT_THE_END < best[i] < 1.0 - AT_THE_END:
            notes.append(f"{key.name} is at the end of its range")
        for j in range(i):
            if abs(matrix[i, j]) > KNOWN_TOGETHER:
                notes.append(f"{keys[j].name} and {key.name} are only known together (correlation {matrix[i, j]:.4f}): "
                             f"{'more' if matrix[i, j] > 0 else 'less'} of one goes with more of the other")
    return notes
