#!/usr/bin/python3
"""The report of a batch: every specimen, their mean curve with its band, the statistics, and the specimens that are rejected."""
import os
import re
import unittest

from runs import FISHERMAN, STRAIGHT, Folders, command_of, keys_on, page_of, read, row_of, tool, write

import numpy as np
import yaml

from knot_utm.report import batch_page, style
from knot_utm.report.batch import Batch
from knot_utm.report.certificate import Check
from knot_utm.report.commands import CannotReport
from knot_utm.report.curves import mean_curve
from knot_utm.report.method_facts import particulars
from knot_utm.report.quantities import number, Units

SCATTER = ["--set", "specimens.scatter={material.stretching_stiffness: {normal: 0.05}, program.pull.speed: {uniform: 0.1}}"]
# Of these three specimens the second one comes undone before it is pulled.
LOOSE = ["config/tighten.yaml", "--set", "material.bending_law=elastic", "--set", "material.friction_couple=0",
         "--set", "physics.accuracy=draft", "--set", "specimen.preload=20",
         "--set", "specimens.scatter={material.friction_coefficient: {normal: 0.3}}", "--set", "material.friction_coefficient=0.3"]


def setUpModule():
    global folders, loops, rods, loose
    folders = Folders()
    loops = folders.run("loops", [*FISHERMAN, "--specimens", "3"], "--report")
    rods = folders.run("rods", [*STRAIGHT, *SCATTER, "--specimens", "2"])
    loose = folders.run("loose", [*LOOSE, "--specimens", "3"])


def html_of(folder):
    return batch_page.report_on_batch(folder, "of the test", "")


def statistics(folder):
    return yaml.safe_load(read(folder, "statistics.yaml"))


def tables_of(html):
    """Rows of cells, as text, of every table that has a row for each specimen."""
    found = []
    for table in re.findall(r'<table class="results beside">.*?</table>', html, re.DOTALL):
        rows = [[" ".join(re.sub(r"<[^>]+>", " ", cell).split()) for cell in re.findall(r"<t[dh].*?</t[dh]>", row, re.DOTALL)]
                for row in re.findall(r"<tr>.*?</tr>", table, re.DOTALL)]
        if rows[0][0] == "Specimen":
            found.append(rows)
    return found


def changed(of, name, change):
    """A copy of a batch, one of whose YAML files was changed."""
    folder = folders.copy(of)
    content = yaml.safe_load(read(folder, name))
    change(content)
    write(yaml.safe_dump(content, sort_keys=False), folder, name)
    return folder


def head_of(html):
    """{label: text}"""
    return dict(re.findall(r'<div><span class="label">(.*?)</span>(.*?)</div>', html))


class PageByAStandard(unittest.TestCase):
    ASKED = {"standard": "ISO 1", "conditioning": "23 °C", "terminations": "wedges", "units": {"length": "in"}}

    def test_says_how_the_specimens_were_tested(self):
        folder = changed(rods, "method.yaml", lambda method: method.update(report=self.ASKED))
        head, speed = head_of(html_of(folder)), Batch(folder).method["program"][-1]["pull"]["speed"]
        self.assertEqual(head, {"Standard": "ISO 1", "Conditioning": "23 °C", "Terminations": "wedges",
                                "Gauge length": number(0.25 / 0.0254) + " in",
                                "Speed of the crosshead": number(60.0 * speed / 0.0254) + " in/min",
                                "Specimens": "2 tested, 2 count, 0 discarded"})
        self.assertEqual(head_of(html_of(rods)), {}, "where no standard is named")

    def test_of_a_load_rate_there_is_no_speed(self):
        method = {"program": [{"pull": {"speed": 0.1, "load_rate": 5.0}}]}
        self.assertEqual(particulars({"standard": "ISO 1"}, method, None, Units()), [])
        self.assertEqual([row[2] for row in particulars({"standard": "ISO 1"}, {"program": [{"pull": {"speed": 0.005}}, {"hold": {}}]},
                                                        0.25, Units())], ["250 mm", "300 mm/min"])


class PageOfABatch(unittest.TestCase):
    def test_has_every_key_of_the_statistics(self):
        for folder in (loops, rods, loose):
            self.assertEqual(set(statistics(folder)) - keys_on(html_of(folder)), set())

    def test_has_a_row_for_each_specimen_and_rows_of_statistics(self):
        table, facts = tables_of(page_of(loops))[0], statistics(loops)
        self.assertEqual([row[0] for row in table[1:]],
                         ["1", "2", "3", "Mean", "Standard deviation", "Coefficient of variation", "Minimum", "Maximum",
                          "95 % interval of the mean, low end", "95 % interval of the mean, high end", "Readings"])
        self.assertEqual(table[0][1], "Plateau force N")
        column = dict((row[0], row[1]) for row in table[1:])
        plateau = facts["plateau_force"]
        for name, value in (("Mean", plateau["mean"]), ("Standard deviation", plateau["sd"]), ("Minimum", plateau["minimum"]),
                            ("Maximum", plateau["maximum"]), ("95 % interval of the mean, low end", plateau["low"]),
                            ("95 % interval of the mean, high end", plateau["high"])):
            self.assertEqual(column[name], number(value, plateau["sd"]), name)
        self.assertAlmostEqual(float(column["Coefficient of variation"].split()[0]), 100.0 * plateau["cv"], delta=0.01)
        for one in (1, 2, 3):
            result = yaml.safe_load(read(loops, f"specimen_{one:03d}", "result.yaml"))
            self.assertEqual(column[str(one)], number(result["plateau_force"], plateau["sd"]))

    def test_begins_with_means_their_intervals_and_their_scatter(self):
        lock = statistics(loops)["lock_extension"]
        found = {one.label: one for one in batch_page.headlines(Batch(loops))}["Lock extension"]
        half = lock["high"] - lock["mean"]
        self.assertEqual((found.value, found.unit), (number(1e3 * lock["mean"], 1e3 * half), "mm"))
        self.assertAlmostEqual(float(found.error), 1e3 * half, delta=0.05 * 1e3 * half)
        self.assertRegex(found.remark, r"^CV [\d.]+ %, n = 3$")

    def test_says_what_was_drawn(self):
        html = html_of(rods)
        table = tables_of(html)[-1]
        self.assertEqual(table[0], ["Specimen", "Stretching stiffness N", "Speed, pull mm/s"])
        for one in (1, 2):
            method = yaml.safe_load(read(rods, f"specimen_{one:03d}", "method.yaml"))
            self.assertAlmostEqual(float(table[one][1]), method["material"]["stretching_stiffness"], delta=100.0)
            self.assertAlmostEqual(float(table[one][2]), 1e3 * method["program"][1]["pull"]["speed"], delta=0.01)
        self.assertIn("<td>Stretching stiffness</td><td>normal, 5 %</td>", html)
        self.assertIn("Nothing was drawn", html_of(folders.run("same", [*STRAIGHT, "--specimens", "2"])))

    def test_says_which_specimens_are_rejected_and_why(self):
        html = html_of(loose)
        self.assertIn("<b>3</b> specimens</span>, of which <b>2</b> count and <b>1</b> is rejected", html)
        self.assertIn("<tr><td>Specimen 2</td><td>the knot came undone before it was pulled</td></tr>", html)
        readings, drawn = tables_of(html)
        self.assertEqual([row[0] for row in readings[1:4]], ["1", "3", "Mean"])
        self.assertEqual([row[0] for row in drawn[1:]], ["1", "2, rejected", "3"])
        self.assertNotIn("Rejected specimens", page_of(loops))

    def test_counts_motion_patterns_and_ends(self):
        self.assertIn("motion pattern <b>sliding 3</b> · ended by <b>", page_of(loops))
        self.assertIn("motion pattern <b>untangling 2</b>", html_of(loose))

    def test_calls_the_largest_load_so_where_it_still_rose(self):
        html = html_of(rods)
        self.assertEqual(tables_of(html)[0][0], ["Specimen", "Stiffness of the pull N/mm", "Largest load N"])
        self.assertIn("its largest load is no peak", html)

    def test_has_every_number_in_the_units_of_its_method(self):
        facts = statistics(rods)
        html = html_of(changed(rods, "method.yaml", lambda method: method.update(
            report={"units": {"force": "kN", "length": "in"}, "specimen_id": "0012"})))
        row = row_of(html, "locked_stiffness")
        self.assertAlmostEqual(float(row[1]), facts["locked_stiffness"]["mean"] * 25.4e-6, delta=0.02)
        self.assertEqual(row[-1], "kN/in")
        self.assertEqual(tables_of(html)[0][0], ["Specimen", "Stiffness of the pull kN/in", "Largest load kN"])
        for unit in ("N", "mm", "N/mm", "mm/s"):
            self.assertNotRegex(re.sub(r'"data:[^"]*"', "", html), rf"\d {unit}\b(?! (?:s/)?m²)", unit)
        for words in ("Specimen</span>0012<", "All files are in SI units"):
            self.assertIn(words, html)

    def test_names_the_command_that_made_it_and_every_file(self):
        html = page_of(loops)
        self.assertTrue(command_of(html).endswith(f"--specimens 3 --quiet --out {loops} --report"), command_of(html))
        for name in os.listdir(loops):
            if not name.startswith("specimen_"):
                self.assertIn(f"<code>{name}</code>", html)
        self.assertIn("<code>specimen_001/ to specimen_003/</code>", html)

    def test_gives_each_warning_once(self):
        folder = folders.copy(rods)
        for one, lines in ((1, ["a < 1.5 mm", "b"]), (2, ["a < 2e-3 mm", "b"])):
            result = yaml.safe_load(read(folder, f"specimen_00{one}", "result.yaml"))
            write(yaml.safe_dump({**result, "warnings": lines}), folder, f"specimen_00{one}", "result.yaml")
        html = html_of(folder)
        self.assertIn("<li>specimens 1 and 2: a &lt; 1.5 mm (the numbers are those of specimen 1)</li>", html)
        self.assertIn("<li>specimens 1 and 2: b</li>", html)

    def test_gives_no_spread_of_what_is_constant(self):
        same = {"mean": 31.000374, "sd": None, "cv": None, "low": None, "high": None, "minimum": 31.00033, "maximum": 31.00042, "n": 2}
        html = html_of(changed(rods, "statistics.yaml", lambda facts: facts.update(peak_force=same)))
        self.assertEqual(row_of(html, "peak_force")[1:], ["31.00", "", "constant", "", "2", "N"])
        self.assertIn("constant, n = 2", html)
        column = tables_of(html)[0]
        place = column[0].index("Largest load N")
        self.assertEqual([row[place] for row in column if row[0] in ("Mean", "Standard deviation", "Coefficient of variation")],
                         ["31.00", "constant", ""])


    def test_gives_no_spread_of_what_is_rounding_and_keeps_that_of_readings_around_zero(self):
        for key, mean, sd, shown in (("inertia_share", 8.9e-13, 4.9e-14, ["0", "", "constant"]), ("balance_offset", 1e-13, 1.0, ["0", "9.0", "1.0"])):
            found = {"mean": mean, "sd": sd, "cv": sd / mean, "low": mean - 9.0 * sd, "high": mean + 9.0 * sd, "n": 2}
            html = html_of(changed(rods, "statistics.yaml", lambda facts: facts.update({key: found})))
            self.assertEqual(row_of(html, key)[1:4], shown)


class CertificateOfABatch(unittest.TestCase):
    def test_counts_the_specimens_that_keep_a_limit(self):
        good, bad = Check("deep", ["a"], "1", "at most 2", True), Check("deep", ["a"], "3", "at most 2", False)
        other, unlimited = Check("wide", ["b"], "1", "yes", True), Check("long", ["c"], "1", "no limit is set", None)
        checks = [(1, [good, other, unlimited]), (2, [bad]), (4, [bad, other])]
        self.assertEqual([(check.words, check.value, check.verdict) for check in batch_page.checks_of_all(checks)],
                         [("deep; not so specimens 2 and 4", "1 of 3 specimens", "fail"), ("wide", "2 of 2 specimens", "pass")])
        self.assertEqual(batch_page.verdict_of_all(checks, "%s keep it."), ("1 of 3 specimens keep it.", False))

    def test_is_of_the_results_of_the_specimens(self):
        folder = folders.copy(rods)
        self.assertIn("2 of 2 specimens keep all limits.", html_of(folder))
        result = yaml.safe_load(read(folder, "specimen_002", "result.yaml"))
        write(yaml.safe_dump({**result, "max_penetration": 0.9}), folder, "specimen_002", "result.yaml")
        html = html_of(folder)
        self.assertIn("1 of 2 specimens keep all limits.", html)
        self.assertEqual(row_of(html, "max_penetration", -1)[0].split("; ")[-1], "not so specimen 2")

    def test_says_how_many_meet_the_specification(self):
        loads = [yaml.safe_load(read(rods, f"specimen_00{one}", "result.yaml"))["energy_to_peak"] for one in (1, 2)]
        between = 0.5 * sum(loads)
        folder = folders.run("asked", [*STRAIGHT, *SCATTER, "--specimens", "2", "--set",
                                       f"specification={{energy_to_peak: {{min: {between}}}}}"])
        html = html_of(folder)
        self.assertIn("1 of 2 specimens meet the specification.", html)
        self.assertIn(f"not so specimen {1 + int(loads[0] > loads[1])}", html)
        self.assertIn("Energy to peak J", tables_of(html)[0][0])


class Named(unittest.TestCase):
    def test_specimens_are_listed_as_in_a_sentence(self):
        self.assertEqual(batch_page.named([3]), "specimen 3")
        self.assertEqual(batch_page.named([5, 2]), "specimens 2 and 5")
        self.assertEqual(batch_page.named([1, 2, 3, 7, 9, 10]), "specimens 1 to 3, 7, 9 and 10")

    def test_no_table_is_wider_than_a_telephone(self):
        self.assertEqual([len(some) for some in batch_page.beside_each_other(list(range(11)))], [4, 4, 3])
        self.assertEqual(batch_page.beside_each_other([]), [])


class TheMeanCurve(unittest.TestCase):
    def test_is_that_of_the_loads_at_each_extension_that_all_have(self):
        # Loads s, 2 s and 6 s: mean 3 s, standard deviation sqrt(7) s; with 2 degrees of freedom t is 4.3027.
        pulls = [(np.array([0.0, 0.4, 4.0]), np.array([0.0, 0.4, 4.0])), (np.array([0.5, 3.0]), np.array([1.0, 6.0])),
                 (np.array([0.0, 1.0, 5.0]), np.array([0.0, 6.0, 30.0]))]
        found = mean_curve(pulls)
        self.assertEqual((found.extension[0], found.extension[-1]), (0.5, 3.0))
        np.testing.assert_allclose(found.mean, 3.0 * found.extension)
        np.testing.assert_allclose(found.sd, np.sqrt(7.0) * found.extension)
        np.testing.assert_allclose(found.half, 4.302652729911275 * np.sqrt(7.0 / 3.0) * found.extension)

    def test_is_not_drawn_where_nothing_is_common(self):
        one, behind = (np.array([0.0, 1.0]), np.array([0.0, 1.0])), (np.array([2.0, 3.0]), np.array([0.0, 1.0]))
        self.assertIsNone(mean_curve([one]))
        self.assertIsNone(mean_curve([one, behind]))
        self.assertIsNone(mean_curve([one, (np.array([]), np.array([]))]))


class FiguresOfABatch(unittest.TestCase):
    def drawn(self, folder, look):
        kept = []
        self.addCleanup(setattr, batch_page, "as_svg", batch_page.as_svg)
        batch_page.as_svg = lambda figure, *_: kept.append(figure) or ""
        batch = Batch(folder)
        batch_page.curves(batch, mean_curve([one.pull for one in batch.tested]), look)
        return kept[0]

    def test_draw_every_specimen_that_counts_and_their_mean(self):
        for folder, counted in ((rods, 2), (loose, 2), (loops, 3)):
            axes = self.drawn(folder, style.WIDE).axes[0]
            thin = [line for line in axes.get_lines() if line.get_color() == style.BLUE]
            self.assertEqual(len(thin), counted)
            legend = [text.get_text() for text in axes.get_legend().get_texts()]
            self.assertEqual(legend, [f"{counted} specimens", "mean ± standard deviation", "mean", "95 % interval of the mean"])

    def test_draw_the_mean_and_its_band_in_the_units_of_the_page(self):
        folder = changed(rods, "method.yaml", lambda method: method.update(report={"units": {"force": "kN", "length": "m"}}))
        axes = self.drawn(folder, style.WIDE).axes[0]
        mean = mean_curve([one.pull for one in Batch(folder).tested])
        drawn = {line.get_label(): line.get_xydata().T for line in axes.get_lines()}
        np.testing.assert_allclose(drawn["mean"], (mean.extension, 1e-3 * mean.mean))
        np.testing.assert_allclose(drawn["95 % interval of the mean"], (mean.extension, 1e-3 * mean.about(mean.half)[0]))
        band = axes.collections[0].get_paths()[0].vertices[:, 1]
        low, high = mean.about(mean.sd)
        np.testing.assert_allclose((band.min(), band.max()), (1e-3 * low.min(), 1e-3 * high.max()))

    def test_never_show_a_mean_beyond_what_a_specimen_shows(self):
        s = np.linspace(0.0, 0.1, 201)
        mean = mean_curve([(s, np.where(s < lock, 5.0, 5.0 + 1e5 * (s - lock))) for lock in (0.05, 0.06, 0.08)])
        self.assertLess((mean.mean - mean.sd).min(), 0.0)  # as the loads are not normally distributed there
        for width in (mean.sd, mean.half):
            low, high = mean.about(width)
            self.assertGreaterEqual(low.min(), 5.0)
            self.assertTrue((low <= mean.mean).all() and (mean.mean <= high).all() and (high <= mean.most).all())

    def test_have_fewer_points_of_many_curves(self):
        s = np.linspace(0.0, 1.0, 5000)
        figure, axes = batch_page.stacked(style.WIDE, [2.0])[:2]
        batch_page.draw(axes[0], [(s, s)] * 100, None, 1.0, 1.0)
        self.assertLessEqual(sum(len(line.get_xdata()) for line in axes[0].get_lines()), 1.1 * batch_page.IN_ALL)
        batch_page.as_svg(figure)


class Failures(unittest.TestCase):
    def test_a_file_that_is_not_what_it_should_be_is_named(self):
        header = "\n".join(read(rods, "specimens.csv").splitlines()[:2]) + "\n"
        for name, text in (("specimens.csv", "specimen\n-\n1\n"), ("specimens.csv", header), ("statistics.yaml", "specimens: 2\n"),
                           ("method.yaml", "[\n"), ("specimen_002/curve_full.csv", "time\ns\n1\n")):
            folder = folders.copy(rods)
            write(text, folder, name)
            with self.assertRaisesRegex(CannotReport, name):
                html_of(folder)

    def test_a_batch_of_which_none_counts_has_a_page_too(self):
        out = os.path.join(folders.path, "none_counts")
        done = tool("tensile_test", *LOOSE, "--set", "material.friction_coefficient=0.15", "--set",
                    "specimens.scatter=none", "--specimens", "2", "--quiet", "--out", out, "--report")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("No specimen counts", page_of(out))


if __name__ == "__main__":
    unittest.main()
