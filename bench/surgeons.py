"""Surgeon's knots of one thread that are pulled tight: the force over the length that the knot takes up, but for one unknown length."""
import math

import numpy as np

from predictions import CPU_LIMIT, STARTS, Row, mean_of_all
from runs import read_curve, read_yaml
from table import at_most

METHOD = "config/validation/surgeons_knot.yaml"
STEP = 2e-4          # [m] from one tried length to the next: forces change by less than 1 % on it
SMALLEST = 0.01 / 3  # [N] that a mean of three readings of their cell tells from nothing


def rows(runner, facts):
    measured = points_of(facts["points"])
    return rows_of({turns: [fit(curve_of(run_of(runner, turns, factor)), points) for factor in STARTS]
                    for turns, points in measured.items()}, facts)


def points_of(file):
    """{turns: (lengths [m] that the knot takes up, forces [N])}"""
    table = read_curve(file)
    columns = [np.array(table[name]) for name in ("turns", "shortening", "force")]
    return {int(turns): tuple(column[columns[0] == turns] for column in columns[1:]) for turns in sorted(set(table["turns"]))}


def run_of(runner, turns, factor):
    apart = read_yaml(METHOD)["specimen"]["end_to_end"]
    return runner.run(f"surgeon/{turns}_{factor:g}", {"specimen.knot": f"surgeon_{turns}",
                                                      "specimen.end_to_end": round(apart * factor, 9)}, METHOD, cpu_limit=CPU_LIMIT)


def curve_of(run):
    """The length that the knot takes up, rising, and the force of the pull; None where the run gave up."""
    if run.exit_code != 0:
        return None
    apart, load = run.pulled("end_to_end", "load")
    return (length_of(run.shape) - np.array(apart))[::-1], np.array(load)[::-1]


def length_of(shape):
    return float(np.linalg.norm(np.diff([shape["x"], shape["y"], shape["z"]], axis=1), axis=0).sum())


def fit(curve, points):
    """The length [m] that the measured knots take up beyond those of the curve, by which both agree best, and then the logarithms of
    predicted over measured force. None where no length lays all points upon the curve."""
    if curve is None:
        return None
    (taken_up, load), (shortening, force) = curve, points
    load = np.maximum(load, SMALLEST)
    fits = [(length, np.log(np.interp(shortening - length, taken_up, load) / force))
            for length in np.arange(max(shortening) - taken_up[-1], min(shortening) - taken_up[0], STEP)]
    return min(fits, key=lambda one: factor_of(one[1]), default=None)


def factor_of(logarithms):
    """Root mean square."""
    return math.exp(math.sqrt(np.mean(np.square(logarithms))))


def rows_of(fits, facts):
    """`fits`: {turns: that of each start}"""
    out = []
    for turns, each in fits.items():
        length, error = mean_of_all([one and one[0] * 1e3 for one in each])
        fitted = "a length, which is missing" if length is None else f"a length: {length:.0f} +/- {error:.1g} mm"
        out.append(row_of(f"{turns} turns", [one and one[1] for one in each], fitted, facts))
    starts = [None if None in one else np.concatenate([logarithms for _, logarithms in one]) for one in zip(*fits.values())]
    return out + [row_of("all points", starts, "those lengths", facts)]


def row_of(what, starts, fitted, facts):
    value, error = mean_of_all([None if one is None else factor_of(one) for one in starts])
    return Row(f"{facts['what']}: {what}", facts["measured"], value, error, value, at_most(facts["factor"]), facts["source"], fitted,
               facts["if_it_fails"])
