"""What the command lines of a sweep, a fit and a refinement have in common; the scripts have their words."""
import argparse
import os
import sys


def parser_of(program, *read):
    """Of a command that reads files, writes a folder, and makes many runs at a time."""
    parser = argparse.ArgumentParser(prog=program, add_help=False, allow_abbrev=False)
    for name in read:
        parser.add_argument(name)
    parser.add_argument("--out")
    parser.add_argument("--jobs", type=int, default=len(os.sched_getaffinity(0)))
    return parser


def parsed(parser, words):
    asked = parser.parse_args(words)
    if asked.jobs < 1:
        parser.error(f"--jobs is {asked.jobs}, but must be at least 1")
    return asked


def say(program, why, code):
    """Says in a line why it ends, and returns the exit code."""
    print(f"{os.path.basename(program)}: {why}", file=sys.stderr)
    return code
