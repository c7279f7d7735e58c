"""The search of a fit, in waves: runs over the box in which the best values may lie, an emulator of them, a smaller box.

So it is neither led astray by stick-slip, which makes single runs rough, nor does it need a start that is near (history matching:
Craig and others 1997)."""
import numpy as np

from knot_utm.fitting import errors, profiles
from knot_utm.fitting.emulator import Emulator
from knot_utm.fitting.likelihood import Likelihood, RecordLikelihood
from knot_utm.fitting.scatter import covariance_of, left_over
from knot_utm.yaml_text import text_of

GRID = 384          # points of a simulated curve
MOST_WAVES = 8
KEPT = 16.0         # rise of -2 log L within which values are kept for the next wave
LEAST_KEPT = 48     # candidates, where those within KEPT are fewer
SHRUNK = 0.8        # a side of the box that shrinks by less has settled
LEARNT = 0.1        # errors of the emulator over all others, at the best place, which are small enough
MARGIN = 0.3        # of the box, beyond which runs are forgotten
GROWN = 0.05        # of the box, by which it is larger than what is kept
ALIKE, UNLIKE = 0.5, 0.8  # misfit of runs that come near to the record, and of those that are of another kind
LEAST = 1e-300      # [N]
CLEARLY = 2.0       # times as far as the nearest run of another kind the nearest one of the record's kind must be


class Case:
    """One record in a search: its runs so far."""

    def __init__(self, record, number, keys, cell, batch):
        self.record, self.number, self.keys, self.cell, self.batch = record, number, keys, cell, batch
        self.cell_name = text_of({key: value for key, value in cell.items() if key != "noise_run"})
        self.inputs = np.array([i for i, key in enumerate(keys) if key.offset is None], int)  # what its runs depend on
        most = max((max(abs(key.low), abs(key.high)) for key in keys if key.offset == (number, "extension")), default=0.0)
        self.grid = np.linspace(record.extension[0] - most, record.extension[-1] + most, GRID)
        self.places, self.curves, self.models, self.misfits = [], [], [], []
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
            self.misfits.append(self._misfit(self._means(model.pull)))

    def _misfit(self, means):
        """From 0 to 1: 0.8 where the loads of a run are nine times as large as the measured ones, or a ninth of them."""
        measured, error = self.record.measured, errors.of_single_means(self.record, self.cell, means)
        return float(np.mean(np.abs(means - measured) / np.maximum(np.abs(means) + np.abs(measured) + error, LEAST)))

    def unlike(self):
        """Whether a run is of another kind than the record, as where knots opened. Nothing is, where no run comes near."""
        misfits = np.array(self.misfits)
        return (misfits > UNLIKE) & (misfits.min(initial=1.0) < ALIKE)

    def is_not(self, places, width):
        """Where runs of the record leave no whole curve, or one of another kind. The benefit of the doubt is for the record: the
        emulator knows little there, and the next runs tell."""
        inputs = self.inputs
        unlike = self.unlike()
        right = [place for place, is_unlike in zip(self.places, unlike) if not is_unlike]
        wrong = [place for place, is_lost in zip(self.tried, self.lost) if is_lost]
        wrong += [place for place, is_unlike in zip(self.places, unlike) if is_unlike]
        if not wrong:
            return np.zeros(len(places), bool)
        to_right, to_wrong = (distances((places / width)[:, inputs], (np.array(of) / width)[:, inputs]) for of in (right, wrong))
        return to_right > CLEARLY * to_wrong

    def likelihood(self, low, high, best):
        """Learnt of the runs in a box and a margin around it that are of the record's kind: others would smear a jump from one
        kind to the other over both sides. `best`: a place at which the errors are taken."""
        places, inputs = np.array(self.places), self.inputs
        width = high - low
        away = np.max(np.maximum(low - places, places - high)[:, inputs] / width[inputs], axis=1)
        away[self.unlike()] = np.inf
        least = min(3 * (len(inputs) + 1), np.isfinite(away).sum())
        used = np.flatnonzero(away <= max(MARGIN, np.sort(away)[least - 1]))
        curves = np.array([self.curves[i] for i in used])
        nearest = used[np.argmin(np.sum((places[used] - best)[:, inputs]**2, axis=1))]
        scatter, grid_scatter = self.scatter(used)
        means = self._means(self.models[nearest].pull)
        result = self.models[nearest].result
        covariance = errors.covariance(self.record, self.cell, means, result, scatter)
        scale = np.interp(self.grid, self.record.centres, np.sqrt(np.diag(covariance)))
        emulator = Emulator(places[used][:, inputs], curves, scale, grid_scatter if np.any(grid_scatter) else None)
        return RecordLikelihood(self.record, self.number, self.keys, inputs, emulator, self.grid, covariance,
                                errors.of_the_cell(self.cell, means, result), self.cell_name)


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
        return np.any([case.is_not(places, self.high - self.low) for case in self.cases], axis=0)

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


def distances(places, others):
    """How far the nearest of the others is, for each place."""
    return np.sqrt(((places[:, None] - others[None])**2).sum(axis=2).min(axis=1))
