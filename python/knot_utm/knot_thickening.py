"""Curves with corners, or whose strands nearly touch, as loose curves that a thick rope can follow. They stay the knots that they
were: in a step no point moves by as much as a third of its distance from other strands, so that nothing passes through anything."""
import numpy as np

from knot_utm.knot_drawing import closest_ways, length_of, TooTight

NODES = 200      # at least, of all curves
MOST_NODES = 1000
STEPS = 200
NEAR = 4         # segments nearer than that along a curve do not push each other
SAFE = 0.3       # part of the distance to others by which a node may move in a step
CROSSED = 1e-6   # distance of strands that is none, of the size


def thickened(lines, closed):
    """The same curves, drawn loosely, of those whose last point is the first one where `closed`. Minimises the sum of ℓ² of all edges
    and 1/d⁴ of all pairs of segments that are d apart; ends of open curves stay where they are. Raises TooTight."""
    spacing = sum(map(length_of, lines)) / max(NODES, 3 * sum(map(len, lines)))
    lines = [divided(line, spacing) for line in lines]
    begins = np.cumsum([0] + [len(line) - closed for line in lines])
    first = np.concatenate([begin + np.arange(len(line) - 1) for begin, line in zip(begins, lines)])
    last = np.concatenate([begin + (np.arange(len(line) - 1) + 1) % (len(line) - closed) for begin, line in zip(begins, lines)])
    x = np.vstack([line[:-1] if closed else line for line in lines])
    if len(x) > MOST_NODES:
        raise TooTight("it has too many points to be drawn loosely")
    ends = [] if closed else [*begins[:-1], *(begins[1:] - 1)]
    free = np.setdiff1d(np.arange(len(x)), ends)
    stiffness, soft = softness(len(x), first, last, free)
    i, j, far = pairs(first, last, begins, closed)
    for step in range(STEPS):
        edges = x[last] - x[first]
        way, s, t = closest_ways(x[first[i]], edges[i], x[first[j]], edges[j])
        distance = np.linalg.norm(way, axis=1)
        if step == 0 and distance.min() < CROSSED:
            raise TooTight("it crosses itself")
        # Of the size where both sums together are least.
        size = (2.0 * (distance[far] ** -4.0).sum() / (edges ** 2).sum()) ** (1.0 / 6.0)
        x, way, distance = size * x, size * way, size * distance
        push = 4.0 * (far / distance ** 6.0)[:, None] * way
        force = -2.0 * stiffness @ x
        for nodes, part in ((first[i], 1.0 - s), (last[i], s), (first[j], t - 1.0), (last[j], -t)):
            force += np.column_stack([np.bincount(nodes, part * push[:, k], len(x)) for k in range(3)])
        move = soft @ force[free]
        nearest, room = np.full((len(first), len(first)), np.inf), np.full(len(x), np.inf)
        nearest[i, j] = nearest[j, i] = distance
        for nodes in (first, last):
            np.minimum.at(room, nodes, nearest.min(axis=0))
        x[free] += min(0.1, SAFE * (room[free] / np.linalg.norm(move, axis=1)).min()) * move
    found = [x[begin:end] for begin, end in zip(begins, begins[1:])]
    return [np.vstack([line, line[:1]]) if closed else line for line in found]


def divided(line, spacing):
    """With more points on its edges, none of which is longer than `spacing` then."""
    edges = np.diff(line, axis=0)
    parts = np.maximum(1, np.ceil(np.linalg.norm(edges, axis=1) / spacing).astype(int))
    return np.vstack([*(p + np.linspace(0.0, 1.0, n, endpoint=False)[:, None] * e for p, e, n in zip(line, edges, parts)), line[-1:]])


def softness(count, first, last, free):
    """The stiffness of the edges, and what makes of forces on free nodes moves that bend a curve smoothly: its root's inverse."""
    stiffness = np.zeros((count, count))
    for one, other in ((first, last), (last, first)):
        np.add.at(stiffness, (one, one), 1.0)
        np.add.at(stiffness, (one, other), -1.0)
    value, vector = np.linalg.eigh(stiffness[np.ix_(free, free)])
    return stiffness, 2.0 * vector / np.sqrt(np.maximum(value, 40.0 / count ** 2)) @ vector.T


def pairs(first, last, begins, closed):
    """Numbers of all pairs of segments that share no node, and which of them push each other."""
    i, j = np.triu_indices(len(first), 1)
    apart = (first[i] != last[j]) & (last[i] != first[j])
    i, j = i[apart], j[apart]
    curve = np.searchsorted(begins, first, side="right") - 1
    along, count = first[j] - first[i], np.diff(begins)[curve[i]]
    return i, j, (curve[i] != curve[j]) | ((np.minimum(along, count - along) if closed else along) >= NEAR)
