"""How specimens of one kind differ: what is drawn of each, and the covariance of their curves."""
import csv
import os

import numpy as np

from knot_utm.fitting.keys import value_at
from knot_utm.fitting.runs import read_model
from knot_utm.yaml_text import load

SPECIMENS = 12
FACTORS = 2  # of the curves of a kind: what moves all of a curve together


class Batch:
    """A batch of specimens: `models`, and `draws`, [{key: drawn value over that of the method}]. `method`: as resolved."""

    def __init__(self, folder):
        self.method = load(os.path.join(folder, "method.yaml"))
        with open(os.path.join(folder, "specimens.csv"), encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(file))[1:]  # behind the units
        keys = [name for name in rows[0] if "." in name]
        self.draws = [{key: float(row[key]) / value_at(self.method, key) for key in keys} for row in rows]
        self.models = [read_model(os.path.join(folder, f"specimen_{number:03d}"), {}) for number in range(1, len(rows) + 1)]

    def drawn(self, number, settings):
        """Settings of one specimen: what is drawn goes with what is set."""
        draw = self.draws[number % len(self.draws)]
        return {**settings, **{key: factor * settings.get(key, value_at(self.method, key)) for key, factor in draw.items()}}


def covariance_of(curves):
    """Of curves that scatter, one a row: the largest common modes of their correlation, and the variance of each mean.

    The sample's own covariance of a few specimens is singular, and would call some differences impossible. The factor over the
    variance allows for how little a few specimens tell of it: it is the variance of Student's t, and that of one more specimen."""
    count = len(curves)
    sd = np.std(curves, axis=0, ddof=1) if count > 1 else np.zeros(np.shape(curves)[1])
    if count < 5 or not np.any(sd > 0):
        return np.diag(sd**2)
    scale = np.where(sd > 0, sd, 1.0)
    correlation = np.cov(curves / scale, rowvar=False)
    values, vectors = np.linalg.eigh(correlation)
    common = (vectors[:, -FACTORS:] * values[-FACTORS:]) @ vectors[:, -FACTORS:].T
    own = np.maximum(np.diag(correlation) - np.diag(common), 0.0)
    student = (count + 1) / count * (count - 1) / (count - 3)
    return student * np.outer(scale, scale) * (common + np.diag(own))
