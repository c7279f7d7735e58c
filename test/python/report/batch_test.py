#!/usr/bin/python3
"""The report of a batch: every specimen, their mean curve with its band, the statistics, and the specimens that are rejected."""
import os
import unittest

from runs import FISHERMAN, STRAIGHT, Folders, command_of, keys_on, page_of, read, row_of, table_of, tool, without_data, write

import yaml

from knot_utm.report import batch_page
from knot_utm.report.certificate import Check
from knot_utm.report.quantities import number

SCATTER = ["--set", "specimens.scatter={material.stretching_stiffness: {normal: 0.05}, program.pull.speed: {uniform: 0.1}}"]
# Of these three specimens the second one comes undone before it is pulled.
LOOSE = ["config/tighten.yaml", "--set", "compatibility=1", "--set", "physics.accuracy=draft", "--set", "specimen.preload=20",
         "--set", "specimens.scatter={material.friction_coefficient: {normal: 0.3}}", "--set", "material.friction_coefficient=0.3"]


def setUpModule():
    global folders, loops, rods, loose
    folders = Folders()
    loops = folders.run("loops", [*FISHERMAN, "--specimens", "3"], "--report")
    rods = folders.run("rods", [*STRAIGHT, *SCATTER, "--specimens", "2"])
    loose = folders.run("loose", [*LOOSE, "--specimens", "3"])


def html_of(folder):
    return without_data(batch_page.report_on_batch(folder, "of the test", ""))


def facts_of(*parts):
    return yaml.safe_load(read(*parts))


class PageOfABatch(unittest.TestCase):
    def test_has_every_key_of_the_statistics(self):
        for html, folder in ((page_of(loops), loops), (html_of(rods), rods), (html_of(loose), loose)):
            self.assertEqual(set(facts_of(folder, "statistics.yaml")) - keys_on(html) - {"specimens", "rejected", "motion_pattern"}, set())

    def test_has_the_statistics_and_a_row_for_each_specimen(self):
        html, plateau = page_of(loops), facts_of(loops, "statistics.yaml")["plateau_force"]
        row, sd = row_of(html, "plateau_force"), plateau["sd"]
        self.assertEqual([row[i] for i in (1, 5, 6, 7, 8)], [
            *(number(plateau[key], sd) for key in ("mean", "minimum", "maximum")), "3", "N"])
        self.assertAlmostEqual(float(row[2]), plateau["high"] - plateau["mean"], delta=0.06 * plateau["high"])
        self.assertAlmostEqual(float(row[4].split()[0]), 100.0 * plateau["cv"], delta=0.01)
        rows = table_of(html, "Specimen")
        column = rows[0].index("Plateau force [N]")
        self.assertEqual([row[column] for row in rows[1:]], [
            number(facts_of(loops, f"specimen_{one:03d}", "result.yaml")["plateau_force"], sd) for one in (1, 2, 3)])

    def test_begins_with_means_their_intervals_and_their_scatter(self):
        lock = facts_of(loops, "statistics.yaml")["lock_extension"]
        found = {one.label: one for one in batch_page.headlines(batch_page.Batch(loops))}["Mean of lock extension"]
        half = 1e3 * (lock["high"] - lock["mean"])
        self.assertEqual((found.value, found.unit), (number(1e3 * lock["mean"], half), "mm"))
        self.assertAlmostEqual(float(found.error), half, delta=0.05 * half)
        self.assertRegex(found.remark, r"^CV [\d.]+ %, n = 3$")

    def test_says_what_was_drawn_in_the_units_of_its_method(self):
        for units, heads, scales in (({}, ["Stretching stiffness [N]", "Speed, pull [mm/s]", "Stiffness of the pull [N/mm]", "Largest load [N]"],
                                      (1.0, 1e3)), ({"force": "kN", "length": "in"}, ["Stretching stiffness [kN]", "Speed, pull [in/s]",
                                                    "Stiffness of the pull [kN/in]", "Largest load [kN]"], (1e-3, 1.0 / 0.0254))):
            folder = folders.changed(rods, "method.yaml", report={"units": units, "specimen_id": "0012", "standard": "ISO 1"})
            html = html_of(folder)
            rows = table_of(html, "Specimen")
            self.assertEqual(rows[0][1:], heads)
            for one in (1, 2):
                method = facts_of(rods, f"specimen_{one:03d}", "method.yaml")
                for text, value in zip(rows[one][1:], (scales[0] * method["material"]["stretching_stiffness"],
                                                       scales[1] * method["program"][1]["pull"]["speed"])):
                    self.assertAlmostEqual(float(text), value, delta=0.01 * value)
            for words in ("Specimen</span>0012<", "2 tested, 2 count, 0 discarded", "its largest load is no peak", "normal, 5 %"):
                self.assertIn(words, html)
        self.assertIn("All files are in SI units", html)
        for unit in ("N", "mm", "N/mm", "mm/s"):
            self.assertNotRegex(html, rf"\d {unit}\b(?! (?:s/)?m²)", unit)

    def test_says_which_specimens_are_rejected_and_why(self):
        html = html_of(loose)
        for words in ("3 specimens, of which 2 count and 1 is rejected", "motion pattern untangling 2", "Specimen 2</td>",
                      "the knot came undone before it was pulled"):
            self.assertIn(words, html)
        rows = table_of(html, "Specimen")
        self.assertEqual([row[0] for row in rows[1:]], ["1", "2, rejected", "3"])
        self.assertEqual(rows[2][-1], "none")
        self.assertNotIn("Rejected specimens", page_of(loops))

    def test_names_the_command_that_made_it_and_every_file(self):
        html = page_of(loops)
        self.assertTrue(command_of(html).endswith(f"--specimens 3 --quiet --out {loops} --report"), command_of(html))
        self.assertEqual({name for name in os.listdir(loops) if not name.startswith("specimen_") and f"<code>{name}</code>" not in html}, set())
        self.assertIn("<code>specimen_001/ to specimen_003/</code>", html)

    def test_gives_each_warning_once(self):
        folder = folders.copy(rods)
        for one, lines in ((1, ["a < 1.5 mm", "b"]), (2, ["a < 2e-3 mm", "b"])):
            result = facts_of(folder, f"specimen_00{one}", "result.yaml")
            write(yaml.safe_dump({**result, "warnings": lines}), folder, f"specimen_00{one}", "result.yaml")
        html = html_of(folder)
        self.assertIn("<p>specimens 1 to 2: a &lt; 1.5 mm (the numbers are those of specimen 1)</p>", html)
        self.assertIn("<p>specimens 1 to 2: b</p>", html)

    def test_gives_no_spread_of_what_is_constant_or_rounding(self):
        constant = {"mean": 31.000374, "sd": None, "cv": None, "low": None, "high": None, "minimum": 31.00033, "maximum": 31.00042, "n": 2}
        html = html_of(folders.changed(rods, "statistics.yaml", peak_force=constant))
        self.assertEqual([row_of(html, "peak_force")[i] for i in (1, 2, 3, 4, 7)], ["31.00", "", "constant", "", "2"])
        for key, mean, sd, shown in (("inertia_share", 8.9e-13, 4.9e-14, ["0", "", "constant"]), ("balance_offset", 1e-13, 1.0, ["0", "9.0", "1.0"])):
            found = {"mean": mean, "sd": sd, "cv": sd / mean, "low": mean - 9.0 * sd, "high": mean + 9.0 * sd, "n": 2}
            html = html_of(folders.changed(rods, "statistics.yaml", **{key: found}))
            self.assertEqual(row_of(html, key)[1:4], shown)

    def test_of_which_no_specimen_counts_says_so(self):
        out = os.path.join(folders.path, "none")
        done = tool("tensile_test", *LOOSE, "--set", "material.friction_coefficient=0.15", "--set", "specimens.scatter=none",
                    "--specimens", "2", "--quiet", "--out", out, "--report")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("No specimen counts", page_of(out))


class CertificateOfABatch(unittest.TestCase):
    def test_counts_the_specimens_that_keep_a_limit(self):
        good, bad = Check("deep", "a", "1", "at most 2", True), Check("deep", "a", "3", "at most 2", False)
        other = Check("wide", "b", "1", "yes", True)
        checks = [(1, [good, other]), (2, [bad]), (3, [bad]), (4, [bad]), (6, [bad, other])]
        self.assertEqual([(check.words, check.value, check.kept) for check in batch_page.checks_of_all(checks)],
                         [("deep; not so specimens 2 to 4 and 6", "1 of 5 specimens", False), ("wide", "2 of 2 specimens", True)])
        self.assertEqual(batch_page.verdict_of_all(checks, "%s keep it."), ("1 of 5 specimens keep it.", False))

    def test_is_of_the_results_of_the_specimens(self):
        folder = folders.copy(rods)
        self.assertIn("2 of 2 specimens keep all limits.", html_of(folder))
        result = facts_of(folder, "specimen_002", "result.yaml")
        write(yaml.safe_dump({**result, "max_penetration": 0.9}), folder, "specimen_002", "result.yaml")
        html = html_of(folder)
        self.assertIn("1 of 2 specimens keep all limits.", html)
        self.assertIn("; not so specimen 2", row_of(html, "max_penetration", -1)[0])

    def test_says_how_many_meet_the_specification(self):
        loads = [facts_of(rods, f"specimen_00{one}", "result.yaml")["energy_to_peak"] for one in (1, 2)]
        folder = folders.run("asked", [*STRAIGHT, *SCATTER, "--specimens", "2", "--set",
                                       f"specification={{energy_to_peak: {{min: {0.5 * sum(loads)}}}}}"])
        html = html_of(folder)
        self.assertIn("1 of 2 specimens meet the specification.", html)
        self.assertIn(f"not so specimen {1 + int(loads[0] > loads[1])}", html)
        self.assertIn("Energy to peak [J]", table_of(html, "Specimen")[0])


if __name__ == "__main__":
    unittest.main()
