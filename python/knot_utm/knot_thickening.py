"""Curves with corners, or whose strands nearly touch, as loose curves that a thick rope can follow. They stay the knots that they
were: in a step no point moves by as much as a third of its distance from other strands, so that nothing passes through anything."""
import numpy as np

from knot_utm.errors import WrongInput
from knot_utm.knot_drawing import closest_ways, length_of, TooTight

NODES = 200      # at least, of all curves
MOST_NODES = 1200
STEPS = 200
NEAR = 4         # segments nearer than that along a curve do not push each other
SAFE = 0.3       # part of the distance to others by which a node may move in a step
CROSSED = 1e-6   # distance of strands that is none, of the size


def thickened(curves, lines, leads=None):
    """The lines of the curves, drawn loosely: minimises the sum of ℓ² of all edges and of 1/d⁴ of all pairs of segments that are d
    apart. `leads`: the ways on from both ends of each open line, which stand still. Raises WrongInput."""
    x, begins, names = divided(curves, lines, leads)
    first = np.setdiff1d(np.arange(len(x)), begins[1:] - 1 if leads else [])
    last, led, free = first + 1, np.zeros(len(first), dtype=bool), first
    if leads:
        led = np.isin(first, begins[:-1]) | np.isin(last, begins[1:] - 1)
        free = np.setdiff1d(first, np.concatenate([first[led], last[led]]))
    else:
        last[begins[1:] - 1] = begins[:-1]
    i, j, pushed = pairs(first, last, begins, closed=not leads)
    stiffness, soft = softness(first, last, free)
    for step in range(STEPS):
        edges = x[last] - x[first]
        way, s, t = closest_ways(x[first[i]], edges[i], x[first[j]], edges[j])
        distance = np.linalg.norm(way, axis=1)
        if step == 0 and distance.min() < CROSSED:
            at = [names[first[k[distance.argmin()]]] for k in (i, j)]
            raise WrongInput(f"{' and '.join(dict.fromkeys(at))}: there it crosses itself or turns back")
        # Of the size where both sums together are least.
        size = (2.0 * (distance[pushed] ** -4.0).sum() / (edges[~led] ** 2).sum()) ** (1.0 / 6.0)
        x, way, distance = size * x, size * way, size * distance
        push = 4.0 * (pushed / distance ** 6.0)[:, None] * way
        force = -2.0 * stiffness @ x
        for nodes, part in ((first[i], 1.0 - s), (last[i], s), (first[j], t - 1.0), (last[j], -t)):
            force += np.column_stack([np.bincount(nodes, part * push[:, k], len(x)) for k in range(3)])
        nearest, room = np.full((len(first), len(first)), np.inf), np.full(len(x), np.inf)
        nearest[i, j] = nearest[j, i] = distance
        for nodes in (first, last):
            np.minimum.at(room, nodes, nearest.min(axis=0))
        move = soft @ force[free]
        x[free] += min(0.1, SAFE * (room[free] / np.linalg.norm(move, axis=1)).min()) * move
    found = [x[begin:end] for begin, end in zip(begins, begins[1:])]
    return [line[1:-1] if leads else np.vstack([line, line[:1]]) for line in found]


def divided(curves, lines, leads):
    """Nodes on all lines and at the far ends of their leads, where those of each line begin, and what their places are called."""
    spacing = sum(map(length_of, lines)) / np.clip(3 * sum(map(len, lines)), NODES, 2 * NODES)
    parts, names = [], []
    for number, (one, line) in enumerate(zip(curves, lines)):
        edges = np.diff(line, axis=0)
        counts = np.maximum(1, np.ceil(np.linalg.norm(edges, axis=1) / spacing).astype(int))
        nodes = [start + edge * k / count for start, edge, count in zip(line, edges, counts) for k in range(count)]
        before, behind = ([leads[number][0]], [line[-1], leads[number][1]]) if leads else ([], [])
        parts.append(np.array([*before, *nodes, *behind]))
        names += len(before) * one.places[:1] + list(np.repeat(one.places[:len(counts)], counts)) + len(behind) * one.places[-1:]
    if len(names) > MOST_NODES:
        raise TooTight("it has too many points to be drawn loosely")
    return np.vstack(parts), np.cumsum([0, *map(len, parts)]), names


def pairs(first, last, begins, closed):
    """Numbers of all pairs of segments that share no node, and which of them push each other."""
    i, j = np.triu_indices(len(first), 1)
    apart = (first[i] != last[j]) & (last[i] != first[j])
    i, j = i[apart], j[apart]
    curve = np.searchsorted(begins, first, side="right") - 1
    along, around = first[j] - first[i], np.diff(begins)[curve[i]]
    return i, j, (curve[i] != curve[j]) | ((np.minimum(along, around - along) if closed else along) >= NEAR)


def softness(first, last, free):
    """The stiffness of the edges, and the inverse of its root, which makes of forces on free nodes moves that bend a curve smoothly."""
    stiffness = np.zeros(2 * [last.max() + 1])
    for one, other in ((first, last), (last, first)):
        np.add.at(stiffness, (one, one), 1.0)
        stiffness[one, other] = -1.0
    value, vector = np.linalg.eigh(stiffness[np.ix_(free, free)])
    return stiffness, 2.0 * vector / np.sqrt(np.maximum(value, 40.0 / len(free) ** 2)) @ vector.T
