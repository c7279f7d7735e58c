#!/usr/bin/python3
"""The report of a run: what is on its page, and what is said where it cannot be made."""
import base64
import json
import os
import re
import subprocess
import unittest

from runs import FISHERMAN, STRAIGHT, Folders, command_of, html_of, keys_on, page_of, read, row_of, script, tool, without_data, write

import numpy as np
import yaml

from knot_utm.report import page, quantities, run_page, turnable
from knot_utm.report.commands import CannotReport
from knot_utm.report.marks import marks_of
from knot_utm.report.run import Run
from knot_utm.report.shapes import series_of


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


class PageOfARun(unittest.TestCase):
    def test_has_every_key_of_the_result_and_those_that_it_never_heard_of(self):
        self.assertEqual(set(yaml.safe_load(read(fisherman, "result.yaml"))) - keys_on(page_of(fisherman)) - {*quantities.GROUPS["head"]}, set())
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

    def test_begins_with_warnings_and_with_the_reason_where_the_physics_gave_up(self):
        html = html_of(folders.changed(straight, "result.yaml", ended_by="solver", reason="no step converged", warnings=["a & b < c"]))
        for words in ("The physics gave up before the test ended", "no step converged", "<p>a &amp; b &lt; c</p>"):
            self.assertLess(html.index(words), html.index("<h2>"))
        self.assertNotIn("The test gave no warning", html)

    def test_names_the_command_that_made_it_and_every_file(self):
        html = page_of(fisherman)
        self.assertTrue(command_of(html).endswith(
            f"tensile_test {' '.join(FISHERMAN)} --quiet --out {fisherman} --report"), command_of(html))
        self.assertEqual({name for name in os.listdir(fisherman) if f"<code>{name}</code>" not in html}, set())

    def test_holds_every_shape_in_a_millionth_of_its_size(self):
        given = json.loads(re.search(r'id="turnable-data">(.*?)</script>', read(fisherman, "report.html"))[1])
        series, _ = series_of(Run(fisherman))
        points = np.frombuffer(base64.b64decode(given["points"]), "<u2").reshape(len(series), given["nodes"], 3)
        for i, (time, places) in enumerate(zip(given["times"], points)):
            shape = series.shape(i)
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
        for name in ("shapes.csv", "test.bag"):
            if os.path.exists(os.path.join(folder, name)):
                os.remove(os.path.join(folder, name))
        for remark in ("no test.bag", "test.bag cannot be read"):
            html = run_page.report_on_run(folder, "", "")
            self.assertTrue(remark in html)
            self.assertEqual(html.count(' src="data:image/png'), 3)
            write("#ROSBAG V2.0\n", folder, "test.bag")

    def test_of_a_test_that_ended_before_it_was_pulled(self):
        for count, pictures in ((None, 2), (2, 0)):  # while it was prepared; without a reading
            folder = folders.copy(straight)
            for name in ("curve.csv", "curve_full.csv"):
                rows = [row for row in read(folder, name).splitlines() if ",pull," not in row]
                write("\n".join(rows[:count]) + "\n", folder, name)
            html = without_data(run_page.report_on_run(folder, "", ""))
            self.assertIn("there is no curve", html)
            self.assertEqual(html.count(' src="data:image/png'), pictures)


class NumbersOfThePage(unittest.TestCase):
    """Each is that of result.yaml, and what stands beside each other is of one row of the curve."""

    @classmethod
    def setUpClass(cls):
        cls.broken = folders.run("broken", [*STRAIGHT, "--set", "material.breaking_force=400"])

    def test_are_those_of_the_result(self):
        for folder, html in ((fisherman, page_of(fisherman)), (self.broken, html_of(self.broken))):
            run, seen = Run(folder), 0
            for key, value in run.result.items():
                if f'data-key="{key}' not in html or not isinstance(value, float):
                    continue
                text = row_of(html, key)[1].replace("–", "-").replace(" · 10", "e")
                shown, error = float(text.translate(str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789"))), run.value(key + "_error")
                scale = run.units.of(quantities.quantity_of(key).kind).scale
                digits = abs(value) * scale * 6e-4 if error is None else max(0.06 * error * scale, 1e-12)
                self.assertAlmostEqual(shown, value * scale, delta=max(digits, quantities.NOTHING), msg=key)
                seen += 1
            self.assertGreater(seen, 20)
            self.assertNotRegex(html, r">[-–]0(\.0+)?[ <]")

    def test_of_every_mark_are_of_one_row(self):
        for folder in (fisherman, self.broken):
            run = Run(folder)
            places = {tuple(row) for curve in (run.curve, run.readings)
                      for row in np.column_stack([curve[name] for name in ("time", "extension", "load")]).tolist()}
            for mark in marks_of(run):
                if not np.isnan(mark.load):
                    self.assertIn((float(mark.time), float(mark.extension), float(mark.load)), places, mark.title())

    def test_that_were_given_are_no_result(self):
        self.assertIn("parted at the breaking force that was given, 400 N, which the peak force repeats", html_of(self.broken))
        folder = folders.copy(fisherman)
        old = "knot_efficiency: null  # the rod did not break"
        self.assertIn(old, read(folder, "result.yaml"))
        write(read(folder, "result.yaml").replace(old, "knot_efficiency: null  # not predicted: it was given"), folder, "result.yaml")
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
                write(text, folder, name)
            with self.assertRaisesRegex(CannotReport, name):
                html_of(folder)

    def test_a_package_that_is_not_there_is_named(self):
        blocked = (f"import sys; sys.modules['weasyprint'] = None; sys.argv[1:] = [{straight!r}]\n"
                   "from knot_utm.report import __main__; __main__.main()")
        done = subprocess.run(["/usr/bin/python3", "-B", "-c", blocked], capture_output=True, text=True, check=False)
        self.assertIn("install Debian's package weasyprint\n", self.one_line(done, 1))

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
