"""Scenes of a public bench of rod codes: what the tests of ours computed, beside what it found of other codes."""
import os

import references
from runs import read_yaml
from table import ROOT, Report, Table

FACTS = os.path.join(ROOT, "bench/exam.yaml")


def numbers(facts):
    return {references.number_of(what) for what in facts["theirs"]}


def report(rows, facts):
    """`rows`: those of references.run. A scene of the facts without a row fails."""
    found = {row.what: row for row in rows}
    table = Table("Scenes", ["right value", "ours", "error", *facts["codes"]])
    for what, theirs in facts["theirs"].items():
        row = found.pop(what, references.Row(what))
        table.add(what, "-", [row.reference, row.ours, row.difference, *theirs], [None, row.gate] + [None] * 4)
    for row in found.values():  # a test that failed otherwise
        table.add(row.what, "-", [row.reference, row.ours, row.difference, *["–"] * 3], [None, row.gate] + [None] * 4)
    listed = Table("Experiments", ["here"])
    for name, here in facts["experiments"]:
        listed.add(name, "-", [here])
    return Report("An exam by others",
                  f"Scenes of {facts['source']}, by its numbers, with its right values. X15 is of its findings. Ours are of the tests "
                  "of test/validation/exam_test.cpp, and errors are relative; of the other codes it is what that bench says.", [table, listed])
