"""What a run and a batch have in common: readings by their keys, as of a dict, and a line that shows them."""
from collections.abc import Mapping

from knot_utm import spelling

PULLS = ("pull", "cycle", "follow")  # the phases of curve.csv in which the specimen is pulled


class Readings(Mapping):
    """A dict of readings that is only read. What derives from it has `_readings`, a pandas object with the keys as its index."""

    def __getitem__(self, key):
        if key not in self._readings.index:
            raise KeyError(f"there is no reading {key!r}{spelling.hint(key, self._readings.index)}")
        return self._readings.loc[key]

    def __iter__(self):
        return iter(self._readings.index)

    def __len__(self):
        return len(self._readings.index)

    def __getattr__(self, name):
        # Called for names that are not there. What copies an object asks for some before it has any of its own.
        if name.startswith("_"):
            raise AttributeError(name)
        near = spelling.hint(name, dir(self)) or (f"; it is a reading: [{name!r}]" if name in self._readings.index else "")
        raise AttributeError(f"{type(self).__name__} has no attribute {name!r}{near}")

    __hash__ = object.__hash__

    def __eq__(self, other):
        return self is other


def plot_curve(curve, axes=None, **style):
    """Draws load [N] over extension [mm] of the pulls of a curve, into new axes unless some are given. Returns the axes."""
    if axes is None:
        from matplotlib import pyplot
        axes = pyplot.subplots(layout="constrained")[1]
        axes.set_xlabel("extension [mm]")
        axes.set_ylabel("load [N]")
    pulled = curve[curve["phase"].isin(PULLS)]
    axes.plot(1e3 * pulled["extension"], pulled["load"], **style)
    return axes


def shown(value, unit):
    """With four digits."""
    return "none" if value is None or value != value else f"{value:.4g} {unit}".removesuffix(" -")
