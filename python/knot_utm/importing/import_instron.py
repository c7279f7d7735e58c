#!/usr/bin/python3
"""Writes the raw data of a testing machine as a curve.csv, or as a bag with the topics utm/crosshead and utm/load_cell."""
import math
import os
import subprocess
import sys
import tempfile

if not __package__:  # called as a program: by its link beside the others, or as it was installed there
    own = os.path.dirname(os.path.realpath(__file__))
    installed = os.path.join(own, "../python3/dist-packages")
    sys.path[0] = installed if os.path.isdir(installed) else os.path.join(own, "../..")

from knot_utm import tool
from knot_utm.command_line import exit_code_of
from knot_utm.errors import refuse_if, WrongInput
from knot_utm.importing.table import INVERT, parsed_columns, read_record, Reading
from knot_utm.report.commands import OneLineParser, why_not

PROGRAM = "import_instron"
HELPER = "write_curve_bag"
PULLS = "pull", "cycle", "follow"
MOVED, STILL = 0.01, 0.001  # of all growth of the extension: the pull has begun; at the same place
BEGINS = {True: b"#ROSBAG", False: b"time,"}  # of what --overwrite replaces: a bag, or a curve.csv


def main(words):
    for stream in (sys.stdout, sys.stderr):  # names of files are bytes
        stream.reconfigure(errors="surrogateescape")
    if "--version" in words:
        print(tool.package_version())
        return 0
    # A value of --invert only stands behind "=": a file may follow.
    asked = _parser().parse_args(["--invert=falling" if word == "--invert" else word for word in words])
    return exit_code_of(PROGRAM, lambda: _import(asked))


def _import(asked):
    file, out, is_bag = asked.raw_data, asked.out, not asked.out.endswith(".csv")
    _require_new(out, file, asked.overwrite, BEGINS[is_bag])
    record = read_record(file, reading_of(asked, is_bag))
    given = [f"--{name}" for name in ("columns", "units", "invert", "specimen", "rate", "join") if getattr(asked, name)]
    if record.is_own and given:
        record.notes.append(f"{file}: the curve is one of knot_utm, for which {' and '.join(given)} change{'s' * (len(given) == 1)} nothing")
    if asked.balance:
        record = balanced(record, file)
    if is_bag:
        _write_bag(out, record, file)
    else:
        write_curve(out, record)
    if not asked.quiet:
        times = record.columns["time"]
        over = f" over {times[-1] - times[0]:g} s" if times and math.isfinite(times[0]) else ""
        print(*record.notes, f"{len(times)} {'reading' if len(times) == 1 else 'readings'}{over} written to {out}", sep="\n")
    return 0


def reading_of(asked, needs_time):
    """What the options say. Raises WrongInput."""
    columns, units = (parsed_columns(text, option) if text is not None else ("", "", "")
                      for text, option in ((asked.columns, "--columns"), (asked.units, "--units")))
    refuse_if(asked.specimen is not None and asked.specimen < 1, f"--specimen is {asked.specimen}, but must be a number from 1 on")
    if asked.rate is not None and not 0.0 < asked.rate < math.inf:
        raise WrongInput(f"--rate is {asked.rate:g}, but must be readings per second, above 0")
    return Reading(columns, units, asked.specimen or 0, asked.invert or "", needs_time, asked.join, asked.rate or 0.0)


def balanced(record, file):
    """From the last reading at rest on, with load and extension zero there, as `compare` balances raw data (analysis/raw_zero.hpp). A
    curve that has its zero stays as it is. Raises WrongInput."""
    s, load = record.columns["extension"], record.columns["load"]
    if any(map(math.isfinite, record.columns["end_to_end"])):
        return record._replace(notes=[*record.notes, f"{file}: the curve has its zero, so that --balance changes nothing"])
    rows = [row for row, phase in enumerate(record.columns["phase"]) if phase in PULLS]
    growth = max((s[row] - s[rows[0]] for row in rows), default=0.0)
    if not growth > 0.0:
        raise WrongInput(f"{file}: {'there is no travel' if math.isnan(growth) else 'nothing is pulled'}, so that --balance finds no zero: no "
                         "reading has a larger extension than the first one")
    begun = next(i for i, row in enumerate(rows) if s[row] > s[rows[0]] + MOVED * growth)
    first = max(i for i in range(begun) if s[rows[i]] <= s[rows[0]])
    last, rest = rows[first], []
    for row in rows[first::-1]:
        if abs(s[row] - s[last]) > STILL * growth:
            break
        rest.append(row)
    zeros = {name: values[last] + sum(values[row] - values[last] for row in rest) / len(rest)
             for name, values in (("extension", s), ("load", load))}
    columns = {name: [values[row] - zeros[name] if name in zeros else values[row] for row in rows[first:]]
               for name, values in record.columns.items()}
    count = f"the mean of its {len(rest)} readings before the crosshead moves" if len(rest) > 1 else "its first reading: it shows no rest"
    return record._replace(columns=columns, notes=[*record.notes, f"{file}: zero is {zeros['load']:.6g} N at {zeros['extension']:.6g} m, {count}"])


def write_curve(file, record):
    """As curve.csv. Raises OSError."""
    with open(file, "w", encoding="utf-8") as out:
        for row in (record.units, record.units.values(), *zip(*record.columns.values())):
            print(*(cell if isinstance(cell, str) else repr(cell + 0.0).removesuffix(".0") for cell in row), sep=",", file=out)


def _write_bag(file, record, source):
    """By a program in C++, which writes the messages of a test."""
    helper = os.path.join(os.path.dirname(os.path.abspath(sys.argv[0])), HELPER)
    if not os.path.exists(helper):
        helper = os.path.join(os.path.dirname(tool.tensile_test()), HELPER)
    with tempfile.TemporaryDirectory() as folder:
        curve = os.path.join(folder, "curve.csv")
        write_curve(curve, record)
        try:
            done = subprocess.run([helper, curve, file], check=False, capture_output=True, text=True, errors="replace")
        except FileNotFoundError as error:
            raise RuntimeError(f"{helper} is not there, which writes bags and is built with ROS; a name that ends in .csv gives a "
                               "curve.csv") from error
    said = tool.said_by(done.stderr).removeprefix(f"{HELPER}: ").replace(curve, source)
    if done.returncode:
        raise (WrongInput if done.returncode == 2 else RuntimeError)(said)


def _require_new(out, file, overwrite, begins):
    """A file of another kind is not replaced either. Raises WrongInput."""
    if why := why_not(out, [file], overwrite):
        raise RuntimeError(why) if why.startswith("cannot") else WrongInput(f"OUT: {why}")
    if os.path.isfile(out):
        with open(out, "rb") as opened:
            if opened.read(len(begins)) != begins:
                raise WrongInput(f"OUT: {out} is a file of another kind, which --overwrite does not replace: give another name")


def _parser():
    parser = OneLineParser(prog=PROGRAM, description=__doc__, allow_abbrev=False)
    parser.add_argument("raw_data", metavar="RAW_DATA", help="the exported table")
    parser.add_argument("out", metavar="OUT", help="what is to be written: NAME.csv, else a bag")
    parser.add_argument("--columns", help="by name or number: time=NAME,extension=NAME,load=NAME, or one or two of these")
    parser.add_argument("--units", help="time=s,extension=in,load=lbf, or one or two of these")
    parser.add_argument("--specimen", type=int, help="which specimen of a file with several, from 1")
    parser.add_argument("--invert", choices=INVERT, help="turn the sign of what falls in the pull, or, as --invert=load, of these")
    parser.add_argument("--join", action="store_true", help="shift what is before the crosshead was set to zero, to go on there")
    parser.add_argument("--rate", type=float, help="readings per second, where the file has no times or says another rate")
    parser.add_argument("--balance", action="store_true", help="begin where the crosshead begins to move, with the zero there")
    parser.add_argument("--overwrite", action="store_true", help="replace a file that an import wrote")
    parser.add_argument("--quiet", action="store_true", help="say only what went wrong")
    parser.add_argument("--version", action="store_true", help="say which version this is")
    return parser


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
