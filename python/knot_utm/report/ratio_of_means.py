"""The ratio of two means, such as the strength of a rope with a knot over that without one, and how sure it is."""
import math
import statistics

from knot_utm.report.student import quantile


class Sample:
    """Readings of one batch: n, mean, sd over n - 1, and cv, which is sd over the mean."""

    def __init__(self, readings):
        self.n, self.mean, self.sd = len(readings), statistics.fmean(readings), statistics.stdev(readings)
        self.cv = self.sd / self.mean

    def share(self):
        """The variance of the logarithm of the mean, to first order."""
        return self.cv ** 2 / self.n


def ratio_of_means(a, b):
    """(ratio, low, high) of the means of two samples, both above 0, and the 95 % interval of the ratio.

    The logarithm of the ratio has, to first order, the variance v = cv_a^2/n_a + cv_b^2/n_b. Its interval is Student's with
    the degrees of freedom of Welch (1947), v^2/((cv_a^2/n_a)^2/(n_a - 1) + (cv_b^2/n_b)^2/(n_b - 1)). So the interval has
    no end below 0, and the inverse ratio has the inverse interval."""
    ratio, parts = a.mean / b.mean, (a.share(), b.share())
    variance = sum(parts)
    if variance == 0.0:
        return ratio, ratio, ratio
    largest = max(parts)  # squares of tiny shares are 0
    degrees = (variance / largest) ** 2 / sum((part / largest) ** 2 / (of.n - 1) for part, of in zip(parts, (a, b)))
    reach = math.exp(quantile(degrees) * math.sqrt(variance))
    return ratio, ratio / reach, ratio * reach
