#!/usr/bin/python3
"""scripts/material: what a rod that is known would show to a ruler and a scale gives that rod back. The sags are computed
here in another way than there: as boundary value problems, by collocation."""
import math
import os
import random
import subprocess
import tempfile
import unittest

import numpy as np
import yaml
from scipy import integrate

from knot_utm import material

ROOT = os.path.realpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../.."))
TOOLS = os.environ.get("KNOT_UTM_TOOLS_DIR", os.path.join(ROOT, "build/devel/lib/knot_utm"))
GRAVITY = 9.81


def solved(slopes, ends, s, y, p=None):
    found = integrate.solve_bvp(slopes, ends, s, y, p, tol=1e-8, max_nodes=100000)
    assert found.success, found.message
    return found


def drop_of_cantilever(bending, weight, overhang):
    def slopes(s, y):  # of the angle below the level, its slope, down
        return np.array([y[1], -weight / bending * (overhang - s) * np.cos(y[0]), np.sin(y[0])])

    s = np.linspace(0.0, overhang, 200)
    return solved(slopes, lambda a, b: np.array([a[0], b[1], a[2]]), s, np.zeros((3, len(s)))).y[2, -1]


def height_of_loop(bending, weight, length):
    """Half of it: down from the clamp, level at the bottom, there straight below the clamp, by a force across that holds it there."""
    half = 0.5 * length
    s = np.linspace(0.0, half, 200)
    y = np.array([0.5 * math.pi - 0.9 * np.sin(math.pi * np.minimum(2.0 * s / half, 1.0)) + math.pi * np.maximum(s / half - 0.5, 0.0),
                  0.0 * s, 0.0 * s, s])
    force = [0.0]
    for share in (0.0, 0.1, 0.3, 1.0):  # of its weight
        def slopes(s, y, p):
            moment = share * weight * (half - s) * np.cos(y[0]) + p[0] * np.sin(y[0])
            return np.array([y[1], -moment / bending, np.cos(y[0]), np.sin(y[0])])

        found = solved(slopes, lambda a, b, _: np.array([a[0] - 0.5 * math.pi, b[0] - math.pi, a[2], b[2], a[3]]), s, y, force)
        s, y, force = found.x, found.y, found.p
    return y[3, -1]


class Rod:
    """A rod that is known, and what it would show, each reading off by as much as its uncertainty allows."""

    def __init__(self, seed, bending, loop):
        self.random = random.Random(seed)
        self.true = {"radius": 0.0025, "density": 815.0, "stretching_stiffness": 1.2e5, "bending_stiffness": bending,
                     "friction_coefficient": 0.42}
        h = self.true["radius"]
        per_length = self.true["density"] * math.pi * h * h
        weight = per_length * GRAVITY
        mu, k_s = self.true["friction_coefficient"], self.true["stretching_stiffness"]
        self.measured = {
            "name": "A rod that is known", "diameter": self.read(2 * h, 5e-5),
            "weighed": {"length": self.read(10.0, 0.01), "mass": self.read(10 * per_length, 1e-3)},
            "stretched": {"length": self.read(2.0, 2e-3), "mass": self.read(20.0, 0.05),
                          "elongation": self.read(20 * GRAVITY * 2.0 / k_s, 2e-4)},
            "capstan": {"angle": self.read(2 * math.pi, 0.05), "light": self.read(0.2, 1e-3),
                        "heavy": self.read(0.2 * math.exp(mu * 2 * math.pi), 0.05)},
            "tied": {"mass": self.read(11.0, 0.1)}}
        if loop:
            length = 6.5 * (bending / weight) ** (1 / 3)
            self.measured["loop"] = {"length": self.read(length, 5e-4),
                                     "height": self.read(height_of_loop(bending, weight, length), 5e-4)}
        else:
            overhang = 1.8 * (bending / weight) ** (1 / 3)
            self.measured["cantilever"] = {"overhang": self.read(overhang, 1e-3),
                                           "drop": self.read(drop_of_cantilever(bending, weight, overhang), 1e-3)}

    def read(self, value, uncertainty):
        return [float(value + self.random.gauss(0, uncertainty)), uncertainty]


class Material(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory(prefix="knot_utm_material_")
        self.addCleanup(self.folder.cleanup)

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def run_script(self, measured):
        with open(self.path("measured.yaml"), "w", encoding="utf-8") as file:
            yaml.safe_dump(measured, file)
        return self.run_on(self.path("measured.yaml"), self.path("rope.yaml"), "--overwrite")

    @staticmethod
    def run_on(measured, out, *more):
        return subprocess.run([os.path.join(ROOT, "scripts/material"), measured, "--out", out, *more], capture_output=True,
                              text=True, check=False)

    def made(self, measured):
        done = self.run_script(measured)
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(self.path("rope.yaml"), encoding="utf-8") as file:
            text = file.read()
        uncertain = {line.split(":")[0]: float(line.split("+- ")[1].split(",")[0])
                     for line in text.splitlines() if "+-" in line}
        return yaml.safe_load(text), uncertain

    def test_a_known_rod_comes_back_within_its_uncertainty(self):
        misses = []
        for seed, (bending, loop) in enumerate([(2e-5, False), (2e-4, False), (5e-3, False), (2e-4, True), (5e-3, True)]):
            rod = Rod(seed, bending, loop)
            made, uncertain = self.made(rod.measured)
            for name, value in rod.true.items():
                misses.append((made[name] - value) / uncertain[name])
                self.assertLess(abs(misses[-1]), 3.5, f"{name} of rod {seed}: {made[name]} +- {uncertain[name]}, not {value}")
            self.assertLess(uncertain["bending_stiffness"], 0.25 * bending)
            self.assertAlmostEqual(made["tying_preload"], rod.measured["tied"]["mass"][0] * GRAVITY, places=3)
        # Neither larger nor smaller than they should be: of 25 draws, the mean square of a standard normal one.
        self.assertTrue(0.3 < np.mean(np.square(misses)) < 2.2, misses)

    def test_of_a_small_sag_has_its_closed_form(self):
        for share in (0.002, 0.01):  # w l^4/(8 k_b) is the sag
            self.assertAlmostEqual(8.0 * share * material.cantilever_stiffness(1.0, 1.0, share), 1.0, delta=1e-3)

    def test_the_file_runs(self):
        self.made(Rod(7, 2e-4, False).measured)
        done = subprocess.run([os.path.join(TOOLS, "tensile_test"), os.path.join(ROOT, "config/straight.yaml"), "--quiet", "--set",
                               f"material={self.path('rope.yaml')}", "--set", "physics.accuracy=draft", "--out", self.path("out")],
                              capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue(os.path.exists(self.path("out/curve.csv")))

    def test_what_is_wrong_is_named(self):
        good = Rod(1, 2e-4, False).measured
        for change, named in (({"capstan": None}, "capstan"), ({"diameter": 0.005}, "diameter"),
                              ({"diameter": [5, 0.1]}, "is it in metres?"),
                              ({"loops": {}}, "loops"), ({"cantilever": {"overhang": [0.1, 1e-3], "drop": [0.099, 1e-3]}}, "drop")):
            done = self.run_script({**good, **change})
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(named, done.stderr)
            self.assertEqual(done.stderr.count("\n"), 1)
        self.assertIn("is it in degrees? 360 degrees are 6.283 rad",
                      self.run_script({**good, "capstan": {**good["capstan"], "angle": [360, 5]}}).stderr)
        del good["weighed"]
        self.assertIn("missing: weighed", self.run_script(good).stderr)


    def test_slips_of_units_are_asked_about(self):
        good = Rod(1, 2e-4, False).measured
        done = self.run_script(good)
        self.assertRegex(done.stdout, r"rope.yaml: [0-9.]+ g/m at a diameter of [0-9.]+ mm, E = [0-9.e+-]+ GPa")
        self.assertEqual(done.stderr, "")
        def times(group, key, factor):
            return {**good, group: {**good[group], key: [factor * number for number in good[group][key]]}}
        for measured, asked in ((times("weighed", "mass", 1000), "is weighed.mass in kg"),
                                (times("stretched", "elongation", 1e-3), "is stretched.mass in kg"),
                                (times("weighed", "length", 100), "is weighed.mass in kg, and are")):
            done = self.run_script(measured)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn(asked, done.stderr)

    def test_nothing_is_written_over(self):
        self.run_script(Rod(1, 2e-4, False).measured)
        measured, made = self.path("measured.yaml"), self.path("rope.yaml")
        os.symlink(measured, self.path("link.yaml"))
        os.link(measured, self.path("hard.yaml"))
        with open(measured, "rb") as file:
            before = file.read()
        for out, more, why in ((made, (), "exists already"), (measured, ("--overwrite",), "is an input"),
                               (self.path("link.yaml"), ("--overwrite",), "is an input"),
                               (self.path("hard.yaml"), ("--overwrite",), "is an input")):
            done = self.run_on(measured, out, *more)
            self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)
            self.assertIn(why, done.stderr)
        with open(measured, "rb") as file:
            self.assertEqual(file.read(), before)


class Example(unittest.TestCase):
    def test_the_worked_example_gives_what_doc_measure_says(self):
        with open(os.path.join(ROOT, "doc/measure.md"), encoding="utf-8") as file:
            blocks = file.read().split("```yaml\n")[1:]
        measured, said = (block.split("```")[0] for block in blocks[:2])
        with tempfile.TemporaryDirectory(prefix="knot_utm_material_") as folder:
            files = os.path.join(folder, "measured.yaml"), os.path.join(folder, "rope.yaml")
            with open(files[0], "w", encoding="utf-8") as file:
                file.write(measured)
            subprocess.run([os.path.join(ROOT, "scripts/material"), files[0], "--out", files[1]], check=True)
            with open(files[1], encoding="utf-8") as file:
                self.assertEqual(file.read(), said)


if __name__ == "__main__":
    unittest.main()
