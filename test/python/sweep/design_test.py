#!/usr/bin/python3
"""The designs of a study, against NumPy and SciPy used directly, and what a study refuses. Skipped, with exit code 77, where
a module is not installed."""
import glob
import itertools
import os
import tempfile
import unittest

from head import ROOT, read, write

import numpy as np
from scipy import special, stats

from knot_utm import WrongInput, tool
from knot_utm.design import DRAWS
from knot_utm.study import KEYS, load_study
from knot_utm.yaml_text import load, text_of


class Studies(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.file = os.path.join(folder.name, "study.yaml")

    def study(self, text):
        write(self.file, text)
        return load_study(self.file)

    def values(self, text):
        """[values of a run], in the order of the keys."""
        return [tuple(point.values()) for point in self.study(text).points]

    def refuses(self, text, *words):
        with self.assertRaises(WrongInput) as caught:
            self.study(text)
        said = str(caught.exception)
        self.assertTrue(said.startswith(self.file), said)
        self.assertNotIn("\n", said)
        for word in words:
            self.assertIn(word, said)


class Designs(Studies):
    def test_grid_has_every_combination_the_last_key_fastest(self):
        found = self.values("""
            method: straight
            vary:
              material: [nylon, polypropylene]
              specimen.length: {from: 0.1, to: 0.4, steps: 3}
              specimen.edge_length: {from: 1e-3, to: 1e-2, steps: 4, scale: log}""")
        self.assertEqual(found, list(itertools.product(["nylon", "polypropylene"], np.linspace(0.1, 0.4, 3).tolist(),
                                                       np.geomspace(1e-3, 1e-2, 4).tolist())))

    def test_list_puts_values_side_by_side_and_one_value_beside_all(self):
        found = self.values("""
            method: straight
            design: list
            vary: {specimen.length: [0.1, 0.3, 0.2], physics.accuracy: [draft], machine.travel: {from: 1, to: 3, steps: 3}}""")
        self.assertEqual(found, [(0.1, "draft", 1.0), (0.3, "draft", 2.0), (0.2, "draft", 3.0)])

    DRAWN = """
        method: straight
        vary:
          a: {draw: uniform, from: 2, to: 6}
          b: {draw: log_uniform, from: 1e-3, to: 10}
          c: {draw: normal, mean: 5, sd: 0.5}
        """

    def test_sobol_has_the_quantiles_at_its_points(self):
        found = np.array(self.values(self.DRAWN + "design: sobol\n        runs: 64\n        seed: 3"))
        shares = stats.qmc.Sobol(3, seed=3).random_base2(6)
        expected = np.array([2 + 4 * shares[:, 0], 10 ** (-3 + 4 * shares[:, 1]), 5 + 0.5 * special.ndtri(shares[:, 2])]).T
        np.testing.assert_allclose(found, expected, rtol=1e-12)
        # Of 64 points each of 64 equal parts of a range has one: no draw of independent numbers does that.
        self.assertEqual(sorted(np.floor((found[:, 0] - 2) * 16).astype(int)), list(range(64)))

    def test_sobol_takes_each_value_of_a_list_equally_often(self):
        found = self.values("""
            method: straight
            design: sobol
            runs: 16
            vary: {material: [nylon, polypropylene], machine.travel: {from: 1, to: 2}, specimen.length: {from: 1, to: 4, steps: 4}}""")
        self.assertEqual([sum(run[0] == name for run in found) for name in ("nylon", "polypropylene")], [8, 8])
        self.assertEqual([sum(run[2] == length for run in found) for length in (1.0, 2.0, 3.0, 4.0)], [4, 4, 4, 4])
        self.assertTrue(all(1 <= run[1] <= 2 for run in found))

    def test_drawn_lists_have_their_distributions(self):
        found = np.array(self.values(self.DRAWN + "design: list\n        runs: 2000"))
        for column, distribution in zip(found.T, (stats.uniform(2, 4), stats.loguniform(1e-3, 10), stats.norm(5, 0.5))):
            self.assertGreater(stats.kstest(column, distribution.cdf).pvalue, 0.001)
        correlation = np.corrcoef(found[:, 0], found[:, 2])[0, 1]
        self.assertLess(abs(correlation), 5 / np.sqrt(2000))

    def test_draws_are_the_same_each_time_and_others_by_another_seed(self):
        for design in ("list", "sobol"):
            text = self.DRAWN + f"design: {design}\n        runs: 8"
            self.assertEqual(self.values(text), self.values(text))
            self.assertEqual(self.values(text), self.values(text + "\n        seed: 1"))
            self.assertNotEqual(self.values(text), self.values(text + "\n        seed: 2"))

    def test_one_at_a_time_changes_each_key_beside_the_first_values(self):
        found = self.values("""
            method: straight
            design: one_at_a_time
            vary: {material.density: [900, 1000, 1100], specimen.length: [0.1], physics.gravity: [[0, 0, 0], [0, 0, -9.81]]}""")
        none, down = [0, 0, 0], [0, 0, -9.81]
        self.assertEqual(found, [(900, 0.1, none), (1000, 0.1, none), (1100, 0.1, none), (900, 0.1, down)])

    def test_for_each_case_the_design_begins_anew(self):
        study = self.study("""
            method: straight
            design: sobol
            runs: 4
            for_each: {material: [nylon, pink_vps], physics.accuracy: [draft]}
            vary: {specimen.length: {from: 0.1, to: 0.2}}""")
        self.assertEqual([(point["material"], point["physics.accuracy"]) for point in study.points],
                         [("nylon", "draft")] * 4 + [("pink_vps", "draft")] * 4)
        lengths = [point["specimen.length"] for point in study.points]
        self.assertEqual(lengths[:4], lengths[4:])
        self.assertEqual(study.cases, ("material", "physics.accuracy"))

    def test_units_of_the_rod_are_those_of_each_rod(self):
        study = self.study("""
            method: tighten
            for_each: {material: [nylon, pink_vps]}
            vary:
              specimen.preload: {from: 1, to: 100, steps: 3, scale: log, unit: k_b/h2}
              specimen.knot_distance: {values: [40], unit: h}
              material.twisting_stiffness: {values: [0.5], unit: k_b}""")
        for name, points in (("nylon", study.points[:3]), ("pink_vps", study.points[3:])):
            rod = load(os.path.join(ROOT, f"config/materials/{name}.yaml"))
            force = rod["bending_stiffness"] / rod["radius"] ** 2
            np.testing.assert_allclose([point["specimen.preload"] for point in points], np.array([1, 10, 100]) * force)
            np.testing.assert_allclose([point["specimen.knot_distance"] for point in points], 40 * rod["radius"])
            np.testing.assert_allclose([point["material.twisting_stiffness"] for point in points], 0.5 * rod["bending_stiffness"])

    def test_units_follow_a_rod_that_is_drawn(self):
        study = self.study("""
            method: tighten
            design: sobol
            runs: 8
            vary:
              material.radius: {from: 1e-3, to: 1e-2}
              material.bending_stiffness: {from: 1e-6, to: 1e-4, scale: log}
              specimen.preload: {values: [20], unit: k_b/h2}""")
        for point in study.points:
            force = point["material.bending_stiffness"] / point["material.radius"] ** 2
            self.assertAlmostEqual(point["specimen.preload"] / force, 20)

    def test_below_leaves_runs_out(self):
        found = self.values("""
            method: straight
            below: {specimen.edge_length: specimen.length}
            vary: {specimen.edge_length: [1, 2, 3], specimen.length: [2, 3]}""")
        self.assertEqual(found, [(1, 2), (1, 3), (2, 3)])

    def test_repeats_are_batches(self):
        study = self.study("method: straight\nvary: {specimen.length: [0.1, 0.2]}\nrepeat: 3")
        self.assertEqual(study.settings, [{"specimen.length": length, "specimens.count": 3} for length in (0.1, 0.2)])


class Documented(unittest.TestCase):
    def test_every_key_and_draw(self):
        page = read(ROOT, "doc/studies.md")
        for key in KEYS:
            self.assertIn(f"\n| `{key}` |", page)
        for name, parts in DRAWS.items():
            self.assertIn(f"`{{draw: {name}, {', '.join(parts)}}}`", page)

    def test_shipped_studies_would_run(self):
        """Those points that are first with a value of a key that has few; the sweep itself asks of all."""
        studies = glob.glob(os.path.join(ROOT, "config/studies/*.yaml"))
        self.assertTrue(studies)
        for file in studies:
            study = load_study(file)
            first = {}
            for point in study.points:
                for value in point.items():
                    first.setdefault(str(value), point)
            asked = list({id(point): point for point in first.values()}.values())
            for point in asked[::max(1, len(asked) // 8)]:
                self.assertIsNone(tool.refusal(study.method, point), file)

    def test_shipped_methods_would_run(self):
        for folder in ("config", "config/standards", "config/validation"):
            methods = glob.glob(os.path.join(ROOT, folder, "*.yaml"))
            self.assertTrue(methods, folder)
            for file in methods:
                self.assertIsNone(tool.refusal(file, {}), file)

    def test_one_specimen_does_not_scatter_when_it_is_checked(self):
        """With 1 % more there would be no room for the knots."""
        self.assertIsNone(tool.refusal(os.path.join(ROOT, "config/tighten.yaml"), {"specimen.knot_distance": 0.2117}))


class Refused(Studies):
    """The strongest of each kind: the line names file, key and value, and what is allowed."""

    ONE = "method: straight\nvary: {specimen.length: [0.1]}\n"

    def test_keys_and_values_of_a_study(self):
        many = "{from: 1, to: 2, steps: 2000}"
        write(self.file + ".method", "specimens: {count: 8}")
        for text, *words in (
                ("[]", "a study is a map"), ("{", "study.yaml"), ("a: 1\n" + self.ONE, "a is no key of a study"),
                ("vary: {specimen.length: [0.1]}", "method is missing"), ("method: straight", "vary is null"),
                ("method: straight\nvary: {1: [0.1]}", "1 is no key"), (self.ONE + "design: star", "design is star", "grid, one_at_a_time, list, sobol"),
                (self.ONE + "design: one_at_a_time\nruns: 3", "runs is 3", "no effect in a one_at_a_time"), (self.ONE + "repeat: true", "repeat is true"),
                (self.ONE + "repeat: 2\nrepeat: 3", "repeat stands there twice"),
                (self.ONE + "for_each: {specimen.length: [1]}", "vary has the key specimen.length", "for_each"),
                (self.ONE + "for_each: {a: {from: 1, to: 2}}", "for_each.a is drawn", "needs values"),
                ("method: straight\nfor_each: {material: [nylonn]}\nvary: {specimen.length: {values: [80], unit: h}}", "nylonn"),
                ("method: straight\nvary: {material.radius: {values: [1], unit: h}}", "material.radius.unit is h", "follow from this"),
                (self.ONE + "below: {a: specimen.length}", "has the key a"), (self.ONE + "below: {specimen.length: specimen.length}", "no run is left"),
                ("method: straight\nvary: {specimens.count: [1, 2]}", "specimens.count", "give repeat"),
                (f"method: {self.file}.method\nvary: {{a: [1]}}", "specimens.count 8", "give repeat"),
                ("method: straight\ndesign: list\nvary: {a: [1, 2], b: [1, 2, 3]}", "vary.b has 3 values", "have 2"),
                ("method: straight\ndesign: list\nvary: {a: {draw: uniform, from: 1, to: 2}}", "runs is missing"),
                (f"method: straight\nvary: {{a: {many}, b: {many}}}", "4000000 runs", "1000000")):
            self.refuses(text, *words)

    def test_values_of_a_key(self):
        sobol = "design: sobol\nruns: 4"
        for value, design, *words in (
                ("0.1", "", "0.1", "a list of values"), ("{from: 1, to: 2, steps: 1}", "", "steps is 1", "from 2 to"), ("{from: 1, steps: 2}", "", "to is missing"),
                ("{from: 1, to: far, steps: 2}", "", "to is far", "a number"), ("{from: 0, to: 1, steps: 2, scale: log}", "", "from is 0", "above 0"),
                ("{from: 1, to: 2, step: 2}", "", "step is no key"), ("{draw: uniform, from: 1, to: 2}", "", "a grid needs values"),
                ("{from: 1, to: 2, steps: 2, unit: k_b/h2}", "", "unit is k_b/h2", "this key is in m"), ("{values: [1], unit: m}", "", "must be h, k_b/h2"),
                ("{draw: beta, from: 1, to: 2}", sobol, "draw is beta", "log_uniform"), ("{draw: normal, mean: 1, sd: 0}", sobol, "sd is 0"),
                ("{draw: uniform, from: 2, to: 1}", sobol, "to is 1", "above from")):
            self.refuses(f"method: straight\nvary: {{specimen.length: {value}}}\n{design}", "vary.specimen.length", *words)


class Yaml(Studies):
    def test_values_read_back_as_they_were(self):
        for value in (1, 1e-5, 2e22, 0.1, float("inf"), True, None, "nylon", "1e-5", "a: b", "Gruß", [1, [2.5]],
                      {"radius": 0.001, "name": "own"}, "x" * 300):
            write(self.file, "value: " + text_of(value))
            self.assertEqual(load(self.file), {"value": value})
            self.assertNotIn("\n", text_of(value))


if __name__ == "__main__":
    unittest.main()
