"""The closed references: what the tests held against them, as one table."""
import json
import math
import os
import re
import subprocess
import tempfile

from table import text_of

NUMBERED = re.compile(r"(?:.*/)?([KR]\d+)")
PROPERTY = "reference: "  # of a test's report, written by test/reference.hpp


def number_of(text):
    """The number, such as R8, that a reference's or a test's name begins with; None where it has none."""
    found = NUMBERED.match(text)
    return found.group(1) if found else None


def order(number):
    """K1, K2 ... R1 ... R15."""
    return number[0], int(number[1:])


def numbers_in(document):
    """Numbers of the references that a document's tables list."""
    with open(document, encoding="utf-8") as text:
        return {number_of(line[2:]) for line in text if line.startswith("| ")} - {None}


class Row:
    """One result. Without numbers, `remark` says what is wrong."""

    def __init__(self, what, reference=None, ours=None, gate=None, is_bound=False, remark=""):
        self.what, self.reference, self.ours, self.gate = what, reference, ours, gate
        self.is_bound, self.remark = is_bound, remark
        self.number = number_of(what)

    def difference(self):
        """Relative to the reference where that is not zero; None of a bound."""
        if self.is_bound or self.ours is None:
            return None
        away = abs(self.ours - self.reference)
        return away / abs(self.reference) if self.reference else away

    def passes(self):
        if self.ours is None or not math.isfinite(self.ours):
            return False
        if self.is_bound:
            return 0.0 <= self.ours < self.reference
        return abs(self.ours - self.reference) <= self.gate * abs(self.reference)

    def cells(self):
        if self.ours is None:
            return [self.what, "", self.remark, "", "", "FAIL"]
        difference = self.difference()
        return [self.what, ("< " if self.is_bound else "") + text_of(self.reference, ".7g"),
                text_of(self.ours, ".7g"), "" if difference is None else percent(difference),
                "" if self.is_bound else percent(self.gate) if self.gate else "exact",
                "pass" if self.passes() else "FAIL"]


def percent(share):
    return "0" if share == 0 else f"{100 * share:.2g} %"


class References:
    """The table that a report (table.py) is made of."""

    CSV_HEADER = ["reference", "value", "ours", "difference", "gate", "verdict"]
    HEADER = ["Reference", "Value", "Ours", "Difference", "Gate", "Verdict"]

    def __init__(self, rows, missing):
        """`missing`: numbers of which no test left anything."""
        none = [Row(number, remark="no test left a value") for number in missing]
        self.rows = sorted(rows + none, key=lambda row: order(row.number))

    def text(self):
        lines = [self.HEADER] + [row.cells() for row in self.rows]
        widths = [max(len(line[k]) for line in lines) for k in range(len(self.HEADER))]
        return "".join("  ".join(cell.ljust(width) for cell, width in zip(line, widths)).rstrip() + "\n"
                       for line in lines)

    def markdown(self):
        lines = [self.HEADER, ["---"] * len(self.HEADER)] + [row.cells() for row in self.rows]
        return "".join("| " + " | ".join(line) + " |\n" for line in lines)

    def csv_rows(self):
        for row in self.rows:
            difference = row.difference()
            yield [row.what, "" if row.reference is None else row.reference,
                   row.remark if row.ours is None else row.ours, "" if difference is None else difference,
                   "bound" if row.is_bound else "" if row.gate is None else row.gate,
                   "pass" if row.passes() else "FAIL"]

    def failed(self):
        lines = []
        for row in self.rows:
            what, reference, ours, difference, gate, _ = row.cells()
            if not row.passes():
                lines.append(f"{what}: {ours}" + (f", must be {reference}" if reference else "") +
                             (f", off by {difference}, gate {gate}" if difference else ""))
        return lines


def rows_of(report):
    """What a report of Google Test (--gtest_output=json) has to say of references."""
    rows = []
    for suite in report["testsuites"]:
        for test in suite["testsuite"]:
            name = suite["name"].split("/")[-1] + "." + test["name"]
            held = [row_of(key[len(PROPERTY):], value) for key, value in test.items() if key.startswith(PROPERTY)]
            rows += held
            # Where something else than a value that was held made it fail, the table must not pass over it.
            if test.get("failures") and all(row.passes() for row in held):
                rows.append(Row(name, remark="the test failed" if held else "the test failed, no value"))
    return rows


def row_of(what, numbers):
    words = numbers.split()
    if words[0] == "<":
        return Row(what, float(words[1]), float(words[2]), is_bound=True)
    return Row(what, *(float(word) for word in words))


def tests_of(tool, chosen):
    """Names of the tests of a Google Test executable whose suites begin with a number (of `chosen`, where given)."""
    listed = subprocess.run([tool, "--gtest_list_tests"], check=True, capture_output=True, text=True).stdout
    names, suite = [], ""
    for line in listed.splitlines():
        entry = line.split("#")[0].rstrip()
        if entry.endswith(".") and not entry.startswith(" "):
            suite = entry
        elif entry.startswith("  "):
            number = number_of(suite)
            if number and (chosen is None or number in chosen):
                names.append(suite + entry.strip())
    return names


def run(tool, chosen, core):
    """Rows of the tests of an executable, run on one core."""
    names = tests_of(tool, chosen)
    if not names:
        return []
    with tempfile.TemporaryDirectory() as folder:
        file = os.path.join(folder, "report.json")
        command = [tool, "--gtest_brief=1", "--gtest_filter=" + ":".join(names), "--gtest_output=json:" + file]
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace",
                              preexec_fn=lambda: os.sched_setaffinity(0, {core}), check=False)
        try:
            with open(file, encoding="utf-8") as report:
                return rows_of(json.load(report))
        except (OSError, ValueError):
            print(done.stdout[-2000:])
            return [Row(number, remark=f"{os.path.basename(tool)} ended with {done.returncode}, no report")
                    for number in {number_of(name) for name in names}]
