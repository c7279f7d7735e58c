"""The rod over time for ParaView: tubes as VTK PolyData, and the .pvd file that names them with their times."""
import os
import xml.etree.ElementTree as xml

import numpy as np
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

from knot_utm.report.failure import CannotReport
from knot_utm.report.node_values import names_known, node_values
from knot_utm.report.shapes import pieces
from knot_utm.report.tube_mesh import tube


def write_vtk_series(folder, series, radius):
    """rod.pvd, and of each shape rod_000.vtp and so on; how many shapes they hold."""
    shapes = [series.shape(i) for i in range(len(series))]
    names = names_known(shapes)
    root = xml.Element("VTKFile", type="Collection", version="0.1", byte_order="LittleEndian")
    collection = xml.SubElement(root, "Collection")
    for number, shape in enumerate(shapes):
        name = f"rod_{number:03d}.vtp"
        write_tube(os.path.join(folder, name), shape, shapes[0], radius, names)
        xml.SubElement(collection, "DataSet", timestep=repr(float(shape.time)), part="0", file=name)
    xml.indent(root)
    xml.ElementTree(root).write(os.path.join(folder, "rod.pvd"), encoding="utf-8", xml_declaration=True)
    return len(shapes)


def write_tube(file, shape, whole, radius, names):
    """Every file of a series has the same arrays: NaN where a value is not known."""
    known = node_values(shape)
    unknown = np.full(len(shape.points), np.nan)
    values = {name: known.get(name, unknown) for name in names}
    values["arclength"] = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(whole.points, axis=0), axis=1))]) \
        if len(whole.points) == len(shape.points) else unknown
    writer = vtkXMLPolyDataWriter()
    writer.SetFileName(file)
    writer.SetInputData(tube(shape.points, pieces(shape, whole), radius, values))
    if not writer.Write():
        raise CannotReport(f"{file}: cannot be written")
