"""What the command lines of a sweep, a fit, a ranking and the import of a knot have in common; the scripts have
their words."""
import os

import yaml

from knot_utm.errors import refuse_if, WrongInput
from knot_utm.report.commands import in_one_line, OneLineParser
from knot_utm.yaml_text import value_of


def parser_of(program, *read):
    """The parser of a command that reads files, writes a folder, and makes many runs at a time."""
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
        refuse_if(not key or not equals, f"{option}: {word} is no KEY=VALUE, such as specimen.preload=20")
        try:
            found[key] = value_of(text)
        except yaml.YAMLError as error:
            raise WrongInput(f"{option}: {word} is no YAML: {' '.join(str(error).split())}") from error
    return found


def exit_code_of(program, work, goes_on=False):
    """What `work` returns, or the exit code with which it ends in a line (in_one_line)."""
    try:
        with in_one_line(program, goes_on):
            return work()
    except SystemExit as end:
        return end.code
