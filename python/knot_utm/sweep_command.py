"""The command line of a sweep; scripts/sweep has its words."""
import argparse
import os
import shlex
import sys

from knot_utm.errors import Interrupted, WrongInput
from knot_utm.sweeping import sweep

PROGRAM = "scripts/sweep"


def main(words):
    asked = _arguments(words)
    try:
        table = sweep(asked.study, asked.out, asked.jobs, asked.plot)
    except WrongInput as wrong:
        return _say(wrong, 2)
    except (Interrupted, OSError) as error:
        return _say(f"{error}; the same command goes on: {PROGRAM} {shlex.join(words)}", 1)
    except RuntimeError as error:
        return _say(error, 1)
    failed = int((table["exit_code"] != 0).sum())
    out = asked.out or os.path.join("out", os.path.splitext(os.path.basename(asked.study))[0])
    print(f"{len(table)} runs, {failed} of which failed: the table is in {out}/table.csv and {out}/table.h5")
    return 0


def _arguments(words):
    parser = argparse.ArgumentParser(prog=PROGRAM, add_help=False)
    parser.add_argument("study")
    parser.add_argument("--out")
    parser.add_argument("--jobs", type=int)
    parser.add_argument("--plot", action="append", default=[])
    asked = parser.parse_args(words)
    if asked.jobs is not None and asked.jobs < 1:
        parser.error(f"--jobs is {asked.jobs}, but must be at least 1")
    return asked


def _say(why, code):
    print(f"sweep: {why}", file=sys.stderr)
    return code


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
