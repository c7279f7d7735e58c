"""What the rod is coloured by: values at its nodes."""
import numpy as np

# In the order in which they are offered, with the unit in SI.
UNITS = {"tension": "N", "curvature": "1/m", "twist": "rad/m", "contact_force": "N/m"}


def node_values(shape):
    """Those that are known of a shape, by name."""
    found = {"tension": None if shape.tension is None else between_edges(shape.tension),
             "curvature": curvature(shape.points), "twist": shape.twist, "contact_force": shape.contact_force}
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
