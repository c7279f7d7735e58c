"""The rod at the marked points: a tube coloured by its tension."""
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.collections import PathCollection, PolyCollection
from matplotlib.colors import LogNorm, to_rgb

from knot_utm.report.colours import colour_scales, node_values
from knot_utm.report.method_facts import drawing_of, post_diameter
from knot_utm.report.quantities import with_unit
from knot_utm.report.shapes import lengths, pieces
from knot_utm.report.style import as_png, GREY, HUB, INK, ROLLER, SMALL, USUAL
from knot_utm.report.tube import SeenTube, smooth, to_picture

UNKNOWN = to_rgb("#9fb3c4")
PIXELS = 1500   # across a picture
NEAR = 2.6      # strands whose centrelines are nearer than this many radii touch, or nearly so
MARGIN = 4.0    # around what is shown [radii]
LONGEST = 7.0   # a picture wider than this many of its heights shows the knot alone
HIGHEST = 0.8   # a picture, of its width
FROM_ITS_END = 0.99  # a post whose axis runs to the eye within 8 degrees: cosine
NAME = 0.24     # of a name above its picture [in]


def pictures(run, marks, shapes, looks):
    """For each look all of them in one picture, one below the other, with one scale of colours."""
    radius = run.method["material"]["radius"]
    scale = next((one for one in colour_scales(shapes, radius, run.units) if one.name == "tension"), None)
    rods = [tubes_of(run, shape, shapes[0], scale) for shape in shapes]
    views = [view(run, shape, run.thickest()) for shape in shapes]
    return [picture(run, list(zip(marks, shapes, rods, views)), scale, look) for look in looks]


def picture(run, rows, scale, look):
    """`rows`: mark, shape, tubes and view of each."""
    width = width_of([box for *_, box in rows])
    heights = [look.width * (top - bottom) / width + NAME for *_, (_, _, bottom, top) in rows]
    scale_height = 0.75 if scale else 0.1
    figure = plt.figure(figsize=(look.width, sum(heights) + scale_height))
    grid = figure.add_gridspec(len(rows) + 1, 1, height_ratios=[*heights, scale_height], left=0.0, right=1.0,
                               bottom=0.0, top=1.0, hspace=0.0)
    for row, (mark, shape, tubes, box) in enumerate(rows):
        axes = figure.add_subplot(grid[row])
        tubes.draw(axes)
        draw_rollers(axes, run, shape)
        frame(axes, box, (width, width * heights[row] / look.width), 0.5 * NAME * width / look.width)
        label(axes, mark, shape, run)
    if scale:
        draw_scale(figure.add_subplot(grid[len(rows)]), scale)
    return as_png(figure, PIXELS / look.width)


def width_of(views):
    """[mm], of all of them: the widest has room, and none is too high."""
    return max(max(right - left, (top - bottom) / HIGHEST) for left, right, bottom, top in views)


def tubes_of(run, shape, whole, scale):
    values = node_values(shape).get(scale.name) if scale else None

    def colours(node):
        if values is None:
            return np.tile(UNKNOWN, (len(node), 1))
        return scale.of(np.interp(node, np.arange(len(values)), values))

    parts = pieces(shape, whole)
    return Tubes(shape.points, parts, run.radii(shape, parts), colours)


class Tubes:
    """Around parts of the rod, for as many pictures as there are. `colours_at`: of places along it, as numbers of nodes."""

    def __init__(self, points, parts, radii, colours_at):
        tubes = [(part, SeenTube(smooth(to_picture(points[part])), radius)) for part, radius in zip(parts, radii)]
        colours = np.concatenate([tube.shaded(colours_at(part.start + tube.along * (part.stop - 1 - part.start)))
                                  for part, tube in tubes])
        depth = np.concatenate([tube.depth for _, tube in tubes])
        # What is farther from the eye is paler.
        away = (depth.max() - depth) / max(np.ptp(depth), 4.0 * max(radii))
        colours = colours + 0.35 * away[:, None] * (0.93 - colours)
        order = np.argsort(depth, kind="stable")
        outlines = np.concatenate([tube.outlines for _, tube in tubes])[order]
        self.outlines, self.colours = PolyCollection(1e3 * outlines).get_paths(), colours[order]

    def draw(self, axes):
        """The limits of the axes are for others to set."""
        axes.add_collection(PathCollection(self.outlines, facecolors=self.colours, edgecolors=self.colours, linewidths=0.25,
                                           zorder=2), autolim=False)


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
    """Those of a grip that are seen from their end, and the sections of rings whose holes are seen from the side. The first one is
    the grip, at a place along the load axis; radius of the rod."""
    posts = [post for post in drawing.get("posts") or [] if post.get("grip", "lower") == grip]
    seen = []
    for post in posts:
        x, y, z = np.array(post["along"]) / np.linalg.norm(post["along"])
        if "ring" not in post and abs(y) > FROM_ITS_END:
            shifts = [(0.0, 0.0)]
        elif "ring" in post and abs(y) < 1.0 - FROM_ITS_END:
            shifts = [(side * post["ring"] * x, -side * post["ring"] * z) for side in (1.0, -1.0)]
        else:
            continue
        seen += [(float(place + radius * (post["through"][2] - posts[0]["through"][2] + up)),
                  float(radius * (post["through"][0] + across)), radius * post["radius"]) for up, across in shifts]
    return seen


def draw_rollers(axes, run, shape):
    for z, x, radius in rollers(run, shape):
        axes.add_patch(plt.Circle((z, x), radius, facecolor=ROLLER, edgecolor=HUB, lw=0.8, zorder=1))
        axes.add_patch(plt.Circle((z, x), 0.15 * radius, facecolor=HUB, edgecolor="none", zorder=1))


def view(run, shape, radius):
    """Left, right, bottom, top [mm] of what is shown: rod and rollers, or the knot alone where it would be too small."""
    shown = to_picture(shape.points)
    ends = [[1e-3 * (z + side * r), 1e-3 * (x + side * r)] for z, x, r in rollers(run, shape) for side in (-1.0, 1.0)]
    whole = box_around(np.vstack([shown[:, :2], *ends]), radius)
    if whole[1] - whole[0] <= LONGEST * (whole[3] - whole[2]) * 1.6:
        return whole
    knot = touching(shape, radius)
    if not knot.any():
        return whole
    left, right, bottom, top = box_around(shown[knot], radius)
    wide = max(right - left, LONGEST * 0.5 * (top - bottom), 60.0 * 1e3 * radius)
    middle = 0.5 * (left + right)
    inside = (1e3 * shown[:, 0] > middle - 0.5 * wide) & (1e3 * shown[:, 0] < middle + 0.5 * wide)
    _, _, bottom, top = box_around(shown[inside], radius)
    return middle - 0.5 * wide, middle + 0.5 * wide, bottom, top


def box_around(points, radius):
    low, high = points.min(axis=0), points.max(axis=0)
    margin = MARGIN * radius
    return tuple(1e3 * np.array([low[0] - margin, high[0] + margin, low[1] - margin, high[1] + margin]))


def touching(shape, radius):
    """Nodes near another strand: nearer through the air than half as far along the rod."""
    points, edges = shape.points, lengths(shape)
    edges[list(shape.cuts)] += 10.0 * NEAR * radius
    along = np.concatenate([[0.0], np.cumsum(edges)])
    near = np.zeros(len(points), dtype=bool)
    for i, point in enumerate(points):
        distance = np.linalg.norm(points - point, axis=1)
        near[i] = bool(((distance < NEAR * radius) & (np.abs(along - along[i]) > 2.0 * NEAR * radius)).any())
    return near


def frame(axes, box, size, lower):
    """A view in the middle of a place of a size [mm], a bit `lower`, so that there is room for a name."""
    middle = 0.5 * (box[0] + box[1])
    axes.set_xlim(middle - 0.5 * size[0], middle + 0.5 * size[0])
    middle = 0.5 * (box[2] + box[3]) + lower
    axes.set_ylim(middle - 0.5 * size[1], middle + 0.5 * size[1])
    axes.axis("off")


def label(axes, mark, shape, run):
    tested = run.tested()  # a zeroing lets the extension jump; before it a shape is where the test begins
    curve = tested if len(tested) else run.curve
    at = float(np.interp(shape.time, curve["time"], curve["extension"]))
    place = {"xy": (0.0, 1.0), "xycoords": "axes fraction", "textcoords": "offset points", "va": "baseline", "color": INK}
    axes.annotate(mark.letter, xytext=(3, -11), fontsize=USUAL + 2.0, weight="bold", **place)
    axes.annotate(f"{mark.title()}: s = {with_unit(at, run.units.length)}", xytext=(16, -11), fontsize=USUAL, **place)


def draw_scale(axes, scale):
    axes.axis("off")
    draw_bar(axes.inset_axes([0.25, 0.62, 0.5, 0.16]), scale, SMALL)


def draw_bar(axes, scale, letters):
    """The colours with what they mean. `letters`: their size [pt]."""
    bar = plt.colorbar(ScalarMappable(scale.norm, scale.colours), cax=axes, orientation="horizontal",
                       extend="min" if isinstance(scale.norm, LogNorm) else "neither")
    ticks = scale.ticks()
    bar.set_ticks([scale.norm.inverse(place) for place, _ in ticks], labels=[text for _, text in ticks])
    bar.ax.minorticks_off()
    bar.ax.tick_params(labelsize=letters)
    bar.set_label(scale.label(), fontsize=letters)
    bar.outline.set_edgecolor(GREY)
