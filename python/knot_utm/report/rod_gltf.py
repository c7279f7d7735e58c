"""The rod at one time of a test as a mesh with colours."""
import numpy as np

from knot_utm.report.colour_scales import colour_scales
from knot_utm.report.failure import CannotReport
from knot_utm.report.gltf import glb
from knot_utm.report.node_values import node_values
from knot_utm.report.rod_pictures import UNKNOWN
from knot_utm.report.shapes import pieces
from knot_utm.report.tube_mesh import triangles, tube


def rod_glb(run, series, time, name):
    """The file's bytes, and what it holds, in words. `time` [s]; None: the last. `name`: of what the colours show; None:
    the tension, where it is known."""
    shapes = [series.shape(i) for i in range(len(series))]
    shape = shapes[-1] if time is None else series.at(time)
    radius = run.method["material"]["radius"]
    values = node_values(shape)
    scales = {scale.name: scale for scale in colour_scales(shapes, radius, run.units)}
    if name and (name not in values or name not in scales):
        raise CannotReport(f"{run.folder}: --color {name}: it is not known at {shape.time:g} s; known are: "
                           f"{', '.join(known for known in values if known in scales)}")
    shown = name or "tension"
    has_colours = shown in values and shown in scales
    mesh = tube(shape.points, pieces(shape, shapes[0]), radius, {shown: values[shown]} if has_colours else {})
    points, normals, of_points, corners = triangles(mesh)
    colours = scales[shown].of(of_points[shown]) if has_colours else np.tile(UNKNOWN, (len(points), 1))
    words = f"the rod at {shape.time:g} s, " + (f"coloured by its {scales[shown].label()}" if has_colours else
                                                "in one colour, as no tension is known then")
    return glb(points, normals, colours, corners, "rod"), words
