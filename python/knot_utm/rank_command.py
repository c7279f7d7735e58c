"""The command line of a ranking of knots; scripts/rank has its words."""
import os
import sys

from knot_utm import tool
from knot_utm.command_line import exit_code_of, parsed, parser_of, say, settings_of
from knot_utm.ranking import rank

PROGRAM = tool.program("rank")
FILE = "rank.csv"


def main(words):
    return exit_code_of(PROGRAM, lambda: _rank(_arguments(words)), tool.command_to_paste("rank", words))


def _rank(asked):
    out = asked.out or os.path.join("out", "rank")
    table = rank(asked.knots, asked.material, asked.specimens, out, asked.jobs, asked.method, settings_of(asked.set))
    table.to_csv(os.path.join(out, FILE), index=False)
    print(_told(table))
    print(f"the table is in {os.path.join(out, FILE)}")
    failed = table[table["failed"] > 0]
    for _, row in failed.iterrows():
        say(PROGRAM, f"{row['knot']}: {row['failed']} of {row['specimens']} failed: see error in {os.path.join(out, 'table.csv')}", 1)
    return 1 if len(failed) else 0


def _told(table):
    """The table for people: each mean with its standard error."""
    def cell(row, name, form):
        mean, error = row[name], row[name + "_error"]
        if mean != mean:
            return "-"
        return form % mean + (" ± " + form % error if error == error else "")

    def slip_load(row):
        return ("at least " if row["still_rose"] > 0 else "") + cell(row, "slip_load", "%.3g")

    lines = [["knot", "broke", "slip load [N]", "break load [N]", "efficiency", "tail slip [h]"]]
    for _, row in table.iterrows():
        lines.append([row["knot"], f"{row['broke']} of {row['specimens'] - row['failed']}", slip_load(row),
                      cell(row, "break_load", "%.4g"), cell(row, "efficiency", "%.2f"), cell(row, "tail_slip", "%.2g")])
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
