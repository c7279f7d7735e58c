#!/usr/bin/python3
"""scripts/material: what a rod that is known would show to a ruler and a scale gives that rod back. The sags are computed
here in another way than there: as boundary value problems, by collocation, and of fibres that rub step by step, as chains that
remember how they were bent."""
import math
import os
import random
import re
import shlex
import subprocess
import tempfile
import unittest

from head import ROOT, TOOLS, read, write

import numpy as np
import yaml
from scipy import integrate, optimize

from knot_utm import WrongInput, material

EXAMPLE = os.path.join(ROOT, "examples/measure_a_rope.yaml")
GRAVITY = 9.81


def solved(slopes, ends, s, y, p=None):
    found = integrate.solve_bvp(slopes, ends, s, y, p, tol=1e-8, max_nodes=100000)
    assert found.success, found.message
    return found


def end_of_cantilever(bending, weight, overhang):  # how far it is below the clamp, and beside it
    def slopes(s, y):  # of the angle below the level, its slope, down, along
        return np.array([y[1], -weight / bending * (overhang - s) * np.cos(y[0]), np.sin(y[0]), np.cos(y[0])])

    s = np.linspace(0.0, overhang, 200)
    return solved(slopes, lambda a, b: np.array([a[0], b[1], a[2], a[3]]), s, np.zeros((4, len(s)))).y[2:, -1]


class Fibres:
    """A section, or one for each node of a rod, whose fibres rub: kept = M_y/k_b is the curvature at which their friction is full,
    ratio what they add to the stiffness until then. It is the law of include/knot_utm/rod/yielding_bend.hpp."""

    def __init__(self, k_b, kept, ratio):
        self.k_b, self.stiffness, self.yields = k_b, (ratio - 1) * k_b, kept / (ratio - 1)
        self.slid = 0.0

    def moment(self, curvature):
        return self.k_b * curvature + self.stiffness * np.clip(curvature - self.slid, -self.yields, self.yields)

    def slope(self, curvature):
        return self.k_b + np.where(np.abs(curvature - self.slid) < self.yields, self.stiffness, 0.0)

    def remember(self, curvature):
        off = curvature - self.slid
        self.slid = self.slid + off - np.clip(off, -self.yields, self.yields)


def kept_by(fibres, bend):
    """The curvature that a straight section keeps which is bent so far in small steps, and let go until it bears no moment."""
    curvature, step = 0.0, bend / 4000
    while curvature < bend:
        curvature += step
        fibres.remember(curvature)
    while fibres.moment(curvature) > 0:
        curvature -= step
        fibres.remember(curvature)
    return curvature


def drop_of_a_rubbing_cantilever(fibres, weight, overhang, nodes=100):
    """A chain of rods, let down slowly: its weight grows from nothing, and Newton's method finds where each step rests."""
    length = overhang / nodes
    bends = (np.eye(nodes) - np.eye(nodes, k=-1)) / length
    bends[0, 0] = 2 / length  # at the clamp, half a rod away, it is level
    lever = weight * length ** 2 * (np.arange(nodes, 0, -1) - 0.5)  # of the rods from each one to the end

    def left(angles, share):
        return fibres.moment(bends @ angles) - share * np.cumsum((lever * np.cos(angles))[::-1])[::-1]

    angles = np.zeros(nodes)
    for share in np.linspace(0.0, 1.0, 51)[1:]:
        for _ in range(200):
            off = left(angles, share)
            if np.max(np.abs(off)) < 1e-10 * weight * overhang ** 2:
                break
            slope = fibres.slope(bends @ angles)[:, None] * bends + share * np.triu(np.tile(lever * np.sin(angles), (nodes, 1)))
            step = np.linalg.solve(slope, off)
            size = 1.0
            while size > 1e-3 and np.linalg.norm(left(angles - size * step, share)) > np.linalg.norm(off):
                size *= 0.5
            angles = angles - size * step
        else:
            raise AssertionError(f"the chain does not come to rest at {share:.2f} of its weight")
        fibres.remember(bends @ angles)
    return length * np.sum(np.sin(angles))


def slope_of_rolling(board, piece, h, couple):
    """The slope at which a board runs away on pieces that roll, from the balance of each body: couple(N) is the one with which a contact
    that bears the force N resists. Unknown are the shear forces above and below the pieces, for a slope that is tried."""
    def left(angle):
        sine, cosine = math.sin(angle), math.cos(angle)
        above, below = board * GRAVITY * cosine, (board + piece) * GRAVITY * cosine
        # At rest the board is held by the shear force above, and board and pieces by that below; their moments turn the pieces.
        shear = board * GRAVITY * sine, (board + piece) * GRAVITY * sine
        return h * sum(shear) - couple(above) - couple(below)
    return math.tan(optimize.brentq(left, 0.0, 1.5))


def period_of_pendulum(k_t, h, length, mass, radius):
    """Of a disc that hangs on fibres, spread over the section, which do not stretch: as they wind, they lift it."""
    fibres = h * np.sqrt((np.arange(400) + 0.5) / 400)  # their distances from the axis

    def swings(_, y):
        of_weight = mass * GRAVITY * np.mean(fibres ** 2 * y[0] / length / np.sqrt(1 - (fibres * y[0] / length) ** 2))
        return [y[1], -(k_t * y[0] / length + of_weight) / (0.5 * mass * radius ** 2)]

    def passes(_, y):
        return y[0]

    passes.direction = 1
    found = integrate.solve_ivp(swings, (0.0, 300.0), [1.0, 0.0], events=passes, rtol=1e-9, atol=1e-10)
    return np.diff(found.t_events[0])[0]


class Rod:
    """A rod that is known, and what it would show, each reading off by as much as its uncertainty allows."""

    def __init__(self, seed, bending):
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
        overhang = 1.8 * (bending / weight) ** (1 / 3)
        self.measured["cantilever"] = {"overhang": self.read(overhang, 1e-3),
                                       "drop": self.read(end_of_cantilever(bending, weight, overhang)[0], 1e-3)}

    def rub(self, kept, ratio, compaction):
        """Fibres that rub, and what they show."""
        k_b, h = self.true["bending_stiffness"], self.true["radius"]
        self.true.update(friction_moment=h * kept, stick_ratio=ratio, compaction=compaction)
        weight = self.true["density"] * math.pi * h * h * GRAVITY
        far, near = 2.0 / kept + 1.8 * (k_b / weight) ** (1 / 3), 0.9 * math.sqrt(2 * kept * k_b / weight)
        for group, overhang, error in (("cantilever", far, 1e-3), ("light_cantilever", near, 1e-4)):
            drop = drop_of_a_rubbing_cantilever(Fibres(k_b, kept, ratio), weight, overhang)
            self.measured[group] = {"overhang": self.read(overhang, 5e-4), "drop": self.read(drop, error)}
        harder, bend = kept + compaction * h * 20 * GRAVITY / k_b, 200.0
        self.measured["mandrel"] = {"radius": [1 / bend - h, 1e-5],
                                    "kept_radius": self.read(1 / kept_by(Fibres(k_b, kept, ratio), bend), 5e-4)}
        arc = kept_by(Fibres(k_b, harder, ratio), bend)
        self.measured["pulled"] = {"mass": self.read(20.0, 0.05), "chord": self.read(1.6 / arc, 2e-4),
                                   "sag": self.read(0.4 / arc, 2e-4)}  # of a sine of 0.8
        return self

    def read(self, value, uncertainty):
        return [float(value + self.random.gauss(0, uncertainty)), uncertainty]


class Material(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory(prefix="knot_utm_material_")
        self.addCleanup(self.folder.cleanup)

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def run_script(self, measured):
        return self.run_on(write(self.path("measured.yaml"), yaml.safe_dump(measured)), self.path("rope.yaml"), "--overwrite")

    @staticmethod
    def run_on(measured, out, *more):
        return subprocess.run([os.path.join(ROOT, "scripts/material"), measured, "--out", out, *more], capture_output=True,
                              text=True, check=False)

    def made(self, measured):
        done = self.run_script(measured)
        self.assertEqual(done.returncode, 0, done.stderr)
        text = read(self.path("rope.yaml"))
        uncertain = {line.split(":")[0]: float(line.split("+- ")[1].split(",")[0])
                     for line in text.splitlines() if "+-" in line}
        return yaml.safe_load(text), uncertain

    def test_a_known_rod_comes_back_within_its_uncertainty(self):
        misses = []
        for seed, bending in enumerate([2e-5, 2e-4, 5e-3, 1e-4, 1e-3]):
            rod = Rod(seed, bending)
            made, uncertain = self.made(rod.measured)
            for name, value in rod.true.items():
                misses.append((made[name] - value) / uncertain[name])
                self.assertLess(abs(misses[-1]), 3.5, f"{name} of rod {seed}: {made[name]} +- {uncertain[name]}, not {value}")
            self.assertLess(uncertain["bending_stiffness"], 0.25 * bending)
            self.assertAlmostEqual(made["tying_preload"], rod.measured["tied"]["mass"][0] * GRAVITY, places=3)
        # Neither larger nor smaller than they should be: of 25 draws, the mean square of a standard normal one.
        self.assertTrue(0.3 < np.mean(np.square(misses)) < 2.2, misses)

    def test_a_strip_of_cloth_shows_what_peirce_s_formula_says(self):
        drop, reach = end_of_cantilever(1 / 8, 1.0, 1.0)
        self.assertAlmostEqual(math.degrees(math.atan(drop / reach)), 41.5, delta=0.02)
        share = float(re.search(r"k_b = w l³/8:\s`overhang` is l, and `drop` is ([0-9.]+) l\.", read(ROOT, "doc/measure.md"))[1])
        self.assertAlmostEqual(material.cantilever_stiffness(1.0, 1.0, share), 1 / 8, delta=1e-3 / 8)

    def test_fibres_that_rub_come_back_within_their_uncertainty(self):
        k_b = 3e-5
        rope = Rod(0, k_b).rub(25.0, 20.0, 2e-3)
        made, uncertain = self.made(rope.measured)
        self.assertEqual(made["bending_law"], "frictional")
        for name, value in rope.true.items():
            self.assertLess(abs(made[name] - value), 3.5 * uncertain[name], f"{name}: {made[name]}, not {value}")
        for name in ("bending_stiffness", "friction_moment", "stick_ratio", "compaction"):
            self.assertLess(uncertain[name], 0.25 * rope.true[name], name)
        # Without the light one the ratio is assumed, and k_b remains about the same.
        del rope.measured["light_cantilever"]
        values = material.read(yaml.safe_dump(rope.measured))[1]
        self.assertEqual(values["stick_ratio", ""], 20.0)
        self.assertAlmostEqual(material.properties(values)["bending_stiffness"], k_b, delta=0.12 * k_b)

    def test_a_bend_that_is_let_go_keeps_what_the_formulas_say(self):
        kept = 25.0
        for ratio in (2.0, 20.0):
            least = material.least_bend(kept, ratio)
            for bend in (1.01 * least, 3 * least):
                self.assertAlmostEqual(kept_by(Fibres(1.0, kept, ratio), bend), kept, delta=5e-4 * bend)
            for bend in (0.6 * least, 0.95 * least):  # friction does not turn round everywhere
                less = ((ratio - 1) * bend - kept) / ratio
                self.assertLess(less, 0.99 * kept)
                self.assertAlmostEqual(kept_by(Fibres(1.0, kept, ratio), bend), less, delta=5e-4 * bend)

    def test_a_cantilever_of_fibres_that_rub_is_the_chain_s(self):
        weight = 0.157
        for k_b, kept, ratio, far, near in ((3e-5, 25.0, 20.0, 0.2, 0.09), (1e-4, 12.0, 8.0, 0.3, 0.12)):
            drop = drop_of_a_rubbing_cantilever(Fibres(k_b, kept, ratio), weight, far)
            for stuck, given in ((None, ratio), (ratio * k_b, None)):
                self.assertAlmostEqual(material.rubbing_stiffness(weight, far, drop, kept, stuck, given) / k_b, 1.0, delta=2e-3)
            # Read without its friction it seems stiffer, and a short one has the stiffness of fibres that stick.
            self.assertGreater(material.cantilever_stiffness(weight, far, drop), 1.5 * k_b)
            short = drop_of_a_rubbing_cantilever(Fibres(k_b, kept, ratio), weight, near)
            self.assertAlmostEqual(material.cantilever_stiffness(weight, near, short) / (ratio * k_b), 1.0, delta=2e-3)

    def test_rates_are_a_method_s_and_rolling_is_the_material_s(self):
        measured = {**Rod(3, 2e-4).measured, "capstan": {"angle": [6.28, 0.09], "light": [0.2, 1e-3], "heavy": [2.9, 0.05]},
                    "creeping": {"masses": [[4.0, 0.01], [5.4, 0.01]], "speeds": [[1e-4, 1e-5], [1e-3, 1e-4]]},
                    "rolled": {"masses": [[2.0, 0.01], [8.0, 0.01]], "rises": [[0.12, 4e-3], [0.13, 3e-3]], "run": [0.5, 1e-3], "length": [0.3, 1e-3]}}
        made, uncertain = self.made(measured)
        self.assertNotIn("rate", made)
        self.assertEqual(made["rolling_resistance"], 0.25)
        self.assertAlmostEqual(uncertain["rolling_resistance"], math.hypot(4e-3, 3e-3, 0.25 * 2e-3), delta=1e-4)
        self.assertNotIn("bending_law", made)
        said = self.run_script(measured).stdout.split("for a method: ")[1]
        law = yaml.safe_load(re.search(r"{.*}", said)[0])
        # Of two masses, as it is printed: v = v_0 (exp((q - 1)/a) - 1)
        for mass, speed in ((4.0, 1e-4), (5.4, 1e-3)):
            over = math.log(mass / 0.2) / math.log(2.9 / 0.2) - 1
            self.assertAlmostEqual(law["rate_speed"] * math.expm1(over / law["rate"]) / speed, 1, delta=5e-3)
        done = subprocess.run([os.path.join(TOOLS, "tensile_test"), os.path.join(ROOT, "config/tighten.yaml"), "--check", "--set",
                               f"material={self.path('rope.yaml')}", *shlex.split(said, comments=True)], capture_output=True,
                              text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_a_thick_rope_around_a_post_gives_its_friction_back(self):
        """The tension grows as that of a rope with friction at its surface (doc/references.md, R15), forwards."""
        good = Rod(4, 2e-4).measured
        radius, angle, rate, speed = 0.0025, 4 * math.pi, 0.05, 1e-5
        for friction, post in ((0.42, 0.05), (0.42, 0.02), (0.2, 0.01)):
            thick = radius / (post + radius)

            def light_over_heavy(mu):
                return math.exp(-angle * (math.sqrt(1 + 4 * mu ** 2 * thick * (1 - thick)) - 1) / (2 * mu * thick))

            heavy = 0.2 / light_over_heavy(friction)
            speeds = [2 * speed, 50 * speed]
            masses = [0.2 / light_over_heavy(friction * (1 + rate * math.log1p(v / speed))) for v in speeds]
            measured = {**good, "diameter": [2 * radius, 1e-5],
                        "capstan": {"angle": [angle, 0.05], "light": [0.2, 1e-4], "heavy": [heavy, 0.01 * heavy], "post_radius": [post, 1e-3]},
                        "creeping": {"masses": [[m, 1e-4 * m] for m in masses], "speeds": [[v, 0.1 * v] for v in speeds]}}
            measured["rolled"] = {"masses": [[8.0, 0.01]], "rises": [[0.13, 3e-3]], "run": [0.5, 1e-3], "length": [0.3, 1e-3]}  # does not matter
            values, errors = material.read(yaml.safe_dump(measured))[1:]
            here, uncertain = material.with_errors(values, errors)
            self.assertAlmostEqual(here["friction_coefficient"], friction, places=9)
            self.assertAlmostEqual(here["rate"] / rate, 1, places=5)
            self.assertAlmostEqual(here["rate_speed"] / speed, 1, places=5)
            without = {key: value for key, value in values.items() if key != ("capstan", "post_radius")}
            self.assertLess(material.properties(without)["friction_coefficient"], friction)
            # The uncertainty of the post goes in.
            exact = material.with_errors(values, {**errors, ("capstan", "post_radius"): 0.0})[1]
            of_post = math.sqrt(uncertain["friction_coefficient"] ** 2 - exact["friction_coefficient"] ** 2)
            slope = (material.properties({**values, ("capstan", "post_radius"): post + 1e-6})["friction_coefficient"] - friction) / 1e-6
            self.assertAlmostEqual(of_post / abs(slope * 1e-3), 1, delta=0.02)

    @staticmethod
    def told(measured):
        """The properties, their uncertainties, and what is said beside them."""
        values, errors = material.read(yaml.safe_dump(measured))[1:]
        here, uncertain = material.with_errors(values, errors)
        material.usable(values, here)
        return here, uncertain, "\n".join(material.warnings(here, uncertain, values, errors))

    def rolled(self, measured, masses, couple, error=0.02):
        """What is told of 0.3 m of rope that rolls under the masses, and whose weight goes in."""
        h, piece = measured["diameter"][0] / 2, 0.3 * measured["weighed"]["mass"][0] / measured["weighed"]["length"][0]
        rises = [0.5 * slope_of_rolling(mass, piece, h, couple) for mass in masses]
        group = {"masses": [[mass, 1e-3 * mass] for mass in masses], "rises": [[rise, error * rise] for rise in rises], "run": [0.5, 1e-3],
                 "length": [0.3, 1e-3]}
        return self.told({**measured, "rolled": group})

    def test_pieces_under_a_loaded_board_give_back_what_resists_rolling(self):
        rope, h = Rod(5, 2e-4).measured, 0.0025
        for radius in (h, 2 * h):  # whatever the radius
            thick = {**rope, "diameter": [2 * radius, 5e-5]}
            made, uncertain, said = self.rolled(thick, (1.0, 8.0), lambda pressed, radius=radius: 0.27 * radius * pressed)
            self.assertAlmostEqual(made["rolling_resistance"], 0.27, places=5)
            self.assertAlmostEqual(uncertain["rolling_resistance"], 0.27 * math.hypot(0.02 / math.sqrt(2), 2e-3), delta=1e-4)
            self.assertNotIn("rolled", said)
        # Of a solid rod with its wide contact: the share of the work that it loses, from the half width of each contact by Hertz.
        solid = {**rope, "stretched": {**rope["stretched"], "elongation": [500 * number for number in rope["stretched"]["elongation"]]}}
        values = material.read(yaml.safe_dump(solid))[1]
        h, k_s = (material.properties(values)[key] for key in ("radius", "stretching_stiffness"))

        def loses(pressed):
            modulus = k_s / (math.pi * h * h) / (1 - 0.5 ** 2)
            width = math.sqrt(4 * pressed / 0.3 * h / (math.pi * modulus))
            return 0.4 * pressed * 2 * width / (3 * math.pi)

        made, uncertain, said = self.rolled(solid, (2.0, 8.0), loses)
        self.assertAlmostEqual(made["rolling_hysteresis"] / 0.4, 1, delta=0.01)  # of the weight of the pieces, which it leaves out
        self.assertLess(uncertain["rolling_hysteresis"], 0.1)
        self.assertNotIn("rolling_resistance", made)
        self.assertNotIn("rolled", said)

    def test_what_two_weights_cannot_tell_is_said(self):
        rope = Rod(5, 2e-4).measured

        def power(grows, at=0.2, h=0.0025):
            return lambda pressed: at * h * pressed * (pressed / 80.0) ** grows

        for masses, couple, error, said, resists in (
                ((8.0,), power(0), 0.02, "one mass does not tell", 0.2),
                ((2.0, 8.0), power(0.5), 0.02, "that of the heaviest mass is taken", 0.2 * math.sqrt(8 * GRAVITY / 80)),
                ((0.01, 0.08), power(0), 0.02, "rolled: the pieces bear at most 2.6 N/m", 0.2)):
            with self.subTest(said):
                made, _, words = self.rolled({**rope, "diameter": [0.005, 5e-5]}, masses, couple, error)
                self.assertIn(said, words)
                self.assertAlmostEqual(made["rolling_resistance"] / resists, 1, delta=0.01)

    def test_a_torsion_pendulum_gives_the_twisting_stiffness_back(self):
        good = {**Rod(6, 3e-5).measured, "diameter": [0.005, 5e-5]}
        for k_t, mass, radius, heavy in ((7.5e-6, 0.03, 0.1, False), (2e-5, 0.2, 0.05, False), (7.5e-6, 0.5, 0.1, True)):
            period = period_of_pendulum(k_t, 0.0025, 0.5, mass, radius)
            measured = {**good, "twisted": {"length": [0.5, 2e-3], "mass": [mass, 0.01 * mass], "radius": [radius, 5e-4], "period": [float(period), 0.1]}}
            here, uncertain, said = self.told(measured)
            self.assertAlmostEqual(here["twisting_stiffness"] / k_t, 1, delta=1e-3)
            self.assertEqual(heavy, "weight of the disc" in said)
            # By hand, from what the disc shows and the part of its weight.
            weight = mass * GRAVITY * 0.0025 ** 2 / 2
            seen = k_t + weight
            self.assertAlmostEqual(uncertain["twisting_stiffness"] / math.hypot(
                0.01 * k_t, 0.02 * weight, seen * 2e-3 / 0.5, seen * 2 * 5e-4 / radius, seen * 2 * 0.1 / period), 1, delta=0.01)
        # None is measured: fibres that slide past each other, or one rod of rubber.
        values = material.read(yaml.safe_dump(good))[1]
        for elongation, share in ((1, 1 / 4), (5000, 2 / 3)):
            here = material.properties({**values, ("stretched", "elongation"): elongation * values["stretched", "elongation"]})
            self.assertAlmostEqual(here["twisting_stiffness"] / here["bending_stiffness"], share, places=12)

    def test_what_is_wrong_is_named(self):
        good = yaml.safe_load(read(EXAMPLE))
        material.usable(*self.understood(good))

        def has(group, **changed):
            return {**good, group: {**good[group], **changed}}

        def without(*groups):
            return {name: content for name, content in good.items() if name not in groups}

        speeds = good["creeping"]["speeds"]
        for measured, named in (
                (without("mandrel", "light_cantilever"), "pulled tells nothing without mandrel"),
                (has("mandrel", radius=[0.05, 1e-4]), "mandrel: the rope keeps a radius of 0.04 m, for which the mandrel's must be at"),
                (has("mandrel", kept_radius=0.04), "mandrel.kept_radius is 0.04, but must be [value, uncertainty]"),
                (has("light_cantilever", overhang=[0.12, 1e-3]), "light_cantilever: its overhang must be at most 0.0979 m"),
                (has("cantilever", overhang=[0.1, 1e-3], drop=[0.005, 1e-4]), "measure a longer overhang"),
                (has("pulled", mass=[0.02, 1e-4]), "pulled: compaction comes out as 1.86, but a method takes 0 to 1"),
                (has("rolled", rises=[[0.13, 0.01]]), "rolled.rises must be a list of one reading or more, as many as rolled.masses"),
                (has("twisted", period=[187, 3]), "twisted: the weight of the disc alone"),
                (has("creeping", masses=[[4, 0.01]]), "creeping.masses must be a list of two readings or more, as many as creeping.speeds"),
                (has("capstan", post_radius=[2e-4, 1e-5]), "capstan: around a post as thin as 0.0002 m no friction"),
                (has("capstan", angle=[360, 5]), "is it in degrees? 360 degrees are 6.283 rad"),
                ({**good, "diameter": [5, 0.1]}, "is it in metres?"),
                ({**good, "loops": {}}, "loops"),
                (without("weighed"), "missing: weighed"),
                (has("weighed", mass=[160, 1]), "is weighed.mass in kg, and are weighed.length and the diameter in m? A method takes 10 to 25000 kg/m3"),
                (has("creeping", speeds=speeds[::-1]), "a larger mass must creep faster"),
                (has("creeping", masses=[[2.8, 0.01], [5.4, 0.01]]), "every mass must be more than capstan.heavy"),
                (has("creeping", speeds=[[1e-12, 1e-13], [1e-6, 1e-7]]), "creeping: rate_speed comes out as")):
            with self.subTest(named), self.assertRaises(WrongInput) as wrong:
                material.usable(*self.understood(measured))
            self.assertIn(named, str(wrong.exception))
        done = self.run_script(has("mandrel", radius=[0.05, 1e-4]))
        self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)
        self.assertFalse(os.path.exists(self.path("rope.yaml")))

    @staticmethod
    def understood(measured):
        values = material.read(yaml.safe_dump(measured))[1]
        return values, material.properties(values)

    def test_the_rod_is_told_in_words(self):
        good = Rod(1, 2e-4).measured
        done = self.run_script(good)
        self.assertRegex(done.stdout, r"rope.yaml: [0-9.]+ g/m at a diameter of [0-9.]+ mm, E = [0-9.e+-]+ GPa stretched, friction 0.4\d?; "
                                      r"in bending 1/\d+ as stiff as a solid rod of this E, as ropes are\n")
        # It is a rope, whose fibres were not measured, nor how its strands roll.
        self.assertEqual(done.stderr.count("\n"), 2, done.stderr)
        self.assertIn("measure rolled", done.stderr)
        self.assertIn("its bends are taken as elastic", done.stderr)
        solid = {**good, "stretched": {**good["stretched"], "elongation": [1000 * number for number in good["stretched"]["elongation"]]}}
        done = self.run_script(solid)
        self.assertEqual(done.stderr, "")
        self.assertIn("times as stiff as a solid rod of this E\n", done.stdout)


class Example(unittest.TestCase):
    def test_the_worked_example_gives_what_doc_measure_says(self):
        page, measured, said = (read(ROOT, file) for file in (
            "doc/measure.md", EXAMPLE, "test/python/scripts/measured_rope.yaml"))
        values, errors = material.read(measured)[1:]
        here = material.properties(values)
        power, error = material.power_of_rolling(values, errors)
        seen, of_weight = material.swing(values, here["radius"])
        kept = material.kept_curvature(values, "pulled")
        for words in (f"n = {power:.3f} ± {error:.3f}", f"μ_r = {here['rolling_resistance']:.3f} is constant", f"R_pulled = 30²/64 + 4 = {1e3 / kept:.2f} mm",
                      f"4π² J l/t² = {seen:.3g} N m², of which the weight has {of_weight:.2g}.", f"k_t = {here['twisting_stiffness']:.3g} N m², a quarter",
                      f"c_m = {here['compaction']:.5f}.", f"grown by {(kept - 25) * here['bending_stiffness']:.3g} N m."):
            self.assertIn(words.replace("e-0", "e-"), page)
        with tempfile.TemporaryDirectory(prefix="knot_utm_material_") as folder:
            files = EXAMPLE, os.path.join(folder, "rope.yaml")
            subprocess.run([os.path.join(ROOT, "scripts/material"), files[0], "--out", files[1]], check=True)
            self.assertEqual(read(files[1]), said)
            weight = 0.016 * GRAVITY
            self.assertAlmostEqual(material.cantilever_stiffness(weight, 0.2, 0.159) / yaml.safe_load(said)["bending_stiffness"], 2.6, delta=0.05)
            out = os.path.join(folder, "out")
            subprocess.run([os.path.join(TOOLS, "tensile_test"), os.path.join(ROOT, "config/tighten.yaml"), "--quiet", "--set",
                            f"material={files[1]}", "--set", "physics.accuracy=draft", "--out", out], check=True)
            result = yaml.safe_load(read(out, "result.yaml"))
            self.assertEqual(result["motion_pattern"], "sliding")
            slides = float(re.search(r"slide at ([0-9.]+) N", page)[1])
            self.assertAlmostEqual(result["plateau_force"] / slides, 1.0, delta=0.2)


if __name__ == "__main__":
    unittest.main()
