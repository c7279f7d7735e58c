"""Writes report.html and report.pdf into the folder of a test, of a batch of specimens, of a comparison, or of a fit.

    scripts/report FOLDER [--command TEXT] [--version VERSION]

The page names TEXT as the command that made it, and VERSION of knot_utm.
"""
import gc
import importlib
import os
import shlex

from knot_utm.report.commands import in_one_line, OneLineParser

# The function that makes a page, by the file that tells what a folder holds. The first is the newest where it holds two:
# `compare` takes no folder of a run, and tests take away what older tests and comparisons left.
PAGES = {"result.yaml": "run_page.report_on_run", "comparison.yaml": "comparison.report_on_comparison",
         "statistics.yaml": "batch_page.report_on_batch", "fit.yaml": "fit.report_on_fit"}


def main():
    gc.disable()  # what a page is made of is needed until it is written, and a search for garbage finds none
    parser = OneLineParser(prog="report", description=__doc__.partition("\n")[0])
    parser.add_argument("folder", help="that tensile_test, a recorder, compare --report or scripts/fit wrote")
    parser.add_argument("--command", help="that the page names as the one that made it")
    parser.add_argument("--version", help="of knot_utm, that made it", default="")
    arguments = parser.parse_args()
    if not os.path.isdir(arguments.folder):
        parser.error(f"{arguments.folder}: no such folder")
    maker = next((PAGES[name] for name in PAGES if os.path.exists(os.path.join(arguments.folder, name))), None)
    if maker is None:
        parser.error(f"{arguments.folder}: none of {', '.join(PAGES)} is there")
    command = arguments.command or "scripts/report " + shlex.quote(arguments.folder)
    with in_one_line("report"):
        module, function = maker.split(".")
        html = getattr(importlib.import_module(f"knot_utm.report.{module}"), function)(arguments.folder, command, arguments.version)
        importlib.import_module("knot_utm.report.page").write(arguments.folder, html)
    gc.freeze()  # nor does Python look for garbage as it ends


if __name__ == "__main__":
    main()
