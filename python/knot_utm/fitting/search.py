"""The search of a fit, in waves: runs over the box in which the best values may lie, what they tell of the likelihood, a smaller box.

So it is neither led astray by stick-slip, which makes single runs rough, nor does it need a start that is near (history matching:
Craig and others 1997)."""
import warnings

import numpy as np
from scipy import linalg, optimize
from scipy.stats import chi2, qmc

from knot_utm.errors import WrongInput
from knot_utm.fitting.records import covariance, split
from knot_utm.fitting.surface import Likelihood, Surface, scatter_of

RISE = chi2.ppf(0.95, 1)  # of -2 log L, which bounds an interval of 95 %
MOST_WAVES = 12
CANDIDATES = 2048
KEPT, LEAST_KEPT = 16.0, 48  # rise within which candidates are kept for the next wave, and how many at least
SHRUNK = 0.8    # a side of the box that shrinks by less has settled
LEARNT = 0.1    # errors of the polynomial over all, at the best place, which are small enough
LEARNT_OF = 64.0  # rise of the runs that are learnt of
GROWN = 0.05    # of the box, by which it is larger than what is kept
LOOK = 0.25     # of the box, beyond which nothing is looked for: what an earlier wave gave up may come back
POINTS = 41     # of a profile
LEAST_MORE = 3  # runs than keys, of which anything is learnt
STEP = 1e-5     # of a derivative, over the box
ALIKE = np.log(2.0)  # of the ratio of loads, mean by mean, within which runs are of the record's kind


class Search:
    """Of the best values. `run(places, first)`: of each record the models at the places, of specimens counted from `first`."""

    def __init__(self, records, keys, run):
        self.records, self.keys, self.run = records, keys, run
        self.measured = np.concatenate([record.measured for record in records])
        self.least = 3 * (len(keys) + 1)  # so many runs are learnt of
        self.low, self.high = np.zeros(len(keys)), np.ones(len(keys))
        self.best, self.likelihood, self.misfit = np.full(len(keys), 0.5), None, 1.0
        self.places, self.means, self.results = np.zeros((0, len(keys))), np.zeros((0, len(self.measured))), []

    def go(self):
        count = len(self.keys)
        self.add(_sobol(count, 8 * count + 2, 1))
        self.learn(0)
        for number in range(1, MOST_WAVES + 1):
            has_settled = self.wave(number, 4 * count + 2)
            # Where specimens do not differ, all that the polynomial misses is its own error.
            missed = self.likelihood.unknown(self.best, all(not record.scatter for record in self.records))
            if number > 2 and has_settled and missed < LEARNT * len(self.measured):
                break
        self.profiles = [self.profile(key) for key in range(count)]
        return self

    def add(self, places):
        """Runs there. A run that leaves no whole curve has no means."""
        made = list(zip(*self.run(places, len(self.places))))
        means = [np.concatenate([record.simulated(model, **self._offsets(place, number)) for number, (record, model)
                                 in enumerate(zip(self.records, models), start=1)]) for place, models in zip(places, made)]
        self.places, self.means = np.concatenate([self.places, places]), np.concatenate([self.means, means])
        self.results += [[model.result for model in models] for models in made]

    def _offsets(self, place, number):
        """Of a record, by its number."""
        return {key.offset[1] + "_offset": key.value(at) for key, at in zip(self.keys, place) if key.offset and key.offset[0] == number}

    def learn(self, seed):
        """The likelihood, of the runs where the last one was not far from its best, or that are not far from the record themselves, and
        the best place."""
        self.is_lost = np.isnan(self.means).any(axis=1)
        if (~self.is_lost).sum() < len(self.keys) + LEAST_MORE:
            raise WrongInput(f"{self.records[0].name}: {(~self.is_lost).sum()} of {len(self.places)} runs in the ranges of the free keys "
                             "reach as far as the record: narrow the ranges")
        right = self._alike()
        self.is_unlike = ~self.is_lost & ~right & np.all((self.places >= self.low) & (self.places <= self.high), axis=1)
        away = np.zeros(len(self.places))
        if self.likelihood:
            away = np.fmin(self.likelihood.at(self.places) - self.value, self.likelihood.squares(self.means))
        used = np.flatnonzero(right & (away <= max(LEARNT_OF * self.misfit, np.sort(away[right])[:self.least][-1])))
        for _ in range(2):  # the errors are those at the best place, which is known afterwards
            nearest = used[np.argmin(np.sum((self.places[used] - self.best)**2, axis=1))]
            known = covariance(self.records, self.means[nearest], self.results[nearest])
            surface = Surface(self.places[used], self.means[used], np.sqrt(np.diag(known)))
            scatter = linalg.block_diag(*(scatter_of(rows, surface.freedom) for rows in split(self.records, surface.left)))
            self.likelihood = Likelihood(self.measured, surface, scatter, known, self.places, right)
            tried = self._candidates(seed)
            starts = tried[np.argsort(self.likelihood.at(tried), kind="stable")[:3]]
            self.best, self.value = min((self._smallest(start) for start in starts), key=lambda found: found[1])
        # Where nothing fits as yet, a rise of -2 log L cannot be relied on.
        self.misfit = max(1.0, self.likelihood.chi_square(self.best) / len(self.measured))

    def _alike(self):
        """Which runs have loads of the record's size; others, as where knots open, tell only that what is around them is unlikely.
        Where there are too few of them, those that come nearest count as such."""
        error = np.concatenate([record.single_errors(record.measured) for record in self.records])
        ratio = np.log((np.abs(self.means) + error) / (np.abs(self.measured) + error))
        size = np.max([np.abs(part.mean(axis=1)) for part in split(self.records, ratio)], axis=0)
        size[self.is_lost] = np.inf
        return ~self.is_lost & (size <= max(ALIKE, np.sort(size)[:self.least][-1]))

    def wave(self, number, more):
        """More runs, in a new box; whether it is neither smaller than the last one nor cut off where nothing was looked for."""
        around = self._around()
        tried = self._candidates(100 + number)
        rises = self.likelihood.at(tried) - self.value
        kept = np.concatenate([self.best[None], tried[rises <= max(KEPT * self.misfit, np.sort(rises)[LEAST_KEPT - 1])]])
        width = np.maximum(np.ptp(kept, axis=0), 1e-6)
        low, high = np.maximum(kept.min(axis=0) - GROWN * width, around[0]), np.minimum(kept.max(axis=0) + GROWN * width, around[1])
        is_cut = (low == around[0]) & (low > 0.0) | (high == around[1]) & (high < 1.0)
        has_settled = np.all(high - low >= SHRUNK * (self.high - self.low)) and not np.any(is_cut)
        self.low, self.high = low, high
        # The best one, the last ones on each side, which are beyond the ends of the intervals, and others that lie evenly.
        chosen = dict.fromkeys([0, *kept.argmin(axis=0), *kept.argmax(axis=0), *range(1, len(kept))])
        self.add(kept[list(chosen)[:more]])
        self.learn(number)
        return has_settled

    def _around(self):
        """The box, and what is beside it, as far as the range goes."""
        beside = LOOK * (self.high - self.low)
        return np.maximum(self.low - beside, 0.0), np.minimum(self.high + beside, 1.0)

    def _candidates(self, seed):
        low, high = self._around()
        return low + (high - low) * _sobol(len(self.keys), CANDIDATES, seed)

    def _smallest(self, start, fixed=None):
        """(place, -2 log L) of the best that is found from a start; `fixed`: a key that keeps its place."""
        low, high = self._around()
        free = np.flatnonzero(np.arange(len(start)) != fixed)

        def values(inside):
            places = np.tile(start, (len(inside), 1))
            places[:, free] = low[free] + np.clip(inside, 0.0, 1.0) * (high - low)[free]
            return places, self.likelihood.at(places)

        def value_and_slopes(inside):
            _, told = values(inside + STEP * np.vstack([np.zeros(len(free)), np.eye(len(free)), -np.eye(len(free))]))
            return told[0], (told[1:len(free) + 1] - told[len(free) + 1:]) / (2.0 * STEP)
        inside = np.clip((start - low) / (high - low), STEP, 1.0 - STEP)[free]
        if len(free):
            with warnings.catch_warnings():  # of steps that go beyond the bounds and are taken back
                warnings.simplefilter("ignore", RuntimeWarning)
                inside = optimize.minimize(value_and_slopes, inside, jac=True, method="SLSQP", options={"ftol": 1e-5},
                                           bounds=[(STEP, 1.0 - STEP)] * len(free)).x
        places, told = values(inside[None])
        return places[0], told[0]

    def profile(self, key):
        """-2 log L over one key, less the smallest, the others such that it is smallest."""
        low, high = self._around()
        tried = self._candidates(key)
        values = self.likelihood.at(tried)
        at = np.unique(np.append(np.linspace(low[key], high[key], POINTS), self.best[key]))
        mine = int(np.searchsorted(at, self.best[key]))
        places, rises = np.tile(self.best, (len(at), 1)), np.zeros(len(at))
        for way in (1, -1):
            for i in range(mine + way, len(at) if way > 0 else -1, way):
                is_near = np.abs(tried[:, key] - at[i]) < (high[key] - low[key]) / POINTS
                starts = np.stack([places[i - way], tried[np.argmin(np.where(is_near, values, np.inf))]])
                starts[:, key] = at[i]
                places[i], value = min((self._smallest(start, key) for start in starts), key=lambda found: found[1])
                rises[i] = max(value - self.value, 0.0)
        return Profile(key, places, rises, mine)

    def correlation(self):
        """Of the keys. At the end of the interval of one, -2 log L has risen by RISE; where another then goes back to its best value, by
        RISE over 1 - r^2. So keys are also told that go together along a bend."""
        squares, slopes = np.eye(len(self.keys)), np.eye(len(self.keys))
        for one in self.profiles:
            ends = np.array([one.last(way)[0] for way in (-1, 1)])
            slopes[one.key] = (ends[1] - ends[0]) / (ends[1] - ends[0])[one.key]
            for other in np.flatnonzero(np.arange(len(self.keys)) != one.key):
                back = ends.copy()
                back[:, other] = self.best[other]
                squares[one.key, other] = 1.0 - RISE / max(RISE, *(self.likelihood.at(back) - self.value))
        return np.sign(slopes + slopes.T) * np.sqrt(np.minimum(squares, squares.T))


class Profile:
    """Of one key, by its index. `places`, `rises`: along it; `mine`: which of these is the best of all."""

    def __init__(self, key, places, rises, mine):
        self.key, self.places, self.rises, self.mine = key, places, rises, mine

    def end(self, way):
        """Where the interval ends on that side, -1 or 1; None where -2 log L does not rise enough."""
        place, is_end = self.last(way)
        return float(place[self.key]) if is_end else None

    def last(self, way):
        """(place, whether the interval ends there) on that side. The root of the rise is straight from point to point, as that of a
        parabola is."""
        places, roots = self.places[self.mine::way], np.sqrt(self.rises[self.mine::way])
        over = np.flatnonzero(roots**2 > RISE)
        if not len(over):
            return places[-1], False
        i = over[0]
        share = (np.sqrt(RISE) - roots[i - 1]) / (roots[i] - roots[i - 1])
        return places[i - 1] + share * (places[i] - places[i - 1]), True


def _sobol(keys, count, seed):
    """Places from 0 to 1 that lie evenly, one a row."""
    most = 1 << (count - 1).bit_length()  # only a power of two of them is even in every key
    return qmc.Sobol(keys, seed=seed).random(most)[:count]
