"""The search of a fit, in waves: runs over the box in which the best values may lie, an emulator of them, a smaller box.

So it is neither led astray by stick-slip, which makes single runs rough, nor does it need a start that is near (history matching:
Craig and others 1997)."""
import numpy as np

from knot_utm.fitting import ends, errors, kinds, profiles
from knot_utm.fitting.emulator import Emulator, Known
from knot_utm.fitting.likelihood import Likelihood, RecordLikelihood
from knot_utm.fitting.scatter import covariance_of, left_over
from knot_utm.yaml_text import text_of

GRID = 384          # points of a simulated curve; so many readings at most are points, too
MOST_WAVES = 8
KEPT = 16.0         # rise of -2 log L within which values are kept for the next wave
LEAST_KEPT = 48     # candidates, where those within KEPT are fewer
SHRUNK = 0.8        # a side of the box that shrinks by less has settled
LEARNT = 0.1        # errors of the emulator over all others, at the best place, which are small enough
MARGIN = 0.3        # of the box, beyond which runs are forgotten
GROWN = 0.05        # of the box, by which it is larger than what is kept
LOOK = 0.25         # of the box, beyond which nothing is looked for: what an earlier wave gave up may come back


def _grid(extension, most):
    """Extensions at which a simulated curve is known, of a record that may be off by `most`. It is straight from one reading to the
    next: of a few readings each may be a corner."""
    even = np.linspace(extension[0] - most, extension[-1] + most, GRID)
    return np.union1d(even, extension) if len(extension) <= GRID else even


class Case:
    """One record in a search: its runs so far."""

    def __init__(self, record, number, keys, cell, batch):
        self.record, self.number, self.keys, self.cell, self.batch = record, number, keys, cell, batch
        self.cell_name = text_of({key: value for key, value in cell.items() if key != "noise_run"})
        self.inputs = np.array([i for i, key in enumerate(keys) if key.offset is None], int)  # what its runs depend on
        most = max((max(abs(key.low), abs(key.high)) for key in keys if key.offset == (number, "extension")), default=0.0)
        self.grid = _grid(record.extension, most)
        self.places, self.curves, self.models, self.sizes = [], [], [], []
        self.tried, self.lost = [], []  # all places, and whether the run there left no whole curve
        self.apart = None
        self._gather(self._right_of(batch))

    def _right_of(self, batch):
        """The pulls of a batch that are of the record's kind, as far as the runs tell: others would count as scatter."""
        pulls = [model.pull for model in batch.models if self.record.is_reached(model)] if batch else []
        sizes = [*self.sizes, *(self._size(self._means(pull)) for pull in pulls)]
        unlike = kinds.beyond_a_gap(sizes, slice(None))[len(self.sizes):]
        return [pull for pull, is_unlike in zip(pulls, unlike) if not is_unlike]

    def _gather(self, pulls):
        """How the specimens of a batch differ from their mean, in the means of the record and at the grid."""
        if len(pulls) > 1:
            means, curves = (np.array(rows) for rows in zip(*((self._means(pull), pull.at(self.grid)) for pull in pulls)))
            larger = np.sqrt(len(pulls) / (len(pulls) - 1))
            self.apart = larger * (means - means.mean(axis=0)), larger * (curves - curves.mean(axis=0))

    def _means(self, pull):
        return self.record.means(pull.at(self.record.extension))

    def scatter(self, used=()):
        """Covariances of the means and at the grid, of the batch and of runs in the box, which are specimens too."""
        if self.apart is None:
            return (np.zeros((n, n)) for n in (len(self.record.centres), len(self.grid)))
        rows = self.apart
        if len(used):
            places = np.array([self.places[i] for i in used])[:, self.inputs]
            also = np.array([self._means(self.models[i].pull) for i in used]), np.array([self.curves[i] for i in used])
            rows = [np.concatenate([of_batch, left_over(places, of_runs)]) for of_batch, of_runs in zip(rows, also)]
        return covariance_of(rows[0]), rows[1].T @ rows[1] / len(rows[1])

    def renew(self, batch):
        """Another batch, of specimens nearer to the best values; one of which fewer than half are of the record's kind tells
        too little."""
        pulls = self._right_of(batch)
        if 2 * len(pulls) >= len(batch.models):
            self.batch = batch
            self._gather(pulls)

    def settings(self, place, number):
        """Of a run: the record's, the free keys, and what is drawn for a specimen."""
        free = {key.name: float(key.value(at)) for key, at in zip(self.keys, place) if key.offset is None}
        settings = {**self.record.settings, **free}
        return self.batch.drawn(number, settings) if self.batch else settings

    def add(self, place, model):
        self.tried.append(place)
        self.lost.append(not self.record.is_reached(model))
        if not self.lost[-1]:
            self.places.append(place)
            self.curves.append(model.pull.at(self.grid))
            self.models.append(model)
            self.sizes.append(self._size(self._means(model.pull)))

    def _size(self, means):
        return kinds.size(means, self.record.measured, errors.of_single_means(self.record, self.cell, means))

    def unlike(self, low, high):
        """Whether a run is of another kind than the record, beyond a gap among all runs, or among those in a box and a margin
        around it."""
        near = self._away(self.places, low, high) <= MARGIN
        return kinds.beyond_a_gap(self.sizes, slice(None)) | kinds.beyond_a_gap(self.sizes, near)

    def _away(self, places, low, high):
        """How far beyond a box places are, in sides of the box."""
        places, inputs = np.array(places), self.inputs
        return np.max(np.maximum(low - places, places - high)[:, inputs] / (high - low)[inputs], axis=1)

    def is_right(self, low, high):
        """Of all places that were tried: whether the run there left a whole curve, which is of the record's kind."""
        right = ~np.array(self.lost)
        right[right] = ~self.unlike(low, high)
        return right

    def share(self, low, high):
        """Of the runs in a box and a margin around it that leave a whole curve of the record's kind."""
        near = self._away(self.tried, low, high) <= MARGIN
        return kinds.Share(np.array(self.tried)[near][:, self.inputs], ~self.is_right(low, high)[near])

    def likelihood(self, low, high, best):
        """Learnt of the runs in a box and a margin around it that are of the record's kind: others would smear a jump from one
        kind to the other over both sides. `best`: a place at which the errors are taken."""
        places, inputs = np.array(self.places), self.inputs
        away = self._away(places, low, high)
        away[self.unlike(low, high)] = np.inf
        least = min(3 * (len(inputs) + 1), np.isfinite(away).sum())
        used = np.flatnonzero(away <= max(MARGIN, np.sort(away)[least - 1]))
        curves = np.array([self.curves[i] for i in used])
        nearest = used[np.argmin(np.sum((places[used] - best)[:, inputs]**2, axis=1))]
        scatter, grid_scatter = self.scatter(used)
        means = self._means(self.models[nearest].pull)
        result = self.models[nearest].result
        covariance = errors.covariance(self.record, self.cell, means, result, scatter)
        self.errors = covariance, errors.of_the_cell(self.cell, means, result), scatter
        scale = np.interp(self.grid, self.record.centres, np.sqrt(np.diag(covariance)))
        return self._of(Emulator(places[used][:, inputs], curves, scale, grid_scatter if np.any(grid_scatter) else None), covariance)

    def _of(self, emulator, covariance):
        return RecordLikelihood(self.record, self.number, self.keys, self.inputs, emulator, self.grid, covariance, self.errors[1],
                                self.cell_name)

    def seen(self, tried, low, high):
        """(likelihood, share) of some of the runs, by their numbers among those that were tried. The likelihood is that of the mean
        of those that are of the record's kind, without an emulator; the share is theirs. None where there are none of them."""
        right = self.is_right(low, high)
        chosen = [i for i in tried if right[i]]
        if not chosen:
            return None
        covariance, _, scatter = self.errors
        number = np.cumsum(~np.array(self.lost)) - 1  # among the runs with a whole curve
        curve = np.mean([self.curves[number[i]] for i in chosen], axis=0)
        return self._of(Known(curve), covariance + scatter / len(chosen)), len(chosen) / len(tried)


class Search:
    """Of the best values. `run(case, places, first)`: [Model], of specimens that are counted from `first`."""

    def __init__(self, cases, keys, run, renew):
        self.cases, self.keys, self.run, self.renew = cases, keys, run, renew
        self.inputs = np.array([i for i, key in enumerate(keys) if key.offset is None], int)
        self.low, self.high = np.zeros(len(keys)), np.ones(len(keys))
        self.count = 0

    def go(self):
        self.add(profiles.sobol(len(self.keys), 8 * len(self.inputs) + 2, 1))
        self.best = np.full(len(self.keys), 0.5)
        self.learn(0)
        for wave in range(1, MOST_WAVES + 1):
            has_settled = self.wave(wave)
            if wave == 2:
                self.renew(self.best)
                self.learn(wave)
            if wave > 2 and has_settled and self.likelihood.unknown(self.best) < LEARNT * self._means():
                break
        self.ends = ends.checked(self, MOST_WAVES + 1)

    def wave(self, number):
        """More runs, in a new box; whether the box is no longer smaller."""
        low, high, places = self._kept(number, 4 * len(self.inputs) + 2)
        shrunk = np.any((high - low)[self.inputs] < SHRUNK * (self.high - self.low)[self.inputs])
        self.add(places)
        self.low, self.high = low, high
        self.learn(number)
        return not shrunk

    def add(self, places):
        for case, models in zip(self.cases, self.run(places, self.count)):
            for place, model in zip(places, models):
                case.add(place, model)
        self.count += len(places)

    def learn(self, wave):
        for _ in range(2):  # the errors are those at the best place, which is known afterwards
            shares = [(case.inputs, case.share(self.low, self.high)) for case in self.cases]
            self.likelihood = Likelihood([case.likelihood(self.low, self.high, self.best) for case in self.cases], shares)
            self.best, self.value = profiles.best_of(self.likelihood, self.low, self.high, wave)

    def around(self):
        """The box, and what is beside it, as far as the range goes."""
        beside = LOOK * (self.high - self.low)
        return np.maximum(self.low - beside, 0.0), np.minimum(self.high + beside, 1.0)

    def _means(self):
        return sum(len(case.record.centres) for case in self.cases)

    def _kept(self, wave, more):
        """The box of all that may be best, and places in it for the next runs: the best one, and others far from each other."""
        around = self.around()
        tried = profiles.candidates(*around, 100 + wave)
        rises = self.likelihood.at(tried) - self.value
        # Where nothing fits as yet, neither the emulator nor a rise of -2 log L can be relied on.
        misfit = max(1.0, self.likelihood.chi_square(self.best) / self._means())
        kept = tried[rises <= max(KEPT * misfit, np.sort(rises)[LEAST_KEPT - 1])]
        kept = np.concatenate([self.best[None], kept])
        width = np.maximum(np.ptp(kept, axis=0), 1e-6)
        low = np.maximum(kept.min(axis=0) - GROWN * width, around[0])
        high = np.minimum(kept.max(axis=0) + GROWN * width, around[1])
        inside = (kept[:, self.inputs] - low[self.inputs]) / (high - low)[self.inputs]
        chosen = [0]
        away = np.sum((inside - inside[0])**2, axis=1)
        while len(chosen) < min(more, len(kept)):
            chosen.append(int(np.argmax(away)))
            away = np.minimum(away, np.sum((inside - inside[chosen[-1]])**2, axis=1))
        return low, high, kept[chosen]
