"""Curves with corners, or whose strands nearly touch, as loose curves that a thick rope can follow. They stay the knots that they
were: in a step no point moves by as much as a third of its distance from other strands, so that nothing passes through anything."""
import numpy as np

from knot_utm.errors import WrongInput
from knot_utm.knot_drawing import closest_ways, length_of

NODES = 160      # at least, of all curves
MOST_NODES = 1200
STEPS = 300
NEAR = 4         # segments nearer than that along a curve do not push each other
SAFE = 0.3       # part of the distance to others by which a node may move in a step
CROSSED = 1e-6   # distance of strands that is none, of the size


def thickened(curves, lines, leads=None):
    """The lines of the curves, drawn loosely: lowers the sum of ℓ² of all edges and of 1/d⁴ of all pairs of segments that are d
    apart. `leads`: the far ends of what goes on behind both ends of each open line; they and the ends stand still.
    None where there are too many points. Raises WrongInput."""
    x, begins, names = divided(curves, lines, leads)
    if len(x) > MOST_NODES:
        return None
    last = np.arange(1, len(x) + 1)
    last[begins[1:] - 1] = begins[:-1]
    first = np.setdiff1d(np.arange(len(x)), begins[1:] - 1 if leads else [])
    last = last[first]
    stands = np.isin(np.arange(len(x)), np.concatenate([begins[:-1], begins[:-1] + 1, begins[1:] - 2, begins[1:] - 1]) if leads else [])
    inner = ~(stands[first] & stands[last])
    i, j = np.triu_indices(len(first), 1)
    apart = (first[i] != last[j]) & (last[i] != first[j]) & (inner[i] | inner[j])
    i, j = i[apart], j[apart]
    curve = np.searchsorted(begins, first, side="right")
    along, around = first[j] - first[i], np.diff(begins)[curve[i] - 1]
    pushed = (curve[i] != curve[j]) | (np.minimum(along, along if leads else around - along) >= NEAR)
    for step in range(STEPS):
        edges = x[last] - x[first]
        way, s, t = closest_ways(x[first[i]], edges[i], x[first[j]], edges[j])
        distance = np.linalg.norm(way, axis=1)
        if step == 0 and distance.min() < CROSSED:
            at = [names[first[k[(distance < CROSSED).argmax()]]] for k in (i, j)]
            raise WrongInput(f"{' and '.join(dict.fromkeys(at))}: there it crosses itself or turns back")
        # Of the size where both sums together are least.
        size = (2.0 * (distance[pushed] ** -4.0).sum() / (edges[inner] ** 2).sum()) ** (1.0 / 6.0)
        x, edges, way, distance = size * x, size * edges, size * way, size * distance
        push = 4.0 * (pushed / distance ** 6.0)[:, None] * way
        move, room, nearest = np.zeros_like(x), np.full(len(x), np.inf), np.full((len(first), len(first)), np.inf)
        for nodes, forces in ((first, 2.0 * edges), (last, -2.0 * edges), (first[i], (1.0 - s)[:, None] * push),
                              (last[i], s[:, None] * push), (first[j], (t - 1.0)[:, None] * push), (last[j], -t[:, None] * push)):
            move += np.column_stack([np.bincount(nodes, forces[:, k], len(x)) for k in range(3)])
        move[stands] = 0.0
        nearest[i, j] = nearest[j, i] = distance
        for nodes in (first, last):
            np.minimum.at(room, nodes, nearest.min(axis=0))
        x = x + min(0.1, SAFE * np.divide(room, np.linalg.norm(move, axis=1), where=~stands, out=np.ones(len(x))).min()) * move
    found = [x[begin:end] for begin, end in zip(begins, begins[1:])]
    return [line[1:-1] if leads else np.vstack([line, line[:1]]) for line in found]


def divided(curves, lines, leads):
    """Nodes on all lines and at the far ends of their leads, where those of each line begin, and what their places are called."""
    spacing = sum(map(length_of, lines)) / np.clip(3 * sum(map(len, lines)), NODES, 2 * NODES)
    parts, names = [], []
    for one, line, lead in zip(curves, lines, leads or lines):
        edges = np.diff(line, axis=0)
        counts = np.maximum(1, np.ceil(np.linalg.norm(edges, axis=1) / spacing).astype(int))
        nodes = [start + edge * k / count for start, edge, count in zip(line, edges, counts) for k in range(count)]
        places = list(np.repeat(one.places[:len(counts)], counts))
        parts.append(np.array([lead[0], *nodes, line[-1], lead[1]] if leads else nodes))
        names += [places[0], *places, *one.places[-1:] * 2] if leads else places
    return np.vstack(parts), np.cumsum([0, *map(len, parts)]), names
