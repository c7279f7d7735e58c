#!/usr/bin/python3
"""What scripts/bench makes of runs and scripts/validate of test reports: gates, missing values, slopes."""
import math
import os
import re
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../bench"))

import front  # noqa: E402
import readings  # noqa: E402
import references  # noqa: E402
import runs  # noqa: E402
import specimens  # noqa: E402
import tighten  # noqa: E402
from table import Table, at_least, at_most, is_, within  # noqa: E402


class Gates(unittest.TestCase):
    def failed(self, value, gate):
        table = Table("table", ["run"])
        table.add("quantity", "N", [value], gate)
        return table.failed()

    def test_pass_and_fail(self):
        for value, gate in ((2.0, at_least(2.0)), (2.0, at_most(2.0)), (2.0, within(2.0, 3.0)), (True, is_(True))):
            self.assertEqual(self.failed(value, gate), [])
        for value, gate in ((1.9, at_least(2.0)), (2.1, at_most(2.0)), (3.1, within(2.0, 3.0)), (False, is_(True)),
                            ("none", is_("sliding"))):
            self.assertEqual(len(self.failed(value, gate)), 1)

    def test_a_missing_value_fails_its_gate_and_is_printed_as_missing(self):
        for missing in (None, math.nan):
            self.assertIn("missing", self.failed(missing, at_most(1.0))[0])
            table = Table("table", ["run"])
            table.add("quantity", "N", [missing])
            self.assertIn("missing", table.markdown())
            self.assertEqual(table.failed(), [])


class Specimens(unittest.TestCase):
    def test_are_the_same_however_many_are_drawn(self):
        self.assertEqual(specimens.specimens(20)[:12], specimens.specimens(12))

    def test_the_change_of_a_mean_may_lie_as_far_beyond_the_bound_as_its_standard_error(self):
        reference = [4.0] * 4
        for values, passes in (([4.079] * 4, True), ([4.081] * 4, False), ([4.0, 4.2, 4.0, 4.2], True),
                               ([4.1, 4.3, 4.1, 4.3], False), ([3.9, 3.7, 3.9, 3.7], False), ([4.0, None, 4.0, 4.0], False)):
            change = specimens.Change(values, reference)
            self.assertEqual(change.gate().test(change.relative), passes, values)


class Runs(unittest.TestCase):
    def run_of(self, result, rows):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        with open(os.path.join(folder.name, "result.yaml"), "w", encoding="utf-8") as out:
            out.write(result)
        with open(os.path.join(folder.name, "curve_full.csv"), "w", encoding="utf-8") as out:
            out.write("time,extension,load,knot_distance,end_to_end,load_lower,phase\ns,m,N,m,m,N,-\n")
            out.writelines(",".join(map(str, row)) + "\n" for row in rows)
        return runs.Run(folder.name, 2.0, 0, "")

    def test_slope_of_sliding_knots_is_the_one_in_the_result(self):
        rows = [(0, 0, 0, 0.5, 0.25, 0, "tie"), (1, 0.001, 1.0, 0.15, 0.251, 1.0, "pull")]
        run = self.run_of("motion_pattern: sliding\nplateau_slope: -1.95\nsimulated_time: 60\n", rows)
        self.assertEqual(run.slope_of_knot_distance(), -1.95)
        self.assertEqual(run.real_time_factor(), 30.0)
        self.assertEqual(run.pulled("time"), ([1.0],))

    def test_slope_of_all_others_is_that_of_the_whole_pull(self):
        rows = [(0, 0, 0, 0.5, 0.25, 0, "tie")]
        rows += [(1 + i, s, 1.0, 0.15 + 0.3 * s, 0.25 + s, 1.0, "pull") for i, s in enumerate(0.001 * k for k in range(121))]
        run = self.run_of("motion_pattern: stretching\nsimulated_time: 60\n", rows)
        self.assertAlmostEqual(run.slope_of_knot_distance(), 0.3, places=9)

    def test_a_run_that_left_nothing(self):
        run = runs.Run("/nowhere", 1.0, 2, "wrong input")
        self.assertIsNone(run.value("peak_force"))
        self.assertIsNone(run.real_time_factor())
        self.assertIsNone(run.slope_of_knot_distance())

    def test_mean_relative_difference_is_over_what_both_have(self):
        reference = ([0.0, 1.0, 2.0], [1.0, 2.0, 3.0])
        self.assertAlmostEqual(runs.mean_relative_difference(([0.0, 2.0], [1.1, 3.3]), reference), 0.1)
        short, reference = ([0.0, 1.0], [2.0, 2.0]), ([0.5, 9.0], [1.0, 1.0])
        self.assertAlmostEqual(runs.mean_relative_difference(short, reference), 1.0)
        self.assertIsNone(runs.mean_relative_difference(short, ([2.0, 3.0], [1.0, 1.0])))

    def test_a_runs_memory_is_not_that_of_python(self):
        ballast = bytearray(400_000_000)
        ballast[::4096] = b"x" * len(ballast[::4096])
        say = "import resource; print('memory:', resource.getrusage(resource.RUSAGE_SELF).ru_maxrss)"
        done = subprocess.run(runs.SHELLS_CHILD + [sys.executable, "-c", say], capture_output=True, text=True,
                              check=True)
        self.assertLess(int(done.stdout.split()[1]), 200_000)

    def test_the_exit_code_is_that_of_the_run(self):
        self.assertEqual(subprocess.run(runs.SHELLS_CHILD + ["/bin/sh", "-c", "exit 2"], check=False).returncode, 2)


class Errors(unittest.TestCase):
    """When the error beside a reading holds (scripts/bench readings)."""

    def judged(self, result, fine_result, exit_code=0):
        draw = readings.Stranger(1, 0)
        unit = draw.unit_of("plateau_force")
        both = []
        for values, code in ((result, exit_code), (fine_result, 0)):
            run = runs.Run("/nowhere", 1.0, code, "")
            run.result = {key: value * unit for key, value in values.items()}
            both.append(run)
        return readings.Judgement("plateau_force", draw, *both)

    def test_holds_where_the_difference_is_no_larger(self):
        self.assertTrue(self.judged({"true_plateau_force": 1.0, "plateau_force_error": 0.2},
                                    {"true_plateau_force": 1.1}).holds)
        one = self.judged({"true_plateau_force": 1.0, "plateau_force_error": 0.05}, {"true_plateau_force": 1.1})
        self.assertFalse(one.holds)
        self.assertAlmostEqual(one.difference, 0.1)

    def test_a_null_holds_only_where_neither_run_has_a_reading(self):
        self.assertTrue(self.judged({}, {}).holds)
        self.assertFalse(self.judged({}, {"true_plateau_force": 1.0}).holds)
        self.assertFalse(self.judged({"true_plateau_force": 1.0, "plateau_force_error": 9.0}, {}).holds)
        self.assertFalse(self.judged({"true_plateau_force": 1.0}, {"true_plateau_force": 1.0}).holds)
        self.assertFalse(self.judged({"true_plateau_force": 1.0, "plateau_force_error": 9.0},
                                     {"true_plateau_force": 1.0}, exit_code=1).holds)

    def test_the_same_seed_draws_the_same_loops_and_coils_clear_the_rollers(self):
        for number in range(200):
            draw = readings.Stranger(19, number)
            self.assertEqual(draw.settings, readings.Stranger(19, number).settings)
            specimen = draw.settings
            gap = specimen["specimen.end_to_end"] - specimen["specimen.knot_distance"]
            self.assertGreaterEqual(gap, 25.99 * draw.radius)
            self.assertLessEqual(draw.preload, draw.values["stretching"])
        self.assertNotEqual(readings.Stranger(19, 0).settings, readings.Stranger(20, 0).settings)


class Studies(unittest.TestCase):
    def test_at_equal_error_this_program_is_five_times_as_fast_as_its_peers(self):
        rows = {row[0]: row[2] for row in front.side_by_side().rows}
        cost, error = rows.pop("ours, normal")
        least = min(other for name, (other, its_error) in rows.items() if its_error <= error and "ours" not in name)
        self.assertAlmostEqual(least / cost, 5.1, 1)  # as doc/developers/performance.md says


class FakeRunner:
    """Runs that read the same wherever they start, but for what `change` does to them: (name, result) -> exit code."""

    def __init__(self, change=lambda name, result: 0):
        self.change = change

    def run(self, name, settings):
        run = runs.Run("/nowhere", 2.0, 0, "")
        slides = settings["material"] in ("nylon", "polypropylene")
        run.result = {"simulated_time": 60.0, "locked_stiffness": 2e5, "true_peak_force": 7e3}
        if slides:
            run.result.update({"true_plateau_force": 6.0, "plateau_force_sd": 0.3, "lock_extension": 0.08})
        run.exit_code = self.change(name, run.result)
        return run

    def run_all(self, todo):
        return [self.run(*one) for one in todo]


class SpeedOverStarts(unittest.TestCase):
    def table(self, change=lambda name, result: 0):
        return tighten.over_starts(FakeRunner(change), ["polypropylene", "green_vps"], 5)

    def test_a_start_that_fails_fails_the_row(self):
        failed = self.table(lambda name, result: 1 if name == "polypropylene_normal/4" else 0).failed()
        self.assertEqual(len(failed), 1)
        self.assertIn("polypropylene: `normal`: runs that passed is 4", failed[0])


class Means(unittest.TestCase):
    """What scripts/bench specimens and convergence make of the same specimens in several variants."""

    def failed(self, change=lambda name, result: 0, material="polypropylene"):
        return specimens.report(FakeRunner(change), [material], 4).failed()

    def test_what_nothing_moves_passes_whatever_slides(self):
        for material in ("polypropylene", "pink_vps"):
            self.assertEqual(self.failed(material=material), [])

    def test_a_variant_that_moves_a_mean_fails_where_it_is_gated(self):
        def change(factor, variant):
            def changed(name, result):
                result["lock_extension"] *= factor if variant in name else 1.0
                return 0
            return changed
        line, = self.failed(change(1.03, "edges_x1_2/"))
        self.assertIn("edges x1/2: relative change of the mean lock extension is 0.03", line)
        self.assertEqual(self.failed(change(1.03, "edges_h_5/")), [])

    def test_a_ripple_and_a_specimen_that_failed_fail(self):
        def ripple(name, result):
            result["plateau_force_sd"] = 0.7
            return 0
        self.assertIn("ripple of the plateau", self.failed(ripple)[0])
        failed = self.failed(lambda name, result: 1 if name.endswith("presliding_x1_2/1") else 0)
        self.assertTrue(failed and all("presliding x1/2" in line and "of every specimen" in line for line in failed))

    def test_what_is_halved_is_what_is_shipped(self):
        with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../src/machine/measured.hpp"),
                  encoding="utf-8") as source:
            text = source.read()
        for material, name in (("nylon", "kRollingNormal"), ("pink_vps", "kStretchingNormal")):
            step, residual, contact_tolerance, presliding, _ = [
                float(number) for number in re.search(name + r"\{(.*?)\}", text).group(1).split(",")]
            variants = {**specimens.gated_variants(material), **specimens.tolerances(material)}
            for variant, changed in (("longest step x1/2", {"physics.max_step": step / 2}),
                                     ("residual /10", {"physics.residual": residual / 10}),
                                     ("contact tolerance x1/4", {"physics.contact.tolerance": contact_tolerance / 4}),
                                     ("presliding x1/2", {"physics.friction.presliding": presliding / 2})):
                self.assertEqual(variants[variant], changed)


class References(unittest.TestCase):
    def rows_of(self, test, suite="Loads/R8Capstan"):
        return references.rows_of({"testsuites": [{"name": suite, "testsuite": [{"name": "Slides/T2", **test}]}]})

    def verdicts(self, test):
        return [(row.what, row.passes()) for row in self.rows_of(test)]

    def test_a_value_is_judged_at_its_gate_or_bound(self):
        for numbers, values in (("5.319 {} 0.01", ((5.3, True), (5.26, False), (math.nan, False))), ("0 {} 0", ((0, True), (1, False))),
                                ("< 1e-6 {}", ((0.0, True), (9e-7, True), (1e-6, False), (-1e-9, False), (math.nan, False)))):
            for ours, passes in values:
                self.assertEqual(self.verdicts({"reference: R8 capstan": numbers.format(ours)}), [("R8 capstan", passes)])

    def test_a_test_that_fails_without_a_failed_value_stands_in_the_table(self):
        failures = {"failures": [{"failure": "something else"}]}
        alone = ("R8Capstan.Slides/T2: the test failed", False)
        self.assertEqual(self.verdicts(failures), [alone])
        self.assertEqual(self.verdicts({"reference: R8 capstan": "1 1 0", **failures}), [("R8 capstan", True), alone])
        self.assertEqual(self.verdicts({"reference: R8 capstan": "1 2 0", **failures}), [("R8 capstan", False)])

    def test_rows_are_sorted_by_number_and_what_is_missing_fails(self):
        rows = [references.row_of(f"{number} test", "1 1 0") for number in ("R11", "R2", "K7", "R1", "K1")]
        table = references.table_of(rows, {"R10"})
        self.assertEqual([row[0].split()[0] for row in table.rows], ["K1", "K7", "R1", "R2", "R10:", "R11"])
        line, = table.failed()
        self.assertIn("R10: no test left a value", line)

    def test_numbers_of_the_document(self):
        document = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../doc/references.md")
        self.assertGreaterEqual(references.numbers_in(document), {"K7"} | {f"R{n}" for n in range(1, 12)})


if __name__ == "__main__":
    unittest.main()
