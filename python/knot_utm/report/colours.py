"""Colours of the rod by what is known at its nodes, with one scale for all shapes of a test."""
import numpy as np
from matplotlib.colors import LinearSegmentedColormap, LogNorm, Normalize
from matplotlib.ticker import LogLocator, MaxNLocator

from knot_utm.report.quantities import number, Unit
from knot_utm.report.shapes import ropes

# In the order in which they are offered, with the unit in SI.
UNITS = {"tension": "N", "curvature": "1/m", "twist": "rad/m", "contact_force": "N/m"}


def node_values(shape):
    """Those that are known of a shape, by name."""
    parts = ropes(shape)
    found = {"tension": None if shape.tension is None else np.concatenate(
                 [between_edges(shape.tension[rope.start:rope.stop - 1]) for rope in parts]),
             "curvature": np.concatenate([curvature(shape.points[rope]) for rope in parts]), "twist": shape.twist, "contact_force": shape.contact_force}
    return {name: values for name, values in found.items() if values is not None}


def between_edges(values):
    """Of edges to nodes: the mean of both neighbours."""
    return np.concatenate([values[:1], 0.5 * (values[1:] + values[:-1]), values[-1:]])


def curvature(points):
    """[1/m]: the angle by which the rod turns at a node, over the mean length of its two edges; none at the ends."""
    edges = np.diff(points, axis=0)
    lengths = np.linalg.norm(edges, axis=1)
    tangents = edges / lengths[:, None]
    # Exact at small angles too, where the arc cosine is not.
    angle = 2.0 * np.arctan2(np.linalg.norm(tangents[1:] - tangents[:-1], axis=1),
                             np.linalg.norm(tangents[1:] + tangents[:-1], axis=1))
    return np.concatenate([[0.0], 2.0 * angle / (lengths[1:] + lengths[:-1]), [0.0]])


def names_known(shapes):
    """Those that are known of at least one shape."""
    found = set().union(*(node_values(shape) for shape in shapes))
    return [name for name in UNITS if name in found]


HOT = LinearSegmentedColormap.from_list("hot", ["#ece5d3", "#e8bd6a", "#d9752f", "#b02a30", "#6e1540"])
BOTH_WAYS = LinearSegmentedColormap.from_list("both ways", ["#123a66", "#3f7fb5", "#b8c9d6", "#ece5d3", "#e8bd6a",
                                                            "#d9752f", "#8f1f35"])
LABELS = {"tension": "tension of the rod", "curvature": "curvature times radius", "twist": "twist",
          "contact_force": "contact force per length"}
DECADES = 1e-3  # of contact forces that are told apart
EXTREME = 99.5  # percentile of the values that the colours reach to


class ColourScale:
    """Values in SI to colours. `unit`: in which they are named."""

    def __init__(self, name, norm, colours, unit):
        self.name, self.norm, self.colours, self.unit = name, norm, colours, unit

    def label(self):
        return LABELS[self.name] + (f" [{self.unit.name}]" if self.unit.name else "")

    def places(self, values):
        """0 to 1; what a logarithm has no place for is at 0."""
        least = self.norm.vmin
        return np.clip(self.norm(np.maximum(values, least)).filled(0.0), 0.0, 1.0)

    def of(self, values):
        """Red, green, blue of each, 0 to 1."""
        return self.colours(self.places(values))[:, :3]

    def ticks(self):
        """[(place, text)]"""
        low, high = self.unit.scale * self.norm.vmin, self.unit.scale * self.norm.vmax
        logarithmic = isinstance(self.norm, LogNorm)
        locator = LogLocator(subs=(1.0, 2.0, 5.0) if high < 150.0 * low else (1.0,)) if logarithmic else MaxNLocator(4)
        found = [tick for tick in locator.tick_values(low, high) if low <= tick <= high * (1.0 + 1e-9)]
        return [(float(self.norm(tick / self.unit.scale)), number(float(tick))) for tick in found]


def tension_norm(tensions):
    """Logarithmic: a sliding knot carries a thousandth of a locked one. None where no tension is known."""
    largest = max((float(np.percentile(tension, EXTREME)) for tension in tensions), default=0.0)
    if not largest > 0.0:
        return None
    usual = min(float(np.percentile(tension, 70.0)) for tension in tensions)
    return LogNorm(min(max(0.3 * usual, 1e-4 * largest), 0.1 * largest), largest, clip=True)


def colour_scales(shapes, radius, units):
    """Of all that is known of these shapes and is not the same everywhere."""
    values = {name: [] for name in UNITS}
    for shape in shapes:
        for name, of_nodes in node_values(shape).items():
            values[name].append(of_nodes)
    found = []
    for name, (norm_of, colours) in NORMS.items():
        norm = norm_of(values[name]) if values[name] else None
        if norm is not None:
            found.append(ColourScale(name, norm, colours, unit_of(name, radius, units)))
    return found


def unit_of(name, radius, units):
    return {"tension": units.force, "curvature": Unit("", radius), "twist": Unit("rad/m"),
            "contact_force": units.stiffness}[name]


def extreme(values):
    return max(float(np.percentile(np.abs(one), EXTREME)) for one in values)


def linear_norm(values):
    largest = extreme(values)
    return Normalize(0.0, largest, clip=True) if largest > 0.0 else None


def both_ways_norm(values):
    largest = extreme(values)
    return Normalize(-largest, largest, clip=True) if largest > 0.0 else None


def contact_norm(values):
    largest = extreme(values)
    return LogNorm(DECADES * largest, largest, clip=True) if largest > 0.0 else None


NORMS = {"tension": (tension_norm, HOT), "curvature": (linear_norm, HOT), "twist": (both_ways_norm, BOTH_WAYS),
         "contact_force": (contact_norm, HOT)}
