"""What was measured: the means of it that a fit compares, and how far they may be off those of a run.

The covariance of their difference, but for scatter, is

    C = diag(noise^2/n + resolution^2/12 + rounding^2) + sum over modes of d d^T

Noise is of each reading, n of which make a mean. A reading is rounded by up to half of the resolution. The modes d [N] move
many means together. They are the numerical errors of result.yaml, which are meant to hold 19 of 20 readings (half of each is one
standard deviation), and the systematic error of the cell, which moves all records of one cell. That is a bound, and over sqrt(3) it is
a standard deviation. As class_error of tensile_test has it, it is the accuracy times the true load, or the floor where the true load is
below it."""
from collections import defaultdict

import numpy as np
from scipy import linalg

from knot_utm.errors import WrongInput
from knot_utm.fitting.keys import value_at
from knot_utm.yaml_text import is_number, text_of

MOST_BINS = 12   # so many that some dozens of runs tell how they scatter together
FAR = 300.0      # loads or extensions so many times as large as the method's are in other units
WHOLE = 0.9      # of the measured extension, which a run must reach to be compared
BROKEN = 0.02    # the same of one whose rod parted: beyond it the curve goes on with its slope
ROUNDING, ROUNDING_OF_LARGEST = 1e-4, 1e-6  # of a load, of the largest load: of curves straight from point to point
LEAST = 1e-300   # [N]


class Record:
    """One measured curve, and the method that is to produce it."""

    def __init__(self, name, pull, settings, method, notes=()):
        """`settings`: over the method; `method`: with every value; `notes`: what was said of the record when it was read."""
        self.name, self.settings, self.method, self.notes = name, settings, method, notes
        cell = method["machine"]["load_cell"]
        self.cell_name = text_of({key: value for key, value in cell.items() if key != "noise_run"})
        self.cell = defaultdict(float, _numbers(cell))
        scatter = method.get("specimens", {}).get("scatter")
        self.scatter = scatter if isinstance(scatter, dict) else {}
        self.extension, self.load = s, load = pull.extension, pull.load
        self.range, self.largest_load = float(s[-1]), float(np.max(np.abs(load)))
        # Readings in equal parts of the extension; parts without readings are left out.
        count = min(MOST_BINS, len(s))
        part = np.minimum((count * (s - s[0]) / (s[-1] - s[0])).astype(int), count - 1)
        self.parts = np.unique(part, return_inverse=True)[1]
        self.counts = np.bincount(self.parts)
        self.centres, self.measured = self.means(s), self.means(load)

    def means(self, readings):
        """Of values at the readings, part by part."""
        return np.bincount(self.parts, readings) / self.counts

    def simulated(self, model, force_offset=0.0, extension_offset=0.0):
        """The means of a run, as they would have been recorded; not a number where it leaves no whole curve."""
        if not self.is_reached(model):
            return np.full(len(self.centres), np.nan)
        return self.means(model.pull.at(self.extension - extension_offset)) + force_offset

    def run_settings(self, free, number):
        """Of a run with values of the free keys, of one more specimen, which is drawn as tensile_test draws them."""
        settings, random = {**self.settings, **free}, np.random.default_rng(number)
        return {**settings, **{key: float(_factor(law, random) * settings.get(key, value_at(self.method, key)))
                               for key, law in self.scatter.items()}}

    def is_reached(self, model):
        """Whether a run says something of nearly all of the curve."""
        share = BROKEN if model.result.get("ended_by") == "break" else WHOLE
        return model.pull is not None and model.pull.extension[-1] >= share * self.range

    def require_producible(self, model):
        """Raises WrongInput where the method, as it stands, pulls otherwise than the record."""
        if model.pull is None:
            raise WrongInput(f"{self.name}: the method as it stands leaves no curve: "
                             f"{model.result.get('reason') or 'its run failed'}")
        measured, simulated = (float(max(load, key=abs)) for load in (self.load, model.pull.load))
        if measured * simulated < 0.0:
            raise WrongInput(f"{self.name}: the measured load goes to {measured:.4g} N, and the method's to {simulated:.4g} N: one of "
                             "them has another sign, as in compression: --invert turns that of the record")
        end = float(model.pull.extension[-1])
        for measured, made, words in ((self.range, end, "an extension of {:.4g} m, and the method's pull to {:.4g} m"),
                                      (self.largest_load, abs(simulated), "a load of {:.4g} N, and the method's to {:.4g} N")):
            if not made / FAR < measured < made * FAR:
                raise WrongInput(f"{self.name}: the measured curve goes to {words.format(measured, made)}: one of them is in "
                                 "other units, or of another test")
        if not self.is_reached(model):
            raise WrongInput(f"{self.name}: the measured curve goes to an extension of {self.range:.4g} m, but the method's pull "
                             f"ends at {end:.4g} m ({model.result.get('ended_by')}): let it go on, as by "
                             f"--set program.pull.until.extension={self.range:.4g}")

    def require_errors(self):
        """Raises WrongInput where nothing is known of how far the readings may be off."""
        if not self.scatter and not any(self.cell[key] for key in ("noise", "resolution", "accuracy", "floor")):
            raise WrongInput(f"{self.name}: nothing says how far a reading may be off: the load cell of the method has no errors; "
                             "give its class, as by --set machine.load_cell.accuracy=0.005, or resolution or noise")

    def single_errors(self, means):
        """Standard deviations of what is behind each mean alone [N]."""
        rounding = ROUNDING * np.abs(means) + ROUNDING_OF_LARGEST * np.max(np.abs(means)) + LEAST
        return np.sqrt(self.cell["noise"]**2 / self.counts + self.cell["resolution"]**2 / 12.0 + rounding**2)

    def numerical_modes(self, means, result):
        """Of the plateau, of the lock and of the locked stiffness, as far as a result has them [N]."""
        of, s = defaultdict(float, _numbers(result)), self.centres
        lock = of.get("lock_extension", np.inf)
        plateau, stiffness = (0.5 * of[key + "_error"] / (of[key] or np.inf) for key in ("plateau_force", "locked_stiffness"))
        begins = np.interp(lock, s, means) if np.isfinite(lock) else 0.0
        return (np.where(s < lock, plateau * means, 0.0),
                np.where(s > 0.9 * lock, -0.5 * of["lock_extension_error"] * np.gradient(means, s), 0.0),
                np.where((s >= lock) | np.isinf(lock), stiffness * (means - begins), 0.0))

    def cell_mode(self, means, result):
        """Of the systematic error of the cell [N]."""
        true_load = means + _numbers(result).get("balance_offset", 0.0)
        floor = self.cell["floor"] * self.cell["capacity"]
        return np.where(np.abs(true_load) < floor, floor, self.cell["accuracy"] * means) / np.sqrt(3.0)


def covariance(records, means, results):
    """C [N^2]. `means`: simulated ones of all records, one after another; `results`: of the runs that left them."""
    means = split(records, means)
    found = linalg.block_diag(*(np.diag(record.single_errors(part)**2)
                                + sum(np.outer(mode, mode) for mode in record.numerical_modes(part, result))
                                for record, part, result in zip(records, means, results)))
    modes = [record.cell_mode(part, result) for record, part, result in zip(records, means, results)]
    for cell in dict.fromkeys(record.cell_name for record in records):
        mode = np.concatenate([(record.cell_name == cell) * mode for record, mode in zip(records, modes)])
        found += np.outer(mode, mode)
    return found


def split(records, means):
    """Values of all means, record by record; they are the last axis."""
    return np.split(means, np.cumsum([len(record.centres) for record in records])[:-1], axis=-1)


def _factor(law, random):
    """Of a specimen, over the value of the method."""
    (name, spread), = law.items()
    z = spread * (random.uniform(-1.0, 1.0) if name == "uniform" else np.clip(random.standard_normal(), -3.0, 3.0))
    return np.exp(z) if name == "log_normal" else 1.0 + z


def _numbers(result):
    return {key: value for key, value in result.items() if is_number(value)}
