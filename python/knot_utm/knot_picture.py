"""usage: python3 -m knot_utm.knot_picture KNOT.json PNG

Draws a knot from the front and from the side: what tensile_test --draw shows beside the facts. The core says in JSON what there is, in
radii of the rod: "title", "ropes" with the "points" of each and the names of its two "ends", and "posts" with "centre", "axis",
"radius" and "ring" (the radius of a post that is bent to a ring; else 0). A rope is a line of its thickness with a gap in what lies
behind it.
"""
import json
import sys

from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.patches import Circle
import numpy as np

VIEWS = (("from the front: x, z", np.array([1, 0, 0]), np.array([0, -1, 0])),  # to the right, and towards the eye
         ("from the side: y, z", np.array([0, 1, 0]), np.array([1, 0, 0])))
UP = np.array([0, 0, 1])
COLOURS = ["#1f5fa8", "#d9622b", "#2f8f4e", "#8a4fa3", "#a98600"]
POST = "#b9bcc2"
POINTS = 7  # of a radius on paper
BEYOND = 4  # of a post beyond the knot, and white around it [radii]


def pieces_of_rope(points, near, colour):
    """Two edges at a time, each on a wider white line; both reach over their neighbours, so that no seams are seen."""
    for i in range(0, len(points) - 1, 2):
        depth = points[i:i + 3].mean(axis=0) @ near
        yield depth, points[max(i - 1, 0):i + 4], 2.5, "white"
        yield depth, points[max(i - 2, 0):i + 5], 1.8, colour


def pieces_of_post(post, points, near):
    centre, axis, radius, ring = (np.array(post[key]) for key in ("centre", "axis", "radius", "ring"))
    if ring > 0:
        side = np.cross(axis, near if abs(axis @ near) < 0.9 else UP)
        side = side / np.linalg.norm(side)
        angles = np.linspace(0, 2 * np.pi, 49)[:, None]
        around = centre + ring * (np.cos(angles) * side + np.sin(angles) * np.cross(axis, side))
        for i in range(48):
            yield around[i:i + 2].mean(axis=0) @ near, around[i:i + 3], 2 * radius, POST
    elif np.sqrt(max(0, 1 - (axis @ near) ** 2)) >= 0.3:  # else it is seen from its end
        along = (points - centre) @ axis
        yield centre @ near, centre + np.outer([along.min() - BEYOND, along.max() + BEYOND], axis), 2 * radius, POST


def draw(axes, knot, caption, right, near):
    ropes = [np.array(rope["points"], dtype=float) for rope in knot["ropes"]]
    seen = np.column_stack((right, UP))
    pieces = [piece for number, rope in enumerate(ropes) for piece in pieces_of_rope(rope, near, COLOURS[number % len(COLOURS)])]
    pieces += [piece for post in knot["posts"] for piece in pieces_of_post(post, np.vstack(ropes), near)]
    pieces.sort(key=lambda piece: piece[0])
    _, lines, widths, colours = zip(*pieces)
    axes.add_collection(LineCollection([line @ seen for line in lines], linewidths=np.array(widths) * POINTS, colors=colours,
                                       capstyle="butt", joinstyle="round"))
    for post in knot["posts"]:
        if abs(np.array(post["axis"]) @ near) > 0.95 and post["ring"] == 0:
            axes.add_patch(Circle(np.array(post["centre"]) @ seen, post["radius"], color=POST, zorder=0))
    taken = []
    for number, (rope, names) in enumerate(zip(ropes, (rope["ends"] for rope in knot["ropes"]))):
        for (end, following), name in zip(((rope[0], rope[1]), (rope[-1], rope[-2])), names):
            away = (end - following) @ seen
            away = away / np.linalg.norm(away) if np.linalg.norm(away) > 1e-3 else np.array([1, 0])
            place = end @ seen + 2.2 * away
            while any(abs(place[0] - other[0]) < 12 and abs(place[1] - other[1]) < 2 for other in taken):
                place = place + np.array([0, 2 if away[1] >= 0 else -2])
            taken.append(place)
            axes.text(*place, name, color=COLOURS[number % len(COLOURS)], va="center",
                      ha="left" if away[0] > 0.3 else "right" if away[0] < -0.3 else "center")
    axes.text(axes.get_xlim()[0], axes.get_ylim()[0] - 9, caption, color="#666666", va="top")
    axes.set_axis_off()


def picture(knot):
    points = np.vstack([np.array(rope["points"], dtype=float) for rope in knot["ropes"]])
    low, high = points.min(axis=0) - BEYOND, points.max(axis=0) + BEYOND
    widths, height, gap = (high - low)[:2], (high - low)[2], 16
    whole = widths.sum() + gap
    figure = Figure(figsize=(whole * POINTS / 72, height * POINTS / 72))
    for k, view in enumerate(VIEWS):
        axes = figure.add_axes([k * (widths[0] + gap) / whole, 0, widths[k] / whole, 1], xlim=(low[k], high[k]), ylim=(low[2], high[2]))
        draw(axes, knot, *view)
    figure.text(0, 1, knot["title"], fontweight="bold", va="bottom", parse_math=False)
    return figure


if __name__ == "__main__":
    try:
        with open(sys.argv[1], encoding="utf-8") as file:
            figure = picture(json.load(file, strict=False))
        figure.savefig(sys.argv[2], bbox_inches="tight", dpi=100, metadata={"Software": None})
    except OSError as error:
        sys.exit(f"tensile_test: {error}")
