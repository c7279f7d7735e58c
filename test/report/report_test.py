#!/usr/bin/python3
"""The report: what is read from a run's folder, what is made of it, and what is said where it cannot be made."""
import base64
import os
import re
import shutil
import struct
import subprocess
import unittest

from runs import FISHERMAN, ROOT, STRAIGHT, Folders, page_of, put_into, read, script, tool, write

import matplotlib.text
import numpy as np
import yaml

import certificate
import curve_figures
import error_band
import largest_load
import marks
import method_facts
import page
import quantities
import rod_pictures
import shapes
import style
from failure import CannotReport
from few_points import few_points
from run import Curve, Run
from units import Units


def setUpModule():
    global folders, straight, fisherman
    folders = Folders()
    straight = folders.run("straight", STRAIGHT)
    fisherman = folders.run("fisherman", FISHERMAN, "--report")


def tearDownModule():
    folders.remove()


def open_bytes(*parts):
    with open(os.path.join(*parts), "rb") as content:
        return content.read()


def html_of(folder):
    """The page as the script makes it, without the time that its PDF takes."""
    return page.report_on_run(folder, "of the test", "")


def command_of(html):
    """That made the page, as it says itself."""
    return re.sub(r"</?span>", "", re.search(r'class="command">(.*?)</code>', html, re.DOTALL)[1]).strip()


def keys_on(html):
    return set(re.findall(r'data-key="(\w+)"', html))


def row_of(html, key, table=0):
    """Cells of the row of a key, in the first table that has it or in a later one."""
    rows = [row for row in re.findall(r"<tr>.*?</tr>", html, re.DOTALL) if f'data-key="{key}"' in row]
    return [re.sub(r"<[^>]+>", " ", cell).strip() for cell in re.findall(r"<td.*?</td>", rows[table], re.DOTALL)]


def with_report(of, report="", specification="", **results):
    """A copy of a run whose method has a report and a specification, and whose result has other values."""
    folder = folders.copy(of)
    method = re.sub(r"^(report|specification):.*?(?=^\S|\Z)", "", read(folder, "method.yaml"), flags=re.M | re.S)
    write(f"{method}report: {{{report}}}\nspecification: {{{specification}}}\n", folder, "method.yaml")
    result = {**yaml.safe_load(read(folder, "result.yaml")), **results}
    write(yaml.safe_dump(result, sort_keys=False), folder, "result.yaml")
    return folder


class PageOfARun(unittest.TestCase):
    def test_has_every_key_of_the_result(self):
        self.assertEqual(set(yaml.safe_load(read(fisherman, "result.yaml"))) - keys_on(page_of(fisherman)), set())

    def test_has_a_key_that_it_never_heard_of(self):
        folder = folders.copy(straight)
        write(read(folder, "result.yaml") + "loop_energy: 2.5\nknots_of_loop: [1, 2]\n", folder, "result.yaml")
        html = html_of(folder)
        self.assertEqual(row_of(html, "loop_energy")[1:], ["2.5", "J"])
        self.assertEqual(row_of(html, "knots_of_loop")[1], "1; 2")

    def test_leaves_out_what_has_no_value(self):
        folder = with_report(fisherman, break_extension=None, energy_to_peak=None, max_penetration=None)
        html = html_of(folder)
        for key in ("break_extension", "energy_to_peak", "max_penetration"):
            self.assertFalse(any(f'data-key="{key}"' in row for row in re.findall(r"<tr>.*?</tr>", html, re.DOTALL)), key)
        cells = re.findall(r"<td[^>]*>([^<]*)</td>", html)
        self.assertFalse({"–", "None", "null", "nan", "not known"} & {cell.strip() for cell in cells})
        self.assertRegex(html, r"This test has no value of .*break_extension")

    def test_gives_readings_in_the_units_of_testers_with_their_errors(self):
        html, result = page_of(fisherman), yaml.safe_load(read(fisherman, "result.yaml"))
        row = row_of(html, "lock_extension")
        self.assertAlmostEqual(float(row[1]), 1e3 * result["lock_extension"], delta=0.05)
        self.assertAlmostEqual(float(row[2].strip("± ")), 1e3 * result["lock_extension_error"], delta=0.05)
        self.assertEqual(row[-1], "mm")

    def test_has_the_true_force_beside_the_balanced_load(self):
        folder = with_report(fisherman, plateau_force=4.25, plateau_force_error=None, true_plateau_force=5.5)
        self.assertEqual([cell for cell in row_of(html_of(folder), "plateau_force")[1:] if cell], ["4.25", "5.5", "N"])

    def test_has_every_number_in_the_units_of_its_method(self):
        result = {"peak_force": 444.82216152605, "true_peak_force": None, "break_extension": 0.0254, "locked_stiffness": 175.126835,
                  "locked_stiffness_error": None}
        for asked, force, length, values in (("units: {force: lbf, length: in}", "lbf", "in", ("100", "1", "1")),
                                             ("units: {force: kN, length: m}", "kN", "m", ("0.4448", "0.0254", "0.1751"))):
            html = html_of(with_report(straight, asked, "break_extension: {max: 0.0508}", specification_passed=True,
                                       **result))
            for key, value, unit in (("peak_force", values[0], force), ("break_extension", values[1], length),
                                     ("locked_stiffness", values[2], f"{force}/{length}")):
                self.assertEqual([cell for cell in row_of(html, key)[1:] if cell], [value, unit])
            self.assertEqual(row_of(html, "break_extension", 1)[1], f"{values[1]} {length}")
            self.assertIn("all files are in SI units", html)
            for unit in ("N", "mm", "N/mm", "mm/s"):
                self.assertNotRegex(re.sub(r'"data:[^"]*"', "", html), rf"\d {unit}\b(?! (?:s/)?m²)", unit)

    def test_has_head_and_foot_only_where_they_are_given(self):
        bare, full = html_of(straight), html_of(with_report(
            straight, "specimen_id: 0012, operator: A. M., customer: <R&D>, date: 2026-11-23, standard: EN 1, "
                      'notes: "one\\ntwo", signature: Dr. Q.'))
        for word in ("Specimen</span>", "Operator</span>", "Customer</span>", "Date</span>", "Standard</span>",
                     'class="notes"', 'class="signature"', 'class="logo"'):
            self.assertNotIn(word, bare)
        for word in ("Specimen</span>0012<", "Operator</span>A. M.<", "Customer</span>&lt;R&amp;D&gt;<",
                     "Date</span>2026-11-23<", "Standard</span>EN 1<", ">one\ntwo<", ">Dr. Q., 2026-11-23<"):
            self.assertIn(word, full)

    def test_holds_its_logo(self):
        folder = with_report(straight, "logo: logo.svg")
        self.assertIn("logo.svg: the logo cannot be read", script(folder).stderr)
        logo = '<svg xmlns="http://www.w3.org/2000/svg" width="9" height="9"><rect width="9" height="9"/></svg>'
        write(logo, folder, "logo.svg")
        self.assertIn("data:image/svg+xml;base64," + base64.b64encode(logo.encode()).decode(), html_of(folder))

    def test_begins_with_the_reason_where_the_physics_gave_up(self):
        html = html_of(with_report(straight, ended_by="solver", reason="no step converged", warnings=[]))
        self.assertIn("The physics gave up before the test ended", html)
        self.assertIn("no step converged", html)
        self.assertNotIn("The test gave no warning", html)

    def test_names_the_command_that_made_it_and_every_file(self):
        html = page_of(fisherman)
        self.assertTrue(command_of(html).endswith(
            f"tensile_test {' '.join(FISHERMAN)} --quiet --out {fisherman} --report"), command_of(html))
        for name in os.listdir(fisherman):
            self.assertIn(f"<code>{name}</code>", html)

    def test_asks_for_nothing_from_elsewhere(self):
        html = page_of(fisherman)
        self.assertEqual([source[:5] for source in re.findall(r'(?:src|srcset)="([^"]*)"', html)], ["data:"] * 6)
        for elsewhere in ("<link", "<script", "http://", "https://", "url(", "@import"):
            self.assertNotIn(elsewhere, html)

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
            pages.append(html_of(folder))
        self.assertEqual(Run(folder).load_cell_floor(), 0.002 * method["machine"]["load_cell"]["capacity"])
        self.assertEqual(["hatched floor" in html for html in pages], [False, True])
        curves = [re.search(r'src="(data:image/svg[^"]+)"', html).group(1) for html in pages]
        self.assertTrue(curves[0] != curves[1])

    def test_shows_the_final_shape_where_no_bag_can_be_read(self):
        folder = folders.copy(straight)
        bag = os.path.join(folder, "test.bag")
        os.remove(bag) if os.path.exists(bag) else None
        for remark in ("no test.bag", "test.bag cannot be read"):
            html = html_of(folder)
            self.assertTrue(remark in html)
            self.assertTrue("image/png" in html)
            write("#ROSBAG V2.0\n", bag)

    def test_of_a_test_in_which_nothing_was_pulled(self):
        folder = folders.copy(straight)
        for name in ("curve.csv", "curve_full.csv"):
            write("\n".join(read(folder, name).splitlines()[:2]) + "\n", folder, name)
        self.assertEqual(script(folder).returncode, 0)
        self.assertIn("there is no curve", page_of(folder))

    def test_of_a_test_that_ended_while_it_was_prepared(self):
        folder = folders.copy(straight)
        for name in ("curve.csv", "curve_full.csv"):
            rows = read(folder, name).splitlines()
            write("\n".join(row for row in rows if not row.endswith(",pull")) + "\n", folder, name)
        html = html_of(folder)
        self.assertIn("there is no curve", html)
        self.assertEqual(len(re.findall(r' src="data:image/(?:svg|png)', html)), 2)

    def test_says_warnings_first(self):
        folder = folders.copy(straight)
        put_into(folder, "result.yaml", "warnings: []", 'warnings: ["a & b < c"]')
        html = html_of(folder)
        self.assertLess(html.index("<li>a &amp; b &lt; c</li>"), html.index("<h2>"))


class Keys(unittest.TestCase):
    def test_of_every_group_have_a_place_on_the_page(self):
        places = {*quantities.TABLES, quantities.HEAD, quantities.BESIDE, quantities.CERTIFICATE}
        self.assertEqual(set(quantities.GROUPS), places)

    def test_that_are_checked_stand_in_the_certificate(self):
        checked = {key for check in certificate.checks_of({}) for key in check.keys}
        self.assertLessEqual(set(quantities.GROUPS[quantities.CERTIFICATE]), checked)


class Certificate(unittest.TestCase):
    def test_limits_are_those_of_the_program(self):
        source = read(ROOT, "src/io/run_warnings.cpp")
        for name, limit in certificate.LIMITS.items():
            self.assertEqual(float(re.search(rf"constexpr double {name} = ([\d.]+);", source).group(1)), limit, name)
        gate = re.search(r'"force_balance_error"\) .*?at_most\(([\d.]+)\)', read(ROOT, "bench/tighten.py"), re.DOTALL)
        self.assertEqual(float(gate.group(1)), certificate.BENCH_FORCE_BALANCE)

    def test_misses_where_the_program_warns(self):
        good = yaml.safe_load(read(fisherman, "result.yaml"))
        self.assertTrue(certificate.verdict(certificate.certificate(good))[1])
        for key, bad in (("max_penetration", 0.06), ("jump_force", 1.0), ("energy_balance_error", 0.02),
                         ("force_balance_error", 0.02), ("knot_type_preserved", False), ("not_equilibrated", True),
                         ("ended_by", "solver"), ("plateau_force_error", 0.2 * good["true_plateau_force"])):
            missed = [check.keys for check in certificate.certificate({**good, key: bad}) if check.verdict == "fail"]
            self.assertEqual(missed, [[key]])

    def test_makes_up_no_limit(self):
        checks = {check.keys[0]: check for check in certificate.certificate(
            {"moment_balance_error": 0.5, "max_penetration": None, "knot_type_preserved": True})}
        self.assertEqual((checks["moment_balance_error"].limit, checks["moment_balance_error"].verdict),
                         ("no limit is set", ""))
        self.assertNotIn("max_penetration", checks)


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
        html = html_of(with_report(straight, "", "peak_force: {max: 1e6}", specification_passed=True))
        self.assertIn("The test meets its specification.", html)

    def test_is_not_there_where_nothing_was_asked_for(self):
        self.assertNotIn("specification.", html_of(straight))


def a_pull(extension, load):
    columns = {"time": 10.0 * extension, "extension": extension, "load": load,
               "knot_distance": np.full(len(load), np.nan), "end_to_end": extension}
    return Curve(columns, np.full(len(load), "pull"))


class OfValues(Run):
    """A run that is not in a folder."""

    def __init__(self, curve, **result):
        self.curve, self.readings, self.result, self.units = curve, curve, result, Units()


class Band(unittest.TestCase):
    def test_is_a_share_of_the_true_force_where_nothing_slid(self):
        pull = a_pull(np.linspace(0.0, 0.01, 11), np.linspace(0.0, 50.0, 11))
        low, high = error_band.error_band(OfValues(pull, locked_stiffness=4e3, locked_stiffness_error=400.0,
                                                   balance_offset=10.0), pull)
        np.testing.assert_allclose(low, 0.9 * (pull["load"] + 10.0) - 10.0)
        np.testing.assert_allclose(high, 1.1 * (pull["load"] + 10.0) - 10.0)

    def test_behind_the_lock_it_moves_along_the_extension(self):
        s = np.linspace(0.0, 0.1, 1001)
        load = np.where(s < 0.05, 2.0, 2.0 + 1e4 * (s - 0.05))
        run = OfValues(a_pull(s, load), plateau_force=2.0, plateau_force_error=0.2, lock_extension=0.05,
                       lock_extension_error=0.002, locked_stiffness=1e4, locked_stiffness_error=0.0)
        low, high = error_band.error_band(run, run.curve)
        np.testing.assert_allclose((low[200], high[200]), (1.8, 2.2))
        # 2 mm at 1e4 N/m
        np.testing.assert_allclose((low[800], high[800]), (load[800] - 20.0, load[800] + 20.0))

    def test_is_not_drawn_where_no_error_is_known(self):
        pull = a_pull(np.array([0.0, 1.0]), np.array([0.0, 1.0]))
        self.assertIsNone(error_band.error_band(OfValues(pull, locked_stiffness=1.0, locked_stiffness_error=None),
                                                pull))


class FewPoints(unittest.TestCase):
    def test_keep_the_first_the_last_and_every_extreme(self):
        load = np.sin(np.linspace(0.0, 40.0, 300001))
        load[123456], load[200001] = 7.0, -7.0
        rows = few_points(load)
        self.assertLess(len(rows), 10000)
        self.assertEqual((rows[0], rows[-1], load[rows].max(), load[rows].min()), (0, 300000, 7.0, -7.0))
        self.assertEqual(len(few_points(load[:500])), 500)


class ABrokenRod(unittest.TestCase):
    def test_is_drawn_in_its_pieces(self):
        nodes = np.column_stack([np.zeros(10), np.zeros(10), np.linspace(0.0, 0.9, 10)])
        whole = shapes.Shape(0.0, nodes, np.ones(9))
        recoil = np.where(np.arange(10) >= 4, 0.5, 0.0)[:, None] * [0.0, 0.0, 1.0]
        parted = shapes.Shape(1.0, nodes + recoil, np.zeros(9))
        stretched = shapes.Shape(1.0, 3.0 * nodes, np.ones(9))
        self.assertEqual(shapes.pieces(parted, whole), [slice(0, 4), slice(4, 10)])
        self.assertEqual(shapes.pieces(stretched, whole), [slice(0, 10)])


class APicture(unittest.TestCase):
    def test_is_never_much_higher_than_wide(self):
        run = Run(straight)
        across = np.column_stack([np.linspace(0.0, 1.2, 50), np.zeros(50), np.linspace(0.0, 0.008, 50)])
        picture = rod_pictures.pictures(run, [marks.end_of(run.curve)], [shapes.Shape(0.0, across, None)], style.WIDE)
        width, height = struct.unpack(">II", base64.b64decode(picture.split(",")[1])[16:24])  # of a PNG's header
        self.assertLess(height, width)

    def test_is_as_wide_as_the_widest_view(self):
        self.assertEqual(rod_pictures.width_of([(0.0, 50.0, 0.0, 10.0), (0.0, 100.0, 0.0, 10.0)]), 100.0)


class ACompliantFrame(unittest.TestCase):
    def test_is_drawn_as_far_as_its_crosshead_went(self):
        s = np.array([0.0, 1.0, 2.0, 9.0])
        broken = a_pull(s, np.array([0.0, 1.0, 2.0, 0.0]))
        self.assertGreater(curve_figures.extension_limits(OfValues(broken))[1], 9e3)
        broken.columns["crosshead_extension"] = np.array([0.0, 2.0, 4.0, 4.0])
        low, high = curve_figures.extension_limits(OfValues(broken, break_extension=2.0))
        self.assertEqual(low, 0.0)
        self.assertTrue(4e3 < high < 4.5e3, high)

    def test_readings_are_held_against_the_specimens_own_extension(self):
        folder = folders.copy(straight)
        for name in ("curve.csv", "curve_full.csv"):
            rows = [row.split(",") for row in read(folder, name).splitlines()]
            rows = [rows[0] + ["corrected_extension"], rows[1] + ["m"],
                    *(row[:1] + [str(2.0 * float(row[1]))] + row[2:] + [row[1]] for row in rows[2:])]
            write("\n".join(map(",".join, rows)) + "\n", folder, name)
        own, rigid = Run(folder).curve, Run(straight).curve
        np.testing.assert_array_equal(own["extension"], rigid["extension"])
        np.testing.assert_array_equal(own["crosshead_extension"], 2.0 * rigid["extension"])
        self.assertIn("the deflection of the frame is taken off", html_of(folder))


class Marks(unittest.TestCase):
    def test_are_start_lock_peak_and_end(self):
        s = np.linspace(0.0, 0.1, 101)
        run = OfValues(a_pull(s, np.where(s < 0.09, 100.0 * s, 1.0)), lock_extension=0.05, peak_force=9.0)
        found = marks.marks_of(run)
        self.assertEqual([(mark.letter, mark.title()) for mark in found],
                         [("a", "start of the pull"), ("b", "lock"), ("c", "peak"), ("d", "end of the test")])
        self.assertAlmostEqual(found[1].extension, 0.05)

    def test_tell_what_was_before_a_break_from_what_was_behind(self):
        s = np.linspace(0.0, 0.1, 101)
        found = marks.marks_of(OfValues(a_pull(s, np.where(s < 0.0995, s, 0.0)), break_extension=0.0992,
                                          peak_force=0.099))
        self.assertEqual([mark.title() for mark in found], ["start of the pull", "peak, break", "end of the test"])
        self.assertAlmostEqual(marks.time_of_break(found), 0.99)
        seconds = np.array([0.0, 0.5, 0.98, 1.02, 1.3])
        self.assertEqual([shapes.nearest(seconds, time, 1.01) for time in (0.4, 1.005, 1.01, 1.4)], [1, 2, 2, 4])

    def test_that_fall_together_are_one(self):
        s = np.linspace(0.0, 0.1, 101)
        self.assertEqual([mark.title() for mark in marks.marks_of(OfValues(a_pull(s, s), peak_force=0.1))],
                         ["start of the pull", "largest load, end of the test"])

    def test_have_a_peak_only_where_the_pull_has_one(self):
        s = np.linspace(0.0, 0.1, 101)
        held = a_pull(s, np.where(s < 0.05, s, 0.2 - s))
        held.phase[50:] = "hold"
        self.assertEqual([mark.title() for mark in marks.marks_of(OfValues(held, peak_force=None))],
                         ["start of the pull", "end of the test"])
        found = marks.marks_of(OfValues(held, peak_force=0.049))
        self.assertEqual([(mark.title(), mark.load) for mark in found][1], ("largest load", held["load"][49]))
        held.phase[:] = "hold"
        self.assertEqual([mark.title() for mark in marks.marks_of(OfValues(held, peak_force=1.0))],
                         ["start", "end of the test"])


class TheLargestLoad(unittest.TestCase):
    S = np.linspace(0.0, 0.1, 101)

    def of(self, load, **result):
        return largest_load.largest_load(OfValues(a_pull(self.S, load), peak_force=1.0, **result))

    def test_is_a_peak_where_the_load_fell_behind_it(self):
        found = self.of(np.where(self.S < 0.06, self.S, 0.0), ended_by="extension")
        self.assertEqual((found.is_peak, found.name, found.where), (True, "peak", "at an extension of 59 mm"))

    def test_is_a_peak_where_the_rod_parted(self):
        found = self.of(np.where(self.S < 0.0995, self.S, 0.0), ended_by="break", break_extension=0.0992)
        self.assertEqual((found.is_peak, found.where), (True, "where the rod parted"))

    def test_is_no_peak_where_the_test_was_stopped_while_the_load_rose(self):
        for ended_by, where in (("extension", "which was stopped at 100 mm"), ("operator", "the operator stopped at"),
                                ("solver", "where the physics gave up")):
            found = self.of(self.S, ended_by=ended_by)
            self.assertEqual((found.is_peak, found.name), (False, "largest load"))
            self.assertIn("at the end of the test, ", found.where)
            self.assertIn(where, found.where)

    def test_is_no_peak_where_a_hold_follows_the_pull(self):
        held = a_pull(self.S, np.minimum(self.S, 0.05))
        held.phase[51:] = "hold"
        found = largest_load.largest_load(OfValues(held, peak_force=0.05, ended_by="time"))
        self.assertEqual((found.is_peak, found.where), (False, "at the end of the pull, at 50 mm"))

    def test_is_called_so_on_the_page(self):
        html = html_of(straight)
        self.assertIn("The curve has no peak: its largest load", html)
        self.assertRegex(row_of(html, "peak_force")[0], "^Largest load, at the end of the test, which was stopped at")
        self.assertNotRegex(re.sub(r'"data:[^"]*"', "", html), ">Peak")


class Facts(unittest.TestCase):
    def test_have_the_units_of_the_method(self):
        method = {"specimen": {"knot": "straight"}, "material": {}, "machine": {"load_cell": {"accuracy": 0.005}},
                  "physics": {"gravity": [0, 0, -9.81], "accuracy": "draft", "contact": {"tolerance": 0.02},
                              "friction": {"slip_tolerance": 0.001, "presliding": 0.01}},
                  "ends": {"sharp_drop": 0.5, "drop": 0.3, "break_at_fraction_of_peak": 0.2}}
        found = {row for _, rows, _ in method_facts.method_facts(method, Units()) for row in rows}
        self.assertLessEqual({
            ("Accuracy of the cell", "0.005 of the reading"), ("Accuracy", "draft"), ("Gravity", "[0, 0, –9.81] m/s²"),
            ("Contact", "tolerance 0.02 of the radius"),
            ("Friction", "slip tolerance 0.001 m/s, presliding 0.01 of the radius"),
            ("Sharp drop by", "0.5 of the peak"), ("Drop by", "0.3 of the peak"),
            ("Break at no more than", "0.2 of the peak")}, found)

    def test_call_the_stiffness_of_the_whole_pull_so(self):
        result = {"lock_extension": None, "locked_stiffness": 1.0, "locked_stiffness_error": 0.1}
        for lock, name in ((None, "tiffness of the pull"), (0.05, "ocked stiffness")):
            result["lock_extension"] = lock
            shown = page.headlines(OfValues(None, **result), None)
            self.assertTrue(any(headline.label.endswith(name) for headline in shown))
            self.assertTrue(any(name in check.words for check in certificate.certificate(result)))


class Figures(unittest.TestCase):
    def test_have_no_letters_smaller_than_the_smallest(self):
        run, drawn = Run(fisherman), []
        found = marks.marks_of(run)
        shown = [shapes.final_shape(run)]
        keep = lambda figure, *_: drawn.append(figure) or ""
        for module, name in ((curve_figures, "as_svg"), (rod_pictures, "as_png")):
            self.addCleanup(setattr, module, name, getattr(module, name))
            setattr(module, name, keep)
        for look in style.LOOKS:
            curve_figures.force_extension(run, found, look)
            curve_figures.course(run, look)
            rod_pictures.pictures(run, found[-1:], shown, look)
        self.assertEqual(len(drawn), 6)
        for figure in drawn:
            sizes = [text.get_fontsize() for text in figure.findobj(matplotlib.text.Text) if text.get_text().strip()]
            self.assertGreaterEqual(min(sizes), style.SMALL)

    def test_show_where_a_knot_jumped_open_and_the_small_loads(self):
        run = Run(with_report(fisherman, jump_force=1.626, jump_extension=0.0121, lock_extension=None, plateau_force=None,
                              lock_extension_by_load=None, locked_stiffness=None))
        found, drawn = marks.marks_of(run), []
        self.assertIn("a knot jumped open", [mark.title() for mark in found])
        self.addCleanup(setattr, curve_figures, "as_svg", curve_figures.as_svg)
        curve_figures.as_svg = lambda figure, *_: drawn.append(figure) or ""
        curve_figures.force_extension(run, found, style.LOOKS[0])
        texts = [text.get_text() for text in drawn[0].findobj(matplotlib.text.Text)]
        self.assertIn("a knot jumped open at 1.626 N", texts)
        self.assertIn("small loads [N]", texts)

    def test_of_scripts_picture_are_of_the_same_style(self):
        source = read(ROOT, "scripts/picture")
        self.assertNotRegex(source, r"#[0-9a-fA-F]{6}|fontsize=\d")


class Numbers(unittest.TestCase):
    def test_have_the_digits_that_their_error_leaves(self):
        self.assertEqual(quantities.number(6.08745, 0.4664), "6.09")
        self.assertEqual(quantities.number(0.0744, 0.0014), "0.0744")
        self.assertEqual(quantities.number(-1.94937), "–1.949")
        self.assertEqual(quantities.number(123456.7), "123457")
        self.assertEqual(quantities.number(5.55e-8), "5.55 · 10⁻⁸")
        self.assertEqual(quantities.shown(float("nan")), "–")


class Failures(unittest.TestCase):
    def one_line(self, done, code):
        self.assertEqual(done.returncode, code)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        return done.stderr

    def test_a_folder_without_a_result(self):
        self.assertIn("neither result.yaml nor comparison.yaml nor fit.yaml", self.one_line(script(folders.path), 1))
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
            self.assertIn(name, self.one_line(script(folder), 1))
            self.assertFalse(os.path.exists(os.path.join(folder, "report.html")))

    def test_a_package_that_is_not_there_is_named(self):
        for module, package in (("matplotlib", "python3-matplotlib"), ("weasyprint", "weasyprint"),
                                ("jinja2", "python3-jinja2")):
            blocked = (f"import sys; sys.modules['{module}'] = None; sys.argv[1:] = [{straight!r}]\n"
                       f"sys.path.insert(0, {os.path.join(ROOT, 'report')!r})\nimport make_report; make_report.main()")
            done = subprocess.run(["/usr/bin/python3", "-B", "-c", blocked], capture_output=True, text=True,
                                  check=False)
            self.assertIn(f"install Debian's package {package}\n", self.one_line(done, 1))

    def test_a_report_that_cannot_be_written_leaves_the_results(self):
        out = os.path.join(folders.path, "no_room")
        os.makedirs(os.path.join(out, "report.html", "in_the_way"))
        done = tool("tensile_test", *STRAIGHT, "--quiet", "--out", out, "--report")
        self.assertIn("tensile_test: report: ", self.one_line(done, 1))
        self.assertIn("report.html: cannot be written", done.stderr)
        self.assertIn("ended_by: extension", read(out, "result.yaml"))

    def test_a_new_run_takes_the_old_page_away(self):
        out = folders.run("twice", STRAIGHT, "--report")
        self.assertTrue(os.path.exists(os.path.join(out, "report.pdf")))
        folders.run("twice", STRAIGHT, "--overwrite")
        self.assertFalse({"report.html", "report.pdf"} & set(os.listdir(out)))


    def test_a_page_that_cannot_be_written_leaves_the_old_one_and_no_part(self):
        out = os.path.join(folders.path, "parts")
        os.makedirs(os.path.join(out, "report.pdf.part"))
        write("old", out, "report.html")
        with self.assertRaisesRegex(CannotReport, "report.pdf: cannot be written"):
            page.write(out, "new")
        self.assertEqual(sorted(os.listdir(out)), ["report.html", "report.pdf.part"])
        self.assertEqual(read(out, "report.html"), "old")


class PageOfAComparison(unittest.TestCase):
    def compare(self, out, *more):
        return tool("compare", f"{straight}/curve.csv", f"{straight}/curve_full.csv", "--report", out, *more)

    def test_has_what_compare_prints(self):
        out = os.path.join(folders.path, "comparison")
        done = self.compare(out, "--tolerance", "1")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(read(out, "comparison.yaml"), done.stdout)
        html = page_of(out)
        self.assertEqual(set(yaml.safe_load(done.stdout)) - keys_on(html), set())
        self.assertTrue(command_of(html).endswith(f"curve_full.csv --report {out} --tolerance 1"), command_of(html))
        self.assertIn("simulated: Straight rod, nylon", html)
        self.assertIn("Forces are in N and lengths in mm", html)
        self.assertIn("Curve A ends at its largest load", html)
        self.assertEqual(row_of(html, "peak_force")[0].split("  ")[0], "Largest load")
        self.assertEqual(script(out).returncode, 0)

    def test_takes_files_of_any_name(self):
        odd = os.path.join(folders.path, "a$b$ <c> it's_ä.csv")
        write(read(straight, "curve.csv"), odd)
        out = os.path.join(folders.path, "odd")
        self.assertEqual(tool("compare", odd, f"{straight}/curve.csv", "--report", out).stderr, "")
        self.assertIn("a$b$ &lt;c&gt; it&#39;s_ä.csv", page_of(out))
        bytes_only = os.fsencode(folders.path) + b"/\xff"
        shutil.copytree(os.fsencode(straight), bytes_only)
        self.assertEqual(script(bytes_only).stderr, "")
        # Another comparison goes beside the one that stands there.
        beside = tool("compare", bytes_only + b"/curve.csv", odd, "--report", out)
        self.assertIn(f"this one is written to {out}-2\n", beside.stderr)
        self.assertIn("a$b$ &lt;c&gt; it&#39;s_ä.csv", page_of(out))
        out += "-2"
        self.assertIn("/\\udcff/curve.csv", page_of(out))
        self.assertIn("simulated: Straight rod, nylon", page_of(out))

    def test_makes_room_for_a_run(self):
        out = os.path.join(folders.path, "makes_room")
        self.assertEqual(self.compare(out).returncode, 0)
        for name in ("method.yaml", "result.yaml", "curve.csv", "curve_full.csv", "final_shape.csv"):
            shutil.copy(os.path.join(straight, name), out)
        self.assertEqual(script(out).returncode, 0)
        self.assertIn("<h1>Straight rod, nylon</h1>", page_of(out))
        folders.run("makes_room", STRAIGHT, "--overwrite")
        self.assertFalse({"comparison.yaml", "a.csv", "b.csv", "report.html"} & set(os.listdir(out)))

    def test_is_written_beyond_the_tolerance_too(self):
        out = os.path.join(folders.path, "beyond")
        other = folders.copy(straight)
        last = read(other, "curve.csv").splitlines()[-1].split(",")
        put_into(other, "curve.csv", ",".join(last), ",".join([*last[:2], str(1.1 * float(last[2])), *last[3:]]))
        done = tool("compare", f"{straight}/curve.csv", f"{other}/curve.csv", "--report", out, "--tolerance", "0.05")
        self.assertEqual(done.returncode, 1)
        self.assertTrue(os.path.exists(os.path.join(out, "report.pdf")))

    def test_takes_no_run_and_no_file_that_it_compares(self):
        before = set(os.listdir(straight))
        done = self.compare(straight)
        self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (2, "", 1))
        self.assertEqual(set(os.listdir(straight)), before)
        own = os.path.join(folders.path, "own")
        os.makedirs(own)
        write(read(straight, "curve.csv"), own, "a.csv")
        done = tool("compare", f"{own}/a.csv", f"{straight}/curve.csv", "--report", own)
        self.assertEqual((done.returncode, os.listdir(own)), (2, ["a.csv"]))
        self.assertEqual(read(own, "a.csv"), read(straight, "curve.csv"))
        for name in ("", f"{own}/a.csv/below"):
            self.assertEqual(self.compare(name).returncode, 2)


if __name__ == "__main__":
    unittest.main()
