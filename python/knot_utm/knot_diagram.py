"""Codes of planar diagrams, as tables of knots have them, as curves in space: PD codes (the four strands of each crossing,
counterclockwise from the lower one that comes in) and Gauss codes (the crossings along each strand, signed where they are told)."""
import itertools
import re

import numpy as np

from knot_utm.errors import refuse_if

MOST_CROSSINGS = 60
MOST_UNSIGNED = 16  # crossings: all their signs are tried


def diagram_in(file, text):
    """The closed polygons of a text that is a code, each point named by its crossing; None of any other text. Raises WrongInput."""
    text = re.sub(r'"[^"]*"|^[^\[{(]*(?=[\[{(])', "", text)  # names
    crossings = planar(text) or gauss(file, text)
    if not crossings:
        return None
    refuse_if(len(crossings) > MOST_CROSSINGS, f"{file}: it has {len(crossings)} crossings, but may have at most {MOST_CROSSINGS}")
    refuse_if(not is_plane(crossings), f"{file}: it is the code of no diagram in a plane, or of one in several parts")
    return polygons(crossings)


def planar(text):
    """[strands of each crossing] of a PD code; None of another text."""
    numbers = [int(word) for word in re.findall(r"\d+", text)]
    if not numbers or len(numbers) % 4 or re.search("[-+]", text) or sorted(numbers) != sorted(2 * list(set(numbers))):
        return None
    return np.reshape(numbers, (-1, 4)).tolist()


def gauss(file, text):
    """The same of a Gauss code: of whole numbers, negative where the strand lies below, and perhaps the crossings' signs behind them
    (Sage); of 1+c with the sign c or a (pyknotid); or of O1+ with the sign + or -."""
    signs, walks = {}, []
    for group in re.findall(r"[\[{(]([^\[\]{}()]+)[\]})]", text) or re.split(r"\s*[\n/]\s*", re.sub(r",\s+", ",", text)):
        visits = re.findall(r"([OU]?)(\d+)([+-])([ca]?)", group)
        walk = [(int(name), (level or mark) in "O+") for level, name, mark, _ in visits]
        walk = walk or [(abs(int(word)), int(word) > 0) for word in re.findall(r"-?\d+", group)]
        signs.update((int(name), (turn or mark) in "c+") for level, name, mark, turn in visits if level or turn)
        if {name for name, _ in walk} == {1} and 2 * len(walk) == sum(map(len, walks)):
            signs = dict(enumerate((positive for _, positive in walk), 1))
        elif walk:
            walks.append(walk)
    names = sorted({name for walk in walks for name, _ in walk})
    if not names or sorted(itertools.chain(*walks)) != sorted(itertools.product(names, (False, True))):
        return None
    if names == sorted(signs):
        return signed(walks, [signs[name] for name in names])
    refuse_if(len(names) > MOST_UNSIGNED, f"{file}: a Gauss code of more than {MOST_UNSIGNED} crossings must tell their signs")
    found = (signed(walks, each) for each in itertools.product((True, False), repeat=len(names)))
    return next(filter(is_plane, found), signed(walks, [True] * len(names)))


def signed(walks, signs):
    """A PD code of a Gauss code. `signs`: of the crossings in the order of their names, True where positive."""
    strands, first = {}, 0
    for walk in walks:
        for k, visit in enumerate(walk):
            strands[visit] = first + k, first + (k + 1) % len(walk)  # that come in and go out
        first += len(walk)
    found = []
    for name, sign in zip(sorted({name for name, _ in strands}), signs):
        (below_in, below_out), over = strands[name, False], strands[name, True]
        found.append([below_in, over[sign], below_out, over[not sign]])
    return found


def ends_of_strands(crossings):
    """{(crossing, place around it): the one at the other end of its strand}."""
    where = {}
    for dart in itertools.product(range(len(crossings)), range(4)):
        where.setdefault(crossings[dart[0]][dart[1]], []).append(dart)
    return {one: other for pair in where.values() for one, other in (pair, pair[::-1])}


def walks_over(crossings, turn):
    """[places by which it leaves crossings] of all walks along strands: by `turn` 2 straight on, by -1 around a face to the left."""
    other, left, found = ends_of_strands(crossings), set(itertools.product(range(len(crossings)), range(4))), []
    while left:
        dart, walk = min(left), []
        while dart in left:
            left.remove(dart)
            walk.append(dart)
            dart = other[dart][0], (other[dart][1] + turn) % 4
        found.append(walk)
    return found


def is_plane(crossings):
    return len(walks_over(crossings, -1)) == len(crossings) + 2


def polygons(crossings):
    other, places = ends_of_strands(crossings), in_plane(crossings)
    height = 0.5 * min(np.linalg.norm(places[dart] - places[end]) for dart, end in other.items())
    found = []
    for walk in walks_over(crossings, 2):
        if min(walk) < min(other[dart] for dart in walk):  # one way of two
            points = [point for dart in walk for point in ([*places[dart[0]], height if dart[1] % 2 else -height],
                                                           [*places[dart], 0.0], [*places[other[dart]], 0.0])]
            found.append((np.array(points), [f"crossing {crossing + 1}" for crossing, _ in walk for _ in range(3)]))
    return found


def in_plane(crossings):
    """{crossing or place around it: where it is drawn}: the middle of its neighbours in a net of triangles that has a ring within each
    face, so that no two edges meet (Tutte 1963)."""
    other, faces = ends_of_strands(crossings), sorted(walks_over(crossings, -1), key=len)
    edges = [(dart[0], dart) for dart in other] + [pair for pair in other.items() if pair[0] < pair[1]]
    for number, face in enumerate(faces):
        border = [node for dart in face for node in (dart[0], dart, other[dart])]
        ring = [("ring", number, k) for k in range(len(border))]
        for k, node in enumerate(ring):
            edges += [(node, border[k]), (node, border[k - 1]), (node, ring[k - 1])] + [(node, ("face", number))] * (face != faces[-1])
    number = {node: k for k, node in enumerate(dict.fromkeys(node for edge in edges for node in edge))}
    one, two = np.array([[number[node] for node in edge] for edge in edges]).T
    outer, angle = [number[node] for node in ring], -2.0 * np.pi * np.arange(len(ring)) / len(ring)
    inner = np.setdiff1d(np.arange(len(number)), outer)
    net, places = np.zeros((len(number), len(number))), np.zeros((len(number), 2))
    for row, column, weight in ((one, one, 1.0), (two, two, 1.0), (one, two, -1.0), (two, one, -1.0)):
        np.add.at(net, (row, column), weight)
    places[outer] = np.column_stack([np.cos(angle), np.sin(angle)])
    places[inner] = np.linalg.solve(net[np.ix_(inner, inner)], -net[np.ix_(inner, outer)] @ places[outer])
    return {node: places[k] for node, k in number.items()}
