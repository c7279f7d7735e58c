"""How likely measured means are over the free keys, as far as runs tell: their means are a polynomial of the keys, and the rest is
scatter.

The polynomial is that of least squares. Its order is the one, from 1 on, with which runs are told best that are left out one at a
time. Of n runs and p terms the scatter S is the covariance of the residuals, over n - p. It holds how specimens differ, stick-slip, and
what the polynomial misses. With the errors C of records.py the likelihood is

    -2 log L = r^T A^-1 r + log det A - log det C - 2 log q(u),   A = C + (1 + h) S,   h = t^T (T^T T)^-1 t

r: measured less simulated means; t: the terms of the polynomial at the place u, T: those of all runs. h S is what is not known of the
polynomial, so that a place where nothing was run is not believed to be unlikely. q: the share of the runs around u whose loads are of
the record's size. A is diagonal in the eigenvectors of S beside C.

Reference: Myers, Montgomery and Anderson-Cook, Response Surface Methodology (2016), chapters 2 and 3."""
import itertools

import numpy as np
from scipy import linalg

HIGHEST_ORDER = 4
NEAR = 0.15  # of the range of the runs: how far a run tells of what kind others are


class Surface:
    """Of the means of runs, one run a row, at places from 0 to 1. `scale`: what is small, mean by mean."""

    def __init__(self, places, means, scale):
        self.low, self.width = places.min(axis=0), np.maximum(np.ptp(places, axis=0), 1e-12)
        self.order = min(range(1, HIGHEST_ORDER + 1), key=lambda order: self._missed(order, places, means / scale))
        terms = self._terms(places, self.order)
        q, self.root = np.linalg.qr(terms)
        self.weights = linalg.solve_triangular(self.root, q.T @ means)
        self.left, self.freedom = means - terms @ self.weights, len(terms) - terms.shape[1]

    def at(self, places):
        """(means, h), one place a row."""
        terms = self._terms(places, self.order)
        return terms @ self.weights, (linalg.solve_triangular(self.root, terms.T, trans="T")**2).sum(axis=0)

    def _missed(self, order, places, means):
        """Mean square by which runs are missed that are left out; infinite where the runs are too few for the order."""
        terms = self._terms(places, order)
        if order > 1 and len(terms) < 2 * terms.shape[1]:
            return np.inf
        q, _ = np.linalg.qr(terms)
        return np.mean(((means - q @ (q.T @ means)) / np.maximum(1.0 - (q**2).sum(axis=1), 1e-6)[:, None])**2)

    def _terms(self, places, order):
        u = 2.0 * (places - self.low) / self.width - 1.0
        powers = [keys for n in range(order + 1) for keys in itertools.combinations_with_replacement(range(u.shape[1]), n)]
        return np.stack([np.prod(u[:, list(keys)], axis=1) for keys in powers], axis=1)


class Likelihood:
    """`known`: C; `scatter`: S; `places`, `is_right`: all runs, and which of them are of the record's kind."""

    def __init__(self, measured, surface, scatter, known, places, is_right):
        self.measured, self.surface, self.places, self.is_right = measured, surface, places, is_right
        self.errors = np.sqrt(np.diag(known + scatter))
        sizes, self.vectors = linalg.eigh(scatter, known)
        self.sizes = np.maximum(sizes, 0.0)

    def at(self, places):
        """-2 log L, one place a row."""
        squares, spread = self._parts(places)
        weight = np.exp(-0.5 * (((places[:, None] - self.places) / (NEAR * self.surface.width))**2).sum(axis=2))
        share = (1.0 + weight @ self.is_right) / (1.0 + weight.sum(axis=1))
        return (squares + np.log(spread)).sum(axis=1) - 2.0 * np.log(share)

    def chi_square(self, place):
        return float(self._parts(place[None])[0].sum())

    def squares(self, means):
        """How far runs themselves are off the record, over the errors and the scatter: a chi^2 of each row."""
        return (((self.measured - means) @ self.vectors)**2 / (1.0 + self.sizes)).sum(axis=1)

    def unknown(self, place, scatter_too):
        """How much of the errors is of the polynomial, and of the scatter if that counts, too."""
        _, h = self.surface.at(place[None])
        return float(((h + scatter_too) * self.sizes / (1.0 + self.sizes)).sum())

    def _parts(self, places):
        means, h = self.surface.at(places)
        spread = 1.0 + (1.0 + h)[:, None] * self.sizes
        return ((self.measured - means) @ self.vectors)**2 / spread, spread


def scatter_of(rows, freedom):
    """S, of residuals, one a row. Their correlation is that of the sample, drawn towards none by oracle approximating shrinkage (Chen,
    Wiesel, Eldar and Hero 2010): of a few runs the sample would call some differences impossible. The factor over the variance is that
    of Student's t, which allows for how little a few runs tell."""
    size = rows.shape[1]
    sd = np.sqrt((rows**2).sum(axis=0) / freedom)
    scale = np.where(sd > 0, sd, 1.0)
    sample = (rows / scale).T @ (rows / scale) / freedom
    square, trace = np.sum(sample**2), np.trace(sample)
    apart = (freedom + 1.0 - 2.0 / size) * (square - trace**2 / size)
    shrinkage = min(1.0, ((1.0 - 2.0 / size) * square + trace**2) / apart) if apart > 0 else 1.0
    correlation = (1.0 - shrinkage) * sample + shrinkage * np.diag(np.diag(sample))
    return freedom / max(freedom - 2.0, 1.0) * np.outer(scale, scale) * correlation
