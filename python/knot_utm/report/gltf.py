"""A mesh with a colour at each point as glTF 2.0 in one binary file (.glb), for slides and the web.

Source: Khronos Group, glTF 2.0 Specification, chapters 3 (properties) and 4 (GLB file format)."""
import json
import struct

import numpy as np

MAGIC, JSON_CHUNK, BINARY_CHUNK = 0x46546C67, 0x4E4F534A, 0x004E4942
FLOAT, UNSIGNED_INT, UNSIGNED_BYTE = 5126, 5125, 5121
POINTS, INDICES = 34962, 34963
# The file has y up, towards which the test's z is turned: a quarter turn about x.
Z_UP = [-np.sqrt(0.5), 0.0, 0.0, np.sqrt(0.5)]


def glb(points, normals, colours, triangles, name):
    """The bytes of a file. `points` [m]; `colours`: red, green, blue, 0 to 1, as a screen shows them."""
    columns = {"POSITION": np.asarray(points, dtype="<f4"), "NORMAL": unit(np.asarray(normals, dtype="<f4")),
               "COLOR_0": with_alpha(linear(colours))}
    arrays = [*columns.values(), np.asarray(triangles, dtype="<u4").reshape(-1)]
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
    found = {"bufferView": view, "count": len(array), "type": "SCALAR",
             "componentType": {"f": FLOAT, "B": UNSIGNED_BYTE}.get(array.dtype.char, UNSIGNED_INT)}
    if array.ndim == 2:
        found["type"] = f"VEC{array.shape[1]}"
    if array.dtype == np.uint8:
        found["normalized"] = True
    return found


def unit(vectors):
    return vectors / np.linalg.norm(vectors, axis=1, keepdims=True)


def linear(colours):
    """From sRGB, as glTF has them."""
    return np.where(colours <= 0.04045, colours / 12.92, ((colours + 0.055) / 1.055) ** 2.4)


def with_alpha(colours):
    return np.column_stack([np.rint(255.0 * colours), np.full(len(colours), 255.0)]).astype(np.uint8)


def padded(content, by):
    """Every piece begins at a multiple of four bytes."""
    return content + by * (-len(content) % 4)
