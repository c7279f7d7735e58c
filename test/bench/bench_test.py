#!/usr/bin/python3
"""What scripts/bench makes of runs and scripts/validate of test reports: gates, missing values, and figures that pages show."""
import math
import os
import re
import sys
import unittest

sys.dont_write_bytecode = True
ROOT = os.path.realpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "../.."))
sys.path.insert(0, os.path.join(ROOT, "bench"))

import bends  # noqa: E402
import exam  # noqa: E402
import front  # noqa: E402
import measured  # noqa: E402
import references  # noqa: E402
import runs  # noqa: E402
import specimens  # noqa: E402
from table import Table, at_least, at_most, is_, within  # noqa: E402


class Gates(unittest.TestCase):
    def test_what_is_missing_or_beyond_its_bound_fails(self):
        for gate, passes, fails in ((at_least(2.0), 2.0, 1.9), (at_most(2.0), 2.0, 2.1), (within(2.0, 3.0), 2.0, 3.1), (is_(True), True, False),
                                    (is_("sliding"), "sliding", "none")):
            table = Table("table", ["run"] * 4)
            table.add("quantity", "N", [passes, fails, None, math.nan], gate)
            self.assertEqual([table.verdict(value, gate) for value in table.rows[0][2]], ["pass", "FAIL", "FAIL", "FAIL"])
            self.assertEqual(len(table.failed()), 3)


class Runs(unittest.TestCase):
    def test_at_equal_error_peers_took_as_long_as_the_page_says(self):
        cost, error = front.PEERS[front.OURS]
        (coarse, its_error), (fine, finer_error) = (front.PEERS[f"DisMech, step of {step}"] for step in
                                                    ("0.2 s, tolerance 1e-3", "0.1 s, tolerance 3e-3, 300 N/m"))
        along = math.log(error / finer_error) / math.log(its_error / finer_error)
        said = f"DisMech took {fine * (coarse / fine) ** along / cost:.1f} times and imc-der {front.PEERS['imc-der, step of 0.2 s'][0] / cost:.1f} times"
        with open(os.path.join(ROOT, "doc/developers/performance.md"), encoding="utf-8") as page:
            self.assertIn(said, page.read())


class Shipped(unittest.TestCase):
    def test_is_what_the_bench_of_measurements_takes(self):
        facts = runs.read_yaml(measured.FACTS)
        held = [knot for name in ("greased", "ordinary", "slippery") for knot in facts[name]["slip"] + facts[name]["hold"]]
        knots = [f"surgeon_{turns}" for turns in (1, 2, 3)] + facts["orders"]["order"] + facts["slipping"]["order"] + held + list(facts["strengths"]["knots"])
        ropes = facts["orders"]["ropes"] + facts["ordinary"]["ropes"] + [facts[name]["rope"] for name in ("slipping", "greased", "slippery")]
        names = [f"knots/{knot}" for knot in knots] + [f"materials/{rope}" for rope in ropes] + [
            f"validation/{name}" for name in facts["inversions"]["photographs"]]
        for name in names:
            self.assertTrue(runs.read_yaml(f"config/{name}.yaml"), name)
        with open(os.path.join(ROOT, "doc/method.md"), encoding="utf-8") as page:
            self.assertIn(f"(`auto`: {bends.TYING_SPEED:g} radii/s;", page.read())

    def test_what_is_halved_is_what_is_shipped(self):
        with open(os.path.join(ROOT, "src/settings/measured.hpp"), encoding="utf-8") as source:
            text = source.read()
        for material, name in (("nylon", "kRollingNormal"), ("pink_vps", "kStretchingNormal")):
            step, _, contact_tolerance, presliding, _ = map(float, re.search(name + r"\{(.*?)\}", text).group(1).split(","))
            variants = specimens.gated_variants(material)
            for variant, changed in (("longest step x1/2", {"physics.max_step": step / 2}),
                                     ("contact tolerance x1/4", {"physics.contact.tolerance": contact_tolerance / 4}),
                                     ("presliding x1/2", {"physics.friction.presliding": presliding / 2})):
                self.assertEqual(variants[variant], changed)


class References(unittest.TestCase):
    def verdicts(self, test):
        rows = references.rows_of({"testsuites": [{"name": "Loads/R8Capstan", "testsuite": [{"name": "Slides/T2", **test}]}]})
        return [(row.what, row.passes()) for row in rows]

    def test_a_value_is_judged_at_its_gate_or_bound(self):
        for numbers, values in (("5.319 {} 0.01", ((5.3, True), (5.26, False), (math.nan, False))), ("0 {} 0", ((0, True), (1, False))),
                                ("< 1e-6 {}", ((0.0, True), (9e-7, True), (1e-6, False), (-1e-9, False), (math.nan, False)))):
            for ours, passes in values:
                self.assertEqual(self.verdicts({"reference: R8 capstan": numbers.format(ours)}), [("R8 capstan", passes)])

    def test_every_number_of_the_document_needs_a_value(self):
        listed = references.numbers_in(os.path.join(ROOT, "doc/references.md"))
        self.assertGreaterEqual(listed, {"K7"} | {f"R{n}" for n in (*range(1, 10), 11)})
        line, = references.table_of([references.row_of("R2 test", "1 1 0")], {"R9"}).failed()
        self.assertIn("R9: no test left a value", line)


class Exam(unittest.TestCase):
    facts = runs.read_yaml(exam.FACTS)

    def test_every_scene_needs_a_value_and_every_experiment_is_named(self):
        self.assertEqual(len(exam.report([], self.facts).failed()), len(self.facts["theirs"]))
        self.assertEqual([int(name.split()[0]) for name, _ in self.facts["experiments"]], list(range(1, 15)))
        self.assertLessEqual(exam.numbers(self.facts), references.numbers_in(os.path.join(ROOT, "doc/references.md")))

    def test_two_scenes_are_run_beside_the_results_of_others(self):
        tool = os.path.join(os.environ.get("KNOT_UTM_TOOLS_DIR", ""), "validation_tests")
        if not os.path.exists(tool):
            self.skipTest("validation_tests: not built")
        rows = references.run(tool, {"X3", "X4"}, max(os.sched_getaffinity(0)))
        self.assertEqual(len(exam.report(rows, self.facts).failed()), len(self.facts["theirs"]) - len(rows))
        self.assertEqual(len(rows), 2)


if __name__ == "__main__":
    unittest.main()
