#!/usr/bin/python3
"""Writes report.html and report.pdf into the folder of a test, of a batch of specimens, of a comparison, or of a fit.

    make_report.py FOLDER [--command TEXT] [--version VERSION]

The page names TEXT as the command that made it, and VERSION of knot_utm.
"""
import argparse
import os
import shlex
import sys

from knot_utm.report.failure import CannotReport, in_one_line

# Debian's name of what a module is in.
PACKAGES = {"matplotlib": "python3-matplotlib", "numpy": "python3-numpy", "yaml": "python3-yaml",
            "jinja2": "python3-jinja2", "weasyprint": "weasyprint"}


class OneLineParser(argparse.ArgumentParser):
    def error(self, message):
        refuse(self.prog, message)


def refuse(program, message):
    """Bad input."""
    print(f"{program}:", message.encode("utf-8", "backslashreplace").decode("utf-8"), file=sys.stderr)
    sys.exit(2)


def main():
    parser = OneLineParser(prog="report", description="Writes report.html and report.pdf into the folder of "
                                     "a test, of a batch of specimens, of a comparison, or of a fit.")
    parser.add_argument("folder", help="that tensile_test, a recorder, compare --report or scripts/fit wrote")
    parser.add_argument("--command", help="that the page names as the one that made it")
    parser.add_argument("--version", help="of knot_utm, that made it", default="")
    arguments = parser.parse_args()
    if not os.path.isdir(arguments.folder):
        parser.error(f"{arguments.folder}: no such folder")
    command = arguments.command or "scripts/report " + shlex.quote(arguments.folder)
    with in_one_line("report", PACKAGES):
        make(arguments.folder, command, arguments.version)


def make(folder, command, version):
    # The first is the newest where a folder holds two: `compare` takes no folder of a run, and tests take away what
    # older tests and comparisons left.
    kinds = {"result.yaml": "run", "comparison.yaml": "comparison", "statistics.yaml": "batch", "fit.yaml": "fit"}
    kind = next((kinds[name] for name in kinds if os.path.exists(os.path.join(folder, name))), None)
    if kind is None:
        raise CannotReport(f"{folder}: none of {', '.join(kinds)} is there")
    from knot_utm.report import batch_page
    from knot_utm.report import fit_page
    from knot_utm.report import page
    from knot_utm.report import typefaces

    makers = {"run": page.report_on_run, "comparison": page.report_on_comparison, "batch": batch_page.report_on_batch,
              "fit": fit_page.report_on_fit}
    html = makers[kind](folder, command, version)
    page.write(folder, html)
    if line := typefaces.told(typefaces.without_typeface(html)):
        print("report:", line, file=sys.stderr)


if __name__ == "__main__":
    main()
