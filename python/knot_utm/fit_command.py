"""The command line of a fit; scripts/fit has its words."""
import shlex
import signal
import sys

from knot_utm import tool
from knot_utm.command_line import exit_code_of, parsed, parser_of, settings_of
from knot_utm.finding import fit

PROGRAM = tool.program("fit")


def main(words):
    signal.signal(signal.SIGTERM, signal.default_int_handler)  # as Ctrl-C
    parser = parser_of(PROGRAM, "measured", "method")
    parser.add_argument("--free", action="extend", nargs="+", default=[])
    parser.add_argument("--also", action="append", nargs="+", default=[])
    parser.add_argument("--set", action="append", default=[])
    parser.add_argument("--no-report", action="store_true")
    parser.add_argument("--overwrite", action="store_true")
    return exit_code_of(PROGRAM, lambda: _fit(parsed(parser, words), shlex.join([PROGRAM, *words])))


def _fit(asked, command):
    also = [(file, settings_of(more, "--also")) for file, *more in asked.also]
    fitted = fit(asked.measured, asked.method, asked.free, asked.out, settings_of(asked.set), also, asked.jobs, command,
                 not asked.no_report, asked.overwrite)
    for key, one in fitted.found.items():
        low, high = ("?" if end is None else f"{end:.5g}" for end in (one.low, one.high))
        print(f"{key}: {one.value:.5g}, from {low} to {high}" + ("" if one.identifiable else " (not identifiable)"))
    print(f"rms: {fitted.rms:.4g} N")
    for note in fitted.notes:
        print(f"fit: {note}", file=sys.stderr)
    return 0 if fitted.fits else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
