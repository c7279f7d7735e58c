"""Curves over parameters, learnt from runs: Gaussian processes of their principal components.

Each curve is a mean and a sum of components. The weight t of a component is a smooth function of the parameters u, known at
those of the runs but for a noise tau^2, which is the scatter of specimens and stick-slip:

    cov(t(u), t(v)) = T (1 + u v) + a^2 exp(-sum_d (u_d - v_d)^2/(2 l_d^2)) + tau^2 [u = v],   T = 100

a, l and tau are those of the largest marginal likelihood. Reference: Rasmussen and Williams, Gaussian Processes for Machine
Learning (2006), chapters 2 and 5."""
import numpy as np
from scipy import linalg, optimize

MOST_COMPONENTS = 10
LEFT_OUT = 1e-4       # variance of all components that are left out, in units of the scale
TREND = 100.0         # T, over the variance of the weights
LEAST_NOISE = 1e-7    # tau^2, over the same
LENGTHS = (0.15, 8.0)  # of l, over the range


class Emulator:
    """Learnt of curves, one a row, at places, one a row. `scale`: what is small, point by point; `noise`: covariance of what
    differs from run to run at one place."""

    def __init__(self, places, curves, scale, noise=None):
        self.low = places.min(axis=0)
        self.width = np.maximum(np.ptp(places, axis=0), 1e-12)
        self.mean = curves.mean(axis=0)
        self.scale = scale
        u, sizes, vectors = np.linalg.svd((curves - self.mean) / scale, full_matrices=False)
        left = np.append(np.cumsum((sizes**2)[::-1])[::-1] / len(curves), 0.0)
        count = max(1, min(MOST_COMPONENTS, int(np.argmax(left < LEFT_OUT))))
        vectors = vectors[:count]
        self.components = vectors * scale            # [N], one a row
        weights = u[:, :count] * sizes[:count]
        known = np.zeros(count) if noise is None else np.einsum("ki,ij,kj->k", vectors / scale, noise, vectors / scale)
        inside = (places - self.low) / self.width
        self.processes = [Process(inside, weights[:, k], known[k]) for k in range(count)]

    def weights(self, places):
        """Expected weights of the components and their variances, one place a row."""
        inside = (places - self.low) / self.width
        told = [process.at(inside) for process in self.processes]
        return np.stack([mean for mean, _ in told], axis=1), np.stack([variance for _, variance in told], axis=1)


class Known:
    """In place of an emulator, where the curve is known."""

    def __init__(self, curve):
        self.mean = curve
        self.components = np.zeros((1, len(curve)))

    def weights(self, places):
        return np.zeros((len(places), 1)), np.ones((len(places), 1))


class Process:
    """One component."""

    def __init__(self, places, values, noise):
        self.places = places
        self.size = max(float(np.std(values)), 1e-12)
        self.values = values / self.size
        least = np.log(max(LEAST_NOISE, noise / self.size**2))
        lengths = [tuple(np.log(LENGTHS))] * places.shape[1]
        bounds = [(-10.0, 6.0), (least, max(least, 0.0) + 1e-9), *lengths]
        self.squares = (places[:, None, :] - places[None, :, :])**2
        starts = [[0.0, max(least, -14.0), *[0.0] * places.shape[1]], [-1.0, max(least, -2.0), *[-0.7] * places.shape[1]]]
        found = [optimize.minimize(self._unlikely, start, jac=True, method="L-BFGS-B", bounds=bounds, options={"maxiter": 60})
                 for start in starts]
        self.parameters = min(found, key=lambda one: one.fun).x
        covariance = self._covariance(self.parameters)[0]
        self.factor = linalg.cholesky(covariance, lower=True)
        self.alpha = linalg.cho_solve((self.factor, True), self.values)

    def at(self, places):
        amplitude, lengths = np.exp(self.parameters[0]), np.exp(self.parameters[2:])
        squares = ((places[:, None, :] - self.places[None, :, :]) / lengths)**2
        covariance = amplitude * np.exp(-0.5 * squares.sum(axis=2)) + TREND * (1.0 + places @ self.places.T)
        alone = amplitude + TREND * (1.0 + (places**2).sum(axis=1))
        explained = linalg.solve_triangular(self.factor, covariance.T, lower=True)
        variance = np.maximum(alone - (explained**2).sum(axis=0), 1e-10)
        return self.size * (covariance @ self.alpha), self.size**2 * variance

    def _covariance(self, parameters):
        amplitude, noise = np.exp(parameters[:2])
        smooth = amplitude * np.exp(-0.5 * (self.squares / np.exp(2.0 * parameters[2:])).sum(axis=2))
        trend = TREND * (1.0 + self.places @ self.places.T)
        return trend + smooth + noise * np.eye(len(self.places)), smooth, noise

    def _unlikely(self, parameters):
        """Minus the logarithm of the marginal likelihood, and its derivatives."""
        covariance, smooth, noise = self._covariance(parameters)
        try:
            factor = linalg.cholesky(covariance, lower=True)
        except linalg.LinAlgError:
            return 1e10, np.zeros(len(parameters))
        inverse = linalg.cho_solve((factor, True), np.eye(len(covariance)))
        alpha = inverse @ self.values
        left = inverse - np.outer(alpha, alpha)
        slopes = [0.5 * np.sum(left * smooth), 0.5 * noise * np.trace(left)]
        slopes += [0.5 * np.sum(left * smooth * self.squares[:, :, d]) / np.exp(2.0 * parameters[2 + d])
                   for d in range(self.squares.shape[2])]
        return 0.5 * self.values @ alpha + np.sum(np.log(np.diag(factor))), np.array(slopes)
