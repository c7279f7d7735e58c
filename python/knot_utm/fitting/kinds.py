"""Runs of another kind than the record, as where knots open, and where such runs are to be expected.

The size of a run beside the record is

    g = mean over the parts of log((|F| + e)/(|F_m| + e)),

F: its means, F_m: those of the record, e: the error of a single mean [N]. Runs all over a box have sizes that lie close to each
other, and a jump of the model leaves a gap among them. What lies beyond a gap, seen from the record, is of another kind."""
import numpy as np
from scipy import optimize, special

ALIKE = np.log(3.0)  # size of the run that is nearest to the record, beyond which no run tells which kind is the record's
GAP = np.log(2.0)    # the least gap
OF_ALL = 0.25        # the least gap over the range of all sizes
LEAST = 1e-300       # [N]
PRIOR = 8.0          # standard deviation of a coefficient of log odds, over half of what the runs cover


def size(means, measured, error):
    """g."""
    error = np.maximum(error, LEAST)
    return float(np.mean(np.log((np.abs(means) + error) / (np.abs(measured) + error))))


def beyond_a_gap(sizes, among):
    """Whether runs are beyond a gap among some of them; none is, where no run is like the record."""
    sizes, ordered = np.asarray(sizes), np.sort(np.asarray(sizes)[among])
    if not len(ordered) or np.min(np.abs(ordered)) > ALIKE:
        return np.zeros(len(sizes), bool)
    own = int(np.argmin(np.abs(ordered)))
    gaps = np.flatnonzero(np.diff(ordered) > max(GAP, OF_ALL * (ordered[-1] - ordered[0])))
    low = ordered[gaps[gaps < own]].max(initial=-np.inf)
    high = ordered[gaps[gaps >= own] + 1].min(initial=np.inf)
    return (sizes <= low) | (sizes >= high)


class Share:
    """How large the share of the record's kind is, learnt of runs at places, one a row. `wrong`: whether they are of another one.
    The odds are the exponential of a second-order polynomial of the place, with a normal prior of its coefficients (logistic
    regression), so that a few runs do not promise too much."""

    def __init__(self, places, wrong):
        self.is_whole = not np.any(wrong)
        if self.is_whole:
            return
        self.middle, self.half = 0.5 * (places.max(axis=0) + places.min(axis=0)), np.maximum(0.5 * np.ptp(places, axis=0), 1e-12)
        terms, signs = self._terms(places), np.where(wrong, 1.0, -1.0)

        def unlikely(weights):
            odds = signs * (terms @ weights)
            slopes = weights / PRIOR**2 - terms.T @ (signs * special.expit(-odds))
            return np.logaddexp(0.0, -odds).sum() + 0.5 * np.sum(weights**2) / PRIOR**2, slopes
        self.weights = optimize.minimize(unlikely, np.zeros(terms.shape[1]), jac=True, method="BFGS").x

    def rarity(self, places):
        """-2 log(share)."""
        return np.zeros(len(places)) if self.is_whole else 2.0 * np.logaddexp(0.0, self._terms(places) @ self.weights)

    def _terms(self, places):
        u = (places - self.middle) / self.half
        pairs = [u[:, i] * u[:, j] for i in range(u.shape[1]) for j in range(i, u.shape[1])]
        return np.column_stack([np.ones(len(u)), u, *pairs])
