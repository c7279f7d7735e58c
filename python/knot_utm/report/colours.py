"""Colours of the rod by what is known at its nodes, with one scale for all shapes of a test."""
import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LinearSegmentedColormap, LogNorm, Normalize
from matplotlib.ticker import LogLocator, MaxNLocator

from knot_utm.report.quantities import number, Unit
from knot_utm.report.shapes import ropes
from knot_utm.report.style import GREY

# In the order in which they are offered, with their labels.
LABELS = {"tension": "tension of the rod", "curvature": "curvature times radius", "twist": "twist",
          "contact_force": "contact force per length"}
HOT = LinearSegmentedColormap.from_list("hot", ["#ece5d3", "#e8bd6a", "#d9752f", "#b02a30", "#6e1540"])
BOTH_WAYS = LinearSegmentedColormap.from_list("both ways", ["#123a66", "#3f7fb5", "#b8c9d6", "#ece5d3", "#e8bd6a",
                                                            "#d9752f", "#8f1f35"])
DECADES = 1e-3  # of contact forces that are told apart
EXTREME = 99.5  # percentile of the values that the colours reach to


def node_values(shape):
    """The values that are known of a shape, by name."""
    parts = ropes(shape)
    tension = None
    if shape.tension is not None:  # at a node it is the mean of both edges
        edges = [shape.tension[rope.start:rope.stop - 1] for rope in parts]
        tension = np.concatenate([0.5 * (np.append(one[:1], one) + np.append(one, one[-1:])) for one in edges])
    found = {"tension": tension, "curvature": np.concatenate([curvature(shape.points[rope]) for rope in parts]), "twist": shape.twist,
             "contact_force": shape.contact_force}
    return {name: values for name, values in found.items() if values is not None}


def curvature(points):
    """[1/m]: the angle by which the rod turns at a node, over the mean length of its two edges; none at the ends."""
    edges = np.diff(points, axis=0)
    lengths = np.linalg.norm(edges, axis=1)
    tangents = edges / lengths[:, None]
    # Exact at small angles too, where the arc cosine is not.
    angle = 2.0 * np.arctan2(np.linalg.norm(tangents[1:] - tangents[:-1], axis=1),
                             np.linalg.norm(tangents[1:] + tangents[:-1], axis=1))
    return np.concatenate([[0.0], 2.0 * angle / (lengths[1:] + lengths[:-1]), [0.0]])


class ColourScale:
    """Values in SI to colours. `unit`: in which they are named."""

    def __init__(self, name, low, high, unit, logarithmic=False):
        self.name, self.unit, self.colours = name, unit, BOTH_WAYS if low < 0.0 else HOT
        self.norm = (LogNorm if logarithmic else Normalize)(low, high, clip=True)

    def label(self):
        return LABELS[self.name] + (f" [{self.unit.name}]" if self.unit.name else "")

    def places(self, values):
        """0 to 1; what a logarithm has no place for is at 0."""
        return np.clip(self.norm(np.maximum(values, self.norm.vmin)).filled(0.0), 0.0, 1.0)

    def of(self, values):
        """Red, green, blue of each, 0 to 1."""
        return self.colours(self.places(values))[:, :3]

    def ticks(self):
        """[(place, text)]"""
        low, high = self.unit.scale * self.norm.vmin, self.unit.scale * self.norm.vmax
        locator = MaxNLocator(4)
        if isinstance(self.norm, LogNorm):
            locator = LogLocator(subs=(1.0, 2.0, 5.0) if high < 150.0 * low else (1.0,))
        found = [tick for tick in locator.tick_values(low, high) if low <= tick <= high * (1.0 + 1e-9)]
        return [(float(self.norm(tick / self.unit.scale)), number(float(tick))) for tick in found]

    def draw(self, axes, letters):
        """The colours with what they mean, as axes that lie. `letters`: their size [pt]."""
        bar = axes.figure.colorbar(ScalarMappable(self.norm, self.colours), cax=axes, orientation="horizontal",
                                   extend="min" if isinstance(self.norm, LogNorm) else "neither")
        bar.set_ticks([self.norm.inverse(place) for place, _ in self.ticks()], labels=[text for _, text in self.ticks()])
        bar.ax.minorticks_off()
        bar.ax.tick_params(labelsize=letters)
        bar.set_label(self.label(), fontsize=letters)
        bar.outline.set_edgecolor(GREY)


def colour_scales(shapes, radius, units):
    """{name: scale} of all that is known of these shapes and is not zero everywhere."""
    of_shapes, found = [node_values(shape) for shape in shapes], {}
    named = {"tension": units.force, "curvature": Unit("", radius), "twist": Unit("rad/m"), "contact_force": units.stiffness}
    for name, unit in named.items():
        values = [values[name] for values in of_shapes if name in values]
        largest = max((float(np.percentile(np.abs(one), EXTREME)) for one in values), default=0.0)
        if not largest > 0.0:
            continue
        low = {"curvature": 0.0, "twist": -largest, "contact_force": DECADES * largest}.get(name)
        if name == "tension":  # a sliding knot carries a thousandth of a locked one
            usual = min(float(np.percentile(tension, 70.0)) for tension in values)
            low = min(max(0.3 * usual, 1e-4 * largest), 0.1 * largest)
        found[name] = ColourScale(name, low, largest, unit, name in ("tension", "contact_force"))
    return found
