"""The rod as a tube: the one mesh from which pictures, movies and files for other programs are made. (A browser makes its tubes
itself, turnable.js: those of all shapes would be too many bytes for a page.)"""
import numpy as np

SIDES = 16
LIGHT = np.array([-0.35, 0.55, 0.76]) / np.linalg.norm([-0.35, 0.55, 0.76])  # in the picture's frame: right, up, towards the eye
TILT = np.radians(12.0)                # the eye stands this much above the plane of x and z
LENGTH, TURN = 1.5, np.radians(6.0)    # of a face: how long it is at most [radii], and by how much the line turns along it


class Mesh:
    """`points`; at each the outward `normals`, and `along`, its place on the line as a number of the line's points. `quads`: four
    points each, in the order in which the face is seen from outside; of a triangle the first is the last, too."""

    def __init__(self, points, normals, along, quads):
        self.points, self.normals, self.along, self.quads = points, normals, along, quads

    def triangles(self):
        halves = np.concatenate([self.quads[:, [0, 1, 2]], self.quads[:, [0, 2, 3]]])
        return halves[(halves[:, 0] != halves[:, 1]) & (halves[:, 0] != halves[:, 2])]


def tube(line, radius, sides=SIDES):
    """Around a line of points; its sides do not spin along it. Flat faces, with points of their own, close its ends."""
    count = len(line)
    tangent = np.gradient(line, axis=0)
    tangent /= np.linalg.norm(tangent, axis=1)[:, None]
    side, across = np.cross(tangent[0], np.eye(3)[np.argmin(np.abs(tangent[0]))]), []
    for direction in tangent:
        side = side - side.dot(direction) * direction
        side /= np.linalg.norm(side)
        across.append(side)
    across = np.array(across)
    angle = np.linspace(0.0, 2.0 * np.pi, sides, endpoint=False)[:, None]
    out = np.cos(angle) * across[:, None] + np.sin(angle) * np.cross(tangent, across)[:, None]
    rings = line[:, None] + radius * out
    points = np.concatenate([rings.reshape(-1, 3), rings[0], rings[-1]])
    normals = np.concatenate([out.reshape(-1, 3), np.repeat([-tangent[0], tangent[-1]], sides, axis=0)])
    along = np.concatenate([np.repeat(np.arange(count), sides), np.repeat([0, count - 1], sides)])
    here = np.arange(sides)
    there = (here + 1) % sides
    around = np.stack([here, there, sides + there, sides + here], axis=1)
    first, last = sides * count, sides * (count + 1)
    fan = np.stack([0 * here, here, there, 0 * here], axis=1)[1:-1]
    quads = np.concatenate([*(around + sides * i for i in range(count - 1)), first + fan[:, ::-1], last + fan])
    return Mesh(points, normals, along.astype(float), quads)


def rod_mesh(points, pieces, radii):
    """One mesh around all pieces, slices of the nodes. `along` is the number of the node."""
    meshes = [tube(points[piece], radius) for piece, radius in zip(pieces, radii)]
    before = np.cumsum([0, *(len(mesh.points) for mesh in meshes)])
    return Mesh(*(np.concatenate([getattr(mesh, name) for mesh in meshes]) for name in ("points", "normals")),
                np.concatenate([mesh.along + piece.start for mesh, piece in zip(meshes, pieces)]),
                np.concatenate([mesh.quads + begin for mesh, begin in zip(meshes, before)]))


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


def enough_points(line, radius):
    """Numbers of those points of a line, its ends among them, between which a tube of flat faces looks round."""
    edges = np.diff(line, axis=0)
    lengths = np.linalg.norm(edges, axis=1)
    turns = np.linalg.norm(np.diff(edges / lengths[:, None], axis=0, prepend=edges[:1] / lengths[0]), axis=1)
    faces = np.cumsum([0.0, *np.maximum(lengths / (LENGTH * radius), turns / TURN)])
    return np.unique([*np.searchsorted(faces, np.arange(faces[-1])), len(line) - 1])


def seen(points, radius, colours_at):
    """The faces of a tube around nodes that face the eye, under a light: outlines in the picture, depths, and colours. `colours_at`:
    of places along the nodes, 0 to 1."""
    line = smooth(to_picture(points))
    kept = enough_points(line, radius)
    mesh = tube(line[kept], radius)
    normals = mesh.normals[mesh.quads].mean(axis=1)
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    facing = normals[:, 2] > -0.05
    normals, quads = normals[facing], mesh.quads[facing]
    half = LIGHT + [0.0, 0.0, 1.0]
    diffuse = np.clip(normals @ LIGHT, 0.0, 1.0)[:, None]
    shine = np.clip(normals @ (half / np.linalg.norm(half)), 0.0, 1.0)[:, None] ** 30
    base = colours_at(kept[mesh.along.astype(int)][quads].mean(axis=1) / (len(line) - 1))
    corners = mesh.points[quads]
    return corners[:, :, :2], corners[:, :, 2].mean(axis=1), np.clip(base * (0.30 + 0.75 * diffuse) + 0.35 * shine, 0.0, 1.0)
