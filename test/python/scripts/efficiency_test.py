#!/usr/bin/python3
"""scripts/efficiency: the ratio of the means of two batches, worked out by hand, and how often its interval holds it."""
import math
import os
import subprocess
import tempfile
import unittest

import numpy as np
import yaml

from knot_utm.report.efficiency import ratio_of_means, Sample

ROOT = os.path.realpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../.."))
SCRIPT = os.path.join(ROOT, "scripts/efficiency")

# Student's t of 2 and of 4 degrees of freedom has closed forms.
T2 = 0.95 * math.sqrt(2.0 / (1.0 - 0.95**2))
T4 = 2.0 * math.sqrt(math.cos(math.acos(math.sqrt(0.0975)) / 3.0) / math.sqrt(0.0975) - 1.0)


class TheRatio(unittest.TestCase):
    def test_is_that_of_the_means_with_the_interval_worked_out_by_hand(self):
        # Means 12 and 24, both with a coefficient of variation of 1/6: v = 2/108, and Welch's degrees of freedom are 4.
        ratio, low, high = ratio_of_means(Sample([10.0, 12.0, 14.0]), Sample([20.0, 24.0, 28.0]))
        reach = math.exp(T4 / math.sqrt(54.0))
        self.assertAlmostEqual(T4, 2.776445, places=6)
        self.assertEqual(ratio, 0.5)
        self.assertAlmostEqual(low, 0.5 / reach, places=8)
        self.assertAlmostEqual(high, 0.5 * reach, places=8)

    def test_has_the_degrees_of_freedom_of_the_batch_that_scatters(self):
        ratio, low, high = ratio_of_means(Sample([10.0, 12.0, 14.0]), Sample([24.0] * 9))
        reach = math.exp(T2 / math.sqrt(108.0))
        self.assertEqual(ratio, 0.5)
        self.assertAlmostEqual(low, 0.5 / reach, places=8)
        self.assertAlmostEqual(high, 0.5 * reach, places=8)

    def test_of_batches_that_do_not_scatter_is_sure(self):
        self.assertEqual(ratio_of_means(Sample([3.0, 3.0]), Sample([4.0, 4.0])), (0.75, 0.75, 0.75))

    def test_upside_down_has_the_inverse_interval(self):
        a, b = Sample([10.0, 12.0, 15.0]), Sample([21.0, 24.0, 22.0, 25.0])
        ratio, low, high = ratio_of_means(a, b)
        np.testing.assert_allclose(ratio_of_means(b, a), (1.0 / ratio, 1.0 / high, 1.0 / low))


class TheScript(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="knot_utm_efficiency_")
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def batch(self, name, rows):
        """`rows`: of each specimen whether it is rejected, how its test ended, its peak force and its plateau force."""
        folder = os.path.join(self.folder, name)
        os.makedirs(folder)
        with open(os.path.join(folder, "specimens.csv"), "w", encoding="utf-8") as file:
            file.write("specimen,specimen.tail,rejected,ended_by,motion_pattern,plateau_force,peak_force\n-,m,-,-,-,N,N\n")
            for number, (rejected, ended_by, peak, plateau) in enumerate(rows, 1):
                file.write(f"{number},0.03,{rejected},{ended_by},sliding,{plateau},{peak}\n")
        return folder

    def run_script(self, *words):
        return subprocess.run([SCRIPT, *words], capture_output=True, text=True, check=False)

    def test_prints_both_batches_and_their_ratio(self):
        knotted = self.batch("knotted", [("false", "break", peak, "nan") for peak in (10, 12, 14)] +
                             [("true", "untangled", 99, 9), ("false", "break", "nan", 5)])
        straight = self.batch("straight", [("false", "break", peak, 2) for peak in (20, 24, 28)])
        done = self.run_script(knotted, straight)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("key: peak_force  # [N]\n", done.stdout)
        said = yaml.safe_load(done.stdout)
        self.assertEqual(said["knotted"], {"n": 3, "mean": 12, "sd": 2, "cv": 0.1667})
        self.assertEqual(said["straight"], {"n": 3, "mean": 24, "sd": 4, "cv": 0.1667})
        self.assertEqual(said["ratio"], {"of_means": 0.5, "low": 0.3427, "high": 0.7296, "cv": 0.2357})

    def test_says_where_a_largest_load_is_no_strength(self):
        one = self.batch("one", [("false", "break", 10, 1), ("false", "extension", 12, 2)])
        done = self.run_script(one, one)
        self.assertEqual(done.returncode, 0)
        self.assertIn("1 of 2 specimens did not break", done.stderr)
        self.assertEqual(self.run_script(one, one, "--key", "plateau_force").stderr, "")

    def test_predicts_nothing_of_a_rod_that_parts_at_a_force_that_was_given(self):
        one = self.batch("one", [("false", "break", 10, 1), ("false", "break", 12, 2)])
        for material, predicted in (("{breaking_force: 31}", False), ("{breaking_force: 31, breaking: {law: tension}}", False),
                                    ("{breaking_force: 31, breaking: {law: tension_and_bending, bending_share: 0.1}}", True)):
            with open(os.path.join(one, "method.yaml"), "w", encoding="utf-8") as file:
                file.write(f"material: {material}\n")
            done = self.run_script(one, one)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            self.assertEqual("ratio: null  # not predicted: " in done.stdout, not predicted, material)
            self.assertEqual(yaml.safe_load(done.stdout)["ratio"] is None, not predicted)
            self.assertTrue(yaml.safe_load(self.run_script(one, one, "--key", "plateau_force").stdout)["ratio"])

    def test_what_is_wrong_is_named_in_one_line(self):
        good = self.batch("good", [("false", "break", 10, "nan"), ("false", "break", 12, -1)])
        few = self.batch("few", [("false", "break", 10, 1), ("true", "solver", 12, 2)])
        none = self.batch("none", [])
        broken = self.batch("broken", [("false", "break", "ten", 1)])
        for words, named in (((good,), "STRAIGHT"), ((good, self.folder), "no folder of a batch"),
                             ((good, os.path.join(self.folder, "absent")), "no folder of a batch"),
                             ((good, few), "1 of 2 specimens count and have peak_force"), ((none, good), "no specimens"),
                             ((broken, good), "peak_force"), ((good, good, "--key", "ended_by"), "--key ended_by is no reading"),
                             ((good, good, "--key", "plateau_force"), "1 of 2 specimens count and have plateau_force")):
            done = self.run_script(*words)
            self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
            self.assertIn(named, done.stderr)
        below = self.batch("below", [("false", "break", 10, 1), ("false", "break", -1, 1)])
        self.assertIn("a ratio needs readings above 0", self.run_script(below, good).stderr)


if __name__ == "__main__":
    unittest.main()
