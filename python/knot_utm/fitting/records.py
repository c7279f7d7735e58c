"""What was measured, and the means of it that a fit compares."""
import numpy as np

from knot_utm.errors import WrongInput

MOST_BINS = 12  # so many that some dozens of specimens tell how they scatter together
FAR = 300.0      # loads or extensions so many times as large as the method's are in other units
WHOLE = 0.9      # of the measured extension, which a run must reach to be compared
BROKEN = 0.02    # the same of one whose rod parted: beyond it the curve goes on with its slope


class Record:
    """One measured curve, and what is set over the method that is to produce it."""

    def __init__(self, name, pull, settings, notes=()):
        """`notes`: what was said of it when it was read."""
        self.name, self.settings, self.notes = name, settings, notes
        self.extension, self.load = pull.extension, pull.load
        self._bin()

    def _bin(self):
        """Readings in equal parts of the extension; parts without readings are left out."""
        s = self.extension
        count = min(MOST_BINS, len(s))
        part = np.minimum((count * (s - s[0]) / (s[-1] - s[0])).astype(int), count - 1)
        self.parts = np.unique(part, return_inverse=True)[1]
        self.counts = np.bincount(self.parts)
        self.centres = self.means(s)
        self.measured = self.means(self.load)

    @property
    def range(self):
        return float(self.extension[-1])

    @property
    def largest_load(self):
        return float(np.max(np.abs(self.load)))

    def means(self, readings):
        """Of values at the readings, part by part."""
        return np.bincount(self.parts, readings) / self.counts

    def is_reached(self, model):
        """Whether a run says something of nearly all of the curve."""
        return model.pull is not None and model.pull.extension[-1] >= _wanted(model) * self.range

    def require_producible(self, model):
        """Raises WrongInput where the method, as it stands, pulls otherwise than the record."""
        if model.pull is None:
            raise WrongInput(f"{self.name}: the method as it stands leaves no curve: "
                             f"{model.result.get('reason') or 'its run failed'}")
        measured, simulated = (float(max(load, key=abs)) for load in (self.load, model.pull.load))
        if measured * simulated < 0.0:
            raise WrongInput(f"{self.name}: the measured load goes to {measured:.4g} N, and the method's to {simulated:.4g} N: one of "
                             "them has another sign, as in compression: --invert turns that of the record")
        end, most = float(model.pull.extension[-1]), float(np.max(np.abs(model.pull.load)))
        for measured, simulated, words in ((self.range, end, "an extension of {:.4g} m, and the method's pull to {:.4g} m"),
                                           (self.largest_load, most, "a load of {:.4g} N, and the method's to {:.4g} N")):
            if not simulated / FAR < measured < simulated * FAR:
                raise WrongInput(f"{self.name}: the measured curve goes to {words.format(measured, simulated)}: one of them is in "
                                 "other units, or of another test")
        if not self.is_reached(model):
            raise WrongInput(f"{self.name}: the measured curve goes to an extension of {self.range:.4g} m, but the method's pull "
                             f"ends at {end:.4g} m ({model.result.get('ended_by')}): let it go on, as by "
                             f"--set program.pull.until.extension={self.range:.4g}")


def _wanted(model):
    return BROKEN if model.result.get("ended_by") == "break" else WHOLE
