"""The command line of a sweep; scripts/sweep has its words."""
import os
import sys

from knot_utm import tool
from knot_utm.command_line import exit_code_of, parsed, parser_of
from knot_utm.sweeping import Sweep

PROGRAM = tool.program("sweep")


def main(words):
    parser = parser_of(PROGRAM, "study")
    parser.add_argument("--only")
    parser.add_argument("--plot", action="append", default=[])
    parser.add_argument("--readings")
    return exit_code_of(PROGRAM, lambda: _sweep(parsed(parser, words)), goes_on=True)


def _sweep(asked):
    work = Sweep(asked.study, asked.out, asked.plot, asked.readings)
    if asked.only == "names":
        print("\n".join(work.runs))
    elif asked.only == "check":
        work.check(asked.jobs)
    elif asked.only not in (None, "table"):
        work.some(asked.only)
    else:
        table, out = work.table() if asked.only else work.all(asked.jobs), os.path.relpath(work.folder.path)
        out = work.folder.path if out.startswith(os.pardir) else out
        print(f"{len(table)} runs, {(table['exit_code'] != 0).sum()} of which failed: the table is in {out}/table.csv and {out}/table.h5")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
