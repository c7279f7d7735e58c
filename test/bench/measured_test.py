#!/usr/bin/python3
"""What scripts/validate --measured makes of runs: means over starts, orders, what holds, gates, and what its files say."""
import math
import os
import subprocess
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
import inversions  # noqa: E402
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


class Starts(unittest.TestCase):
    def test_a_mean_needs_every_start(self):
        value, error = predictions.mean_of_all([1.0, 2.0, 3.0])
        self.assertEqual((value, round(error, 9)), (2.0, round(1 / math.sqrt(3), 9)))
        self.assertEqual(predictions.mean_of_all([1.0, None, 3.0]), (None, None))

    def test_there_are_three_or_more_that_differ(self):
        for factors in (predictions.STARTS, bends.SPEEDS):
            self.assertGreaterEqual(len(set(factors)), 3)

    def test_the_speed_of_tying_is_the_documented_default(self):
        with open(os.path.join(ROOT, "doc/method.md"), encoding="utf-8") as page:
            self.assertIn(f"(auto: {bends.TYING_SPEED:g} radii/s;", page.read())


class Inversions(unittest.TestCase):
    def row(self, values):
        return inversions.row_of("overhand_inversion_2", [0.75, 0.79], FACTS["inversions"], values)

    def test_the_place_is_that_of_the_ends_over_the_length(self):
        method = {"specimen": {"length": 2.0}}
        self.assertEqual(inversions.inverted_at(a_run({"gauge_length": 1.2, "snap_extension": 0.3}, method)), 0.75)
        self.assertIsNone(inversions.inverted_at(a_run({"gauge_length": 1.2, "snap_extension": None}, method)))
        self.assertIsNone(inversions.inverted_at(a_run({"gauge_length": 1.2, "snap_extension": 0.3}, method, exit_code=1)))

    def test_the_gate_is_the_photographs_and_a_hundredth(self):
        for value, passes in ((0.741, True), (0.799, True), (0.739, False), (0.801, False), (None, False)):
            self.assertEqual(predictions.table_of([self.row([value] * 3)]).failed() == [], passes, value)

    def test_every_method_is_there_with_its_ends_and_length(self):
        for name in FACTS["inversions"]["photographs"]:
            specimen = runs.read_yaml(os.path.join(ROOT, f"config/validation/{name}.yaml"))["specimen"]
            self.assertEqual((specimen["turns"], specimen["length"]), (int(name.split("_")[-1]), 1.0))


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

    def test_a_factor_is_the_root_mean_square_of_logarithms(self):
        self.assertAlmostEqual(surgeons.factor_of([math.log(2.0), -math.log(2.0)]), 2.0)
        self.assertAlmostEqual(surgeons.factor_of([0.0, 0.0]), 1.0)

    def test_a_curve_that_is_shorter_than_the_points_fits_none(self):
        length, force = self.CURVE
        self.assertIsNone(surgeons.fit((length[:90], force[:90]), self.points(0.0)))
        self.assertIsNone(surgeons.fit(None, self.points(0.0)))

    def test_a_knot_that_pushes_counts_as_the_smallest_force_that_was_read(self):
        length, force = self.CURVE
        _, logarithms = surgeons.fit((length, np.full_like(force, -1.0)), self.points(0.0))
        np.testing.assert_allclose(np.exp(logarithms), surgeons.SMALLEST / self.points(0.0)[1])

    def test_a_curve_is_the_rod_less_the_distance_of_its_ends(self):
        run = a_run(pull=[(0.0, 1.0), (0.1, 2.0)])
        run.curve["end_to_end"] = [0.3, 0.4]
        run.shape = {"x": [0.0, 0.3, 0.3], "y": [0.0, 0.0, 0.4], "z": [0.0] * 3}
        taken_up, load = surgeons.curve_of(run)
        np.testing.assert_allclose(taken_up, [0.3, 0.4])
        self.assertEqual(list(load), [2.0, 1.0])
        self.assertIsNone(surgeons.curve_of(a_run(exit_code=1)))

    def test_points_have_the_published_scatter(self):
        points = runs.read_curve(os.path.join(ROOT, FACTS["surgeons"]["points"]))
        for turns, scatter in ((1, 0.28), (2, 0.47), (3, 0.19)):
            ratios = [d / f for t, d, f in zip(points["turns"], points["deviation"], points["force"]) if t == turns]
            self.assertAlmostEqual(runs.median(ratios), scatter, delta=0.005)
            self.assertTrue(os.path.exists(os.path.join(ROOT, f"config/knots/surgeon_{turns}.yaml")))
        self.assertEqual(list(surgeons.points_of(os.path.join(ROOT, FACTS["surgeons"]["points"]))), [1, 2, 3])

    def test_a_start_that_fits_nothing_fails_its_knot_and_all_points(self):
        good = surgeons.fit(self.CURVE, self.points(0.0, 1.2))
        rows = surgeons.rows_of({1: [good] * 3, 2: [good, None, good]}, FACTS["surgeons"])
        self.assertEqual([row.predicted is None for row in rows], [False, True, True])
        self.assertEqual(len(predictions.table_of(rows).failed()), 2)


class Capstans(unittest.TestCase):
    def failed(self, smallest, largest):
        starts = {turns: [[1.2, 1.0]] * 3 for turns in FACTS["capstans"]["turns"]}
        starts[min(starts)], starts[max(starts)] = [smallest] * 3, [largest] * 3
        return predictions.table_of(capstans.rows_of(starts, FACTS["capstans"])).failed()

    def test_an_exponent_is_the_slope_of_logarithms(self):
        self.assertAlmostEqual(capstans.exponent({1: 3.0, 2: 12.0}, 1, 2), 2.0)
        for force in (None, 0.0, -1.0):
            self.assertIsNone(capstans.exponent({1: force, 2: 12.0}, 1, 2))

    def test_superlinear_then_linear_and_less_so_at_small_angles(self):
        self.assertEqual(self.failed([1.1, 1.0], [1.3, 1.0]), [])
        self.assertIn("excess over 1", self.failed([1.3, 1.0], [1.2, 1.0])[0])
        self.assertIn("2 turns, touching lightly", self.failed([0.9, 1.0], [0.99, 1.0])[0])
        self.assertIn("2 turns, touching all along", self.failed([1.1, 1.0], [1.3, 1.11])[0])
        self.assertEqual(len(self.failed([1.1, 1.0], [None, None])), 3)


class Fibers(unittest.TestCase):
    def test_a_strand_without_thickness_is_a_thread(self):
        self.assertAlmostEqual(fibers.rate_of_a_thick_strand(0.3, 1e-6), 0.3, places=6)
        self.assertLess(fibers.rate_of_a_thick_strand(0.3, 0.1), 0.3)

    def test_a_polynomial_is_extrapolated_to_its_value_at_zero(self):
        x = [0.1, 0.07, 0.05]
        self.assertAlmostEqual(fibers.at_zero(x, [2.0 - 3.0 * at + 5.0 * at ** 2 for at in x]), 2.0)

    def test_the_torque_of_a_yarn_is_that_of_its_energy(self):
        force, radius, k_b, k_t, step = 3.0, 1.1, 2.0, 1.3, 1e-6

        def energy(angle):  # of both strands less the work of the force, for each length of a strand
            bend, twist = math.sin(angle) ** 2 / radius, math.sin(angle) * math.cos(angle) / radius
            return k_b * bend ** 2 + k_t * twist ** 2 - force * math.cos(angle)

        for angle in (0.1, 0.4, 0.7):
            turned = (math.sin(angle + step) - math.sin(angle - step)) / radius
            torque = (energy(angle + step) - energy(angle - step)) / turned
            twist = math.sin(angle) * math.cos(angle) / radius
            self.assertAlmostEqual(fibers.torque_of(force, radius, angle, twist, k_b, k_t), torque, places=6)

    def test_a_double_helix_is_read_as_it_is(self):
        s = np.linspace(0.0, 40.0, 201)
        angle, radius = 0.3, 1.02
        turn = math.sin(angle) / radius * s
        one = np.array([radius * np.cos(turn), radius * np.sin(turn), math.cos(angle) * s])
        other = (one * np.array([[-1], [-1], [1]]))[:, ::-1]
        x, y, z = np.concatenate([one, other], axis=1)
        shapes = {"time": np.full(402, 2.0), "x": x, "y": y, "z": z, "twist": np.full(402, 0.25), "rope": np.repeat([1, 2], 201)}
        for found, there in zip(fibers.middle_of(shapes), (radius, angle, 0.25)):
            self.assertAlmostEqual(found, there, places=9)


class Hitches(unittest.TestCase):
    FORCES = {"lightly": [(t, 5.0 * t ** 1.4) for t in (0.3, 1.0, 2.0)], "tightly": [(t, 12.0 * t) for t in (10.0, 20.0, 100.0)]}

    def failed(self, **forces):
        starts = {rope: [self.FORCES] * 3 for rope in FACTS["hitches"]["ropes"]}
        starts["elastic braid"] = [{**self.FORCES, **forces}] * 3
        return predictions.table_of(hitches.rows_of(starts, FACTS["hitches"])).failed()

    def test_the_force_on_a_post_is_the_load_along_the_rod_at_rest_less_what_strands_press_on_each_other(self):
        # Four edges of 0.1 m at rest, drawn out to 0.15 m by half their stiffness: 6 N/m presses on 0.4 m, of which 2 * 0.5 N is theirs.
        shape = {"x": np.linspace(0.0, 0.6, 5), "y": np.zeros(5), "z": np.zeros(5), "tension": np.array([2.0, 2.0, 2.0, 2.0, math.nan]),
                 "contact_force": np.full(5, 6.0)}
        stretch = hitches.stretch_of(shape["tension"][:-1] / 4.0, "linear")
        self.assertAlmostEqual(hitches.post_force(shape, stretch, 0.5), 6.0 * 0.4 - 2 * 0.5, places=14)
        self.assertAlmostEqual(hitches.stretch_of((2.0 - 0.25) / 3, "neo_hookean"), 2.0, places=5)
        self.assertEqual(hitches.tension_of(shape), 2.0)

    def test_an_exponent_is_fitted_to_all_pre_loads(self):
        self.assertAlmostEqual(hitches.exponent(self.FORCES["lightly"]), 1.4)
        for point in (None, (1.0, 0.0), (1.0, -1.0)):
            self.assertIsNone(hitches.exponent(self.FORCES["lightly"] + [point]))

    def test_superlinear_then_linear_and_alike(self):
        self.assertEqual(self.failed(), [])
        self.assertIn("elastic braid, touching lightly", self.failed(lightly=[(t, 5.0 * t ** 0.9) for t, _ in self.FORCES["lightly"]])[0])
        self.assertIn("elastic braid, touching all along", self.failed(tightly=[(t, t ** 1.11) for t, _ in self.FORCES["tightly"]])[0])
        self.assertIn("3 ropes", self.failed(tightly=[(t, 1.11 * force) for t, force in self.FORCES["tightly"]])[0])
        self.assertEqual(len(self.failed(lightly=[None])), 2)

    def test_the_shape_that_counts_is_the_last(self):
        shape = hitches.last_shape({"time": [1.0, 1.0, 2.0, 2.0], "x": [0.0, 1.0, 2.0, 3.0]})
        np.testing.assert_array_equal(shape["x"], [2.0, 3.0])


class Orders(unittest.TestCase):
    ORDER = ["grief", "thief", "granny", "reef"]

    def row(self, *loads):
        return bend_orders.rows({"rope": {knot: (load, 0.0) for knot, load in zip(self.ORDER, loads)}}, FACTS["orders"])[0]

    def test_a_load_is_the_largest_in_the_pull_in_units_of_the_rod(self):
        method = {"material": {"bending_stiffness": "2e0", "radius": 0.5}}  # YAML of this library takes 2e0 for a text
        run = a_run({}, method, pull=[(0.0, 3.0), (0.1, 24.0), (0.2, 8.0)])
        self.assertEqual(bends.load_of(run), 3.0)
        run.exit_code = 1
        self.assertIsNone(bends.load_of(run))

    def test_only_the_published_order_passes(self):
        self.assertEqual(predictions.table_of([self.row(1.0, 2.0, 3.0, 4.0)]).failed(), [])
        self.assertEqual(self.row(1.0, 2.0, 3.0, 4.0).factor, 1.0)
        swapped = self.row(1.0, 2.0, 4.0, 3.0)
        self.assertEqual(swapped.predicted, "grief < thief < reef < granny")
        self.assertAlmostEqual(swapped.factor, 0.8)
        table = predictions.table_of([swapped])
        self.assertEqual(len(table.failed()), 1)
        self.assertIn(FACTS["orders"]["if_it_fails"], table.markdown())
        self.assertNotIn(FACTS["orders"]["if_it_fails"], predictions.table_of([self.row(1.0, 2.0, 3.0, 4.0)]).markdown())

    def test_bends_that_let_go_count_as_alike(self):
        for loads, passes in (((0.9, 0.3, 3.0, 4.0), True), ((1.1, 0.3, 3.0, 4.0), False), ((0.1, 0.2, 0.9, 0.8), True)):
            self.assertEqual(predictions.table_of([self.row(*loads)]).failed() == [], passes, loads)

    def test_a_bend_slips_where_its_load_falls_to_less_than_half(self):
        method = {"material": {"bending_stiffness": 2.0, "radius": 0.5}}
        for last, load in ((11.0, 3.0), (13.0, None)):
            self.assertEqual(bends.slipping_load_of(a_run({}, method, pull=[(0.0, 3.0), (0.1, 24.0), (0.2, last)])), load)
        self.assertIsNone(bends.slipping_load_of(a_run({}, method, exit_code=1, pull=[(0.1, 24.0), (0.2, 1.0)])))

    def test_bends_that_slip_are_judged_by_their_ranks(self):
        facts = FACTS["slipping"]
        for loads, passes in (([1, 2, 3, 4, 5, 6], True), ([2, 1, 3, 4, 6, 5], True), ([1, 2, 3, 6, 5, 4], False),
                              ([1, 2, 3, 4, 5, None], False)):
            row = bend_orders.slipping_row({knot: (load, 0.0) for knot, load in zip(facts["order"], loads)}, facts)
            self.assertEqual(predictions.table_of([row]).failed() == [], passes, loads)

    def test_a_knot_that_has_no_load_fails(self):
        self.assertEqual(len(predictions.table_of([self.row(1.0, None, 3.0, 4.0)]).failed()), 1)


class Holding(unittest.TestCase):
    GREASED = FACTS["greased"]

    def bends(self, *, wrong=0, loads=(1.0, 2.0, 3.0, 4.0)):
        facts = self.GREASED
        knots = facts["slip"] + facts["hold"]
        held = {knot: 0 if (knot in facts["slip"]) != (knot in knots[:wrong]) else len(bends.SPEEDS) for knot in knots}
        return {knot: holding.Bend(held[knot], (load, 0.1)) for knot, load in zip(knots, loads + (9.0,) * 4)}

    def test_breaks_are_counted_and_a_run_that_gave_up_is_none(self):
        ends = [a_run({"ended_by": word}) for word in ("break", "extension", "break")]
        self.assertEqual(holding.count_of_breaks(ends), 2)
        self.assertIsNone(holding.count_of_breaks(ends + [a_run({"ended_by": "break"}, exit_code=1)]))

    def test_the_best_friction_is_named_as_fitted_and_judged(self):
        for wrong, passes in ((2, True), (3, False)):
            scan = {0.1: self.bends(wrong=4), 0.2: self.bends(wrong=wrong), 0.3: self.bends(wrong=5)}
            count, order = holding.rows_of_scan(scan, self.GREASED)
            self.assertEqual((count.predicted, count.fitted), (8 - wrong, "friction of suture_3-0_nylon: 0.2"))
            self.assertEqual(count.gate.test(count.predicted), passes)
            self.assertEqual(order.predicted, 1.0)

    def test_of_frictions_with_as_many_right_the_best_order_counts(self):
        scan = {0.1: self.bends(loads=(4.0, 3.0, 2.0, 1.0)), 0.2: self.bends(loads=(1.0, 3.0, 2.0, 4.0)), 0.3: self.bends(loads=(2.0, 1.0, 4.0, 3.0))}
        _, order = holding.rows_of_scan(scan, self.GREASED)
        self.assertAlmostEqual(order.predicted, 0.8)
        self.assertTrue(order.gate.test(order.predicted))

    def test_a_bend_that_holds_in_some_starts_only_is_not_right_and_is_named(self):
        for held in (2, None):
            some = {**self.bends(), "zeppelin": holding.Bend(held, (1.0, 0.1))}
            self.assertEqual(holding.wrong(some, self.GREASED), ["zeppelin"])
            self.assertIn("zeppelin", str(holding.table_of("title", {"0.1": some}, self.GREASED).rows[-1]))

    def test_without_a_gate_of_its_own_every_bend_has_to_be_right(self):
        facts = {**self.GREASED}
        del facts["right"]
        for wrong in (0, 1):
            row = holding.row(self.bends(wrong=wrong), facts)
            self.assertEqual(row.gate.test(row.predicted), wrong == 0)


class Strengths(unittest.TestCase):
    FACTS = FACTS["strengths"]

    def kept(self, **others):
        middle = {knot: (runs.mean(ranges[0]), 0.01) for knot, ranges in self.FACTS["knots"].items()}
        return {"overhand_tied": (0.55, 0.01), **middle, **others}

    def failed(self, ratio=2.0, **others):
        return predictions.table_of(strengths.rows_of(self.kept(**others), ratio, self.FACTS)).failed()

    def test_each_knot_is_held_against_what_was_published(self):
        self.assertEqual(self.failed(), [])
        self.assertEqual(len(self.failed(ratio=1.0)), 1)
        self.assertEqual(len(self.failed(overhand_tied=(0.62, 0.01))), 1)
        self.assertEqual(len(self.failed(bowline=(0.38, 0.01))), 1)

    def test_so_many_have_to_be_near(self):
        far = dict(list({knot: (0.9, 0.01) for knot in self.FACTS["knots"] if knot != "bowline"}.items())[:3])
        self.assertEqual(self.failed(**dict(list(far.items())[:2])), [])
        self.assertIn("published range is 4", self.failed(**far)[0])

    def test_near_is_near_one_of_the_sources(self):
        for value, near in ((0.44, True), (0.42, False), (0.55, False), (0.59, True), (None, False)):
            self.assertEqual(strengths.is_near(value, [[0.48], [0.62, 0.7]], 0.05), near, value)

    def test_a_start_that_did_not_part_is_no_value(self):
        self.assertEqual(len(self.failed(overhand_tied=(None, None))), 1)
        self.assertEqual(len(self.failed(ratio=None)), 1)


class Facts(unittest.TestCase):
    def test_knots_and_ropes_are_shipped(self):
        bends_held = [knot for name in ("greased", "ordinary", "slippery") for knot in FACTS[name]["slip"] + FACTS[name]["hold"]]
        for knot in FACTS["orders"]["order"] + FACTS["slipping"]["order"] + bends_held + list(FACTS["strengths"]["knots"]):
            self.assertTrue(os.path.exists(os.path.join(ROOT, f"config/knots/{knot}.yaml")), knot)
        for rope in FACTS["orders"]["ropes"] + FACTS["ordinary"]["ropes"] + [FACTS[name]["rope"] for name in ("slipping", "greased", "slippery")]:
            self.assertTrue(os.path.exists(os.path.join(ROOT, f"config/materials/{rope}.yaml")), rope)

    def test_every_measurement_has_its_source_and_what_is_not_compared_a_reason(self):
        for name, fact in FACTS.items():
            for one in fact if name == "not_yet" else [fact]:
                self.assertRegex(one["what"], r"^K\d+ ")
                self.assertTrue(one["source"])
                self.assertTrue(name != "not_yet" or one["reason"])


class Script(unittest.TestCase):
    def test_wrong_words_get_one_line(self):
        for words, said in ((["--measured", "--only", "R8"], "--only: not with --measured"),
                            (["--measured", "--build", "/nowhere"], "tensile_test: not built; scripts/build tensile_test")):
            done = subprocess.run([os.path.join(ROOT, "scripts/validate"), *words], check=False, capture_output=True, text=True)
            self.assertEqual(done.returncode, 2)
            self.assertIn(said, done.stderr.splitlines()[-1])


if __name__ == "__main__":
    unittest.main()
