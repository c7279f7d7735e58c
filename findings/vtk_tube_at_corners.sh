#!/bin/bash
# The tube that VTK 9.1 (and with it ParaView's filter "Tube") puts round a polyline: how thick is it at a corner?
#
# Two edges of length 1, radius 0.1, 8 sides, and between them a turn of 30, 60, 90, 120 or 150 degrees.
#
# Guessed: corners are mitred, so that the tube keeps its radius about each edge up to the corner; or a knee is put in.
# Seen: at the corner stands one circle of the tube's radius, across half of the turn. About either edge the tube therefore is as thin as
# cos(turn/2) of its radius in the plane of the turn: 0.97, 0.87, 0.71, 0.5 and 0.26 of it, tapering over the whole of both edges.
# Why it matters: knots of few sticks, and rods of few nodes at a tight bend, are drawn too thin where they touch: strands in contact show a gap
# that is not there, and a mesh made from the tube (for printing or a contact search) has less volume. Refine the curve first (vtkSplineFilter)
# or draw capsules.
#
# usage: findings/vtk_tube_at_corners.sh
# It loads Debian packages, and what they need and this machine lacks, into a temporary folder, installs nothing, and ends with 1 where VTK
# does otherwise.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
version=9.1.0+really9.1.0+dfsg2-5+deb12u1
mapfile -t needed < <(apt-get -s --no-install-recommends install "python3-vtk9=$version" "libvtk9.1=$version" | sed -n 's/^Inst \([^ ]*\) (\([^ ]*\).*/\1=\2/p')
apt-get -qq download "python3-vtk9=$version" "libvtk9.1=$version" "${needed[@]}" 2>/dev/null
for package in *.deb; do dpkg -x "$package" tree; done
libraries=$(find "$PWD/tree" -name '*.so*' -printf '%h\n' | sort -u | paste -sd :)
LD_LIBRARY_PATH=$libraries PYTHONPATH=tree/usr/lib/python3/dist-packages /usr/bin/python3 - <<'PYTHON'
import math
import numpy
import vtk
from vtk.util.numpy_support import vtk_to_numpy

RADIUS = 0.1


def least_radius(turn):
    """The tube's least distance from the line of the first edge, at the corner, over its radius."""
    points, lines, rod, tube = vtk.vtkPoints(), vtk.vtkCellArray(), vtk.vtkPolyData(), vtk.vtkTubeFilter()
    for place in ((-1, 0, 0), (0, 0, 0), (math.cos(turn), math.sin(turn), 0)):
        points.InsertNextPoint(place)
    lines.InsertNextCell(3, (0, 1, 2))
    rod.SetPoints(points)
    rod.SetLines(lines)
    tube.SetInputData(rod)
    tube.SetRadius(RADIUS)
    tube.SetNumberOfSides(8)
    tube.Update()
    ring = vtk_to_numpy(tube.GetOutput().GetPoints().GetData()).reshape(3, 8, 3)[1]
    return numpy.hypot(ring[:, 1], ring[:, 2]).min() / RADIUS


wrong = vtk.vtkVersion.GetVTKVersion() != "9.1.0"
print("VTK", vtk.vtkVersion.GetVTKVersion())
for degrees in (30, 60, 90, 120, 150):
    seen = least_radius(math.radians(degrees))
    same = abs(seen - math.cos(math.radians(degrees) / 2)) < 0.002
    wrong |= not same
    print(f"a turn of {degrees} degrees: {seen:.3f} of the radius" + ("" if same else f"   expected {math.cos(math.radians(degrees) / 2):.3f}"))
raise SystemExit(wrong)
PYTHON
