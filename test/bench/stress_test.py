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


class Outcomes(unittest.TestCase):
    GOOD = "ended_by: extension\nmax_penetration: 0.02\nknot_type_preserved: true\nwarnings: []\nplateau_force: null\n"

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def check(self, status, exit_code, result="", said="", load="1.0", knot="fisherman", distance="0.1"):
        files = {"result.yaml": result, "method.yaml": f"specimen: {{knot: {knot}}}\n",
                 "curve_full.csv": f"time,load,knot_distance,phase\ns,N,m,-\n0.1,{load},{distance},pull\n"}
        for name, text in files.items() if result else ():
            with open(os.path.join(self.folder, name), "w", encoding="utf-8") as out:
                out.write(text)
        self.assertEqual(stress.classify(runs.Run(self.folder if result else "/nowhere", 1.0, exit_code, said))[0], status)

    def test_each_status(self):
        self.check("ended", 0, self.GOOD)
        self.check("solver", 1, self.GOOD.replace("extension", "solver") + "reason: time step\n")
        self.check("ended", 1, self.GOOD.replace("extension", "untangled"))  # the physics did all that it was asked for
        self.check("not at rest", 0, self.GOOD + "not_equilibrated: true\n")
        self.check("refused", 2, said="tensile_test: m.yaml: a is b, but must be c")
        self.check("mute", 2, said="one line\nand another")
        self.check("mute", 2, self.GOOD, said="refused, and yet written")
        self.check("mute", 1, said="an exception")
        self.check("crash", 128 + 11)
        self.check("crash", 3)
        self.check("hang", 128 + 24)

    def test_a_number_that_is_none(self):
        self.check("nan", 0, self.GOOD + "peak_force: .nan\n")
        self.check("nan", 0, self.GOOD + "excess_length: [0.1, .inf]\n")
        self.check("nan", 1, self.GOOD, load="nan")
        self.check("nan", 0, self.GOOD, distance="nan")
        self.check("ended", 0, self.GOOD, distance="nan", knot="overhand")

    def test_strands_that_ran_through_each_other(self):
        self.check("tunnelled", 0, self.GOOD.replace("0.02", "0.51"))
        self.check("tunnelled", 0, self.GOOD.replace("[]", '["the rod ran through itself at 3 s"]'))

    def test_of_programs_that_really_end_so(self):
        tool = os.path.join(self.folder, "tool")
        for script, status in (("kill -SEGV $$", "crash"), ("while :; do :; done", "hang"), ("echo one line >&2; exit 2", "refused")):
            with open(tool, "w", encoding="utf-8") as out:
                out.write("#!/bin/sh\n" + script + "\n")
            os.chmod(tool, 0o755)
            runner = runs.Runner(self.folder, tool, None, self.folder, [], verbose=False)
            self.assertEqual(stress.Outcome(DRAWS[0], runner.run(*stress.task_of(runner, DRAWS[0]), cpu_limit=1)).status, status)


class Target(unittest.TestCase):
    def failed(self, *counts):
        """Of a matrix with so many runs of each status."""
        outcomes = [stress.Outcome(draw, runs.Run("/nowhere", 1.0, 0, "")) for draw in DRAWS]
        for outcome, status in zip(outcomes, [status for status, count in counts for _ in range(count)]):
            outcome.status = status
        return len(stress.Matrix(outcomes).failed())

    def test_one_in_a_hundred_may_be_given_up_and_none_may_crash_hang_or_go_wrong(self):
        self.assertEqual(self.failed(("ended", 190), ("refused", 3), ("solver", 2), ("not at rest", 5)), 0)
        self.assertEqual(self.failed(("ended", 196), ("solver", 3), ("not at rest", 1)), 1)
        for status in "crash", "hang", "nan", "tunnelled", "mute":
            self.assertEqual(self.failed(("ended", 199), (status, 1)), 1)

    def test_every_choice_is_drawn(self):
        for name, options in (("knot", set(KNOTS)), ("grips", {"rollers", "nodes", "clamps"}),
                              ("friction.law", {"memory", "smoothed", "rate"}),
                              ("twist", {"auto", "on", "off"}), ("accuracy", {"draft", "normal", "fine"}),
                              ("handedness", {"same", "opposite"}), ("turns", {1, 2, 3})):
            self.assertEqual({draw.values[name] for draw in DRAWS if name in draw.values}, options)


if __name__ == "__main__":
    unittest.main()
