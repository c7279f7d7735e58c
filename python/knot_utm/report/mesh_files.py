"""A mesh of the rod in files for other programs: glTF 2.0 in one binary file (.glb) for slides and the web, and VTK PolyData (.vtp)
for ParaView.

Sources: Khronos Group, glTF 2.0 Specification, chapters 3 (properties) and 4 (GLB file format); Kitware, VTK File Formats, XML."""
import base64
import json
import struct
import xml.etree.ElementTree as xml

import numpy as np

MAGIC, JSON_CHUNK, BINARY_CHUNK = 0x46546C67, 0x4E4F534A, 0x004E4942
FLOAT, UNSIGNED_INT, UNSIGNED_BYTE = 5126, 5125, 5121
POINTS, INDICES = 34962, 34963
# The file has y up, towards which the test's z is turned: a quarter turn about x.
Z_UP = [-np.sqrt(0.5), 0.0, 0.0, np.sqrt(0.5)]


def glb(mesh, colours, name):
    """The bytes of a file of a mesh [m]. `colours`: red, green, blue of each point, 0 to 1, as a screen shows them."""
    columns = {"POSITION": mesh.points.astype("<f4"), "NORMAL": mesh.normals.astype("<f4"), "COLOR_0": with_alpha(linear(colours))}
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
    """From sRGB, as glTF has them."""
    return np.where(colours <= 0.04045, colours / 12.92, ((colours + 0.055) / 1.055) ** 2.4)


def with_alpha(colours):
    return np.column_stack([np.rint(255.0 * colours), np.full(len(colours), 255.0)]).astype(np.uint8)


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
