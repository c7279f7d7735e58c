"""What numbers of a table say: shares, powers, thresholds and differences, each with its error; and what it says of points between its
runs, by those that are nearest."""
import functools
from collections import namedtuple

import numpy as np
import pandas as pd
from scipy import optimize, spatial, stats

from knot_utm import axes

Z = stats.norm.ppf(0.975)  # of 95 % intervals
STEEP = 50.0               # a logistic that is steeper, in units of the range of x, is a step
NEAREST = 15               # runs that tell of a point between them


@functools.cache  # a map asks the same of thousands of points
def share(count, n):
    """(share, low, high): count of n with Wilson's 95 % interval."""
    interval = stats.binomtest(count, n).proportion_ci(method="wilson")
    return count / n, interval.low, interval.high


def power(x, y):
    """(b, its standard error) of y = a x^b by least squares of the logarithms, of the points where both are above 0; None of
    fewer than three different x."""
    x, y = np.asarray(x, float), np.asarray(y, float)
    known = (x > 0) & (y > 0)
    if len(np.unique(x[known])) < 3:
        return None
    line = stats.linregress(np.log(x[known]), np.log(y[known]))
    return line.slope, line.stderr


def powers(table, keys, result):
    """The exponents of a product of powers of the keys, by least squares of the logarithms where all are above 0, a row for each
    key with its standard error, the number of runs, and `scatter`, the standard deviation of the logarithm from the product; None
    of too few runs."""
    known = table[[*keys, result]].apply(pd.to_numeric)
    known = np.log(known[(known > 0).all(axis=1)])
    free = len(known) - len(keys) - 1
    if free < 1:
        return None
    terms = np.column_stack([np.ones(len(known)), known[keys]])
    found, *_ = np.linalg.lstsq(terms, known[result], rcond=None)
    variance = np.sum((known[result] - terms @ found) ** 2) / free
    errors = np.sqrt(variance * np.diag(np.linalg.pinv(terms.T @ terms)))
    return pd.DataFrame({"key": keys, "exponent": found[1:], "standard_error": errors[1:], "n": len(known),
                         "scatter": np.sqrt(variance)})


# The x at which something happens in half of the cases, and its 95 % interval.
Threshold = namedtuple("Threshold", "value low high")


def threshold(x, happened):
    """The threshold of something that happens below a value of x only, or above it only. A logistic over ln x by maximum likelihood, its
    interval by the curvature of the likelihood. Where the cases part without overlap the interval is from the last x on the one
    side to the first on the other. None where it happened always or never."""
    x, happened = np.asarray(x, float), np.asarray(happened, bool)
    if happened.all() or not happened.any():
        return None
    for one, other in ((happened, ~happened), (~happened, happened)):
        if x[one].max() < x[other].min():
            low, high = x[one].max(), x[other].min()
            return Threshold(np.sqrt(low * high), low, high)
    return _logistic(np.log(x), happened)


def _logistic(u, happened):
    """p = 1/(1 + exp(-s (u - c))), c and s by maximum likelihood."""
    middle, width = u.mean(), np.ptp(u)
    sign = np.where(happened, 1.0, -1.0)

    def unlikelihood(at):
        return np.logaddexp(0.0, -sign * (at[0] + at[1] * (u - middle) / width)).sum()

    found = optimize.minimize(unlikelihood, [0.0, 0.0], method="BFGS")
    offset, slope = found.x
    if not 1.0 / STEEP < abs(slope) < STEEP:
        return None
    p = 1.0 / (1.0 + np.exp(-(offset + slope * (u - middle) / width)))
    terms = np.stack([np.ones_like(u), (u - middle) / width])
    covariance = np.linalg.inv((terms * (p * (1.0 - p))) @ terms.T)
    gradient = np.array([-1.0 / slope, offset / slope**2])
    half = Z * width * np.sqrt(gradient @ covariance @ gradient)
    centre = middle - width * offset / slope
    return Threshold(*np.exp([centre, centre - half, centre + half]))


def levels(table, by, result):
    """For each combination of the columns `by`: n, mean, sd and standard_error of the readings that are there."""
    groups = table.groupby(by, sort=False, dropna=False)[result]
    return groups.agg(n="count", mean="mean", sd="std", standard_error="sem").reset_index()


def differences(table, keys, cases, result):
    """How a result changes where one key alone is another one. Each run is held against the first one of the same `cases`, where
    it differs from that in one of the other `keys` only; specimens of the same number, which are drawn alike, against each
    other. Columns: the cases, key, value, n of pairs, mean and sd there, difference and its standard_error, and relative, the
    difference over the mean of the first."""
    rows = []
    others = [key for key in keys if key not in cases]
    for case, part in axes.combinations(table, cases):
        (_, first), *runs = axes.combinations(part, others)
        for _, run in runs:
            changed = [key for key in others if run[key].iloc[0] != first[key].iloc[0]]
            if len(changed) == 1:
                pairs = pd.DataFrame({"first": first[result].to_numpy(), "then": run[result].to_numpy()}).dropna()
                change, then = pairs["then"] - pairs["first"], pairs["then"]
                rows.append({**dict(zip(cases, case)), "key": changed[0], "value": run[changed[0]].iloc[0], "n": len(pairs),
                             "mean": then.mean(), "sd": then.std(), "difference": change.mean(), "standard_error": change.sem(),
                             "relative": change.mean() / pairs["first"].mean()})
    return pd.DataFrame(rows)


class Neighbours:
    """Runs as points in a unit cube: each key from its smallest to its largest value, as its axis counts."""

    def __init__(self, table, keys, outcomes):
        self.keys = keys
        self.scales = [axes.scales(table[key]) for key in keys]
        columns = [ahead(table[key].to_numpy(float)) for (ahead, _), key in zip(self.scales, keys)]
        self.low = np.array([column.min() for column in columns])
        self.width = np.array([np.ptp(column) for column in columns])
        self.names = sorted(set(outcomes))
        self.outcomes = np.array([self.names.index(outcome) for outcome in outcomes])
        self.tree = spatial.cKDTree((np.stack(columns, axis=1) - self.low) / self.width)
        self.count = min(NEAREST, len(table) - 1)

    def values(self, places):
        """The values of the keys at places in the cube."""
        return np.stack([back(low + width * column) for (_, back), low, width, column
                         in zip(self.scales, self.low, self.width, np.asarray(places).T)], axis=1)

    def majority(self, places):
        """(name, share, low, high) of the most frequent outcome near each place, with Wilson's 95 % interval."""
        _, near = self.tree.query(places, self.count)
        counts = (self.outcomes[np.reshape(near, (len(places), self.count, 1))] == np.arange(len(self.names))).sum(axis=1)
        return [(self.names[name], *share(int(row[name]), self.count)) for name, row in zip(counts.argmax(axis=1), counts)]
