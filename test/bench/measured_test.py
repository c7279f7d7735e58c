#!/usr/bin/python3
"""What scripts/validate --measured makes of runs: figures, means over starts, orders, what holds, and gates."""
import math
import os
import sys
import unittest

import numpy as np

sys.dont_write_bytecode = True
ROOT = os.path.realpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "../.."))
sys.path.insert(0, os.path.join(ROOT, "bench"))

import bend_orders  # noqa: E402
import bends  # noqa: E402
import capstans  # noqa: E402
import fibers  # noqa: E402
import hitches  # noqa: E402
import holding  # noqa: E402
import measured  # noqa: E402
import predictions  # noqa: E402
import strengths  # noqa: E402
import runs  # noqa: E402
import surgeons  # noqa: E402

FACTS = runs.read_yaml(measured.FACTS)


def a_run(result=None, method=None, exit_code=0, pull=()):
    run = runs.Run("/nowhere", 1.0, exit_code, "")
    run.result, run.method = result or {}, method or {}
    run.curve = {"phase": ["pull"] * len(pull), "extension": [s for s, _ in pull], "load": [force for _, force in pull]}
    return run


def failed(rows):
    return predictions.table_of(rows).failed()


class Facts(unittest.TestCase):
    def test_a_mean_needs_every_start(self):
        value, error = predictions.mean_of_all([1.0, 2.0, 3.0])
        self.assertEqual((value, round(error, 9)), (2.0, round(1 / math.sqrt(3), 9)))
        self.assertEqual(predictions.mean_of_all([1.0, None, 3.0]), (None, None))

    def test_the_speed_of_tying_is_the_documented_default(self):
        with open(os.path.join(ROOT, "doc/method.md"), encoding="utf-8") as page:
            self.assertIn(f"(auto: {bends.TYING_SPEED:g} radii/s;", page.read())

    def test_knots_ropes_and_methods_are_shipped(self):
        bends_held = [knot for name in ("greased", "ordinary", "slippery") for knot in FACTS[name]["slip"] + FACTS[name]["hold"]]
        surgeons_knots = [f"surgeon_{turns}" for turns in (1, 2, 3)]
        for knot in surgeons_knots + FACTS["orders"]["order"] + FACTS["slipping"]["order"] + bends_held + list(FACTS["strengths"]["knots"]):
            self.assertTrue(runs.read_yaml(f"config/knots/{knot}.yaml"), knot)
        for rope in FACTS["orders"]["ropes"] + FACTS["ordinary"]["ropes"] + [FACTS[name]["rope"] for name in ("slipping", "greased", "slippery")]:
            self.assertTrue(runs.read_yaml(f"config/materials/{rope}.yaml"), rope)
        for name in FACTS["inversions"]["photographs"]:
            specimen = runs.read_yaml(f"config/validation/{name}.yaml")["specimen"]
            self.assertEqual((specimen["turns"], specimen["length"]), (int(name.split("_")[-1]), 1.0))
        self.assertEqual(list(surgeons.points_of(FACTS["surgeons"]["points"])), [1, 2, 3])


class Surgeons(unittest.TestCase):
    CURVE = (np.linspace(0.1, 0.3, 201), 1e-3 * np.linspace(0.1, 0.3, 201) ** -3)  # force over the length taken up

    def points(self, beyond, factor=1.0):
        lengths = np.linspace(0.15, 0.25, 11)
        return lengths + beyond, factor * 1e-3 * lengths ** -3

    def test_the_unknown_length_is_found_and_leaves_the_factor_1(self):
        length, logarithms = surgeons.fit(self.CURVE, self.points(0.07))
        self.assertAlmostEqual(length, 0.07, delta=surgeons.STEP)
        # At the shortest length, half a step makes 3/2 STEP/0.15 of a force that falls with the cube.
        self.assertAlmostEqual(surgeons.factor_of(logarithms), 1.0, delta=1.5 * surgeons.STEP / 0.15)
        self.assertAlmostEqual(surgeons.factor_of([math.log(2.0), -math.log(2.0)]), 2.0)

    def test_a_start_that_fits_nothing_fails_its_knot_and_all_points(self):
        length, force = self.CURVE
        good, nothing = (surgeons.fit((length[:end], force[:end]), self.points(0.0, 1.2)) for end in (201, 90))
        self.assertIsNone(surgeons.curve_of(a_run(exit_code=1)))
        rows = surgeons.rows_of({1: [good] * 3, 2: [good, nothing, good]}, FACTS["surgeons"])
        self.assertEqual([row.predicted is None for row in rows], [False, True, True])
        self.assertEqual(len(failed(rows)), 2)


class Cylinders(unittest.TestCase):
    FORCES = {"lightly": [(t, 5.0 * t ** 1.4) for t in (0.3, 1.0, 2.0)], "tightly": [(t, 12.0 * t) for t in (10.0, 20.0, 100.0)]}

    def capstans(self, smallest, largest):
        starts = {turns: [[1.2, 1.0]] * 3 for turns in FACTS["capstans"]["turns"]}
        starts[min(starts)], starts[max(starts)] = [smallest] * 3, [largest] * 3
        return failed(capstans.rows_of(starts, FACTS["capstans"]))

    def hitches(self, **forces):
        starts = {rope: [self.FORCES] * 3 for rope in FACTS["hitches"]["ropes"]}
        starts["elastic braid"] = [{**self.FORCES, **forces}] * 3
        return failed(hitches.rows_of(starts, FACTS["hitches"]))

    def test_an_exponent_is_the_slope_of_logarithms_and_a_polynomial_is_extrapolated_to_zero(self):
        self.assertAlmostEqual(capstans.exponent({1: 3.0, 2: 12.0}, 1, 2), 2.0)
        self.assertAlmostEqual(hitches.exponent(self.FORCES["lightly"]), 1.4)
        for force, point in ((None, None), (-1.0, (1.0, -1.0))):
            self.assertIsNone(capstans.exponent({1: force, 2: 12.0}, 1, 2))
            self.assertIsNone(hitches.exponent(self.FORCES["lightly"] + [point]))
        x = [0.1, 0.07, 0.05]
        self.assertAlmostEqual(fibers.at_zero(x, [2.0 - 3.0 * at + 5.0 * at ** 2 for at in x]), 2.0)

    def test_capstans_are_superlinear_then_linear_and_less_so_at_small_angles(self):
        self.assertEqual(self.capstans([1.1, 1.0], [1.3, 1.0]), [])
        self.assertIn("excess over 1", self.capstans([1.3, 1.0], [1.2, 1.0])[0])
        self.assertIn("2 turns, touching all along", self.capstans([1.1, 1.0], [1.3, 1.11])[0])
        self.assertEqual(len(self.capstans([1.1, 1.0], [None, None])), 3)

    def test_hitches_are_superlinear_then_linear_and_alike(self):
        self.assertEqual(self.hitches(), [])
        self.assertIn("elastic braid, touching lightly", self.hitches(lightly=[(t, 5.0 * t ** 0.9) for t, _ in self.FORCES["lightly"]])[0])
        self.assertIn("3 ropes", self.hitches(tightly=[(t, 1.11 * force) for t, force in self.FORCES["tightly"]])[0])
        self.assertEqual(len(self.hitches(lightly=[None])), 2)

    def test_the_force_on_a_post_is_the_load_along_the_rod_at_rest_less_what_strands_press_on_each_other(self):
        # Four edges of 0.1 m at rest, drawn out to 0.15 m by half their stiffness: 6 N/m presses on 0.4 m, of which 2 * 0.5 N is theirs.
        shape = {"x": np.linspace(0.0, 0.6, 5), "y": np.zeros(5), "z": np.zeros(5), "tension": np.array([2.0, 2.0, 2.0, 2.0, math.nan]),
                 "contact_force": np.full(5, 6.0)}
        stretch = hitches.stretch_of(shape["tension"][:-1] / 4.0, "linear")
        self.assertAlmostEqual(hitches.post_force(shape, stretch, 0.5), 6.0 * 0.4 - 2 * 0.5, places=14)
        self.assertAlmostEqual(hitches.stretch_of((2.0 - 0.25) / 3, "neo_hookean"), 2.0, places=5)
        self.assertEqual(hitches.tension_of(shape), 2.0)


class Orders(unittest.TestCase):
    def row(self, *loads):
        return bend_orders.rows({"rope": {knot: (load, 0.0) for knot, load in zip(FACTS["orders"]["order"], loads)}}, FACTS["orders"])[0]

    def test_a_load_is_the_largest_in_the_pull_in_units_of_the_rod_and_a_bend_slips_where_it_falls_to_less_than_half(self):
        method = {"material": {"bending_stiffness": "2e0", "radius": 0.5}}  # YAML of this library takes 2e0 for a text
        for exit_code, last, load, slips_at in ((0, 11.0, 3.0, 3.0), (0, 13.0, 3.0, None), (1, 1.0, None, None)):
            run = a_run({}, method, exit_code, [(0.0, 3.0), (0.1, 24.0), (0.2, last)])
            self.assertEqual((bends.load_of(run), bends.slipping_load_of(run)), (load, slips_at))

    def test_only_the_published_order_passes_and_bends_that_let_go_count_as_alike(self):
        for loads, passes in (((1.0, 2.0, 3.0, 4.0), True), ((1.0, 2.0, 4.0, 3.0), False), ((1.0, None, 3.0, 4.0), False),
                              ((0.9, 0.3, 3.0, 4.0), True), ((1.1, 0.3, 3.0, 4.0), False), ((0.1, 0.2, 0.9, 0.8), True)):
            self.assertEqual(failed([self.row(*loads)]) == [], passes, loads)
        swapped = self.row(1.0, 2.0, 4.0, 3.0)
        self.assertEqual((swapped.predicted, round(swapped.factor, 9)), ("grief < thief < reef < granny", 0.8))


class Holding(unittest.TestCase):
    GREASED = FACTS["greased"]

    def bends(self, wrong=0):
        facts = self.GREASED
        knots = facts["slip"] + facts["hold"]
        held = {knot: 0 if (knot in facts["slip"]) != (knot in knots[:wrong]) else len(bends.SPEEDS) for knot in knots}
        return {knot: holding.Bend(held[knot], (load, 0.1)) for knot, load in zip(knots, range(1, 9))}

    def test_a_bend_is_right_where_every_start_does_as_measured(self):
        ends = [a_run({"ended_by": word}) for word in ("break", "extension", "break")]
        self.assertEqual(holding.count_of_breaks(ends), 2)
        self.assertIsNone(holding.count_of_breaks(ends + [a_run({"ended_by": "break"}, exit_code=1)]))
        for held in (2, None):
            self.assertEqual(holding.wrong({**self.bends(), "zeppelin": holding.Bend(held)}, self.GREASED), ["zeppelin"])

    def test_the_best_friction_is_named_as_fitted_and_judged(self):
        for wrong, passes in ((2, True), (3, False)):
            scan = {0.1: self.bends(wrong=4), 0.2: self.bends(wrong=wrong), 0.3: self.bends(wrong=5)}
            count, order = holding.rows_of_scan(scan, self.GREASED)
            self.assertEqual((count.predicted, count.fitted), (8 - wrong, "friction of suture_3-0_nylon: 0.2"))
            self.assertEqual(failed([count]) == [], passes)
            self.assertEqual(order.predicted, 1.0)
        without = {key: value for key, value in self.GREASED.items() if key != "right"}  # then every bend has to be right
        self.assertEqual([len(failed([holding.row(self.bends(wrong=wrong), without)])) for wrong in (0, 1)], [0, 1])


class Strengths(unittest.TestCase):
    FACTS = FACTS["strengths"]

    def failed(self, ratio=2.0, **others):
        middle = {knot: (runs.mean(ranges[0]), 0.01) for knot, ranges in self.FACTS["knots"].items()}
        return failed(strengths.rows_of({"overhand_tied": (0.55, 0.01), **middle, **others}, ratio, self.FACTS))

    def test_each_knot_is_held_against_what_was_published(self):
        self.assertEqual(self.failed(), [])
        for beyond in ({"ratio": 1.0}, {"ratio": None}, {"overhand_tied": (0.62, 0.01)}, {"overhand_tied": (None, None)}, {"bowline": (0.38, 0.01)}):
            self.assertEqual(len(self.failed(**beyond)), 1, beyond)

    def test_so_many_have_to_be_near_one_of_their_sources(self):
        far = {knot: (0.9, 0.01) for knot in ("reef", "sheet_bend")}
        self.assertEqual(self.failed(**far), [])
        self.assertIn("published range is 4", self.failed(carrick=(0.9, 0.01), **far)[0])
        for value, near in ((0.44, True), (0.42, False), (0.55, False), (0.59, True), (None, False)):
            self.assertEqual(strengths.is_near(value, [[0.48], [0.62, 0.7]], 0.05), near, value)


if __name__ == "__main__":
    unittest.main()
