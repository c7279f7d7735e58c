#!/usr/bin/python3
"""Writes the rod of a test for other programs: over time for ParaView, or as it lay at one time for slides and the web.

    export.py DIR --vtk OUT
    export.py DIR --gltf OUT.glb [--color NAME] [--time SECONDS] [--overwrite]

DIR is the folder of a test. Its shapes over time are those of shapes.csv (tensile_test --shapes), else of test.bag; without
them there is the final shape alone.
"""
import argparse
import os
import sys

from knot_utm.report.failure import CannotReport, in_one_line
from knot_utm.report.__main__ import OneLineParser
from knot_utm.report.new_file import files_of, why_not

PACKAGES = {"vtkmodules": "python3-vtk9", "numpy": "python3-numpy", "yaml": "python3-yaml",
            "matplotlib": "python3-matplotlib"}
NAMES = ("tension", "curvature", "twist", "contact_force")


def asked():
    parser = OneLineParser(prog="export", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", metavar="DIR", help="the folder of a test")
    to = parser.add_mutually_exclusive_group(required=True)
    to.add_argument("--vtk", metavar="OUT", help="a new folder for rod.pvd and a .vtp file for each shape")
    to.add_argument("--gltf", metavar="OUT", help="a .glb file")
    parser.add_argument("--color", choices=NAMES, help="what the colours of the .glb show [tension]")
    parser.add_argument("--time", type=float, metavar="SECONDS",
                        help="of the test, for the .glb; the shape nearest to it is taken [the last one]")
    parser.add_argument("--overwrite", action="store_true", help="write over a file that exists")
    found = parser.parse_args()
    if found.vtk is not None and (found.color or found.time is not None):
        parser.error("--color and --time belong to --gltf: the files of --vtk hold all values at all times")
    if not os.path.isdir(found.folder):
        parser.error(f"{found.folder}: no such folder")
    if found.gltf is not None and not found.gltf.endswith(".glb"):
        parser.error(f"--gltf {found.gltf}: the name of the file must end with .glb")
    if found.gltf is not None and (why := why_not(found.gltf, files_of(found.folder), found.overwrite)):
        parser.error(f"--gltf: {why}")
    if found.vtk is not None and os.path.exists(found.vtk) and not (os.path.isdir(found.vtk) and not os.listdir(found.vtk)):
        parser.error(f"--vtk {found.vtk}: is there already; give a new folder")
    return found


def main():
    arguments = asked()
    with in_one_line("export", PACKAGES):
        try:
            print(export(arguments))
        except OSError as error:
            raise CannotReport(f"{error.filename}: cannot be written: {error.strerror}") from error


def export(arguments):
    """What was written, in one line."""
    from knot_utm.report.run import Run
    from knot_utm.report.shapes import series_of

    run = Run(arguments.folder)
    series, note = series_of(run)
    if note:
        print("export:", note.replace(" is shown", " is written"), file=sys.stderr)
    radius = run.method["material"]["radius"]
    if arguments.vtk is not None:
        from knot_utm.report.vtk_series import write_vtk_series

        os.makedirs(arguments.vtk, exist_ok=True)
        count = write_vtk_series(arguments.vtk, series, radius)
        return f"{os.path.join(arguments.vtk, 'rod.pvd')}: {count} shapes"
    from knot_utm.report.rod_gltf import rod_glb

    content, words = rod_glb(run, series, arguments.time, arguments.color)
    with open(arguments.gltf, "wb") as out:
        out.write(content)
    return f"{arguments.gltf}: {words}"


if __name__ == "__main__":
    main()
