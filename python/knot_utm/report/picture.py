"""Draws runs of one test: the rod as a shaded tube on its rollers, and its curve with its phases."""
import shlex
import sys

from knot_utm.report.commands import CannotReport, files_of, in_one_line, OneLineParser, refuse, why_not


def main():
    parser = OneLineParser(prog="picture", description=__doc__)
    parser.add_argument("runs", nargs="+", metavar="RUN")
    parser.add_argument("--out", default="tighten.png", help="the picture [tighten.png]")
    parser.add_argument("--overwrite", action="store_true", help="write over a picture that exists")
    asked = parser.parse_args()
    if why := why_not(asked.out, [file for folder in asked.runs for file in files_of(folder)], asked.overwrite):
        refuse("picture", f"--out: {why}")
    with in_one_line("picture"):
        from knot_utm.report.picture_of_runs import draw
        from knot_utm.report.run import Run

        try:
            runs = [Run(folder) for folder in asked.runs]
        except CannotReport as error:
            refuse("picture", str(error))
        for run in runs:
            if not len(run.pull()):
                refuse("picture", f"{run.folder}: a run in which nothing was pulled")
        draw(runs, asked.out, shlex.join(["scripts/picture", *(word for word in sys.argv[1:] if word != "--overwrite")]))


if __name__ == "__main__":
    main()
