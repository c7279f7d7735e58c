"""The closed references: what the tests held against them, as one table."""
import json
import os
import re
import subprocess
import tempfile
from dataclasses import dataclass

from table import Gate, Table

NUMBERED = re.compile(r"(?:.*/)?([KRX]\d+)")
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


@dataclass(frozen=True)
class Row:
    """One result. Where `ours` is None the text says what is wrong."""

    what: str
    reference: object = ""
    ours: float = None
    difference: object = ""  # relative to the reference where that is not zero
    gate: Gate = Gate("a value", lambda value: True)

    @property
    def number(self):
        return number_of(self.what)

    def passes(self):
        return self.ours is not None and self.gate.test(self.ours)


def table_of(rows, missing):
    """`missing`: numbers of which no test left anything."""
    table = Table("References", ["value", "ours", "difference"])
    for row in sorted(rows + [Row(f"{number}: no test left a value") for number in missing], key=lambda row: order(row.number)):
        table.add(row.what, "-", [row.reference, row.ours, row.difference], [None, row.gate, None], ".7g")
    return table


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
                rows.append(Row(name + ": the test failed"))
    return rows


def row_of(what, numbers):
    """`numbers`: "REFERENCE OURS GATE", the gate relative to the reference, or "< BOUND OURS"."""
    first, second, third = numbers.split()
    if first == "<":
        bound = float(second)
        return Row(what, f"< {bound:g}", float(third), "", Gate("from 0", lambda value: 0.0 <= value < bound))
    reference, ours, gate = float(first), float(second), float(third)
    away = abs(ours - reference)
    return Row(what, reference, ours, away / abs(reference) if reference else away,
               Gate(f"+/- {100 * gate:g} %" if gate else "exact", lambda value: abs(value - reference) <= gate * abs(reference)))


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
            return [Row(f"{number}: {os.path.basename(tool)} ended with {done.returncode}, no report")
                    for number in {number_of(name) for name in names}]
