"""What is made of curves before they are drawn: fewer points, the band of errors, the mean of several."""
import math

import numpy as np

MOST = 6000


def few_points(*columns, most=MOST):
    """Rows to be drawn: all of them, or the first, the smallest and the largest of each column in every stretch."""
    rows = np.arange(len(columns[0]))
    if len(rows) <= most:
        return rows
    stretches = np.array_split(rows, most // (2 * len(columns) + 1))
    kept = {rows[0], rows[-1]}
    for stretch in stretches:
        kept.add(stretch[0])
        for column in columns:
            part = np.where(np.isfinite(column[stretch]), column[stretch], 0.0)
            kept.update((stretch[np.argmin(part)], stretch[np.argmax(part)]))
    return np.array(sorted(kept))


def error_band(run, pull):
    """Where the curve of ever finer tolerances may lie, by the errors that result.yaml gives for its readings.

    Up to the lock the force may be off by plateau_force_error / true_plateau_force, behind it by locked_stiffness_error /
    locked_stiffness, each as a share of the true force; the extension may be off by lock_extension_error at the lock and behind it,
    and in proportion before. A curve between these errors lies between the lowest and the highest load that are returned: over the
    extensions of the pull, NaN where no error is known; None where none is known anywhere."""
    lock = run.value("lock_extension")
    sliding, locked = share(run, "plateau_force"), share(run, "locked_stiffness")
    shift = run.value("lock_extension_error") if lock is not None else 0.0
    if len(pull) < 2 or (sliding is None and locked is None):
        return None
    s, force = pull["extension"], pull["load"] + run.offset()
    # Nothing slid: the stiffness is that of the whole pull.
    behind = s >= lock if lock is not None else np.full(len(s), sliding is None)
    relative = np.where(behind, np.nan if locked is None else locked, np.nan if sliding is None else sliding)
    low, high = force - relative * np.abs(force), force + relative * np.abs(force)
    if shift:
        reach = shift * np.minimum(1.0, np.maximum(s, 0.0) / lock)
        moved = [np.interp(s + t * reach, s, force) for t in np.linspace(-1.0, 1.0, 21)]
        lowest, highest = np.min(moved, axis=0), np.max(moved, axis=0)
        low, high = lowest - relative * np.abs(lowest), highest + relative * np.abs(highest)
    return low - run.offset(), high - run.offset()


def share(run, key):
    """Errors of forces belong to the true one."""
    value, error = run.value("true_" + key) or run.value(key), run.value(key + "_error")
    return None if value is None or error is None or value == 0.0 else abs(error / value)


STEPS = 1000


class MeanCurve:
    """Over `extension` [m] the `mean` of the loads [N], their standard deviation `sd`, and half the width of the 95 %
    interval of the mean, `half`. `least` and `most` are the loads of the specimens between which all of them lie. Between
    its readings a load is taken straight from point to point."""

    def __init__(self, pulls, low, high):
        self.extension = np.linspace(low, high, STEPS + 1)
        loads = np.array([np.interp(self.extension, s, load) for s, load in pulls])
        from scipy.stats import t

        n = len(loads)
        self.mean, self.sd = loads.mean(axis=0), loads.std(axis=0, ddof=1)
        self.half = t.ppf(0.975, n - 1) * self.sd / math.sqrt(n)
        self.least, self.most = loads.min(axis=0), loads.max(axis=0)

    def about(self, width):
        """The mean less and plus a width, no further than a specimen shows: where locks lie apart, loads are no longer
        normally distributed, and a band would reach below all of them."""
        return np.maximum(self.mean - width, self.least), np.minimum(self.mean + width, self.most)


def mean_curve(pulls):
    """`pulls`: of each curve extension and load. None: they are not two, or no extension is common to all."""
    if len(pulls) < 2 or any(len(s) < 2 for s, _ in pulls):
        return None
    low, high = max(s[0] for s, _ in pulls), min(s[-1] for s, _ in pulls)
    return MeanCurve(pulls, low, high) if low < high else None
