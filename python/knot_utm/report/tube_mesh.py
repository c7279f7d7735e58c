"""The surface of the rod for other programs, made by VTK."""
import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkTriangleFilter, vtkTubeFilter

SIDES = 16


def tube(points, pieces, radius, values):
    """vtkPolyData: a tube [m] around each piece, a slice of the nodes. `values`: of every node, by name, which every point
    around it has as well."""
    line = vtkPolyData()
    places = vtkPoints()
    places.SetData(as_vtk(np.asarray(points, dtype=np.float32)))
    line.SetPoints(places)
    cells = vtkCellArray()
    for piece in pieces:
        cells.InsertNextCell(piece.stop - piece.start, list(range(piece.start, piece.stop)))
    line.SetLines(cells)
    for name, of_nodes in values.items():
        array = as_vtk(np.asarray(of_nodes, dtype=np.float32))
        array.SetName(name)
        line.GetPointData().AddArray(array)
    around = vtkTubeFilter()
    around.SetInputData(line)
    around.SetRadius(radius)
    around.SetNumberOfSides(SIDES)
    around.CappingOn()
    around.Update()
    return around.GetOutput()


def triangles(surface):
    """Corners [m], outward normals and values by name of each point, and the three points of each triangle."""
    split = vtkTriangleFilter()
    split.SetInputData(surface)
    split.Update()
    mesh = split.GetOutput()
    data = mesh.GetPointData()
    values = {data.GetArrayName(i): vtk_to_numpy(data.GetArray(i)) for i in range(data.GetNumberOfArrays())}
    normals = values.pop(data.GetNormals().GetName())
    return (vtk_to_numpy(mesh.GetPoints().GetData()), normals, values,
            vtk_to_numpy(mesh.GetPolys().GetData()).reshape(-1, 4)[:, 1:])


def as_vtk(values):
    return numpy_to_vtk(np.ascontiguousarray(values), deep=True)
