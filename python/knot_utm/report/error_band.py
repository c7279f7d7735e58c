"""Where the curve of ever finer tolerances may lie, by the errors that result.yaml gives for its readings.

Up to the lock the force may be off by plateau_force_error / true_plateau_force, behind it by locked_stiffness_error /
locked_stiffness, each as a share of the true force; the extension may be off by lock_extension_error at the lock and
behind it, and in proportion before. A curve between these errors lies between the two that are returned.
"""
import numpy as np


def error_band(run, pull):
    """Lowest and highest load over the extensions of the pull, NaN where no error is known. None where no error is known anywhere."""
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
