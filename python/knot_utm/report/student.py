"""Student's distribution: how far a mean may be off, in standard errors."""
import math

import numpy as np

CONFIDENCE = 0.95
NODES, WEIGHTS = np.polynomial.legendre.leggauss(60)


def quantile(degrees):
    """The t beyond which, on either side, a mean lies with a probability of 5 %. `degrees`: of freedom, at least 1, and
    no whole number where two standard deviations have a share in it.

    With t = sqrt(degrees) tan(a) the density is that of cos(a)^(degrees - 1), from -pi/2 to pi/2."""
    log_half = 0.5 * math.log(math.pi) + math.lgamma(0.5 * degrees) - math.lgamma(0.5 * (degrees + 1.0)) - math.log(2.0)
    wanted = CONFIDENCE * math.exp(log_half)
    # t is largest where the degrees are 1.
    low, high = 0.0, math.atan(math.tan(0.5 * CONFIDENCE * math.pi) / math.sqrt(degrees))
    for _ in range(60):
        middle = 0.5 * (low + high)
        found = 0.5 * middle * float(WEIGHTS @ np.cos(0.5 * middle * (NODES + 1.0)) ** (degrees - 1.0))
        low, high = (middle, high) if found < wanted else (low, middle)
    return math.sqrt(degrees) * math.tan(0.5 * (low + high))
