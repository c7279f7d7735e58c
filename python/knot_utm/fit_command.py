"""The command line of a fit; scripts/fit has its words."""
import shlex
import signal
import sys

import yaml

from knot_utm import tool
from knot_utm.command_line import parsed, parser_of, say
from knot_utm.errors import Interrupted, WrongInput
from knot_utm.finding import fit
from knot_utm.yaml_text import value_of

PROGRAM = tool.program("fit")
READING = ("columns", "units", "specimen")  # of raw data, as compare takes them


def main(words):
    asked = _arguments(words)
    signal.signal(signal.SIGTERM, signal.default_int_handler)  # as Ctrl-C
    try:
        also = [(file, _settings(more, "--also")) for file, *more in asked.also]
        fitted = fit(asked.measured, asked.method, asked.free, asked.out, _settings(asked.set, "--set"), also, asked.jobs,
                     shlex.join([PROGRAM, *words]), not asked.no_report, _reading(asked), asked.overwrite)
    except WrongInput as wrong:
        return say(PROGRAM, wrong, 2)
    except KeyboardInterrupt:
        return say(PROGRAM, "it was interrupted", 1)
    except (Interrupted, OSError, RuntimeError) as error:
        return say(PROGRAM, error, 1)
    for key, one in fitted.found.items():
        low, high = ("?" if end is None else f"{end:.5g}" for end in (one.low, one.high))
        print(f"{key}: {one.value:.5g}, from {low} to {high}" + ("" if one.identifiable else " (not identifiable)"))
    print(f"rms: {fitted.rms:.4g} N")
    for note in fitted.notes:
        print(f"fit: {note}", file=sys.stderr)
    return 0 if fitted.fits else 1


def _settings(words, option):
    found = {}
    for word in words:
        key, equals, text = word.partition("=")
        if not key or not equals:
            raise WrongInput(f"{option}: {word} is no KEY=VALUE")
        try:
            found[key] = value_of(text)
        except yaml.YAMLError as error:
            raise WrongInput(f"{option}: {word} is no YAML: {' '.join(str(error).split())}") from error
    return found


def _reading(asked):
    """The options of `compare` for raw data."""
    words = [f"--{name}={value}" for name in READING if (value := getattr(asked, name)) is not None]
    return words + ([] if asked.invert is None else [f"--invert={asked.invert}"])


def _arguments(words):
    parser = parser_of(PROGRAM, "measured", "method")
    parser.add_argument("--free", action="extend", nargs="+", default=[])
    parser.add_argument("--also", action="append", nargs="+", default=[])
    parser.add_argument("--set", action="append", default=[])
    parser.add_argument("--no-report", action="store_true")
    parser.add_argument("--overwrite", action="store_true")
    for name in READING:
        parser.add_argument(f"--{name}")
    parser.add_argument("--invert", nargs="?", const="falling")
    return parsed(parser, words)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
