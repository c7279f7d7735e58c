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


class Departures(unittest.TestCase):
    def departures(self, iterations, scatter=0.001, exit_code=0):
        each = []
        for value in iterations:
            run = runs.Run("/nowhere", 1.0, exit_code, "")
            run.result = {"newton_iterations": value, "steps": 10, "rejected_steps": 1}
            each.append(run)
        row = {counted.ITERATIONS: "1000", counted.SCATTER: str(scatter), counted.STEPS: "10", counted.REJECTED: "1"}
        return counted.departures({"rope": counted.Held(row)}, {"rope": counted.Count(each)})

    def test_more_and_fewer_iterations_fail_and_a_mean_within_three_per_cent_passes(self):
        self.assertEqual(self.departures([1029, 971, 1040, 960]), [])
        for value in (1031, 969):
            self.assertEqual(len(self.departures([value])), 1)

    def test_a_test_that_scatters_has_a_wider_bound_and_a_narrower_one_with_more_starts(self):
        self.assertEqual(self.departures([1070], 0.02), [])
        self.assertEqual(len(self.departures([1070] * 12, 0.02)), 1)

    def test_a_run_that_failed_fails_and_so_does_a_test_without_a_row(self):
        self.assertIn("a run failed", self.departures([1000], exit_code=1)[0])
        self.assertIn("a run failed", self.departures([1000, None])[0])
        count = counted.Count([runs.Run("/nowhere", 1.0, 0, "")])
        count.iterations = [1000]
        self.assertIn("no such test", counted.departures({}, {"rope": count})[0])
        self.assertIn("no test has", counted.departures(counted.held(), {})[0])


if __name__ == "__main__":
    unittest.main()
