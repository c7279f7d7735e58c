"""The command line of a ranking of knots; scripts/rank has its words."""
import csv
import os
import sys

from knot_utm import tool
from knot_utm.command_line import exit_code_of, parsed, parser_of, say, settings_of
from knot_utm.errors import WrongInput
from knot_utm.ranking import about_of, rank, usual_folder

PROGRAM = tool.program("rank")
FILE = "rank.csv"
EXACT = 1e-9  # of a mean: a smaller error is rounding


def main(words):
    return exit_code_of(PROGRAM, lambda: _rank(_arguments(words)), tool.command_to_paste("rank", words))


def _rank(asked):
    settings = settings_of(asked.set)
    out = asked.out or usual_folder(asked.material)
    file = os.path.join(out, FILE)
    about = about_of(asked.material, asked.method, settings)
    _require_same(file, about)
    table = rank(asked.knots, asked.material, asked.specimens, out, asked.jobs, asked.method, settings)
    table.to_csv(file, index=False)
    print(f"{_words(about)}:")
    print(_told(table))
    print(f"the table is in {file}")
    failed = table[table["failed"] > 0]
    for _, row in failed.iterrows():
        say(PROGRAM, f"{row['knot']}: {row['failed']} of {row['specimens']} failed: see error in {os.path.join(out, 'table.csv')}", 1)
    return 1 if len(failed) else 0


def _words(about):
    return f"in {about['material']}, by {about['method']}" + (f" with {about['settings']}" if about["settings"] else "")


def _require_same(file, about):
    """Raises WrongInput where a table is there that is of another material, method or settings: one table is of one."""
    if not os.path.lexists(file):
        return
    try:
        with open(file, encoding="utf-8", newline="") as opened:
            had = next(csv.DictReader(opened), {})
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise WrongInput(f"{file} cannot be read, and is not written over: choose another folder (--out)") from error
    had = {name: had.get(name) for name in about}
    if had != about:
        whose = f"of knots {_words(had)}" if all(text is not None for text in had.values()) else "no table of a ranking"
        raise WrongInput(f"{file} is {whose}: choose another folder (--out)")


def mean_and_error(mean, error):
    """As text: the error with two digits, and the mean to the same place; three digits of one without an error."""
    if mean != mean:
        return "-"
    if error != error:
        return f"{mean:.3g}"
    if error <= EXACT * abs(mean):
        return f"{mean:.4g} ± 0"
    places = 1 - int(f"{error:.1e}".split("e")[1])
    return " ± ".join(f"{round(value, places):.{max(places, 0)}f}" for value in (mean, error))


def _told(table):
    """The table for people: each mean with its standard error."""
    def cell(row, name):
        return mean_and_error(row[name], row[name + "_error"])

    def slip_load(row):
        return ("at least " if row["still_rose"] > 0 else "") + cell(row, "slip_load")

    lines = [["knot", "broke", "slip load [N]", "break load [N]", "efficiency", "tail slip [h]"]]
    for _, row in table.iterrows():
        lines.append([row["knot"], f"{row['broke']} of {row['specimens'] - row['failed']}", slip_load(row),
                      cell(row, "break_load"), cell(row, "efficiency"), cell(row, "tail_slip")])
    widths = [max(len(line[i]) for line in lines) for i in range(len(lines[0]))]
    return "\n".join("  ".join(text.ljust(width) for text, width in zip(line, widths)).rstrip() for line in lines)


def _arguments(words):
    parser = parser_of(PROGRAM)
    parser.add_argument("knots", nargs="+")
    parser.add_argument("--material", default="nylon")
    parser.add_argument("--specimens", type=int, default=3)
    parser.add_argument("--method", default="knot")
    parser.add_argument("--set", action="append", default=[])
    return parsed(parser, words)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
