"""Tables whose cells may have a gate, and the report made of them."""
import csv
import datetime
import json
import operator
import os
import re
import subprocess
import sys

from runs import ROOT, is_missing

REFERENCE = "(reference)"  # what the others are compared with


class Gate:
    """What a value must be. `words` says it in the table, `test` decides."""

    def __init__(self, words, test):
        self.words, self.test = words, test


def comparing(sign, compare):
    """Makes gates of bounds."""
    return lambda bound: Gate(f"{sign} {bound:g}", lambda value: compare(value, bound))


at_least, at_most, above, below = comparing(">=", operator.ge), comparing("<=", operator.le), comparing(">", operator.gt), comparing("<", operator.lt)


def within(low, high):
    return Gate(f"{low:.4g} to {high:.4g}", lambda value: low <= value <= high)


def is_(wanted):
    return Gate(text_of(wanted), lambda value: value == wanted)


def text_of(value, digits=".4g"):
    if is_missing(value):
        return "missing"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return format(value, digits)
    return str(value)


class Table:
    """One row a quantity, one column a run."""

    CSV_HEADER = ["table", "quantity", "unit", "run", "value", "gate", "verdict"]

    def __init__(self, title, columns):
        self.title, self.columns, self.rows = title, [str(column) for column in columns], []

    def add(self, quantity, unit, values, gates=None, digits=".4g"):
        """`gates`: one for all runs, or one a run; None where a run has none."""
        if not isinstance(gates, (list, tuple)):
            gates = [gates] * len(values)
        self.rows.append((quantity, unit, list(values), list(gates), digits))

    def verdict(self, value, gate):
        """"" without a gate, else pass or FAIL; a missing value fails."""
        if gate is None:
            return ""
        return "pass" if not is_missing(value) and gate.test(value) else "FAIL"

    def failed(self):
        return [f"{self.title}: {column}: {quantity} is {text_of(value, digits)}, must be {gate.words} {unit}"
                .rstrip(" -")
                for quantity, unit, values, gates, digits in self.rows
                for column, value, gate in zip(self.columns, values, gates)
                if self.verdict(value, gate) == "FAIL"]

    def cell(self, value, gate, digits):
        verdict = self.verdict(value, gate)
        return text_of(value, digits) + (f" ({gate.words}: {verdict})" if verdict else "")

    def markdown(self):
        lines = [f"## {self.title}", "", "| Quantity | Unit | " + " | ".join(self.columns) + " |",
                 "|" + " --- |" * (2 + len(self.columns))]
        for quantity, unit, values, gates, digits in self.rows:
            cells = [self.cell(value, gate, digits) for value, gate in zip(values, gates)]
            lines.append(f"| {quantity} | {unit} | " + " | ".join(cells) + " |")
        return "\n".join(lines) + "\n"

    def csv_rows(self):
        for quantity, unit, values, gates, _ in self.rows:
            for column, value, gate in zip(self.columns, values, gates):
                yield [self.title, quantity, unit, column, "" if value is None else value,
                       gate.words if gate else "", self.verdict(value, gate)]


class Report:
    """A study's tables, its picture and the words above them."""

    def __init__(self, title, introduction, tables, draw=None):
        self.title, self.introduction, self.tables, self.draw = title, introduction, tables, draw

    def text(self):
        return "\n".join(table.markdown() for table in self.tables)

    def failed(self):
        return [line for table in self.tables for line in table.failed()]

    def finish(self):
        """Prints tables and failed gates; the exit code."""
        print(self.text())
        for line in self.failed():
            print("FAILED: " + line)
        return 1 if self.failed() else 0

    def write(self, folder, name, core=None):
        """NAME.md with its picture, and NAME.csv. `core`: that the runs were confined to."""
        os.makedirs(folder, exist_ok=True)
        head = [f"# {self.title}", "", self.introduction, "", *circumstances(core), ""]
        if self.draw:
            self.draw(os.path.join(folder, name + ".png"))
            head += [f"![{self.title}]({name}.png)", ""]
        failed = self.failed()
        tail = ["", "Every gate passed."]
        if failed:
            tail = ["", "## Gates that failed", ""] + ["- " + line for line in failed]
        with open(os.path.join(folder, name + ".md"), "w", encoding="utf-8") as out:
            out.write("\n".join(head) + "\n" + self.text() + "\n".join(tail) + "\n")
        with open(os.path.join(folder, name + ".csv"), "w", encoding="utf-8", newline="") as out:
            writer = csv.writer(out)
            writer.writerow(self.tables[0].CSV_HEADER)
            for table in self.tables:
                writer.writerows(table.csv_rows())


def circumstances(core):
    """Command, commit, machine and time, without folders of this machine."""
    script = "scripts/" + os.path.splitext(os.path.basename(sys.argv[0]))[0]
    words = [re.sub(r"/\S*/", "", word) for word in sys.argv[1:]]
    commit = said_by("git", "-C", ROOT, "describe", "--always", "--dirty", "--abbrev=10").strip()
    facts = {field["field"].rstrip(":"): field["data"] for field in json.loads(said_by("lscpu", "-J") or "{}").get("lscpu", [])}
    where = "any core" if core is None else f"core {core}"
    return [f"- Command: `{' '.join([script] + words)}`", f"- Commit: {commit or 'missing (no git here)'}",
            f"- Machine: {facts.get('Model name', 'CPU model missing')}, {os.cpu_count()} cores, run on {where}; load average "
            f"when written {os.getloadavg()[0]:.1f}",
            f"- Written: {datetime.datetime.now(datetime.timezone.utc):%Y-%m-%d %H:%M} UTC"]


def said_by(*command):
    try:
        return subprocess.run(command, check=True, capture_output=True, text=True).stdout
    except (OSError, subprocess.CalledProcessError):
        return ""
