#!/usr/bin/python3
"""The report of a run: what is on its page, and what is said where it cannot be made."""
import base64
import json
import os
import re
import subprocess
import unittest

from runs import (FISHERMAN, STRAIGHT, command_of, html_of, keys_on, open_bytes, page_of, put_into, read, row_of,
                  script, tool, two_runs, write)

import numpy as np
import yaml
from matplotlib.figure import Figure

from knot_utm import yaml_text
from knot_utm.errors import WrongInput
from knot_utm.report import certificate, curve_figures, page, quantities, turnable
from knot_utm.report.commands import CannotReport
from knot_utm.report.run import read_yaml, Run
from knot_utm.report.shapes import series_of


def setUpModule():
    global folders, straight, fisherman
    folders, straight, fisherman = two_runs("--report")


class PageOfARun(unittest.TestCase):
    def test_has_every_key_of_the_result(self):
        self.assertEqual(set(yaml.safe_load(read(fisherman, "result.yaml"))) - keys_on(page_of(fisherman)), set())

    def test_has_a_key_that_it_never_heard_of(self):
        folder = folders.copy(straight)
        write(read(folder, "result.yaml") + "loop_energy: 2.5\nknots_of_loop: [1, 2]\n", folder, "result.yaml")
        html = html_of(folder)
        self.assertEqual(row_of(html, "loop_energy")[1], "2.5")
        self.assertEqual(row_of(html, "knots_of_loop")[1], "1; 2")

    def test_leaves_out_what_has_no_value(self):
        folder = folders.with_report(fisherman, break_extension=None, energy_to_peak=None, max_penetration=None)
        html = html_of(folder)
        for key in ("break_extension", "energy_to_peak", "max_penetration"):
            self.assertFalse(any(f'data-key="{key}"' in row for row in re.findall(r"<tr>.*?</tr>", html, re.DOTALL)), key)
        cells = re.findall(r"<td[^>]*>([^<]*)</td>", html)
        self.assertFalse({"–", "None", "null", "nan", "not known"} & {cell.strip() for cell in cells})
        self.assertRegex(html, r"This test has no value of .*break_extension")

    def test_says_of_nothing_that_has_a_text_that_it_has_no_value(self):
        why = yaml.safe_load(read(straight, "result.yaml"))["no_plateau_because"]
        self.assertTrue(why)
        html = html_of(straight)
        self.assertNotIn("no_plateau_because", re.search(r"This test has no value of .*", html)[0])
        self.assertIn("no_plateau_because", keys_on(html))

    def test_names_the_ropes_of_both_materials(self):
        folder = folders.copy(straight)
        method = yaml.safe_load(read(folder, "method.yaml"))
        method["other_material"] = {**method["material"], "name": "another rope"}
        write(yaml.safe_dump(method), folder, "method.yaml")
        first = method["material"]["name"]
        self.assertIn(f", {first}</h1>", html_of(straight))
        self.assertIn(f", {first} and another rope</h1>", html_of(folder))

    def test_speaks_of_the_band_alone_where_only_the_error_of_the_peak_is_known(self):
        html = html_of(folders.with_report(fisherman, peak_force_error=1.5, plateau_force_error=None, lock_extension_error=None,
                                           locked_stiffness_error=None))
        self.assertIn("No band of numerical error is drawn: it is made of the errors of the plateau, the lock and the stiffness", html)
        self.assertNotIn("No convergence study", html)

    def test_the_line_of_rigid_sliding_is_that_of_the_grips(self):
        for grips, slope in (("rollers", -2.0), ("nodes", -1.0)):
            run = Run(fisherman)
            run.method = {**run.method, "machine": {**run.method["machine"], "grips": grips}}
            axes = Figure().subplots()
            curve_figures.draw_knot_distance(axes, run, [])
            line, = [line for line in axes.lines if "rigid sliding" in line.get_label()]
            (s_from, s_to), (e_from, e_to) = line.get_data()
            self.assertAlmostEqual((e_to - e_from) / (s_to - s_from), slope)
            self.assertIn(f"{-slope:.0f}: rigid", line.get_label())

    def test_has_the_true_force_beside_the_balanced_load(self):
        folder = folders.with_report(fisherman, plateau_force=4.25, plateau_force_error=None, true_plateau_force=5.5)
        self.assertEqual([cell for cell in row_of(html_of(folder), "plateau_force")[1:] if cell], ["4.25", "5.5", "N"])

    def test_has_every_number_in_the_units_of_its_method(self):
        result = {"peak_force": 444.82216152605, "true_peak_force": None, "peak_force_error": None,
                  "break_extension": 0.0254, "locked_stiffness": 175.126835,
                  "locked_stiffness_error": None}
        for asked, force, length, values in (("units: {force: lbf, length: in}", "lbf", "in", ("100", "1", "1.000")),
                                             ("units: {force: kN, length: m}", "kN", "m", ("0.4448", "0.0254", "0.1751"))):
            html = html_of(folders.with_report(straight, asked, "break_extension: {max: 0.0508}", specification_passed=True,
                                       **result))
            for key, value, unit in (("peak_force", values[0], force), ("break_extension", values[1], length),
                                     ("locked_stiffness", values[2], f"{force}/{length}")):
                self.assertEqual([cell for cell in row_of(html, key)[1:] if cell], [value, unit])
            self.assertEqual(row_of(html, "break_extension", 1)[1], f"{values[1]} {length}")
            self.assertIn("All files are in SI units", re.sub(r'"data:[^"]*"', "", html))
            for unit in ("N", "mm", "N/mm", "mm/s"):
                self.assertNotRegex(re.sub(r'"data:[^"]*"', "", html), rf"\d {unit}\b(?! (?:s/)?m²)", unit)

    def test_has_a_head_only_where_it_is_given(self):
        bare, full = html_of(straight), html_of(folders.with_report(
            straight, 'specimen_id: 0012, standard: EN 1, conditioning: <R&D>, terminations: 2026-11-23, notes: "one\\ntwo"'))
        for word in ("Specimen</span>", "Standard</span>", "Conditioning</span>", "Terminations</span>", 'class="notes"'):
            self.assertNotIn(word, bare)
        for word in ("Specimen</span>0012<", "Standard</span>EN 1<", "Conditioning</span>&lt;R&amp;D&gt;<",
                     "Terminations</span>2026-11-23<", ">one\ntwo<"):
            self.assertIn(word, full)

    def test_begins_with_the_reason_where_the_physics_gave_up(self):
        html = html_of(folders.with_report(straight, ended_by="solver", reason="no step converged", warnings=[]))
        self.assertIn("The physics gave up before the test ended", html)
        self.assertIn("no step converged", html)
        self.assertNotIn("The test gave no warning", html)

    def test_names_the_command_that_made_it_and_every_file(self):
        html = page_of(fisherman)
        self.assertTrue(command_of(html).endswith(
            f"tensile_test {' '.join(FISHERMAN)} --quiet --out {fisherman} --report"), command_of(html))
        for name in os.listdir(fisherman):
            self.assertIn(f"<code>{name}</code>", html)

    def test_holds_every_shape_in_a_millionth_of_its_size(self):
        given = json.loads(re.search(r'id="turnable-data">(.*?)</script>', read(fisherman, "report.html"))[1])
        series, _ = series_of(Run(fisherman))
        points = np.frombuffer(base64.b64decode(given["points"]), "<u2").reshape(len(series), given["nodes"], 3)
        for i, (time, places) in enumerate(zip(given["times"], points)):
            shape = series.shape(i)
            self.assertEqual(time, shape.time)
            np.testing.assert_allclose(np.array(given["low"]) + places * given["step"], 1e3 * shape.points, rtol=0.0,
                                       atol=0.51 * max(given["step"]))
        self.assertLess(max(given["step"]), 0.01 * given["radius"])
        for quantity in given["quantities"]:
            places = np.frombuffer(base64.b64decode(quantity["places"]), "u1").reshape(len(series), -1)
            self.assertGreater(len(np.unique(places)), 50, quantity["label"])

    def test_holds_the_library_as_it_is_installed_or_else_the_pictures_alone(self):
        html = read(fisherman, "report.html")
        for file in turnable.SCRIPTS:
            self.assertIn(f"<script>{read(file)}</script>", html)
        self.addCleanup(setattr, turnable, "SCRIPTS", turnable.SCRIPTS)
        turnable.SCRIPTS = ["/not/there"]
        html = page.report_on_run(fisherman, "of the test", "")
        self.assertNotIn("<script", html)
        self.assertEqual(html.count(' src="data:image/'), 3)

    def test_is_the_same_to_the_last_byte_when_made_again(self):
        folder, made = folders.copy(fisherman), []
        for _ in range(2):
            self.assertEqual(script(folder).returncode, 0)
            made.append([open_bytes(folder, name) for name in ("report.html", "report.pdf")])
        self.assertTrue(made[0] == made[1])

    def test_draws_the_floor_of_the_load_cell(self):
        folder = folders.copy(straight)
        method = yaml.safe_load(read(folder, "method.yaml"))
        pages = []
        for floor in (0.0, 0.002):
            method["machine"]["load_cell"]["floor"] = floor
            write(yaml.safe_dump(method), folder, "method.yaml")
            pages.append(html_of(folder, with_figures=True))
        self.assertEqual(Run(folder).load_cell_floor(), 0.002 * method["machine"]["load_cell"]["capacity"])
        self.assertEqual(["hatched floor" in html for html in pages], [False, True])
        curves = [re.search(r'src="(data:image/svg[^"]+)"', html).group(1) for html in pages]
        self.assertTrue(curves[0] != curves[1])

    def test_shows_the_final_shape_where_no_bag_can_be_read(self):
        folder = folders.copy(straight)
        bag = os.path.join(folder, "test.bag")
        os.remove(bag) if os.path.exists(bag) else None
        for remark in ("no test.bag", "test.bag cannot be read"):
            html = html_of(folder, with_figures=True)
            self.assertTrue(remark in html)
            self.assertTrue("image/png" in html)
            write("#ROSBAG V2.0\n", bag)

    def test_of_a_test_that_ended_before_it_was_pulled(self):
        for count, pictures in ((None, 2), (2, 0)):  # while it was prepared; without a reading
            folder = folders.copy(straight)
            for name in ("curve.csv", "curve_full.csv"):
                rows = [row for row in read(folder, name).splitlines() if ",pull," not in row]
                write("\n".join(rows[:count]) + "\n", folder, name)
            html = html_of(folder, with_figures=True)
            self.assertIn("there is no curve", html)
            self.assertEqual(len(re.findall(r' src="data:image/(?:svg|png)', html)), pictures)

    def test_says_warnings_first(self):
        folder = folders.copy(straight)
        put_into(folder, "result.yaml", "warnings: []", 'warnings: ["a & b < c"]')
        html = html_of(folder)
        self.assertLess(html.index("<li>a &amp; b &lt; c</li>"), html.index("<h2>"))


class NumbersOfThePage(unittest.TestCase):
    """Each is that of result.yaml, and what stands beside each other is of one row of the curve."""

    @classmethod
    def setUpClass(cls):
        cls.broken = folders.run("broken", [*STRAIGHT, "--set", "material.breaking_force=400"])

    def check(self, folder, html):
        run, units = Run(folder), Run(folder).units
        rows = [row for row in re.findall(r'<tr><td class="what">.*?</tr>', html, re.DOTALL) if "<code>" in row]
        self.assertGreater(len(rows), 20)
        for row in rows:
            key = re.search(r"<code>(\w+)</code>", row)[1]
            cell = re.search(r'<td class="number figures">(.*?)</td>', row)
            if not cell or not isinstance(run.result[key], float):
                continue
            number = cell[1].replace("–", "-").replace(" · 10", "e")
            number = float(number.translate(str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")))
            value = run.result[key] * units.of(quantities.quantity_of(key).kind).scale
            error = run.value(key + "_error")
            digits = abs(value) * 6e-4 if error is None else max(0.06 * error * units.of(quantities.quantity_of(key).kind).scale, 1e-12)
            self.assertAlmostEqual(number, value, delta=max(digits, quantities.NOTHING), msg=key)
        self.assertNotRegex(re.sub(r'"data:[^"]*"', "", html), r">[-–]0(\.0+)?[ <]")

    def test_are_those_of_the_result(self):
        self.check(fisherman, page_of(fisherman))
        self.check(self.broken, html_of(self.broken))

    def test_of_every_mark_are_of_one_row(self):
        for folder in (fisherman, self.broken):
            run = Run(folder)
            places = {tuple(row) for curve in (run.curve, run.readings)
                      for row in np.column_stack([curve[name] for name in ("time", "extension", "load")]).tolist()}
            for mark in page.marks_of(run):
                if not np.isnan(mark.load):
                    self.assertIn((float(mark.time), float(mark.extension), float(mark.load)), places, mark.title())

    def test_that_were_given_are_no_result(self):
        html = html_of(self.broken)
        self.assertIn("parted at the breaking force that was given, 400 N, which the peak force repeats", html)
        folder = folders.copy(fisherman)
        put_into(folder, "result.yaml", "knot_efficiency: null  # the rod did not break",
                 "knot_efficiency: null  # not predicted: the breaking force was given")
        self.assertEqual(row_of(html_of(folder), "knot_efficiency")[1], "not predicted")


    def test_of_a_rod_without_two_knots_miss_no_plateau_and_no_lock(self):
        html = html_of(straight)
        self.assertNotIn("Why there is no plateau", html)
        self.assertIn("from the error of the stiffness of the pull in the table below", html)
        loop = html_of(folders.with_report(fisherman, plateau_force=None, no_plateau_because="the load is not level"))
        self.assertEqual(row_of(loop, "no_plateau_because")[1].strip(), "the load is not level")


class Keys(unittest.TestCase):
    def test_of_every_group_have_a_place_on_the_page(self):
        places = {*quantities.TABLES, quantities.HEAD, quantities.BESIDE, quantities.CERTIFICATE}
        self.assertEqual(set(quantities.GROUPS), places)

    def test_that_are_checked_stand_in_the_certificate(self):
        checked = {key for check in certificate.checks_of({}) for key in check.keys}
        self.assertLessEqual(set(quantities.GROUPS[quantities.CERTIFICATE]), checked)


class Failures(unittest.TestCase):
    def one_line(self, done, code):
        self.assertEqual(done.returncode, code)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        return done.stderr

    def test_a_folder_without_a_result(self):
        self.assertIn("none of result.yaml, comparison.yaml, statistics.yaml, fit.yaml is there", self.one_line(script(folders.path), 2))
        self.assertFalse(os.path.exists(os.path.join(folders.path, "report.html")))

    def test_no_folder(self):
        self.assertIn("folder", self.one_line(script(), 2))
        for folder in ("", os.path.join(folders.path, "not_there")):
            self.assertEqual(self.one_line(script(folder), 2), f"report: {folder}: no such folder\n")
            self.assertFalse(os.path.exists(os.path.join(folders.path, "not_there")))

    def test_files_that_are_not_what_they_should_be(self):
        for name, text in (("result.yaml", "a: [\n"), ("result.yaml", "1\n"), ("curve_full.csv", "time\ns\n1,2\n"),
                           ("curve.csv", "time,load\ns,N\n"), ("method.yaml", None)):
            folder = folders.copy(straight)
            if text is None:
                os.remove(os.path.join(folder, name))
            else:
                write(text, folder, name)
            with self.assertRaisesRegex(CannotReport, name):
                html_of(folder)

    def test_a_file_that_is_no_text(self):
        folder = folders.copy(straight)
        file = os.path.join(folder, "knot.yaml")
        with open(file, "wb") as out:
            out.write(b"source: mine\ntitle: caf\xe9\n")
        for reader, refusal in ((read_yaml, CannotReport), (yaml_text.load, WrongInput)):
            with self.assertRaisesRegex(refusal, "knot.yaml: line 2: the byte 0xe9 is no text in UTF-8$"):
                reader(file)

    def test_a_package_that_is_not_there_is_named(self):
        for module, package in (("matplotlib", "python3-matplotlib"), ("weasyprint", "weasyprint"),
                                ("jinja2", "python3-jinja2")):
            blocked = (f"import sys; sys.modules['{module}'] = None; sys.argv[1:] = [{straight!r}]\n"
                       "from knot_utm.report import __main__; __main__.main()")
            done = subprocess.run(["/usr/bin/python3", "-B", "-c", blocked], capture_output=True, text=True,
                                  check=False)
            self.assertIn(f"install Debian's package {package}\n", self.one_line(done, 1))

    def test_a_report_that_cannot_be_written_leaves_the_results(self):
        out = os.path.join(folders.path, "no_room")
        os.makedirs(os.path.join(out, "report.html", "in_the_way"))
        done = tool("tensile_test", *STRAIGHT, "--quiet", "--out", out, "--report")
        self.assertEqual(self.one_line(done, 1), f"report: {out}/report.html: cannot be written: Is a directory\n")
        self.assertIn("ended_by: extension", read(out, "result.yaml"))

    def test_a_page_that_cannot_be_written_leaves_the_old_one_and_no_part(self):
        out = os.path.join(folders.path, "parts")
        os.makedirs(os.path.join(out, "report.pdf.part"))
        write("old", out, "report.html")
        with self.assertRaisesRegex(CannotReport, "report.pdf: cannot be written"):
            page.write(out, "new")
        self.assertEqual(sorted(os.listdir(out)), ["report.html", "report.pdf.part"])
        self.assertEqual(read(out, "report.html"), "old")


if __name__ == "__main__":
    unittest.main()
