"""What the command lines of a sweep, a fit, a ranking and the import of a knot have in common; the scripts have
their words."""
import os
import sys

import yaml

from knot_utm import tool
from knot_utm.errors import Interrupted, WrongInput
from knot_utm.report.commands import OneLineParser
from knot_utm.yaml_text import value_of


def parser_of(program, *read):
    """Of a command that reads files, writes a folder, and makes many runs at a time."""
    parser = OneLineParser(prog=program, add_help=False, allow_abbrev=False)
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


def settings_of(words, option="--set"):
    """{key: value} of words such as specimen.preload=20. Raises WrongInput."""
    found = {}
    for word in words:
        key, equals, text = word.partition("=")
        if not key or not equals:
            raise WrongInput(f"{option}: {word} is no KEY=VALUE, such as specimen.preload=20")
        try:
            found[key] = value_of(text)
        except yaml.YAMLError as error:
            raise WrongInput(f"{option}: {word} is no YAML: {' '.join(str(error).split())}") from error
    return found


def exit_code_of(program, work, goes_on=False):
    """Calls `work`, and returns its exit code, or what it ended by: 2 for bad input, 1 for all else that is no mistake of ours.
    Says why in a line. `goes_on`: whether the same command goes on where the work was cut off."""
    again = "; the same command goes on" if goes_on else ""
    try:
        return work()
    except WrongInput as wrong:
        return say(program, wrong, 2)
    except KeyboardInterrupt:
        return say(program, "it was interrupted", 1)
    except OSError as error:
        why = f"{error.filename}: {error.strerror.lower()}" if error.filename else str(error)
        return say(program, why + again * tool.is_of_a_full_disk(why), 1)
    except Interrupted as error:
        return say(program, f"{error}{again}", 1)
    except RuntimeError as error:
        return say(program, error, 1)


def say(program, why, code):
    """Says in a line why it ends, and returns the exit code."""
    print(f"{os.path.basename(program)}: {why}", file=sys.stderr)
    return code
