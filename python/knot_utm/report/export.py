"""Writes the rod of a test for other programs: over time for ParaView, or as it lay at one time for slides and the web.

    scripts/export DIR --vtk OUT
    scripts/export DIR --gltf OUT.glb [--color NAME] [--time SECONDS] [--overwrite]

DIR is the folder of a test. Its shapes over time are those of shapes.csv (tensile_test --shapes), else of test.bag; without
them there is the final shape alone.
"""
import argparse
import os
import sys

from knot_utm.report.commands import CannotReport, files_of, in_one_line, OneLineParser, why_not

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
    with in_one_line("export"):
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
    shapes = [series.shape(i) for i in range(len(series))]
    if arguments.vtk is not None:
        return over_time(arguments.vtk, shapes, run.method["material"]["radius"])
    return at_one_time(arguments, run, shapes, shapes[-1] if arguments.time is None else series.at(arguments.time))


def over_time(folder, shapes, radius):
    """rod.pvd, and of each shape rod_000.vtp and so on. Every file has the same arrays: NaN where a value is not known."""
    import numpy as np

    from knot_utm.report.colours import names_known, node_values
    from knot_utm.report.mesh_files import write_pvd, write_vtp
    from knot_utm.report.shapes import lengths, pieces
    from knot_utm.report.tube import rod_mesh

    os.makedirs(folder, exist_ok=True)
    names, files = names_known(shapes), [f"rod_{number:03d}.vtp" for number in range(len(shapes))]
    along = np.concatenate([[0.0], np.cumsum(lengths(shapes[0]))])
    for file, shape in zip(files, shapes):
        unknown = np.full(len(shape.points), np.nan)
        of_nodes = {**dict.fromkeys(names, unknown), **node_values(shape), "arclength": along if len(along) == len(unknown) else unknown}
        mesh = rod_mesh(shape.points, pieces(shape, shapes[0]), radius)
        write_vtp(os.path.join(folder, file), mesh, {name: values[mesh.along.astype(int)] for name, values in of_nodes.items()})
    pvd = os.path.join(folder, "rod.pvd")
    write_pvd(pvd, [shape.time for shape in shapes], files)
    return f"{pvd}: {len(shapes)} shapes"


def at_one_time(arguments, run, shapes, shape):
    import numpy as np

    from knot_utm.report.colours import colour_scales, node_values
    from knot_utm.report.mesh_files import glb
    from knot_utm.report.rod_pictures import UNKNOWN
    from knot_utm.report.shapes import pieces
    from knot_utm.report.tube import rod_mesh

    radius, values = run.method["material"]["radius"], node_values(shape)
    scales = {scale.name: scale for scale in colour_scales(shapes, radius, run.units) if scale.name in values}
    if arguments.color and arguments.color not in scales:
        raise CannotReport(f"{run.folder}: --color {arguments.color}: it is not known at {shape.time:g} s; known are: "
                           f"{', '.join(name for name in values if name in scales)}")
    scale = scales.get(arguments.color or "tension")
    mesh = rod_mesh(shape.points, pieces(shape, shapes[0]), radius)
    colours = scale.of(values[scale.name][mesh.along.astype(int)]) if scale else np.tile(UNKNOWN, (len(mesh.points), 1))
    with open(arguments.gltf, "wb") as out:
        out.write(glb(mesh, colours, "rod"))
    in_colours = f"coloured by its {scale.label()}" if scale else "in one colour, as no tension is known then"
    return f"{arguments.gltf}: the rod at {shape.time:g} s, {in_colours}"


if __name__ == "__main__":
    main()
