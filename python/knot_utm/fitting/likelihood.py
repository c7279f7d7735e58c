"""How likely measured curves are, over the free keys:

    -2 log L = r^T (A + g g^T)^-1 r + log det(A + g g^T) - log det C - 2 log p,   A = C + V

r: measured less simulated means [N], with the offsets of the record. C: errors.py. V: what the emulator does not know of the
simulated curve, so that a place where nothing was run is not believed to be unlikely. p: the share of the runs that are of the
record's kind (kinds.py). g: the systematic error of the cell. C and
V are blocks, one a record. g is one vector over all records of one cell, so that (Sherman and Morrison)

    r^T (A + g g^T)^-1 r = a - b^2/(1 + c),   log det(A + g g^T) = log det A + log(1 + c)

with a = r^T A^-1 r, b = g^T A^-1 r and c = g^T A^-1 g, which are sums over the records."""
from collections import defaultdict

import numpy as np
from scipy import linalg

SHIFTS = 41  # of an offset of the extension, over its range


class RecordLikelihood:
    """Of one record. `inputs`: which of the free keys its runs depend on; `of_the_cell`: g, of the cell of that name."""

    def __init__(self, record, number, keys, inputs, emulator, grid, covariance, of_the_cell, cell):
        self.record, self.emulator, self.inputs, self.cell = record, emulator, inputs, cell
        self.factor = linalg.cholesky(covariance, lower=True)
        self.of_the_cell = self._whitened(of_the_cell)
        self.errors = np.sqrt(np.diag(covariance) + of_the_cell**2)
        self.force = _offset(keys, number, "force")
        self.shift = _offset(keys, number, "extension")
        self.shifts = self.shift[1].value(np.linspace(0.0, 1.0, SHIFTS)) if self.shift else np.zeros(1)
        seen = [self._means(grid, shift) for shift in self.shifts]
        self.constant = np.stack([self._whitened(self.record.measured - means @ emulator.mean) for means in seen])
        self.slopes = np.stack([self._whitened(means @ emulator.components.T) for means in seen])
        self.one = self._whitened(np.ones(len(record.centres)))

    def _means(self, grid, shift):
        """What makes the means of a curve that is known at a grid, straight between its points, at readings less the shift."""
        at = np.clip(self.record.extension - shift, grid[0], grid[-1])
        right = np.clip(np.searchsorted(grid, at), 1, len(grid) - 1)
        share = (at - grid[right - 1]) / (grid[right] - grid[right - 1])
        made = np.zeros((len(self.record.centres), len(grid)))
        np.add.at(made, (self.record.parts, right - 1), 1.0 - share)
        np.add.at(made, (self.record.parts, right), share)
        return made / self.record.counts[:, None]

    def _whitened(self, values):
        return linalg.solve_triangular(self.factor, values, lower=True)

    def parts(self, places):
        """(r over its errors, slopes over the weights of the components, variances of the weights), one place a row."""
        weights, variances = self.emulator.weights(places[:, self.inputs])
        constant, slopes = self._shifted(places)
        left = constant - np.einsum("nkq,nq->nk", slopes, weights)
        if self.force:
            left = left - self.force[1].value(places[:, self.force[0]])[:, None] * self.one
        return left, slopes, variances

    def _shifted(self, places):
        if not self.shift:
            return self.constant[[0] * len(places)], np.broadcast_to(self.slopes[0], (len(places), *self.slopes[0].shape))
        at = places[:, self.shift[0]] * (SHIFTS - 1)
        left = np.clip(at.astype(int), 0, SHIFTS - 2)
        share = at - left
        one, two = share[:, None], share[:, None, None]
        return ((1.0 - one) * self.constant[left] + one * self.constant[left + 1],
                (1.0 - two) * self.slopes[left] + two * self.slopes[left + 1])

    def at(self, places):
        """(a, b, c, log det A - log det C), one place a row."""
        left, slopes, variances = self.parts(places)
        unknown = np.einsum("nkq,nkp->nqp", slopes, slopes)
        diagonal = np.arange(unknown.shape[1])
        unknown[:, diagonal, diagonal] += 1.0 / variances
        both = np.stack([left, np.broadcast_to(self.of_the_cell, left.shape)], axis=2)
        projected = np.einsum("nkq,nks->nqs", slopes, both)
        taken = np.einsum("nqs,nqt->nst", projected, np.linalg.solve(unknown, projected))
        products = np.einsum("nks,nkt->nst", both, both) - taken
        logarithm = np.linalg.slogdet(unknown)[1] + np.log(variances).sum(axis=1)
        return products[:, 0, 0], products[:, 0, 1], products[:, 1, 1], logarithm

    def unknown(self, place):
        """How much of the errors is of the emulator: the trace of V over C."""
        _, slopes, variances = self.parts(place[None])
        return float((slopes[0]**2 @ variances[0]).sum())

    def simulated(self, place):
        """Means of the simulated curve, with the offsets of the record [N]."""
        left, _, _ = self.parts(place[None])
        return self.record.measured - self.factor @ left[0]


class Likelihood:
    """Of all records, over places in the ranges of the free keys, 0 to 1 each. `shares`: of each record the inputs of its runs
    and the Share of them that are of its kind."""

    def __init__(self, records, shares=()):
        self.records, self.shares = records, shares

    def at(self, places):
        return sum(self._parts(places)) + sum(share.rarity(places[:, inputs]) for inputs, share in self.shares)

    def chi_square(self, place):
        return float(self._parts(place[None])[0][0])

    def _parts(self, places):
        """(chi^2, log det(A + g g^T) - log det C), one place a row."""
        of_cell = defaultdict(list)
        for record in self.records:
            of_cell[record.cell].append(record.at(places))
        chi_square = logarithm = 0.0
        for parts in of_cell.values():
            a, b, c, own = map(sum, zip(*parts))
            chi_square = chi_square + a - b**2 / (1.0 + c)
            logarithm = logarithm + own + np.log(1.0 + c)
        return chi_square, logarithm

    def unknown(self, place):
        return sum(record.unknown(place) for record in self.records)


def _offset(keys, number, kind):
    """(place among the keys, key) of an offset of a record; None where it is not free."""
    return next(((i, key) for i, key in enumerate(keys) if key.offset == (number, kind)), None)
