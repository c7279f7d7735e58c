"""A rod as a shaded tube in a plane: z of the test to the right, x up, y towards the eye."""
import numpy as np

LIGHT = np.array([-0.35, 0.55, 0.76])  # in the picture's frame: right, up, towards the eye
TILT = np.radians(12.0)                # the eye stands this much above the plane of x and z


def to_picture(points):
    """World (z along the load, x across, y towards the eye) to the picture: right, up, towards the eye."""
    right, up, near = points[:, 2], points[:, 0], points[:, 1]
    return np.column_stack([right, up * np.cos(TILT) - near * np.sin(TILT), up * np.sin(TILT) + near * np.cos(TILT)])


def smooth(points, pieces=4):
    """The quadratic B-spline that has these points for control points: what the contacts see."""
    u = np.linspace(0.0, 1.0, pieces, endpoint=False)[:, None]
    weights = [0.5 * (1.0 - u) ** 2, 0.5 + u - u ** 2, 0.5 * u ** 2]
    segments = [sum(w * points[i + k] for k, w in enumerate(weights)) for i in range(len(points) - 2)]
    return np.vstack([points[0], *segments, points[-1]])


class Tube:
    """Quadrilaterals around a line, those that face the eye, the farthest first. `along`: where each lies along the
    line, 0 to 1."""

    def __init__(self, line, radius, facets=24):
        quads, normals, along = surface(line, radius, facets)
        facing = normals[:, 2] > -0.05
        order = np.argsort(quads[facing][:, :, 2].mean(axis=1))
        self.outlines = quads[facing][order][:, :, :2]
        self.depth = quads[facing][order][:, :, 2].mean(axis=1)
        self.normals = normals[facing][order]
        self.along = along[facing][order]

    def shaded(self, base):
        """Colours under the light, of a colour each."""
        light = LIGHT / np.linalg.norm(LIGHT)
        half = light + [0.0, 0.0, 1.0]
        diffuse = np.clip(self.normals @ light, 0.0, 1.0)[:, None]
        shine = np.clip(self.normals @ (half / np.linalg.norm(half)), 0.0, 1.0)[:, None] ** 30
        return np.clip(base * (0.30 + 0.75 * diffuse) + 0.35 * shine, 0.0, 1.0)


def surface(line, radius, facets):
    """Quadrilaterals, outward normals, and where each lies along the line; by parallel transport along it."""
    tangent = np.gradient(line, axis=0)
    tangent /= np.linalg.norm(tangent, axis=1)[:, None]
    side = np.cross(tangent[0], np.eye(3)[np.argmin(np.abs(tangent[0]))])
    sides = []
    for t in tangent:
        side = side - side.dot(t) * t
        side /= np.linalg.norm(side)
        sides.append(side)
    sides = np.array(sides)
    others = np.cross(tangent, sides)
    angle = np.linspace(0.0, 2.0 * np.pi, facets + 1)[:, None, None]
    normals = np.cos(angle) * sides + np.sin(angle) * others
    rings = line + radius * normals
    # Around first, then along; the last two are the end faces, as fans.
    quads = np.stack([rings[:-1, :-1], rings[1:, :-1], rings[1:, 1:], rings[:-1, 1:]], axis=2).reshape(-1, 4, 3)
    middle = (normals[:-1, :-1] + normals[1:, 1:]).reshape(-1, 3)
    for end, out in ((0, -tangent[0]), (-1, tangent[-1])):
        centre = np.broadcast_to(line[end], (facets, 3))
        face = np.stack([centre, rings[:-1, end], rings[1:, end], centre], axis=1)
        quads, middle = np.vstack([quads, face]), np.vstack([middle, np.broadcast_to(out, (facets, 3))])
    along = np.concatenate([np.tile(np.linspace(0.0, 1.0, len(line) - 1), facets), np.repeat([0.0, 1.0], facets)])
    return quads, middle / np.linalg.norm(middle, axis=1)[:, None], along
