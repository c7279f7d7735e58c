"""The mean of several curves over the extensions that all of them have."""
import math

import numpy as np

from knot_utm.report.student import quantile

STEPS = 1000


class MeanCurve:
    """Over `extension` [m] the `mean` of the loads [N], their standard deviation `sd`, and half the width of the 95 %
    interval of the mean, `half`. `least` and `most` are the loads of the specimens between which all of them lie. Between
    its readings a load is taken straight from point to point."""

    def __init__(self, pulls, low, high):
        self.extension = np.linspace(low, high, STEPS + 1)
        loads = np.array([np.interp(self.extension, s, load) for s, load in pulls])
        n = len(loads)
        self.mean, self.sd = loads.mean(axis=0), loads.std(axis=0, ddof=1)
        self.half = quantile(n - 1.0) * self.sd / math.sqrt(n)
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
