"""The rod as a thing to turn in a browser: what turnable.js needs of a test, and the library that draws it."""
import base64
import json
import os

import numpy as np

from knot_utm.report.colours import colour_scales, node_values
from knot_utm.report.page import Turnable
from knot_utm.report.rod_pictures import rollers, UNKNOWN
from knot_utm.report.shapes import ropes
from knot_utm.yaml_text import read_text

LIBRARY = "/usr/share/javascript/three"  # Debian: libjs-three
SCRIPTS = [os.path.join(LIBRARY, "three.min.js"), os.path.join(LIBRARY, "examples/js/controls/OrbitControls.js"),
           os.path.join(os.path.dirname(os.path.abspath(__file__)), "turnable.js")]
KNOWN = 255    # colours; the next number is that of what is not known
FINEST = 65535  # places along an axis are whole numbers up to this


def turnable(run, shapes, marks):
    """None where the library is not installed."""
    if not all(os.path.exists(file) for file in SCRIPTS):
        return None
    # No "<" that could end the element that holds it.
    return Turnable(json.dumps(content(run, shapes, marks), separators=(",", ":")).replace("<", "\\u003c"),
                    [read_text(file) for file in SCRIPTS])


def content(run, shapes, marks):
    """Lengths are in mm."""
    points = 1e3 * np.array([shape.points for shape in shapes])
    low, high = points.min(axis=(0, 1)), points.max(axis=(0, 1))
    step = np.maximum(high - low, 1e-6) / FINEST
    scales = colour_scales(shapes, run.method["material"]["radius"], run.units).values()
    values = [node_values(shape) for shape in shapes]
    wheels = [rollers(run, shape) for shape in shapes]
    return {"radius": 1e3 * run.method["material"]["radius"], "nodes": points.shape[1],
            "times": [shape.time for shape in shapes], "first": first_shown(shapes, marks),
            "low": low.tolist(), "step": step.tolist(), "points": encoded(np.rint((points - low) / step), "<u2"),
            "ropes": [[rope.start, rope.stop, 1e3 * radius] for rope, radius in zip(ropes(shapes[0]), run.radii(shapes[0]))],
            "unknown": list(UNKNOWN),
            "quantities": [coloured(scale, values, points.shape[1]) for scale in scales],
            "rollers": [[[z, x] for z, x, _ in one] for one in wheels], "roller_radii": [radius for _, _, radius in wheels[0]],
            "words": [run.words_at(shape.time) for shape in shapes]}


def encoded(values, kind):
    return base64.b64encode(np.ascontiguousarray(values).astype(kind).tobytes()).decode("ascii")


def first_shown(shapes, marks):
    """The shape that the page begins with: at the lock, where there is one, else at the end of the test."""
    mark = next((mark for mark in marks if "lock" in mark.names), marks[-1] if marks else None)
    return min(range(len(shapes)), key=lambda i: abs(shapes[i].time - mark.time)) if mark else len(shapes) - 1


def coloured(scale, values, nodes):
    """`values`: of each shape by name."""
    places = np.full((len(values), nodes), float(KNOWN))
    known = [i for i, of_nodes in enumerate(values) if scale.name in of_nodes]
    places[known] = np.rint((KNOWN - 1) * scale.places(np.array([values[i][scale.name] for i in known])))
    palette = np.rint(255.0 * scale.colours(np.linspace(0.0, 1.0, KNOWN))[:, :3])
    return {"label": scale.label(), "ticks": scale.ticks(), "palette": encoded(palette, "u1"), "places": encoded(places, "u1")}
