#!/usr/bin/python3
"""The report: verdicts on the computation and on the specification, numbers, and the facts of the method."""
import re
import unittest

from runs import FISHERMAN, ROOT, STRAIGHT, Folders, OfValues, html_of, read, row_of

import yaml

from knot_utm.report import certificate, method_facts, quantities, run_page
from knot_utm.report.quantities import Units
from knot_utm.report.run import Run


def setUpModule():
    global folders, straight, fisherman
    folders = Folders()
    straight, fisherman = folders.run("straight", STRAIGHT), folders.run("fisherman", FISHERMAN)


class Certificate(unittest.TestCase):
    def test_limits_are_those_of_the_program(self):
        source = read(ROOT, "include/knot_utm/verdict/run_warnings.hpp") + read(ROOT, "src/verdict/run_warnings.cpp")
        for name, limit in certificate.LIMITS.items():
            self.assertEqual(float(re.search(rf"constexpr double {name} = ([\d.]+);", source).group(1)), limit, name)

    def test_misses_where_the_program_warns(self):
        good = yaml.safe_load(read(fisherman, "result.yaml"))
        checks = certificate.certificate(good)
        self.assertTrue(certificate.verdict(checks)[1])
        self.assertLessEqual(set(quantities.GROUPS[quantities.CERTIFICATE]), {check.key for check in checks})
        for key, bad in (("max_penetration", 0.06), ("jump_force", 1.0), ("energy_balance_error", 0.02),
                         ("force_balance_error", 0.02), ("knot_type_preserved", False), ("not_equilibrated", True),
                         ("ended_by", "solver"), ("plateau_force_error", 0.3 * good["true_plateau_force"])):
            missed = [check.key for check in certificate.certificate({**good, key: bad}) if not check.kept]
            self.assertEqual(missed, [key])

    def test_has_no_row_of_what_is_not_there(self):
        result = {**yaml.safe_load(read(straight, "result.yaml")), "max_penetration": None}
        keys = {check.key for check in certificate.certificate(result, False)}
        self.assertFalse({"max_penetration", "knot_type_preserved", "jump_force"} & keys)


class Specification(unittest.TestCase):
    def test_verdicts_are_those_of_the_program(self):
        folder = folders.run("specified", [*STRAIGHT, "--set", "specification={peak_force: {min: 1}, chord_stiffness: {min: 1, max: 2}, "
                                           "untangled_at: {max: 9}}"])
        run = Run(folder)
        checks = certificate.specification_checks(run.method, run.result, run.units)
        self.assertEqual([check.kept for check in checks], [True, False, False])
        self.assertEqual(checks[2].value, "not measured")
        self.assertEqual([line.split()[0] for line in run.result["specification_failed"]],
                         [check.key for check in checks if not check.kept])
        html = html_of(folder)
        self.assertEqual(html.count("The test does not meet its specification: 2 of 3 requirements are not met."), 2)
        self.assertEqual(row_of(html, "chord_stiffness", 1)[2:], ["at least 0.001 and at most 0.002 N/mm", "fail"])
        self.assertNotIn("specification.", html_of(straight))


class Facts(unittest.TestCase):
    def test_have_the_labels_and_units_of_every_law(self):
        method = {"specimen": {"knot": "capstan", "wrap": 3.0, "end_to_end": 0.2},
                  "machine": {"roller_friction": 0.3, "load_cell": {"accuracy": 0.005}, "travel": 1.0},
                  "material": {"stretching_law": "linear", "bending_law": "plastic", "friction_coefficient": 0.46},
                  "physics": {"gravity": [0, 0, -9.81], "friction": {"law": "memory", "slip_tolerance": 0.001, "presliding": 0.02}},
                  "ends": {"break_at_fraction_of_peak": 0.2}, "automatic": {"machine.travel": 1}}
        found = {row for _, rows, _ in method_facts.method_facts(method, Units("lbf", "in")) for row in rows}
        self.assertLessEqual({
            ("Knot", "Strand around a post (capstan)"), ("Angle around the post", "3 rad"), ("End to end L", "7.874 in"),
            ("Accuracy of the cell", "0.005 of the reading"), ("Gravity", "[0, 0, –9.81] m/s²"), ("Travel", "39.37 in (auto)"),
            ("Friction", "law memory, slip tolerance 0.001 m/s, presliding 0.02 of the radius"),
            ("Break at no more than", "0.2 of the peak"), ("Bending law", "plastic")}, found)
        self.assertEqual([row for row in found if "riction c" in row[0]], [("Friction coefficient of the rod on the post", "0.3")])

    def test_of_a_step_have_the_units_of_the_page(self):
        steps = [{"pull": {"speed": 0.002, "until": {"extension": 0.1, "load": 5.0, "break": True}}},
                 {"cycle": {"extension": [0.0, 0.01], "count": 3}}]
        self.assertEqual(method_facts.program({"program": steps}, Units()), [
            ("1. pull", "speed 2 mm/s, until extension 100 mm or load 5 N or break"),
            ("2. cycle", "extension [0, 10] mm, count 3")])

    def test_by_a_standard_have_no_speed_where_the_load_decides_it(self):
        for step, expected in (({"pull": {"speed": 0.1, "load_rate": 5.0}}, []), ({"pull": {"speed": 0.005}}, ["250 mm", "300 mm/min"])):
            found = method_facts.particulars({"standard": "ISO 1"}, {"program": [step, {"hold": {}}]}, 0.25 if expected else None, Units())
            self.assertEqual([text for _, text in found], expected)

    def test_begin_with_what_a_capstan_is_for(self):
        shown = run_page.headlines(OfValues(None, force_ratio=5.8, peak_force=25.0), None)
        self.assertEqual([headline.label for headline in shown], ["Force ratio", "Peak force"])


class Numbers(unittest.TestCase):
    def test_have_the_digits_that_their_error_leaves(self):
        self.assertEqual(quantities.number(6.08745, 0.4664), "6.09")
        self.assertEqual(quantities.number(-1.94937), "–1.949")
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
        self.assertEqual([quantities.is_rounding(key, of) for key in ("hysteresis", "elongation_residual", "energy_to_peak")],
                         [True, False, False])

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
