#!/usr/bin/python3
"""The report of a run: numbers, verdicts, facts and figures of its page, and what is said where it cannot be made."""
import base64
import json
import os
import re
import unittest
from types import SimpleNamespace

from runs import (FISHERMAN, STRAIGHT, Folders, OfValues, a_pull, command_of, html_of, keys_on, page_of, read, row_of, script, tool,
                  without_data, write)

import matplotlib.text
import numpy as np
import yaml

from knot_utm.errors import WrongInput
from knot_utm.report import certificate, curves, marks, method_facts, quantities, rod_pictures, run_page, shapes, turnable
from knot_utm.report.quantities import Units
from knot_utm.report.run import Run


def setUpModule():
    global folders, straight, fisherman
    folders = Folders()
    straight, fisherman = folders.run("straight", STRAIGHT, "--report"), folders.run("fisherman", FISHERMAN, "--report")


def bytes_of(folder):
    found = []
    for name in ("report.html", "report.pdf"):
        with open(os.path.join(folder, name), "rb") as content:
            found.append(content.read())
    return found


def texts_of(figure):
    return [text for text in figure.findobj(matplotlib.text.Text) if text.get_text().strip()]


class PageOfARun(unittest.TestCase):
    def test_has_every_key_of_the_result_and_those_that_it_never_heard_of(self):
        page = page_of(fisherman)
        self.assertEqual(set(yaml.safe_load(read(fisherman, "result.yaml"))) - keys_on(page) - {*quantities.GROUPS["head"]}, {"no_plateau_because"})
        self.assertTrue(command_of(page).endswith(f"tensile_test {' '.join(FISHERMAN)} --quiet --out {fisherman} --report"), command_of(page))
        self.assertEqual({name for name in os.listdir(fisherman) if f"<code>{name}</code>" not in page}, set())
        html = html_of(folders.changed(straight, "result.yaml", loop_energy=2.5, knots_of_loop=[1, 2]))
        self.assertEqual((row_of(html, "loop_energy")[1], row_of(html, "knots_of_loop")[1]), ("2.5", "1; 2"))

    def test_leaves_out_what_has_no_value(self):
        html = html_of(folders.changed(fisherman, "result.yaml", break_extension=None, energy_to_peak=None, max_penetration=None))
        for key in ("break_extension", "energy_to_peak", "max_penetration"):
            self.assertNotRegex(html, f'data-key="{key}')
            self.assertIn(key, re.search(r"This test has no value of .*", html)[0])
        cells = re.findall(r"<td[^>]*>([^<]*)</td>", html)
        self.assertFalse({"–", "None", "null", "nan", "not known"} & {cell.strip() for cell in cells})

    def test_has_the_true_force_beside_the_balanced_load(self):
        folder = folders.changed(fisherman, "result.yaml", plateau_force=4.25, plateau_force_error=None, true_plateau_force=5.5)
        self.assertEqual([cell for cell in row_of(html_of(folder), "plateau_force")[1:] if cell], ["4.25", "5.5", "N"])

    def test_has_every_number_in_the_units_of_its_method(self):
        of = folders.changed(straight, "result.yaml", peak_force=444.82216152605, true_peak_force=None, peak_force_error=None,
                             break_extension=0.0254, locked_stiffness=175.126835, locked_stiffness_error=None, specification_passed=True)
        for force, length, values in (("lbf", "in", ("100", "1", "1.000")), ("kN", "m", ("0.4448", "0.0254", "0.1751"))):
            html = html_of(folders.changed(of, "method.yaml", report={"units": {"force": force, "length": length}},
                                           specification={"break_extension": {"max": 0.0508}}))
            for key, value, unit in (("peak_force", values[0], force), ("break_extension", values[1], length),
                                     ("locked_stiffness", values[2], f"{force}/{length}")):
                self.assertEqual([cell for cell in row_of(html, key)[1:] if cell], [value, unit])
            self.assertEqual(row_of(html, "break_extension", 1)[1], f"{values[1]} {length}")
            self.assertIn("All files are in SI units", html)
            for unit in ("N", "mm", "N/mm", "mm/s"):
                self.assertNotRegex(html, rf"\d {unit}\b(?! (?:s/)?m²)", unit)

    def test_has_a_head_of_what_is_given(self):
        full = html_of(folders.changed(straight, "method.yaml", report={
            "specimen_id": "0012", "standard": "EN 1", "conditioning": "<R&D>", "notes": "one\ntwo"}))
        for words in ("Specimen</span>0012<", "Standard</span>EN 1<", "Conditioning</span>&lt;R&amp;D&gt;<", ">one\ntwo<",
                      "Speed of the crosshead</span>"):
            self.assertIn(words, full)
        self.assertNotIn("Standard</span>", html_of(straight))

    def test_holds_every_shape_in_a_millionth_of_its_size(self):
        given = json.loads(re.search(r'id="turnable-data">(.*?)</script>', read(fisherman, "report.html"))[1])
        of_run, _ = shapes.shapes_of(Run(fisherman))
        points = np.frombuffer(base64.b64decode(given["points"]), "<u2").reshape(len(of_run), given["nodes"], 3)
        for shape, time, places in zip(of_run, given["times"], points):
            self.assertEqual(time, shape.time)
            np.testing.assert_allclose(np.array(given["low"]) + np.array(given["step"]) * places, 1e3 * shape.points,
                                       atol=0.51 * max(given["step"]))

    def test_stands_alone_and_shows_its_pictures_without_the_library_too(self):
        self.addCleanup(setattr, turnable, "SCRIPTS", turnable.SCRIPTS)
        turnable.SCRIPTS = ["/not/there"]
        html = run_page.report_on_run(fisherman, "of the test", "")
        self.assertNotIn("<script", html)
        self.assertEqual(re.findall(r' (?:src|href)="(.{11})', html), 3 * ["data:image/"])

    def test_is_the_same_to_the_last_byte_when_made_again(self):
        folder, made = folders.copy(straight), []
        for _ in range(2):
            self.assertEqual(script("report", folder).returncode, 0)
            made.append(bytes_of(folder))
        self.assertTrue(made[0] == made[1])

    def test_shows_the_final_shape_where_there_are_no_others(self):
        folder = folders.copy(straight)
        if os.path.exists(os.path.join(folder, "shapes.csv")):
            os.remove(os.path.join(folder, "shapes.csv"))
        html = run_page.report_on_run(folder, "", "")
        self.assertTrue("no shapes.csv" in html)
        self.assertEqual(html.count(' src="data:image/'), 3)

    def test_of_a_test_that_ended_before_it_was_pulled(self):
        for count, pictures in ((None, 2), (2, 0)):  # while it was prepared; without a reading
            folder = folders.copy(straight)
            for name in ("curve.csv", "curve_full.csv"):
                rows = [row for row in read(folder, name).splitlines() if ",pull," not in row]
                write(os.path.join(folder, name), "\n".join(rows[:count]) + "\n")
            html = without_data(run_page.report_on_run(folder, "", ""))
            self.assertIn("there is no curve", html)
            self.assertEqual(html.count(' src="data:image/'), pictures)


class NumbersOfThePage(unittest.TestCase):
    """Each is that of result.yaml, and what stands beside each other is of one row of the curve."""

    @classmethod
    def setUpClass(cls):
        cls.broken = folders.run("broken", [*STRAIGHT, "--set", "material.breaking_force=400"])

    def test_are_those_of_the_result(self):
        for folder, html in ((fisherman, page_of(fisherman)), (self.broken, html_of(self.broken))):
            run, seen = Run(folder), 0
            for key, value in run.result.items():
                if not re.search(f'data-key="{key}[ "]', html) or not isinstance(value, float) or key == "plateau_force_error":
                    continue
                text = row_of(html, key)[1].replace("–", "-").replace(" · 10", "e")
                shown, error = float(text.translate(str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789"))), run.value(key + "_error")
                scale = run.units.of(quantities.quantity_of(key).kind).scale
                digits = abs(value) * scale * 6e-4 if error is None else max(0.06 * error * scale, 1e-12)
                self.assertAlmostEqual(shown, value * scale, delta=max(digits, quantities.NOTHING), msg=key)
                seen += 1
            self.assertGreater(seen, 20)
            self.assertNotRegex(html, r">[-–]0(\.0+)?[ <]")

    def test_that_were_given_are_no_result(self):
        self.assertIn("parted at the breaking force that was given, 400 N, which the peak force repeats", html_of(self.broken))
        folder = folders.copy(fisherman)
        old = "knot_efficiency: null  # the rod did not break"
        self.assertIn(old, read(folder, "result.yaml"))
        write(os.path.join(folder, "result.yaml"),
              read(folder, "result.yaml").replace(old, "knot_efficiency: null  # not predicted: it was given"))
        self.assertEqual(row_of(html_of(folder), "knot_efficiency")[1], "not predicted")


class Failures(unittest.TestCase):
    def one_line(self, done, code):
        self.assertEqual((done.returncode, done.stderr.count("\n")), (code, 1), done.stderr)
        return done.stderr

    def test_a_folder_that_is_none_or_without_a_result(self):
        self.assertIn("none of result.yaml, comparison.yaml, statistics.yaml, fit.yaml is there", self.one_line(script("report", folders.path), 2))
        missing = os.path.join(folders.path, "not_there")
        self.assertEqual(self.one_line(script("report", missing), 2), f"report: {missing}: no such folder\n")
        self.assertFalse(os.path.exists(os.path.join(folders.path, "report.html")) or os.path.exists(missing))

    def test_files_that_are_not_what_they_should_be(self):
        for name, text in (("result.yaml", "a: [\n"), ("result.yaml", "1\n"), ("curve_full.csv", "time\ns\n1,2\n"),
                           ("curve.csv", "time,load\ns,N\n"), ("method.yaml", None)):
            folder = folders.copy(straight)
            if text is None:
                os.remove(os.path.join(folder, name))
            else:
                write(os.path.join(folder, name), text)
            with self.assertRaisesRegex(WrongInput, name):
                html_of(folder)

    def test_a_report_that_cannot_be_written_leaves_the_results(self):
        out = os.path.join(folders.path, "no_room")
        os.makedirs(os.path.join(out, "report.html", "in_the_way"))
        done = tool("tensile_test", *STRAIGHT, "--quiet", "--out", out, "--report")
        self.assertEqual(self.one_line(done, 1), f"report: {out}/report.html: is a directory\n")
        self.assertIn("ended_by: extension", read(out, "result.yaml"))


class Certificate(unittest.TestCase):
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


class Numbers(unittest.TestCase):
    def test_have_the_digits_that_their_error_leaves(self):
        self.assertEqual(quantities.number(6.08745, 0.4664), "6.09")
        self.assertEqual(quantities.number(-1.94937), "–1.949")
        self.assertEqual(quantities.number(5.55e-8), "5.55 · 10⁻⁸")
        self.assertEqual(quantities.shown(float("nan")), "–")
        # Both end with the same digit, also where an error of 9.97 is one of 10.
        for value, error, words in ((4985.24, 9.97, ("4985", "10")), (2500.06, 5.0002, ("2500.1", "5.0")), (0.001234, 9.96e-5, ("0.00123", "0.00010"))):
            self.assertEqual((quantities.number(value, error), quantities.error_shown(error, 1.0)), words)

    def test_in_sentences_are_in_the_units_of_the_page(self):
        said = ("parted 0.370498 m along at 2500.08 N (2 strands of 3 radii), from 44.48 to 4.448 N, at 0.0254 m/s, where k_b/h^2 is "
                "-4.448 N; 175.1 N/m, 2e-05 m, 8 N/m², 5 mm and 1e-7 s")
        self.assertEqual(quantities.in_units(said, Units("lbf", "in")),
                         "parted 14.59 in along at 562.0 lbf (2 strands of 3 radii), from 10.00 to 1.000 lbf, at 1 in/s, where k_b/h^2 is "
                         "–1.000 lbf; 0.9998 lbf/in, 0.0007874 in, 8 N/m², 5 mm and 1e-7 s")


class Band(unittest.TestCase):
    def test_behind_the_lock_it_moves_along_the_extension(self):
        s = np.linspace(0.0, 0.1, 1001)
        load = np.where(s < 0.05, 2.0, 2.0 + 1e4 * (s - 0.05))
        run = OfValues(a_pull(s, load), plateau_force=2.0, plateau_force_error=0.2, lock_extension=0.05,
                       lock_extension_error=0.002, locked_stiffness=1e4, locked_stiffness_error=0.0)
        low, high = curves.error_band(run, run.curve)
        np.testing.assert_allclose((low[200], high[200]), (1.8, 2.2))
        # 2 mm at 1e4 N/m
        np.testing.assert_allclose((low[800], high[800]), (load[800] - 20.0, load[800] + 20.0))


class TheMeanCurve(unittest.TestCase):
    def test_is_that_of_the_loads_at_each_extension_that_all_have(self):
        # Loads s, 2 s and 6 s: mean 3 s, standard deviation sqrt(7) s; with 2 degrees of freedom t is 4.3027.
        pulls = [(np.array([0.0, 0.4, 4.0]), np.array([0.0, 0.4, 4.0])), (np.array([0.5, 3.0]), np.array([1.0, 6.0])),
                 (np.array([0.0, 1.0, 5.0]), np.array([0.0, 6.0, 30.0]))]
        found = curves.mean_curve(pulls)
        self.assertEqual((found.extension[0], found.extension[-1]), (0.5, 3.0))
        np.testing.assert_allclose(found.mean, 3.0 * found.extension)
        # Neither band goes beyond what a specimen shows.
        np.testing.assert_allclose(found.scatter[1], (3.0 + np.sqrt(7.0)) * found.extension)
        np.testing.assert_allclose(found.scatter[0], found.extension)
        np.testing.assert_allclose(found.interval[1], 6.0 * found.extension)


class APicture(unittest.TestCase):
    def test_has_the_rollers_of_every_loop_and_the_post_of_a_strand_around_one(self):
        shape = shapes.Shape(0.0, np.zeros((2, 3)), None)
        for knot, grips, expected in (("fisherman", "rollers", [(0.0, 0.0, 20.0), (250.0, 0.0, 20.0)]),
                                      ("multiple_fisherman", "rollers", [(0.0, 0.0, 20.0), (250.0, 0.0, 20.0)]),
                                      ("fisherman", "clamps", []), ("capstan", "nodes", [(0.0, 0.0, 15.0)]),
                                      ("straight", "clamps", []), ("overhand", "nodes", []), ("reef", "clamps", []),
                                      ("bowline", "clamps", [(0.0, 0.0, 10.0)])):
            run = SimpleNamespace(method={"specimen": {"knot": knot, "post_diameter": 0.03},
                                          "machine": {"grips": grips, "roller_diameter": 0.04}},
                                  curve={"time": [0.0, 1.0], "end_to_end": [0.25, 0.3]}, folder="", thickest=lambda: 0.002)
            self.assertEqual(rod_pictures.rollers(run, shape), expected, (knot, grips))

    def test_a_ring_is_two_sections_on_either_side_of_its_hole(self):
        drawing = {"upper": ["upper"], "posts": [{"through": [1, 0, 5], "along": [0, 0, 2], "radius": 1, "ring": 3},
                                                 {"through": [0, 0, 9], "along": [0, 1, 0], "radius": 1, "ring": 3}]}
        self.assertEqual(rod_pictures.posts_of(drawing, "lower", 0.0, 2.0), [(0.0, -4.0, 2.0), (0.0, 8.0, 2.0)])


class ACompliantFrame(unittest.TestCase):
    def test_readings_are_held_against_the_specimens_own_extension(self):
        folder = folders.copy(straight)
        for name in ("curve.csv", "curve_full.csv"):
            rows = [row.split(",") for row in read(folder, name).splitlines()]
            rows = [rows[0] + ["crosshead_travel"], rows[1] + ["m"], *(row + [str(2.0 * float(row[1]))] for row in rows[2:])]
            write(os.path.join(folder, name), "\n".join(map(",".join, rows)) + "\n")
        run = Run(folder)
        np.testing.assert_array_equal(run.curve["extension"], Run(straight).curve["extension"])
        np.testing.assert_array_equal(run.curve["crosshead_extension"], 2.0 * run.curve["extension"])
        self.assertIn("the deflection of the frame is taken off", run_page.caption(run, [], None))


class TheLargestLoad(unittest.TestCase):
    S = np.linspace(0.0, 0.1, 101)

    def of(self, load, **result):
        return marks.largest_load(OfValues(a_pull(self.S, load), peak_force=1.0, **result))

    def test_is_a_peak_only_where_the_load_fell_behind_it_or_the_rod_parted(self):
        broken = {"ended_by": "break", "break_extension": 0.099}
        for end, result, is_peak, where in ((0.06, {"ended_by": "extension"}, True, "at an extension of 59 mm"),
                                            (0.0995, broken, True, "where the rod parted, at 99 mm"),
                                            (1.0, {"ended_by": "extension"}, False, "at 100 mm, where the test was stopped"),
                                            (1.0, {"ended_by": "solver"}, False, "at 100 mm, where the physics gave up")):
            found = self.of(np.where(self.S < end, self.S, 0.0), **result)
            self.assertEqual((found.is_peak, found.where), (is_peak, where))


class Figures(unittest.TestCase):
    def test_draw_the_floor_of_the_load_cell_and_the_line_of_rigid_sliding(self):
        for grips, slope in (("rollers", 2), ("nodes", 1)):
            run = Run(fisherman)
            cell = {"floor": 0.002, "capacity": 100.0}
            run.method = {**run.method, "machine": {**run.method["machine"], "grips": grips, "load_cell": cell}}
            figure = curves.force_extension(run, [])
            self.assertIn("cell's floor, 0.2 N", [text.get_text() for text in texts_of(figure)])
            line, = [line for line in figure.axes[-1].lines if line.get_label() == f"de/ds = –{slope}: rigid sliding"]
            (s_from, s_to), (e_from, e_to) = line.get_data()
            self.assertAlmostEqual((e_to - e_from) / (s_to - s_from), -slope)


if __name__ == "__main__":
    unittest.main()
