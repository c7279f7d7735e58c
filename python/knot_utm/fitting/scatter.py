"""How specimens of one kind differ: what is drawn of each, and the covariance of their curves."""
import os

import numpy as np
import pandas as pd

from knot_utm.fitting.keys import value_at
from knot_utm.fitting.runs import read_model
from knot_utm.yaml_text import load

SPECIMENS = 12


class Batch:
    """A batch of specimens: `models`, and `draws`, [{key: drawn value over that of the method}]. `method`: as resolved."""

    def __init__(self, folder):
        self.method = load(os.path.join(folder, "method.yaml"))
        table = pd.read_csv(os.path.join(folder, "specimens.csv"), skiprows=[1], float_precision="round_trip")
        keys = [name for name in table if "." in name]
        self.draws = [{key: float(row[key]) / value_at(self.method, key) for key in keys} for _, row in table.iterrows()]
        self.models = [read_model(os.path.join(folder, f"specimen_{number:03d}")) for number in range(1, len(table) + 1)]

    def drawn(self, number, settings):
        """Settings of one specimen: what is drawn goes with what is set."""
        draw = self.draws[number % len(self.draws)]
        return {**settings, **{key: factor * settings.get(key, value_at(self.method, key)) for key, factor in draw.items()}}


def left_over(places, curves):
    """What is left of curves, one a row, beyond a second-order polynomial of the places: their scatter, with the size that it
    has where nothing was fitted to it. None of them where there are too few."""
    u = places - places.mean(axis=0)
    pairs = [(i, j) for i in range(u.shape[1]) for j in range(i, u.shape[1])]
    terms = np.column_stack([np.ones(len(u)), u, *[u[:, i] * u[:, j] for i, j in pairs]])
    count, lost = terms.shape
    if count < 2 * lost:
        return np.zeros((0, curves.shape[1]))
    return (curves - terms @ np.linalg.lstsq(terms, curves, rcond=None)[0]) * np.sqrt(count / (count - lost))


def covariance_of(curves):
    """Of curves that scatter, one a row: R = (1 - l) R_n + l 1 is their correlation, with that of the sample, R_n.

    The sample's own of a few specimens would call some differences impossible. l is that of oracle approximating shrinkage (Chen,
    Wiesel, Eldar and Hero 2010). The factor over the variance allows for how little a few specimens tell of it: the variance of
    Student's t, and that of one more specimen."""
    count, size = np.shape(curves)
    sd = np.std(curves, axis=0, ddof=1) if count > 3 else np.zeros(size)
    if size < 2 or not np.any(sd > 0):
        return np.diag(sd**2)
    scale = np.where(sd > 0, sd, 1.0)
    sample = np.cov(curves / scale, rowvar=False)
    square, trace = np.sum(sample**2), np.trace(sample)
    apart = (count + 1.0 - 2.0 / size) * (square - trace**2 / size)
    shrinkage = min(1.0, ((1.0 - 2.0 / size) * square + trace**2) / apart) if apart > 0 else 1.0
    correlation = (1.0 - shrinkage) * sample + shrinkage * np.diag(np.diag(sample))
    student = (count + 1) / count * (count - 1) / (count - 3)
    return student * np.outer(scale, scale) * correlation
