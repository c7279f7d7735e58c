"""The command line of a refinement; scripts/refine has its words."""
import argparse
import sys

from knot_utm import tool
from knot_utm.command_line import say
from knot_utm.errors import WrongInput
from knot_utm.refining import refine

PROGRAM = tool.program("refine")


def main(words):
    parser = argparse.ArgumentParser(prog=PROGRAM, add_help=False)
    parser.add_argument("study")
    parser.add_argument("--out", required=True)
    parser.add_argument("--runs", type=int, required=True)
    parser.add_argument("--seed", type=int, default=1)
    asked = parser.parse_args(words)
    for name, value, least in (("runs", asked.runs, 1), ("seed", asked.seed, 0)):
        if value < least:
            parser.error(f"--{name} is {value}, but must be at least {least}")
    try:
        print(refine(asked.study, asked.out, asked.runs, asked.seed))
    except WrongInput as wrong:
        return say(PROGRAM, wrong, 2)
    except (OSError, RuntimeError) as error:
        return say(PROGRAM, error, 1)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
