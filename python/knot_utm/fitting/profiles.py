"""The smallest -2 log L, its profiles and the intervals that they tell, in a box of places."""
from dataclasses import dataclass

import numpy as np
from scipy import optimize
from scipy.stats import qmc

CANDIDATES = 2048
POINTS = 41
RISE = 3.841458820694124  # of -2 log L: 95 % of chi^2 with one degree of freedom
STEP = 1e-4               # of a derivative, over the box
WELL_ENOUGH = {"ftol": 1e-6, "gtol": 1e-2}  # more would be lost in the rounding of the derivatives
KNOWN_TOGETHER = 0.99     # correlation from which on two keys are known as a combination only


@dataclass(frozen=True)
class Profile:
    """-2 log L over one key, the others such that it is smallest, less the smallest of all. `low`, `high`: where it rises by
    RISE; None where it does not within the box. `at`: where it is smallest, a value of all keys a row."""

    places: np.ndarray
    rises: np.ndarray
    low: object
    high: object
    at: np.ndarray
    mine: int  # which of the places is that of the smallest of all

    def end(self, way):
        """On that side; `way`: -1 or 1."""
        return self.low if way < 0 else self.high

    def outwards(self, way):
        """(places, rises) from the smallest one on; `way`: -1 or 1."""
        inside = slice(self.mine, None, way)
        return self.at[inside], self.rises[inside]


def sobol(keys, count, seed):
    """Places from 0 to 1 that lie evenly, one a row."""
    most = 1 << (count - 1).bit_length()  # only a power of two of them is even in every key
    return qmc.Sobol(keys, seed=seed).random(most)[:count]


def candidates(low, high, seed):
    return low + (high - low) * sobol(len(low), CANDIDATES, seed)


def smallest(likelihood, low, high, starts, fixed=None):
    """(place, value) of the best that is found from the starts, within a box; `fixed`: a key that keeps its place."""
    free = np.array([d for d in range(len(low)) if d != fixed], int)
    if len(free) == 0:
        values = likelihood.at(starts)
        return starts[np.argmin(values)], float(values.min())
    best = None
    width = (high - low)[free]  # the search goes in shares of the box, in which all keys count alike
    for start in starts:
        def value_and_slopes(inside, place=start):
            about = np.tile(place, (2 * len(free) + 1, 1))
            about[:, free] = low[free] + inside * width
            for i, d in enumerate(free):
                about[2 * i + 1, d] += STEP * width[i]
                about[2 * i + 2, d] -= STEP * width[i]
            values = likelihood.at(about)
            return values[0], (values[1::2] - values[2::2]) / (2.0 * STEP)
        found = optimize.minimize(value_and_slopes, np.clip((start[free] - low[free]) / width, 0.0, 1.0), jac=True,
                                  method="L-BFGS-B", bounds=[(0.0, 1.0)] * len(free), options=WELL_ENOUGH)
        if best is None or found.fun < best[1]:
            place = start.copy()
            place[free] = low[free] + found.x * width
            best = place, float(found.fun)
    return best


def best_of(likelihood, low, high, seed):
    """(place, value), of candidates over the box and on from the best of them."""
    tried = candidates(low, high, seed)
    order = np.argsort(likelihood.at(tried), kind="stable")[:3]
    return smallest(likelihood, low, high, tried[order])


def profile(likelihood, key, low, high, best, value, seed):
    """Of one key, by index; `best`, `value`: the smallest of all."""
    places = np.unique(np.append(np.linspace(low[key], high[key], POINTS), best[key]))
    tried = candidates(low, high, seed)
    values = likelihood.at(tried)
    mine = int(np.searchsorted(places, best[key]))
    rises, at = np.zeros(len(places)), [best] * len(places)
    for way in (range(mine + 1, len(places)), range(mine - 1, -1, -1)):
        beside = best
        for i in way:
            is_near = np.abs(tried[:, key] - places[i]) < (high[key] - low[key]) / POINTS
            starts = np.stack([beside, tried[np.argmin(np.where(is_near, values, np.inf))]])
            starts[:, key] = places[i]
            beside, found = smallest(likelihood, low, high, starts, key)
            rises[i], at[i] = max(found - value, 0.0), beside
    ends = (_crossing(places[mine::way], rises[mine::way]) for way in (-1, 1))
    return Profile(places, rises, *ends, np.array(at), mine)


def _crossing(places, rises):
    """Where the rise first passes RISE, outwards; its root is straight from point to point, as that of a parabola is."""
    over = np.flatnonzero(rises > RISE)
    if len(over) == 0:
        return None
    i, roots = over[0], np.sqrt(rises)
    share = (np.sqrt(RISE) - roots[i - 1]) / (roots[i] - roots[i - 1])
    return float(places[i - 1] + share * (places[i] - places[i - 1]))


def correlations(likelihood, best, low, high):
    """Of the keys, from the curvature at the best place. That the ranges are not endless counts as a flat prior's variance,
    1/12."""
    count = len(best)
    step = 0.02 * (high - low)
    at = np.clip(best, low + step, high - step)
    offsets, values = [], {}
    for i in range(count):
        for j in range(i, count):
            for a, b in ((1, 1), (1, -1), (-1, 1), (-1, -1)):
                offsets.append((i, j, a, b))
    places = np.tile(at, (len(offsets), 1))
    for row, (i, j, a, b) in zip(places, offsets):
        row[i] += a * step[i] if i != j else 0.5 * (a + b) * step[i]
        row[j] += b * step[j] if i != j else 0.0
    for (i, j, a, b), value in zip(offsets, likelihood.at(places)):
        values[i, j] = values.get((i, j), 0.0) + a * b * value
    curvature = np.zeros((count, count))
    for (i, j), value in values.items():
        # Of one key the four are those at +1, 0, 0 and -1 steps: their sum with signs is a second difference.
        curvature[i, j] = curvature[j, i] = value / (step[i] * step[j]) * (1.0 if i == j else 0.25)
    sizes, vectors = np.linalg.eigh(0.5 * curvature)
    spread = (vectors / (np.maximum(sizes, 0.0) + 12.0)) @ vectors.T
    sd = np.sqrt(np.diag(spread))
    return spread / np.outer(sd, sd)
