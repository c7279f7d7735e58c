#!/usr/bin/python3
"""What scripts/stress draws, and what it calls what became of a run."""
import os
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../bench"))

import runs  # noqa: E402
import stress  # noqa: E402
from draws import KNOTS, Draw  # noqa: E402

DRAWS = [Draw(1, number) for number in range(200)]


class Draws(unittest.TestCase):
    def test_same_seed_and_number_same_test(self):
        again = Draw(1, 17)
        self.assertEqual(again.settings, DRAWS[17].settings)
        self.assertEqual(again.values, DRAWS[17].values)
        self.assertNotEqual(again.settings, Draw(2, 17).settings)
        self.assertNotEqual(again.settings, Draw(1, 18).settings)

    def test_every_choice_is_drawn(self):
        for name, options in (("knot", set(KNOTS)), ("grips", {"rollers", "nodes", "clamps"}),
                              ("friction.law", {"memory", "smoothed", "rate"}), ("contact.law", {"smooth", "edge"}),
                              ("twist", {"auto", "on", "off"}), ("accuracy", {"draft", "normal", "fine"}),
                              ("handedness", {"same", "opposite"}), ("turns", {1, 2, 3})):
            self.assertEqual({draw.values[name] for draw in DRAWS if name in draw.values}, options)


class Outcomes(unittest.TestCase):
    GOOD = "ended_by: extension\nmax_penetration: 0.02\nknot_type_preserved: true\nwarnings: []\nplateau_force: null\n"

    def run_of(self, exit_code, result="", said="", load="1.0", knot="fisherman", distance="0.1"):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        files = {"result.yaml": result, "method.yaml": f"specimen: {{knot: {knot}}}\n",
                 "curve_full.csv": f"time,load,knot_distance,phase\ns,N,m,-\n0.1,{load},{distance},pull\n"}
        for name, text in files.items() if result else ():
            with open(os.path.join(folder.name, name), "w", encoding="utf-8") as out:
                out.write(text)
        return runs.Run(folder.name, 1.0, exit_code, said)

    def status(self, *args, **kwargs):
        return stress.classify(self.run_of(*args, **kwargs))[0]

    def test_each_status(self):
        solver = self.GOOD.replace("extension", "solver") + "reason: time step\n"
        self.assertEqual(self.status(0, self.GOOD), "ended")
        self.assertEqual(self.status(1, solver), "solver")
        # The physics did all that it was asked for.
        self.assertEqual(self.status(1, self.GOOD.replace("extension", "untangled")), "ended")
        self.assertEqual(self.status(0, self.GOOD + "not_equilibrated: true\n"), "not at rest")
        self.assertEqual(self.status(2, said="tensile_test: m.yaml: a is b, but must be c"), "refused")
        self.assertEqual(self.status(2, said="one line\nand another"), "mute")
        self.assertEqual(self.status(2, self.GOOD, said="refused, and yet written"), "mute")
        self.assertEqual(self.status(1, said="an exception"), "mute")
        self.assertEqual(self.status(128 + 11), "crash")
        self.assertEqual(self.status(3), "crash")
        self.assertEqual(self.status(128 + 24), "hang")

    def test_a_number_that_is_none(self):
        self.assertEqual(self.status(0, self.GOOD + "peak_force: .nan\n"), "nan")
        self.assertEqual(self.status(0, self.GOOD + "excess_length: [0.1, .inf]\n"), "nan")
        self.assertEqual(self.status(1, self.GOOD, load="nan"), "nan")
        self.assertEqual(self.status(0, self.GOOD, distance="nan"), "nan")
        self.assertEqual(self.status(0, self.GOOD, distance="nan", knot="overhand"), "ended")

    def test_strands_that_ran_through_each_other(self):
        deep = self.GOOD.replace("0.02", "0.51")
        crossed = self.GOOD.replace("[]", '["the rod ran through itself at 3 s"]')
        self.assertEqual(self.status(0, deep), "tunnelled")
        self.assertEqual(self.status(0, crossed), "tunnelled")
        self.assertEqual(self.status(0, self.GOOD.replace("true", "false")), "ended")

    def started(self, script):
        """What a program that does this is called."""
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        tool = os.path.join(folder.name, "tool")
        with open(tool, "w", encoding="utf-8") as out:
            out.write("#!/bin/sh\n" + script + "\n")
        os.chmod(tool, 0o755)
        runner = runs.Runner(folder.name, tool, None, folder.name, [], verbose=False)
        return stress.Outcome(DRAWS[0], runner.run(*stress.task_of(runner, DRAWS[0]), cpu_limit=1)).status

    def test_of_programs_that_really_end_so(self):
        self.assertEqual(self.started("kill -SEGV $$"), "crash")
        self.assertEqual(self.started("while :; do :; done"), "hang")
        self.assertEqual(self.started("echo one line >&2; exit 2"), "refused")


class Target(unittest.TestCase):
    def failed(self, *counts):
        """Of a matrix with so many runs of each status."""
        all_outcomes = []
        for status, count in counts:
            for _ in range(count):
                outcome = stress.Outcome(DRAWS[len(all_outcomes)], runs.Run("/nowhere", 1.0, 0, ""))
                outcome.status, outcome.reason = status, "a reason"
                all_outcomes.append(outcome)
        matrix = stress.Matrix(all_outcomes)
        self.assertEqual(len(list(matrix.csv_rows())), len(all_outcomes))
        self.assertTrue(all(len(row) == len(matrix.CSV_HEADER) for row in matrix.csv_rows()))
        self.assertEqual(matrix.markdown().count("a reason"), sum(n for status, n in counts if status != "ended"))
        return len(matrix.failed())

    def test_one_in_a_hundred_may_be_given_up(self):
        self.assertEqual(self.failed(("ended", 190), ("refused", 3), ("solver", 2), ("not at rest", 5)), 0)
        self.assertEqual(self.failed(("ended", 196), ("solver", 3), ("not at rest", 1)), 1)

    def test_none_may_crash_hang_or_go_wrong(self):
        for status in stress.NEVER:
            self.assertEqual(self.failed(("ended", 199), (status, 1)), 1)


if __name__ == "__main__":
    unittest.main()
