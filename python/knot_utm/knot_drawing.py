"""Curves in space as the file of a knot: scaled until strands nearly touch, turned along the load axis, their held ends led to the
grips, and drawn through few points. All this moves no strand through another one."""
import numpy as np
from scipy.spatial import cKDTree

from knot_utm.errors import refuse_if, WrongInput

X, UP = np.eye(3)[[0, 2]]
APART = 2.2            # least distance of strands [radii]
ALONG = 1.5 * np.pi    # places nearer along a strand are the same one's [radii]
DENSE = 0.5            # of the points that are measured [radii]
OPENING = 5.0          # from the place where a closed curve is opened to its new ends [radii]
SIGHT = 6.0            # around that place, before which nothing lies, and of such places from each other [radii]
VIEWS = 50             # from which they are looked at
THINNEST = 12          # times the ropes are made thinner by a sixth until they can be opened
TURN = 3.0             # radius of the bend by which a held end turns to its grip [radii]
STRAIGHT = 3.0         # of a held strand, twice, behind it [radii]
LEAD = 10.0            # of an open curve beyond its ends, over its size
DEVIATION = 0.1        # of the drawn curve [radii]
FARTHEST = 199.0       # coordinate of a knot's file [radii]
LONGEST = 3500.0       # rope of a file, twice as long as that of any shipped knot; strands that cross count as tighter [radii]


class TooTight(WrongInput):
    """No rope can be laid along curves as they are."""


def lines_of(curves, lower=(), upper=()):
    """The curves as polylines of the size 1 around the origin, and whether they are closed, which end where they begin then. The longest
    axis becomes z, the next one x; of open ones what is held below lies below, or the first one begins there. Raises WrongInput."""
    closed = curves[0].closed
    refuse_if(any(one.closed != closed for one in curves), "some of its curves are closed and others are not")
    size = np.ptp(np.vstack([one.points for one in curves]), axis=0).max()
    lines = [(np.vstack([one.points, one.points[:1]]) if closed else one.points) / size for one in curves]
    everything = np.vstack([dense(line) for line in lines])
    middle = everything.mean(axis=0)
    lines = [line - middle for line in lines]
    axes = np.linalg.svd(everything - middle, full_matrices=False)[2]
    z, ends = axes[0], ends_of(lines)
    if not closed:
        below, above = held_ends(ends, lower, upper) if lower or upper else (["a1"], ["a2"])
        rise = np.mean([ends[name][0] for name in above], axis=0) - np.mean([ends[name][0] for name in below], axis=0)
        z = z if rise @ z >= 0.0 else -z
    frame = np.array([axes[1], np.cross(z, axes[1]), z])
    return [line @ frame.T for line in lines], closed


def ropes_of(lines, curves):
    """[points] of each rope whose strands are APART, in its radii. Raises TooTight, which names places of the curves."""
    lines = [dense(line) for line in lines]
    radius, near = tightest(lines, curves[0].closed)
    length = sum(map(length_of, lines)) / radius
    if length > LONGEST:
        raise TooTight(f"{places_of(curves, near)}: there its strands come so near to each other, or bend so sharply, that the rope is "
                       f"{length:.0f} radii long, but it must be at most {LONGEST:.0f}")
    return [line / radius for line in lines]


def strands_of(ropes, closed, smaller=1.0):
    """[points] of each strand in radii, along z and around the origin. A closed curve is opened. `smaller`: radius of the rope against
    that by which strands are APART."""
    for thinner in range(THINNEST):
        lines = [resampled(rope * 1.2 ** thinner / smaller, DENSE) for rope in ropes]
        if found := opened(lines) if closed else lines:
            return found
    raise WrongInput("its curves cannot be opened: from nowhere all of them can be seen beside each other")


def places_of(curves, near):
    """What places are called in the file of the curves. `near`: (number of the curve, share of its length) of each."""
    found = []
    for number, share in near:
        one = curves[number]
        along = way_along(np.vstack([one.points, one.points[:1]]) if one.closed else one.points)
        found.append(one.places[int(np.argmin(np.abs(along - share * along[-1]))) % len(one.places)])
    return " and ".join(dict.fromkeys(found))


def closest_ways(p, u, q, v):
    """From the place of each segment from q to q + v that is nearest to the one from p to p + u to that one's, and both places, from
    0 to 1: way, s, t."""
    def dot(a, b):
        return np.einsum("ij,ij->i", a, b)

    w, uu, vv, uv = p - q, dot(u, u), dot(v, v), dot(u, v)
    area = uu * vv - uv * uv
    with np.errstate(divide="ignore", invalid="ignore"):
        s = np.where(area > 1e-12 * uu * vv, np.clip((uv * dot(v, w) - dot(u, w) * vv) / area, 0.0, 1.0), 0.0)
    t = np.clip((uv * s + dot(v, w)) / vv, 0.0, 1.0)
    s = np.clip((uv * t - dot(u, w)) / uu, 0.0, 1.0)
    return w + s[:, None] * u - t[:, None] * v, s, t


def dense(line, count=1500):
    return resampled(line, length_of(line) / max(count, 2 * len(line)))


def way_along(line):
    return np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))])


def length_of(line):
    return way_along(line)[-1]


def resampled(line, spacing):
    along = way_along(line)
    at = np.linspace(0.0, along[-1], max(4, int(np.ceil(along[-1] / spacing)) + 1))
    return np.column_stack([np.interp(at, along, line[:, k]) for k in range(3)])


def tightest(lines, closed):
    """The largest radius of a rope whose strands stay APART: places that are nearer than that are no more than ALONG apart on
    the same strand, so that bends count, too. And the two places that allow no larger one: (number of the line, share of its
    length) of each."""
    lines = [line[::max(1, len(line) * len(lines) // 1200)] for line in lines]
    distance = np.concatenate([np.concatenate([apart(one, other) for other in lines], axis=1) for one in lines])
    along = np.full(distance.shape, np.inf)
    begin = 0
    for line in lines:
        place = way_along(line)
        way = np.abs(place[:, None] - place)
        along[begin:begin + len(line), begin:begin + len(line)] = np.minimum(way, place[-1] - way) if closed else way
        begin += len(line)
    radii = np.geomspace(1e-4, 0.2, 400) * distance.max()
    # The first radius of which a pair lies nearer than APART, but further along than ALONG.
    tight = np.searchsorted(radii, distance / APART, side="right")
    first = np.where(ALONG * np.append(radii, np.inf)[tight] < along, tight, len(radii)).min()
    refuse_if(first == len(radii), "no strand comes near another one: there is no knot")
    nearest = np.unravel_index(np.argmin(np.where(along > ALONG * radii[first], distance, np.inf)), distance.shape)
    shares = [(number, i / (len(line) - 1)) for number, line in enumerate(lines) for i in range(len(line))]
    return radii[first] / 1.02, [shares[i] for i in nearest]  # the radius before


def apart(one, other):
    return np.linalg.norm(one[:, None] - other, axis=2)


def opened(lines):
    """Each closed one at a place before which nothing lies, as seen along x from somewhere, and their ends led out there beside each
    other. None where no such places are found."""
    random, gap = np.random.default_rng(1), round(OPENING / DENSE)
    for view in range(VIEWS if min(map(len, lines)) > 4 * gap else 0):
        turn = np.linalg.qr(random.normal(size=(3, 3)))[0] if view else np.eye(3)
        turned = [line[:-1] @ turn * np.linalg.det(turn) for line in lines]
        everything = np.vstack(turned)
        tree, places = cKDTree(everything[:, 1:]), []
        for line in turned:
            order = np.argsort(-line[:, 0])
            places.append(next((k for k in order if everything[tree.query_ball_point(line[k, 1:], SIGHT), 0].max() < line[k, 0] + 1.0), None))
            if places[-1] is None:
                break
        else:
            if np.diff(np.sort([line[k, 1] for line, k in zip(turned, places)])).min(initial=np.inf) > SIGHT:
                rolled = [np.roll(line, -k, axis=0)[gap:-gap] for line, k in zip(turned, places)]
                return [led_out(line, everything[:, 0].max() + SIGHT) for line in rolled]
    return None


def led_out(line, reach):
    """A line whose ends are led to x = `reach`, that of the first one above."""
    line = line if line[0][2] > line[-1][2] else line[::-1]
    ways = []
    for end, direction in ends_of([line]).values():
        way = [end, *run_out(end, direction, X)[:-2]]
        ways.append(resampled(np.vstack([*way, [reach, *way[-1][1:]]]), DENSE)[1:])
    return np.vstack([ways[0][::-1], line, ways[1]])


def ends_of(strands):
    """{name: (place, outward direction)}: a1 and a2 of the first strand, b1 and b2 of the next one, and so on."""
    found = {}
    for letter, line in zip("abcdefghijklmnopqrstuvwxyz", strands):
        for number, (end, before) in enumerate(((line[0], line[2]), (line[-1], line[-3])), 1):
            found[f"{letter}{number}"] = end, (end - before) / np.linalg.norm(end - before)
    return found


def held_ends(ends, lower, upper):
    """The lowest end is held below and the highest one above, unless others are told."""
    for name in [*lower, *upper]:
        refuse_if(name not in ends, f"no end is called {name}; the ends are {', '.join(ends)}")
    if twice := [name for name in lower if name in upper]:
        raise WrongInput(f"{twice[0]} cannot be held below and above")
    free = [name for name in ends if name not in lower and name not in upper]
    lowest = sorted(free, key=lambda name: ends[name][0][2])
    return list(lower) or lowest[:1], list(upper) or lowest[-1:]


def leads_of(lines, lower, upper):
    """The first and the last point of each open line, far beyond its ends: in the line of a grip, or straight on."""
    ends = ends_of([dense(line) for line in lines])
    lower, upper = held_ends(ends, lower, upper)
    far = [end + LEAD * (UP if name in upper else -UP if name in lower else way) for name, (end, way) in ends.items()]
    return list(zip(far[::2], far[1::2]))


def run_out(end, direction, target):
    """Points behind an end, by a bend and then straight along `target` to its grip."""
    side = target - direction * (target @ direction)
    if np.linalg.norm(side) < 0.3:
        side = X - direction * (X @ direction)
    side /= np.linalg.norm(side)
    angle = np.arctan2(np.linalg.norm(np.cross(direction, target)), direction @ target)
    bend = [end + TURN * (np.sin(a) * direction + (1.0 - np.cos(a)) * side)
            for a in np.linspace(0.0, angle, 2 + int(angle / np.radians(40.0)))[1:]] if angle > np.radians(5.0) else []
    last = bend[-1] if bend else end
    return [*bend, last + STRAIGHT * target, last + 2.0 * STRAIGHT * target]


def drawn_through(line):
    """The fewest evenly spaced points by which the curve of a knot's file stays within DEVIATION of the line."""
    count = max(4, len(line) // 12)
    while count < len(line):
        points = line[np.rint(np.linspace(0, len(line) - 1, count)).astype(int)]
        if cKDTree(through(points)).query(line)[0].max() < DEVIATION:
            return points
        count = int(1.15 * count) + 1
    return line


def through(points, pieces=24):
    """The centripetal Catmull-Rom curve (knot_drawing.hpp)."""
    ends = [2.0 * points[0] - points[1], *points, 2.0 * points[-1] - points[-2]]
    t = np.linspace(0.0, 1.0, pieces)[:, None]
    out = []
    for p in zip(ends, ends[1:], ends[2:], ends[3:]):
        knot = np.concatenate([[0.0], np.cumsum([np.sqrt(np.linalg.norm(b - a)) for a, b in zip(p, p[1:])])])
        u = knot[1] + t * (knot[2] - knot[1])

        def between(a, b, i, j):
            return ((knot[j] - u) * a + (u - knot[i]) * b) / (knot[j] - knot[i])

        a, b, c = (between(p[i], p[i + 1], i, i + 1) for i in range(3))
        out.append(between(between(a, b, 0, 2), between(b, c, 1, 3), 1, 2))
    return np.vstack(out)


def knot_text(title, source, strands, lower=(), upper=()):
    """The text of a knot's file. Raises WrongInput."""
    ends = ends_of(strands)
    lower, upper = held_ends(ends, lower, upper)
    entries = []
    for letter, line in zip("abcdefghijklmnopqrstuvwxyz", strands):
        points = list(drawn_through(line))
        for name, place in ((f"{letter}1", 0), (f"{letter}2", 1)):
            target = UP if name in upper else -UP if name in lower else None
            more = [] if target is None else run_out(*ends[name], target)
            points = points + more if place else more[::-1] + points
        if np.abs(points).max() > FARTHEST:
            raise TooTight(f"it is {2.0 * np.abs(points).max():.0f} radii large where its strands lie {APART} radii apart, but must "
                           f"be at most {2.0 * FARTHEST:.0f}")
        rows = "".join(f"      - [{x:.3f}, {y:.3f}, {z:.3f}]\n" for x, y, z in np.add(points, 0.0))
        entries.append(f"  - ends: [{letter}1, {letter}2]\n    points:\n{rows}")
    free = [name for name in ends if name not in lower and name not in upper]
    tie = f"tie:\n  - {{{', '.join(f'{name}: 1' for name in free)}}}\n" if free else ""
    return (f"title: {title}\nsource: {source}\nstrands:\n{''.join(entries)}lower: [{', '.join(lower)}]\n"
            f"upper: [{', '.join(upper)}]\n{tie}")
