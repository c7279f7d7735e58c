#!/usr/bin/python3
"""The report: verdicts on the computation and on the specification, numbers, and the facts of the method."""
import unittest

from runs import STRAIGHT, OfValues, html_of, read, row_of, two_runs

import yaml

from knot_utm.report import certificate, method_facts, page, quantities
from knot_utm.report.quantities import Units
from knot_utm.report.run import Run


def setUpModule():
    global folders, straight, fisherman
    folders, straight, fisherman = two_runs()


class Certificate(unittest.TestCase):
    def test_misses_where_the_program_warns(self):
        good = yaml.safe_load(read(fisherman, "result.yaml"))
        self.assertTrue(certificate.verdict(certificate.certificate(good))[1])
        for key, bad in (("max_penetration", 0.06), ("jump_force", 1.0), ("energy_balance_error", 0.02),
                         ("force_balance_error", 0.02), ("knot_type_preserved", False), ("not_equilibrated", True),
                         ("ended_by", "solver"), ("plateau_force_error", 0.3 * good["true_plateau_force"])):
            missed = [check.keys for check in certificate.certificate({**good, key: bad}) if check.verdict == "fail"]
            self.assertEqual(missed, [[key]])

    def test_has_no_row_without_a_verdict_and_none_of_what_is_not_there(self):
        for method, has_knot in (("fisherman", True), ("straight", False)):
            result = yaml.safe_load(read({"fisherman": fisherman, "straight": straight}[method], "result.yaml"))
            checks = certificate.certificate({**result, "max_penetration": None}, has_knot)
            self.assertTrue(all(check.verdict for check in checks))
            keys = {key for check in checks for key in check.keys}
            self.assertNotIn("max_penetration", keys)
            self.assertEqual({"knot_type_preserved", "jump_force"} <= keys, has_knot)


class Specification(unittest.TestCase):
    SPECIFICATION = ["--set", "specification={peak_force: {min: 1}, chord_stiffness: {min: 1, max: 2}, untangled_at: {max: 9}}"]

    def test_verdicts_are_those_of_the_program(self):
        folder = folders.run("specified", [*STRAIGHT, *self.SPECIFICATION])
        run = Run(folder)
        checks = certificate.specification_checks(run.method, run.result, run.units)
        self.assertEqual([check.verdict for check in checks], ["pass", "fail", "fail"])
        self.assertEqual(checks[2].value, "not measured")
        self.assertEqual([line.split()[0] for line in run.result["specification_failed"]],
                         [check.keys[0] for check in checks if check.verdict == "fail"])
        words, passed = certificate.specification_verdict(run.result, checks)
        self.assertFalse(passed)
        html = html_of(folder)
        self.assertIn("2 of 3 requirements are not met", words)
        self.assertEqual(html.count(words), 2)
        self.assertEqual(row_of(html, "chord_stiffness", 1)[2:], ["at least 0.001 and at most 0.002 N/mm", "fail"])

    def test_passes_where_every_requirement_is_met(self):
        html = html_of(folders.with_report(straight, "", "peak_force: {max: 1e6}", specification_passed=True))
        self.assertIn("The test meets its specification.", html)

    def test_is_not_there_where_nothing_was_asked_for(self):
        self.assertNotIn("specification.", html_of(straight))


class Facts(unittest.TestCase):
    def test_have_the_units_of_the_method(self):
        method = {"specimen": {"knot": "straight"}, "material": {}, "machine": {"load_cell": {"accuracy": 0.005}},
                  "physics": {"gravity": [0, 0, -9.81], "accuracy": "draft", "contact": {"tolerance": 0.02},
                              "friction": {"slip_tolerance": 0.001, "presliding": 0.01}},
                  "ends": {"break_at_fraction_of_peak": 0.2}}
        found = {row for _, rows, _ in method_facts.method_facts(method, Units()) for row in rows}
        self.assertLessEqual({
            ("Accuracy of the cell", "0.005 of the reading"), ("Accuracy", "draft"), ("Gravity", "[0, 0, –9.81] m/s²"),
            ("Contact", "tolerance 0.02 of the radius"),
            ("Friction", "slip tolerance 0.001 m/s, presliding 0.01 of the radius"),
            ("Break at no more than", "0.2 of the peak")}, found)

    def test_have_the_labels_and_units_of_every_law(self):
        method = {"specimen": {"knot": "capstan", "wrap": 3.0, "end_to_end": 0.2}, "machine": {},
                  "material": {"stretching_law": "linear", "bending_law": "plastic", "hardening": 0.1},
                  "physics": {"inertia": 2.0, "friction": {"law": "power", "exponent": 0.9, "reference_pressure": 100.0,
                                                           "presliding": 0.02}}}
        found = {row for _, rows, _ in method_facts.method_facts(method, Units("lbf", "in")) for row in rows}
        self.assertLessEqual({
            ("Knot", "Strand around a post (capstan)"), ("Angle around the post", "3 rad"), ("End to end L", "7.874 in"),
            ("Stretching law", "linear"), ("Bending law", "plastic"),
            ("Share of the bending stiffness that does not yield", "0.1"),
            ("Mass that is accelerated", "2 of the own mass"),
            ("Friction", "law power, exponent 0.9 of the pressure, reference pressure 100 N/m, "
                         "presliding 0.02 of the radius")}, found)

    def test_of_a_step_have_the_units_of_the_page(self):
        steps = [{"pull": {"speed": 0.002, "until": {"extension": 0.1, "load": 5.0, "break": True}}},
                 {"cycle": {"extension": [0.0, 0.01], "count": 3}}]
        self.assertEqual(method_facts.program({"program": steps}, Units()), [
            ("pull", "speed 2 mm/s, until extension 100 mm or load 5 N or break"),
            ("cycle", "extension [0, 10] mm, count 3")])

    def test_say_which_values_were_automatic(self):
        method = {"specimen": {"knot": "straight", "length": 0.25, "edge_length": 0.005}, "material": {}, "machine": {"travel": 1.0},
                  "program": [{"hold": {"duration": 2}}, {"pull": {"speed": 0.0033, "until": {"extension": 0.01}}}],
                  "automatic": {"specimen.edge_length": 0.005, "machine.travel": 1, "program.1.pull.until.extension": 0.01}}
        found = {row for _, rows, _ in method_facts.method_facts(method, Units()) for row in rows}
        self.assertLessEqual({("Length of rod", "250 mm"), ("Edge length of the mesh", "5 mm (auto)"), ("Travel", "1000 mm (auto)")},
                             found)
        self.assertEqual(method_facts.program(method, Units())[1], ("pull", "speed 3.3 mm/s, until extension 10 mm (auto)"))

    def test_have_the_friction_that_counts_around_a_post(self):
        method = {"specimen": {"knot": "capstan"}, "material": {"friction_coefficient": 0.46}, "machine": {"roller_friction": 0.3}}
        found = [row for _, rows, _ in method_facts.method_facts(method, Units()) for row in rows if "riction" in row[0]]
        self.assertEqual(found, [("Friction coefficient of the rod on the post", "0.3")])

    def test_begin_with_what_a_capstan_is_for(self):
        shown = page.headlines(OfValues(None, force_ratio=5.8, peak_force=25.0), None)
        self.assertEqual([headline.label for headline in shown], ["Force ratio", "Peak force"])


class Numbers(unittest.TestCase):
    def test_have_the_digits_that_their_error_leaves(self):
        self.assertEqual(quantities.number(6.08745, 0.4664), "6.09")
        self.assertEqual(quantities.number(0.0744, 0.0014), "0.0744")
        self.assertEqual(quantities.number(-1.94937), "–1.949")
        self.assertEqual(quantities.number(123456.7), "123457")
        self.assertEqual(quantities.number(5.55e-8), "5.55 · 10⁻⁸")
        self.assertEqual(quantities.shown(float("nan")), "–")
        # Both end with the same digit, also where an error of 9.97 is one of 10.
        for value, error, words in ((4985.24, 9.97, ("4985", "10")), (2500.06, 5.0002, ("2500.1", "5.0")), (0.001234, 9.96e-5, ("0.00123", "0.00010"))):
            self.assertEqual((quantities.number(value, error), quantities.error_shown(error, 1.0)), words)

    def test_keep_the_zeros_that_were_read_and_not_those_that_were_given(self):
        self.assertEqual([quantities.number(value) for value in (103.0345, 34.6502, 1.6003e-7)], ["103.0", "34.65", "1.600 · 10⁻⁷"])
        self.assertEqual([quantities.number(value) for value in (250.0, 0.3, 2.5e-8, 1e3 * 0.0254)], ["250", "0.3", "2.5 · 10⁻⁸", "25.4"])

    def test_of_what_is_left_are_none_where_it_is_rounding(self):
        of = {"hysteresis": 4e-7, "energy_to_peak": 17.0, "elongation_residual": 1e-3, "elongation_total": 0.016}.get
        self.assertTrue(quantities.is_rounding("hysteresis", of))
        self.assertFalse(quantities.is_rounding("elongation_residual", of))
        self.assertFalse(quantities.is_rounding("energy_to_peak", of))

    def test_that_are_nothing_have_no_sign(self):
        for value, error in ((-0.0, None), (-2.2e-15, None), (-0.0004, 0.2)):
            self.assertRegex(quantities.shown(value, 1.0, error), r"^0(\.0+)?$")
        self.assertEqual(quantities.number(-0.4, 0.2), "–0.40")

    def test_in_sentences_are_in_the_units_of_the_page(self):
        said = ("parted 0.370498 m along at 2500.08 N (2 strands of 3 radii), from 44.48 to 4.448 N, at 0.0254 m/s, where k_b/h^2 is "
                "-4.448 N; 175.1 N/m, 2e-05 m, 8 N/m², 5 mm and 1e-7 s")
        self.assertEqual(quantities.in_units(said, Units("lbf", "in")),
                         "parted 14.59 in along at 562.0 lbf (2 strands of 3 radii), from 10.00 to 1.000 lbf, at 1 in/s, where k_b/h^2 is "
                         "–1.000 lbf; 0.9998 lbf/in, 0.0007874 in, 8 N/m², 5 mm and 1e-7 s")


if __name__ == "__main__":
    unittest.main()
