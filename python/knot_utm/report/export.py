"""Writes the rod of a test for other programs: over time for ParaView, or as it lay at one time for slides and the web.

Sources: Khronos Group, glTF 2.0 Specification, chapters 3 (properties) and 4 (GLB file format); Kitware, VTK File Formats, XML.
"""
import base64
import json
import os
import struct
import sys
import xml.etree.ElementTree as xml

import numpy as np

from knot_utm.errors import refuse_if
from knot_utm.report.colours import colour_scales, LABELS, node_values
from knot_utm.report.commands import file_ending, in_one_line, OneLineParser, test_in
from knot_utm.report.rod_pictures import UNKNOWN
from knot_utm.report.run import Run
from knot_utm.report.shapes import lengths, nearest, ropes, shapes_of
from knot_utm.report.tube import rod_mesh

MAGIC, JSON_CHUNK, BINARY_CHUNK = 0x46546C67, 0x4E4F534A, 0x004E4942
FLOAT, UNSIGNED_INT, UNSIGNED_BYTE = 5126, 5125, 5121
POINTS, INDICES = 34962, 34963
# The file has y up, towards which the test's z is turned: a quarter turn about x.
Z_UP = [-np.sqrt(0.5), 0.0, 0.0, np.sqrt(0.5)]


def asked():
    parser = OneLineParser(prog="export", description=__doc__.partition("\n")[0])
    parser.add_argument("folder", metavar="DIR", type=test_in, help="the folder of a test")
    to = parser.add_mutually_exclusive_group(required=True)
    to.add_argument("--vtk", metavar="OUT", help="a new folder for rod.pvd and a .vtp file for each shape")
    to.add_argument("--gltf", metavar="OUT", type=file_ending(".glb"), help="a .glb file")
    parser.add_argument("--color", choices=LABELS, help="what the colours of the .glb show [tension]")
    parser.add_argument("--time", type=float, metavar="SECONDS",
                        help="of the test, for the .glb; the shape nearest to it is taken [the last one]")
    parser.add_argument("--overwrite", action="store_true", help="write over a file that exists")
    found = parser.parse_args()
    if found.vtk is not None and (found.color or found.time is not None):
        parser.error("--color and --time belong to --gltf: the files of --vtk hold all values at all times")
    if found.gltf is not None:
        parser.require_room("--gltf", found.gltf, [found.folder], found.overwrite)
    elif os.path.exists(found.vtk) and not (os.path.isdir(found.vtk) and not os.listdir(found.vtk)):
        parser.error(f"--vtk {found.vtk}: is there already; give a new folder")
    return found


def main():
    arguments = asked()
    run = Run(arguments.folder)
    shapes, note = shapes_of(run)
    if note:
        print("export:", note.replace(" is shown", " is written"), file=sys.stderr)
    if arguments.vtk is not None:
        print(over_time(arguments.vtk, run, shapes))
    else:
        print(at_one_time(arguments, run, shapes, shapes[-1] if arguments.time is None else nearest(shapes, arguments.time)))


def over_time(folder, run, shapes):
    """rod.pvd, and of each shape rod_000.vtp and so on. Every file has the same arrays: NaN where a value is not known."""
    os.makedirs(folder, exist_ok=True)
    known = set().union(*map(node_values, shapes))
    names, files = [name for name in LABELS if name in known], [f"rod_{number:03d}.vtp" for number in range(len(shapes))]
    edges = lengths(shapes[0])
    edges[list(shapes[0].cuts)] = 0.0
    along = np.concatenate([[0.0], np.cumsum(edges)])
    for file, shape in zip(files, shapes):
        unknown = np.full(len(shape.points), np.nan)
        of_nodes = {**dict.fromkeys(names, unknown), **node_values(shape), "arclength": along if len(along) == len(unknown) else unknown}
        mesh = rod_mesh(shape.points, ropes(shape), run.radii(shape))
        write_vtp(os.path.join(folder, file), mesh, {name: values[mesh.along.astype(int)] for name, values in of_nodes.items()})
    pvd = os.path.join(folder, "rod.pvd")
    write_pvd(pvd, [shape.time for shape in shapes], files)
    return f"{pvd}: {len(shapes)} shapes"


def at_one_time(arguments, run, shapes, shape):
    radius, values = run.method["material"]["radius"], node_values(shape)
    scales = {name: scale for name, scale in colour_scales(shapes, radius, run.units).items() if name in values}
    refuse_if(arguments.color and arguments.color not in scales,
              f"{run.folder}: --color {arguments.color}: it is not known at {shape.time:g} s; known are: "
              f"{', '.join(name for name in values if name in scales)}")
    scale = scales.get(arguments.color or "tension")
    mesh = rod_mesh(shape.points, ropes(shape), run.radii(shape))
    colours = scale.of(values[scale.name][mesh.along.astype(int)]) if scale else np.tile(UNKNOWN, (len(mesh.points), 1))
    with open(arguments.gltf, "wb") as out:
        out.write(glb(mesh, colours, "rod"))
    in_colours = f"coloured by the {scale.label()}" if scale else "in one colour, as no tension is known then"
    return f"{arguments.gltf}: the rod at {shape.time:g} s, {in_colours}"


def glb(mesh, colours, name):
    """The bytes of a file of a mesh [m]. `colours`: red, green, blue of each point, 0 to 1, as a screen shows them."""
    columns = {"POSITION": mesh.points.astype("<f4"), "NORMAL": mesh.normals.astype("<f4"), "COLOR_0": linear(colours)}
    arrays = [*columns.values(), mesh.triangles().astype("<u4").reshape(-1)]
    binary, views = b"", []
    for array in arrays:
        views.append({"buffer": 0, "byteOffset": len(binary), "byteLength": array.nbytes,
                      "target": INDICES if array is arrays[-1] else POINTS})
        binary += padded(array.tobytes(), b"\0")
    accessors = [accessor(view, array) for view, array in enumerate(arrays)]
    accessors[0].update(min=arrays[0].min(axis=0).tolist(), max=arrays[0].max(axis=0).tolist())
    document = {
        "asset": {"version": "2.0", "generator": "knot_utm"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, "name": name, "rotation": Z_UP}],
        "meshes": [{"name": name, "primitives": [{
            "attributes": {column: i for i, column in enumerate(columns)}, "indices": len(columns), "material": 0}]}],
        "materials": [{"pbrMetallicRoughness": {"metallicFactor": 0.0, "roughnessFactor": 0.5}}],
        "buffers": [{"byteLength": len(binary)}], "bufferViews": views, "accessors": accessors}
    text = padded(json.dumps(document, separators=(",", ":")).encode("ascii"), b" ")
    chunks = struct.pack("<II", len(text), JSON_CHUNK) + text + struct.pack("<II", len(binary), BINARY_CHUNK) + binary
    return struct.pack("<III", MAGIC, 2, 12 + len(chunks)) + chunks


def accessor(view, array):
    found = {"bufferView": view, "count": len(array), "type": "SCALAR" if array.ndim == 1 else f"VEC{array.shape[1]}",
             "componentType": {"f": FLOAT, "B": UNSIGNED_BYTE}.get(array.dtype.char, UNSIGNED_INT)}
    return {**found, "normalized": True} if array.dtype == np.uint8 else found


def linear(colours):
    """From sRGB, as glTF has them, and opaque."""
    light = np.where(colours <= 0.04045, colours / 12.92, ((colours + 0.055) / 1.055) ** 2.4)
    return np.rint(255.0 * np.column_stack([light, np.ones(len(light))])).astype(np.uint8)


def padded(content, by):
    """Every piece begins at a multiple of four bytes."""
    return content + by * (-len(content) % 4)


def write_vtp(file, mesh, values):
    """`values`: of every point, by name."""
    root = xml.Element("VTKFile", type="PolyData", version="1.0", byte_order="LittleEndian", header_type="UInt32")
    corners = mesh.triangles()
    piece = xml.SubElement(xml.SubElement(root, "PolyData"), "Piece", NumberOfPoints=str(len(mesh.points)),
                           NumberOfPolys=str(len(corners)))
    for section, arrays in (
            ("PointData", {"normals": mesh.normals, **values}), ("Points", {"points": mesh.points}),
            ("Polys", {"connectivity": corners.reshape(-1), "offsets": 3 * np.arange(1, len(corners) + 1)})):
        within = xml.SubElement(piece, section)
        for name, array in arrays.items():
            array = np.ascontiguousarray(array, dtype="<i8" if section == "Polys" else "<f4")
            of = xml.SubElement(within, "DataArray", Name=name, type="Int64" if section == "Polys" else "Float32",
                                NumberOfComponents=str(array.size // max(len(array), 1)), format="binary")
            of.text = base64.b64encode(struct.pack("<I", array.nbytes) + array.tobytes()).decode("ascii")
    piece.find("PointData").set("Normals", "normals")
    xml.ElementTree(root).write(file, encoding="utf-8", xml_declaration=True)


def write_pvd(file, times, names):
    """Files over time, as ParaView opens them."""
    root = xml.Element("VTKFile", type="Collection", version="0.1", byte_order="LittleEndian")
    collection = xml.SubElement(root, "Collection")
    for time, name in zip(times, names):
        xml.SubElement(collection, "DataSet", timestep=repr(float(time)), part="0", file=name)
    xml.indent(root)
    xml.ElementTree(root).write(file, encoding="utf-8", xml_declaration=True)


if __name__ == "__main__":
    with in_one_line("export"):
        main()
