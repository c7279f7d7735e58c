"""Makes the file of a knot from a curve of another program (scripts/knot)."""
import json
import os
import re
import subprocess
import tempfile

from knot_utm import tool
from knot_utm.errors import WrongInput
from knot_utm.knot_drawing import knot_text, leads_of, lines_of, ropes_of, strands_of, TooTight
from knot_utm.knot_shapes import curves_of
from knot_utm.knot_thickening import thickened
from knot_utm.report.commands import in_one_line, OneLineParser, refuse, why_not

SMALLER = 0.94  # radius of the rope of the next attempt
ATTEMPTS = 12
NEAREST = 2.0   # distance of strands [radii]


def asked():
    parser = OneLineParser(prog=tool.program("knot"), add_help=False, allow_abbrev=False)
    parser.add_argument("command", choices=["import"])
    parser.add_argument("shape")
    parser.add_argument("--out", required=True)
    parser.add_argument("--lower", nargs="+", default=[])
    parser.add_argument("--upper", nargs="+", default=[])
    parser.add_argument("--title")
    parser.add_argument("--overwrite", action="store_true")
    found = parser.parse_args()
    if not found.out.endswith(".yaml"):
        refuse("knot", f"--out {found.out}: the name of the file must end with .yaml")
    if why := why_not(found.out, [found.shape], found.overwrite):
        refuse("knot", f"--out: {why}")
    return found


def main():
    arguments = asked()
    try:
        said = imported(arguments)
    except WrongInput as wrong:
        refuse("knot", wrong)
    print(said)


def imported(arguments):
    """Writes the file. A curve that no rope can follow as it is, as through corners, is drawn loosely."""
    curves, note = curves_of(arguments.shape), ""
    try:
        lines, closed = lines_of(curves, arguments.lower, arguments.upper)
        try:
            if curves[0].is_flat:
                raise TooTight("a diagram is no shape in space")
            facts, text = laid(arguments, ropes_of(lines, curves), closed)
        except TooTight:
            loose = thickened(curves, lines, None if closed else leads_of(lines, arguments.lower, arguments.upper))
            if loose is None:
                raise
            facts, text = laid(arguments, ropes_of(loose, curves), closed)
            note = "shape: drawn loosely, since its corners are sharp or its strands near; no strand went through another one\n"
    except WrongInput as wrong:
        raise WrongInput(f"{arguments.shape}: {wrong}") from wrong
    with open(arguments.out, "w", encoding="utf-8") as file:
        file.write(text)
    return f"{facts.strip()}\n{note}{arguments.out}: show it by tensile_test --draw, and test it as specimen.knot"


def laid(arguments, ropes, closed):
    """What tensile_test says of a knot, and its file. Where bends that are rounded off bring strands too near to each other, the
    rope is made thinner. Raises TooTight where that does not help."""
    title = json.dumps(arguments.title or os.path.splitext(os.path.basename(arguments.shape))[0])
    source = json.dumps(os.path.basename(arguments.shape))
    for attempt in range(ATTEMPTS):
        strands = strands_of(ropes, closed, SMALLER ** attempt)
        text = knot_text(title, source, strands, arguments.lower, arguments.upper)
        facts, why = drawn(text)
        # tensile_test also takes strands that overlap a little, as a run may leave them.
        near = re.search(r"least distance of strands: (\S+) radii", facts)
        if facts and not (near and float(near[1]) < NEAREST):
            return facts, text
        why = why or f"strands are {near[1]} radii apart, but must be at least {NEAREST:g}"
    raise TooTight(f"no rope of this shape can be laid: {why}")


def drawn(text):
    """What tensile_test says of a knot, without its picture, and why it refuses it."""
    with tempfile.TemporaryDirectory() as folder:
        file = os.path.join(folder, "knot.yaml")
        with open(file, "w", encoding="utf-8") as opened:
            opened.write(text)
        done = subprocess.run([tool.tensile_test(), "--draw", file, "--out", folder], check=False, text=True, errors="replace",
                              stdin=subprocess.DEVNULL, capture_output=True)
    lines = [line for line in done.stdout.splitlines() if not line.startswith("picture: ")]
    return "\n".join(lines), tool.said_by(done.stderr).replace(file, "the knot").replace("--draw: ", "")


if __name__ == "__main__":
    with in_one_line("knot"):
        main()
