"""The search of a fit, in waves: runs over the box in which the best values may lie, an emulator of them, a smaller box.

So it is neither led astray by stick-slip, which makes single runs rough, nor does it need a start that is near (history matching:
Craig and others 1997)."""
import numpy as np

from knot_utm.fitting import errors, profiles
from knot_utm.fitting.emulator import Emulator
from knot_utm.fitting.likelihood import Likelihood, RecordLikelihood
from knot_utm.fitting.scatter import covariance_of, left_over

GRID = 384          # points of a simulated curve
MOST_WAVES = 8
KEPT = 16.0         # rise of -2 log L within which values are kept for the next wave
LEAST_KEPT = 48     # candidates, where those within KEPT are fewer
SHRUNK = 0.8        # a side of the box that shrinks by less has settled
LEARNT = 0.1        # errors of the emulator over all others, at the best place, which are small enough
MARGIN = 0.3        # of the box, beyond which runs are forgotten
GROWN = 0.05        # of the box, by which it is larger than what is kept


class Case:
    """One record in a search: its runs so far."""

    def __init__(self, record, number, keys, cell, batch):
        self.record, self.number, self.keys, self.cell, self.batch = record, number, keys, cell, batch
        self.inputs = np.array([i for i, key in enumerate(keys) if key.offset is None], int)  # what its runs depend on
        most = max((max(abs(key.low), abs(key.high)) for key in keys if key.offset == (number, "extension")), default=0.0)
        self.grid = np.linspace(record.extension[0] - most, record.extension[-1] + most, GRID)
        self.places, self.curves, self.models = [], [], []
        self.tried, self.lost = [], []  # all places, and whether the run there left no whole curve
        self._gather()

    def _gather(self):
        """How the specimens of the batch differ from their mean, in the means of the record and at the grid."""
        pulls = [model.pull for model in self.batch.models if self.record.is_reached(model)] if self.batch else []
        self.apart = None
        if len(pulls) > 1:
            means, curves = (np.array(rows) for rows in zip(*((self._means(pull), pull.at(self.grid)) for pull in pulls)))
            larger = np.sqrt(len(pulls) / (len(pulls) - 1))
            self.apart = larger * (means - means.mean(axis=0)), larger * (curves - curves.mean(axis=0))

    def _means(self, pull):
        return self.record.means(pull.at(self.record.extension))

    def scatter(self, used=()):
        """Covariances of the means and at the grid, of the batch and of runs in the box, which are specimens too."""
        if self.apart is None:
            return (np.zeros((n, n)) for n in (len(self.record.centres), GRID))
        rows = self.apart
        if len(used):
            places = np.array([self.places[i] for i in used])[:, self.inputs]
            also = np.array([self._means(self.models[i].pull) for i in used]), np.array([self.curves[i] for i in used])
            rows = [np.concatenate([of_batch, left_over(places, of_runs)]) for of_batch, of_runs in zip(rows, also)]
        return covariance_of(rows[0]), rows[1].T @ rows[1] / len(rows[1])

    def renew(self, batch):
        """Another batch, of specimens nearer to the best values; one that fails there tells nothing."""
        if 2 * sum(self.record.is_reached(model) for model in batch.models) < len(batch.models):
            return
        self.batch = batch
        self._gather()

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

    def likelihood(self, low, high, best):
        """Learnt of the runs in a box and a margin around it. `best`: a place at which the errors are taken."""
        places, inputs = np.array(self.places), self.inputs
        width = high - low
        away = np.max(np.maximum(low - places, places - high)[:, inputs] / width[inputs], axis=1)
        least = 3 * (len(inputs) + 1)
        used = np.flatnonzero(away <= max(MARGIN, np.sort(away)[min(least, len(away)) - 1]))
        curves = np.array([self.curves[i] for i in used])
        nearest = used[np.argmin(np.sum((places[used] - best)[:, inputs]**2, axis=1))]
        scatter, grid_scatter = self.scatter(used)
        means = self._means(self.models[nearest].pull)
        covariance = errors.covariance(self.record, self.cell, means, self.models[nearest].result, scatter)
        scale = np.interp(self.grid, self.record.centres, np.sqrt(np.diag(covariance)))
        emulator = Emulator(places[used][:, inputs], curves, scale, grid_scatter if np.any(grid_scatter) else None)
        return RecordLikelihood(self.record, self.number, self.keys, inputs, emulator, self.grid, covariance)


class Search:
    """Of the best values. `run(case, places, first)`: [Model], of specimens that are counted from `first`."""

    def __init__(self, cases, keys, run, renew):
        self.cases, self.keys, self.run, self.renew = cases, keys, run, renew
        self.inputs = np.array([i for i, key in enumerate(keys) if key.offset is None], int)
        self.low, self.high = np.zeros(len(keys)), np.ones(len(keys))
        self.count = 0

    @staticmethod
    def runs_of(inputs):
        """(of the first wave, of each other)"""
        return 8 * inputs + 2, 4 * inputs + 2

    def go(self):
        first, more = self.runs_of(len(self.inputs))
        self._add(profiles.sobol(len(self.keys), first, 1))
        self.best = np.full(len(self.keys), 0.5)
        self._learn(0)
        for wave in range(1, MOST_WAVES + 1):
            low, high, places = self._kept(wave, more)
            shrunk = np.any((high - low)[self.inputs] < SHRUNK * (self.high - self.low)[self.inputs])
            self._add(places)
            self.low, self.high = low, high
            self._learn(wave)
            if wave == 2:
                self.renew(self.best)
                self._learn(wave)
            if wave > 2 and not shrunk and self.likelihood.unknown(self.best) < LEARNT * self._means():
                break

    def _add(self, places):
        for case, models in zip(self.cases, self.run(places, self.count)):
            for place, model in zip(places, models):
                case.add(place, model)
        self.count += len(places)

    def _learn(self, wave):
        for _ in range(2):  # the errors are those at the best place, which is known afterwards
            self.likelihood = Likelihood([case.likelihood(self.low, self.high, self.best) for case in self.cases], self._is_lost)
            self.best, self.value = profiles.best_of(self.likelihood, self.low, self.high, wave)

    def _is_lost(self, places):
        """Where the nearest run of a record was lost."""
        lost = np.zeros(len(places), bool)
        width = (self.high - self.low)[self.inputs]
        for case in self.cases:
            if any(case.lost):
                tried = np.array(case.tried)[:, self.inputs] / width
                away = ((places[:, None, self.inputs] / width - tried[None])**2).sum(axis=2)
                lost |= np.array(case.lost)[np.argmin(away, axis=1)]
        return lost

    def _means(self):
        return sum(len(case.record.centres) for case in self.cases)

    def _kept(self, wave, more):
        """The box of all that may be best, and places in it for the next runs: the best one, and others far from each other."""
        tried = profiles.candidates(self.low, self.high, 100 + wave)
        rises = self.likelihood.at(tried) - self.value
        # Where nothing fits as yet, neither the emulator nor a rise of -2 log L can be relied on.
        misfit = max(1.0, self.likelihood.chi_square(self.best) / self._means())
        kept = tried[rises <= max(KEPT * misfit, np.sort(rises)[LEAST_KEPT - 1])]
        kept = np.concatenate([self.best[None], kept])
        width = np.maximum(np.ptp(kept, axis=0), 1e-6)
        low = np.maximum(kept.min(axis=0) - GROWN * width, self.low)
        high = np.minimum(kept.max(axis=0) + GROWN * width, self.high)
        inside = (kept[:, self.inputs] - low[self.inputs]) / (high - low)[self.inputs]
        chosen = [0]
        away = np.sum((inside - inside[0])**2, axis=1)
        while len(chosen) < min(more, len(kept)):
            chosen.append(int(np.argmax(away)))
            away = np.minimum(away, np.sum((inside - inside[chosen[-1]])**2, axis=1))
        return low, high, kept[chosen]
