#!/usr/bin/python3
"""Newton iterations of short tests against the table in bench/results/counted.csv, on any machine. A change that leads to more of them
makes the program slower; one that leads to fewer is to be kept in the table. bench/counted.py says how much rounding moves them."""
import os
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
ROOT = os.path.realpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "../.."))
sys.path.insert(0, os.path.join(ROOT, "bench"))

import counted  # noqa: E402
import runs  # noqa: E402

TOOLS = os.environ.get("KNOT_UTM_TOOLS_DIR", os.path.join(ROOT, "build/devel/lib/knot_utm"))


class CountedWork(unittest.TestCase):
    def test_is_that_of_the_table(self):
        table = counted.held()
        with tempfile.TemporaryDirectory() as folder:
            runner = runs.Runner(ROOT, os.path.join(TOOLS, "tensile_test"), None, folder, [], verbose=False)
            found = counted.counts(runner, {name: test.checked for name, test in counted.TESTS.items()})
        print(counted.side_by_side(table, found), flush=True)
        lines = counted.departures(table, found)
        self.assertFalse(lines, "\n" + "\n".join(lines) + f"\nWhere this is meant, `{counted.RENEW}` renews the table.")


if __name__ == "__main__":
    unittest.main()
