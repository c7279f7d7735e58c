"""How far a measured curve may be off the simulated one: the covariance of the means that a fit compares.

    C = diag(noise^2/n + resolution^2/12 + rounding^2) + sum over modes of d d^T + S

Noise is of each reading, n of which make a mean. A reading is rounded by up to half of the resolution. The modes d [N] move
all means together. They are the numerical errors of result.yaml, which are meant to hold 19 of 20 readings (half of each is one
standard deviation). S is the scatter from specimen to specimen (scatter.py).

The systematic error of the cell is one more mode, which stands apart because it moves all records of one cell together. It is a
bound, and over sqrt(3) it is a standard deviation. As class_error of tensile_test has it, it is the accuracy times the true
load, or the floor where the true load is below it."""
from collections import defaultdict

import numpy as np

from knot_utm.design import is_number
from knot_utm.errors import WrongInput

ROUNDING, ROUNDING_OF_LARGEST = 1e-4, 1e-6  # of a load, of the largest load: of curves straight from point to point


def covariance(record, cell, means, result, scatter):
    """[N^2]. `cell`: the map of the method; `means`: of the simulated curve [N]; `scatter`: S [N^2]."""
    modes = [np.outer(mode, mode) for mode in _numerical(record.centres, means, result)]
    return np.diag(of_single_means(record, cell, means)**2) + sum(modes) + scatter


def of_single_means(record, cell, means):
    """Standard deviations of what is behind each mean alone [N]."""
    rounding = ROUNDING * np.abs(means) + ROUNDING_OF_LARGEST * np.max(np.abs(means))
    return np.sqrt(_number(cell, "noise")**2 / record.counts + _number(cell, "resolution")**2 / 12.0 + rounding**2)


def of_the_cell(cell, means, result):
    """The mode of its systematic error [N]."""
    true_load = means + _numbers(result)["balance_offset"]
    floor = _number(cell, "floor") * _number(cell, "capacity")
    return np.where(np.abs(true_load) < floor, floor, _number(cell, "accuracy") * means) / np.sqrt(3.0)


def require_known(record, cell, scatter):
    """Raises WrongInput where nothing is known of how far the readings may be off."""
    if not any(_number(cell, key) for key in ("noise", "resolution", "accuracy", "floor")) and not np.any(np.diag(scatter) > 0):
        raise WrongInput(f"{record.name}: nothing says how far a reading may be off: the load cell of the method has no errors; "
                         "give its class, as by --set machine.load_cell.accuracy=0.005, or resolution or noise")


def _numerical(s, means, result):
    """Modes of the plateau, of the lock and of the locked stiffness; zero, as far as a result does not have them."""
    of = _numbers(result)
    lock = of.get("lock_extension", np.inf)
    plateau, stiffness = (0.5 * of[key + "_error"] / (of[key] or np.inf) for key in ("plateau_force", "locked_stiffness"))
    begins = np.interp(lock, s, means) if np.isfinite(lock) else 0.0
    yield np.where(s < lock, plateau * means, 0.0)
    yield np.where(s > 0.9 * lock, -0.5 * of["lock_extension_error"] * np.gradient(means, s), 0.0)
    yield np.where((s >= lock) | np.isinf(lock), stiffness * (means - begins), 0.0)


def _numbers(result):
    """Of a result, zero for those that it does not have."""
    return defaultdict(float, {key: value for key, value in result.items() if is_number(value)})


def _number(cell, key):
    return float(cell.get(key) or 0.0)
