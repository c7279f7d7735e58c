"""The rod at the marked points: a tube coloured by its tension."""
import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.colors import to_rgb
from matplotlib.patches import Circle

from knot_utm.report.colours import colour_scales, node_values
from knot_utm.report.method_facts import drawing_of, post_diameter
from knot_utm.report.quantities import with_unit
from knot_utm.report.shapes import lengths, ropes
from knot_utm.report.style import HUB, INK, new_figure, ROLLER, SMALL, USUAL, WIDTH
from knot_utm.report.tube import seen, to_picture

UNKNOWN = to_rgb("#9fb3c4")
NEAR = 2.6      # strands whose centrelines are nearer than this many radii touch, or nearly so
MARGIN = 4.0    # around what is shown [radii]
LONGEST = 7.0   # a picture wider than this many of its heights shows the knot alone
HIGHEST = 0.8   # a picture, of its width
FROM_ITS_END = 0.99  # a post whose axis runs to the eye within 8 degrees: cosine
NAME = 0.24     # of a name above its picture [in]


def pictures(run, marks, shapes):
    """All of them in one figure, one below the other, with one scale of colours."""
    scale = colour_scales(shapes, run.method["material"]["radius"], run.units).get("tension")
    boxes = [view(run, shape, run.thickest()) for shape in shapes]
    # The widest has room, and none is too high.
    width = max(max(right - left, (top - bottom) / HIGHEST) for left, right, bottom, top in boxes)
    heights = [WIDTH * (top - bottom) / width + NAME for _, _, bottom, top in boxes]
    figure = new_figure(WIDTH, sum(heights) + (0.75 if scale else 0.1))
    grid = figure.add_gridspec(len(boxes) + 1, 1, height_ratios=[*heights, 0.75 if scale else 0.1], left=0.0, right=1.0,
                               bottom=0.0, top=1.0, hspace=0.0)
    for row, (mark, shape, box, height) in enumerate(zip(marks, shapes, boxes, heights)):
        axes = figure.add_subplot(grid[row])
        middle, half = (0.5 * (box[0] + box[1]), 0.5 * (box[2] + box[3]) + 0.5 * NAME * width / WIDTH), (0.5 * width, 0.5 * width * height / WIDTH)
        draw_rod(axes, run, shape, by_scale(scale, shape),
                 (middle[0] - half[0], middle[0] + half[0], middle[1] - half[1], middle[1] + half[1]))
        label(axes, mark, shape, run)
    if scale:
        axes = figure.add_subplot(grid[len(boxes)])
        axes.axis("off")
        scale.draw(axes.inset_axes([0.25, 0.62, 0.5, 0.16]), SMALL)
    return figure


def by_scale(scale, shape):
    """Colours at places along the rod, as numbers of nodes, where the values of a shape are known."""
    values = node_values(shape).get(scale.name) if scale else None
    if values is None:
        return lambda node: np.tile(UNKNOWN, (len(node), 1))
    return lambda node: scale.of(np.interp(node, np.arange(len(values)), values))


def draw_rod(axes, run, shape, colours_at, box):
    """Tubes around the ropes, with what holds them. `colours_at`: of places along them, as numbers of nodes; `box`: left, right, bottom,
    top [mm]."""
    radii = run.radii(shape)
    tubes = [seen(shape.points[rope], radius, lambda along, rope=rope: colours_at(rope.start + along * (rope.stop - 1 - rope.start)))
             for rope, radius in zip(ropes(shape), radii)]
    outlines, depth, colours = (np.concatenate(of_all) for of_all in zip(*tubes))
    # What is farther from the eye is paler.
    away = (depth.max() - depth) / max(np.ptp(depth), 4.0 * max(radii))
    order = np.argsort(depth, kind="stable")
    colours = (colours + 0.35 * away[:, None] * (0.93 - colours))[order]
    axes.add_collection(PolyCollection(1e3 * outlines[order], facecolors=colours, edgecolors=colours, linewidths=0.25, zorder=2), autolim=False)
    for z, x, radius in rollers(run, shape):
        axes.add_patch(Circle((z, x), radius, facecolor=ROLLER, edgecolor=HUB, lw=0.8, zorder=1))
        axes.add_patch(Circle((z, x), 0.15 * radius, facecolor=HUB, edgecolor="none", zorder=1))
    axes.set(xlim=box[:2], ylim=box[2:], aspect="equal")
    axes.axis("off")


def rollers(run, shape):
    """[(place along the load axis, place across, radius)] [mm], and so of posts that stand for a grip or beside such a one."""
    post = post_diameter(run.method)
    if post is not None:
        return [(0.0, 0.0, 0.5e3 * post)]
    apart = 1e3 * float(np.interp(shape.time, run.curve["time"], run.curve["end_to_end"]))
    if run.method["machine"]["grips"] == "rollers":
        radius = 0.5e3 * run.method["machine"]["roller_diameter"]
        return [(z, 0.0, radius) for z in (0.0, apart)]
    drawing = drawing_of(run.method, run.folder)
    return [post for grip, z in (("lower", 0.0), ("upper", apart)) if not drawing.get(grip)
            for post in posts_of(drawing, grip, z, 1e3 * run.thickest())]


def posts_of(drawing, grip, place, radius):
    """The posts of a grip that are seen from their end, and the sections of rings whose holes are seen from the side. The first one is
    the grip, at a place along the load axis; radius of the rod."""
    posts = [post for post in drawing.get("posts") or [] if post.get("grip", "lower") == grip]
    found = []
    for post in posts:
        x, y, z = np.array(post["along"]) / np.linalg.norm(post["along"])
        if "ring" not in post and abs(y) > FROM_ITS_END:
            shifts = [(0.0, 0.0)]
        elif "ring" in post and abs(y) < 1.0 - FROM_ITS_END:
            shifts = [(side * post["ring"] * x, -side * post["ring"] * z) for side in (1.0, -1.0)]
        else:
            continue
        found += [(float(place + radius * (post["through"][2] - posts[0]["through"][2] + up)),
                   float(radius * (post["through"][0] + across)), radius * post["radius"]) for up, across in shifts]
    return found


def view(run, shape, radius):
    """Left, right, bottom, top [mm] of what is shown: rod and rollers, or the knot alone where it would be too small."""
    shown = to_picture(shape.points)
    ends = [[1e-3 * (z + side * r), 1e-3 * (x + side * r)] for z, x, r in rollers(run, shape) for side in (-1.0, 1.0)]
    whole = box_around(np.vstack([shown[:, :2], *ends]), radius)
    knot = touching(shape, radius) if whole[1] - whole[0] > 1.6 * LONGEST * (whole[3] - whole[2]) else np.zeros(1, bool)
    if not knot.any():
        return whole
    left, right, bottom, top = box_around(shown[knot, :2], radius)
    wide, middle = max(right - left, LONGEST * 0.5 * (top - bottom), 60.0 * 1e3 * radius), 0.5 * (left + right)
    inside = np.abs(1e3 * shown[:, 0] - middle) < 0.5 * wide
    return middle - 0.5 * wide, middle + 0.5 * wide, *box_around(shown[inside, :2], radius)[2:]


def box_around(points, radius):
    low, high = 1e3 * (points.min(axis=0) - MARGIN * radius), 1e3 * (points.max(axis=0) + MARGIN * radius)
    return low[0], high[0], low[1], high[1]


def touching(shape, radius):
    """Nodes near another strand: nearer through the air than half as far along the rod."""
    edges = lengths(shape)
    edges[list(shape.cuts)] += 10.0 * NEAR * radius
    along = np.concatenate([[0.0], np.cumsum(edges)])
    near = np.linalg.norm(shape.points[:, None] - shape.points, axis=2) < NEAR * radius
    return (near & (np.abs(along[:, None] - along) > 2.0 * NEAR * radius)).any(axis=1)


def label(axes, mark, shape, run):
    tested = run.curve.tested()  # a zeroing lets the extension jump; before it a shape is where the test begins
    curve = tested if len(tested) else run.curve
    at = float(np.interp(shape.time, curve["time"], curve["extension"]))
    place = {"xy": (0.0, 1.0), "xycoords": "axes fraction", "textcoords": "offset points", "va": "baseline", "color": INK}
    axes.annotate(mark.letter, xytext=(3, -11), fontsize=USUAL + 2.0, weight="bold", **place)
    axes.annotate(f"{mark.title()}: s = {with_unit(at, run.units.length)}", xytext=(16, -11), fontsize=USUAL, **place)
