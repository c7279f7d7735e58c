"""The command line of a sweep; scripts/sweep has its words."""
import argparse
import os
import shlex
import sys

from knot_utm import tool
from knot_utm.errors import Interrupted, WrongInput
from knot_utm.sweeping import Sweep

PROGRAM = tool.program("sweep")


def main(words):
    asked = _arguments(words)
    try:
        work = Sweep(asked.study, asked.out, asked.plot)
        if asked.only == "names":
            print("\n".join(work.runs))
        elif asked.only == "check":
            work.check(asked.jobs)
        elif asked.only not in (None, "table"):
            work.one(asked.only)
        else:
            _tell(work, work.table() if asked.only else work.all(asked.jobs))
    except WrongInput as wrong:
        return _say(wrong, 2)
    except (Interrupted, OSError) as error:
        return _say(f"{error}; the same command goes on: {PROGRAM} {shlex.join(words)}", 1)
    except RuntimeError as error:
        return _say(error, 1)
    return 0


def _tell(work, table):
    if work.begun:
        print(f"{len(work.begun)} runs began with tied specimens that they share, {len(set(work.begun))} in all, which saved "
              f"{work.saved():.1f} s of computing")
    out = os.path.relpath(work.folder.path)
    if out.startswith(os.pardir):
        out = work.folder.path
    failed = int((table["exit_code"] != 0).sum())
    print(f"{len(table)} runs, {failed} of which failed: the table is in {out}/table.csv and {out}/table.h5")


def _arguments(words):
    parser = argparse.ArgumentParser(prog=PROGRAM, add_help=False)
    parser.add_argument("study")
    parser.add_argument("--out")
    parser.add_argument("--jobs", type=int, default=len(os.sched_getaffinity(0)))
    parser.add_argument("--only")
    parser.add_argument("--plot", action="append", default=[])
    asked = parser.parse_args(words)
    if asked.jobs < 1:
        parser.error(f"--jobs is {asked.jobs}, but must be at least 1")
    return asked


def _say(why, code):
    print(f"sweep: {why}", file=sys.stderr)
    return code


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
