#!/bin/bash
# A field whose name has a unit, written by meshio: "tension [N]" on the nodes of a rod.
#
# Debian 12's python3-meshio 7.0.0-3 calls itself 5.0.0. Its .vtu keeps the name. Its .vtk refuses it, because it has a blank, and leaves
# the file half written behind. Its .ply takes it as it is into the header, where a blank ends a word: no error is raised, and meshio itself
# then cannot read the file. It has no writer of .vtp and none of .glb.
#
# Guess before the run: .vtk and .ply would put an underscore for the blank; no .vtp. Half of it was wrong.
# Why it matters: whoever exports rods with readings by meshio needs names without blanks (or .vtu), should remove what a failed .vtk left,
# and cannot use it in place of a writer of polylines (.vtp) or of a scene (.glb).
#
# usage: findings/meshio_names_with_units.sh
# It loads Debian packages into a temporary folder, installs nothing, and ends with 1 where meshio does otherwise.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
apt-get -qq download python3-meshio=7.0.0-3 python3-rich=13.3.1-1 python3-markdown-it=2.1.0-5 python3-mdurl=0.1.2-1 2>/dev/null
for package in *.deb; do dpkg -x "$package" tree; done
PYTHONPATH=tree/usr/lib/python3/dist-packages /usr/bin/python3 - <<'PYTHON'
import os
import meshio
import numpy

rod = meshio.Mesh(numpy.array([[0, 0, 0], [1, 0, 0], [2, 0, 0.]]), [("line", [[0, 1], [1, 2]])],
                  point_data={"tension [N]": numpy.array([1.0, 2.0, 3.0])})


def outcome(action, *args):
    try:
        return action(*args)
    except Exception as error:
        return f"{type(error).__name__}: {error}"


seen = {"version": meshio.__version__}
for kind in ("vtu", "vtk", "ply", "vtp", "glb"):
    name = f"rod.{kind}"
    wrote = outcome(rod.write, name)
    read = outcome(meshio.read, name) if os.path.exists(name) else "no file"
    seen[kind] = (wrote, read if isinstance(read, str) else list(read.point_data))
expected = {
    "version": "5.0.0",
    "vtu": (None, ["tension [N]"]),
    "vtk": ("WriteError: VTK doesn't support spaces in field names ('tension [N]').", "IndexError: list index out of range"),
    "ply": (None, "KeyError: 'double tension'"),
    "vtp": ("ReadError: Could not deduce file format from path 'rod.vtp'.", "no file"),
    "glb": ("ReadError: Could not deduce file format from path 'rod.glb'.", "no file"),
}
for key, value in seen.items():
    print(f"{key}: {value}" + ("" if value == expected[key] else f"   expected {expected[key]}"))
raise SystemExit(seen != expected)
PYTHON
