#!/usr/bin/python3
"""The reports of a batch, with every specimen, their statistics, and those that are rejected, and of a comparison."""
import os
import shutil
import unittest

from runs import FISHERMAN, STRAIGHT, Folders, command_of, keys_on, page_of, read, row_of, script, tables_of, tool, without_data, write

import yaml

from knot_utm.report import batch_page
from knot_utm.report.certificate import Check
from knot_utm.report.quantities import number

SCATTER = ["--set", "specimens.scatter={material.stretching_stiffness: {normal: 0.05}, program.pull.speed: {uniform: 0.1}}"]


def setUpModule():
    global folders, loops, rods, single
    folders = Folders()
    loops = folders.run("loops", [*FISHERMAN, "--specimens", "3"], "--report")
    rods = folders.run("rods", [*STRAIGHT, *SCATTER, "--specimens", "2"])
    single = os.path.join(rods, "specimen_001")


def html_of(folder):
    return without_data(batch_page.report_on_batch(folder, "of the test", ""))


def facts_of(*parts):
    return yaml.safe_load(read(*parts))


class PageOfABatch(unittest.TestCase):
    def test_has_every_key_of_the_statistics(self):
        for html, folder in ((page_of(loops), loops), (html_of(rods), rods)):
            self.assertEqual(set(facts_of(folder, "statistics.yaml")) - keys_on(html) - {"specimens", "rejected", "motion_pattern"}, set())
            self.assertIn("specimens keep all limits.", html)

    def test_has_the_statistics_and_a_row_for_each_specimen(self):
        html, plateau = page_of(loops), facts_of(loops, "statistics.yaml")["plateau_force"]
        row, sd = row_of(html, "plateau_force"), plateau["sd"]
        self.assertEqual([row[i] for i in (1, 5, 6, 7, 8)], [
            *(number(plateau[key], sd) for key in ("mean", "minimum", "maximum")), "3", "N"])
        self.assertAlmostEqual(float(row[2]), plateau["high"] - plateau["mean"], delta=0.06 * plateau["high"])
        self.assertAlmostEqual(float(row[4].split()[0]), 100.0 * plateau["cv"], delta=0.01)
        rows = tables_of(html, "Specimen")
        column = rows[0].index("Plateau force [N]")
        self.assertEqual([row[column] for row in rows[1:]], [
            number(facts_of(loops, f"specimen_{one:03d}", "result.yaml")["plateau_force"], sd) for one in (1, 2, 3)])

    def test_says_what_was_drawn_in_the_units_of_its_method(self):
        for units, heads, scales in (({}, ["Stretching stiffness [N]", "Speed, pull [mm/s]", "Stiffness of the pull [N/mm]", "Largest load [N]"],
                                      (1.0, 1e3)), ({"force": "kN", "length": "in"}, ["Stretching stiffness [kN]", "Speed, pull [in/s]",
                                                    "Stiffness of the pull [kN/in]", "Largest load [kN]"], (1e-3, 1.0 / 0.0254))):
            folder = folders.changed(rods, "method.yaml", report={"units": units, "specimen_id": "0012", "standard": "ISO 1"})
            html = html_of(folder)
            rows = tables_of(html, "Specimen")
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
        why = "the knot came undone before it was pulled"
        for numbers, words in (([2], ("2 specimens, of which 1 count and 1 is rejected", "Of one specimen there is no band")),
                               ([1, 2], ("No specimen counts: all 2 are rejected",))):
            folder = folders.changed(rods, "statistics.yaml", rejected=[{"specimen": number, "reason": why} for number in numbers])
            rows = read(folder, "specimens.csv").splitlines()
            rows[2:] = [row.replace(",false,", ",true,") if number in numbers else row for number, row in enumerate(rows[2:], 1)]
            write(os.path.join(folder, "specimens.csv"), "\n".join(rows) + "\n")
            html = html_of(folder)
            for one in (*words, "Specimen 2</td>", why):
                self.assertIn(one, html)
            self.assertIn(["2, rejected", "none"], [[row[0], row[-1]] for row in tables_of(html, "Specimen")])
        self.assertNotIn("Rejected specimens", page_of(loops))

    def test_gives_no_spread_of_what_is_constant_or_rounding(self):
        constant = {"mean": 31.000374, "sd": None, "cv": None, "low": None, "high": None, "minimum": 31.00033, "maximum": 31.00042, "n": 2}
        html = html_of(folders.changed(rods, "statistics.yaml", peak_force=constant))
        self.assertEqual([row_of(html, "peak_force")[i] for i in (1, 2, 3, 4, 7)], ["31.00", "", "constant", "", "2"])
        for key, mean, sd, shown in (("inertia_share", 8.9e-13, 4.9e-14, ["0", "", "constant"]), ("balance_offset", 1e-13, 1.0, ["0", "9.0", "1.0"])):
            found = {"mean": mean, "sd": sd, "cv": sd / mean, "low": mean - 9.0 * sd, "high": mean + 9.0 * sd, "n": 2}
            html = html_of(folders.changed(rods, "statistics.yaml", **{key: found}))
            self.assertEqual(row_of(html, key)[1:4], shown)


class CertificateOfABatch(unittest.TestCase):
    def test_counts_the_specimens_that_keep_a_limit(self):
        good, bad = Check("deep", "a", "1", "at most 2", True), Check("deep", "a", "3", "at most 2", False)
        other = Check("wide", "b", "1", "yes", True)
        checks = [(1, [good, other]), (2, [bad]), (3, [bad]), (4, [bad]), (6, [bad, other])]
        self.assertEqual([(check.words, check.value, check.kept) for check in batch_page.checks_of_all(checks)],
                         [("deep; not so specimens 2 to 4 and 6", "1 of 5 specimens", False), ("wide", "2 of 2 specimens", True)])
        self.assertEqual(batch_page.verdict_of_all(checks, "%s keep it."), ("1 of 5 specimens keep it.", False))

    def test_says_how_many_meet_the_specification(self):
        loads = [facts_of(rods, f"specimen_00{one}", "result.yaml")["energy_to_peak"] for one in (1, 2)]
        folder = folders.run("asked", [*STRAIGHT, *SCATTER, "--specimens", "2", "--set",
                                       f"specification={{energy_to_peak: {{min: {0.5 * sum(loads)}}}}}"])
        html = html_of(folder)
        self.assertIn("1 of 2 specimens meet the specification.", html)
        self.assertIn(f"not so specimen {1 + int(loads[0] > loads[1])}", html)
        self.assertIn("Energy to peak [J]", tables_of(html, "Specimen")[0])


class PageOfAComparison(unittest.TestCase):
    def compare(self, out, *more):
        return tool("compare", f"{single}/curve.csv", f"{single}/curve_full.csv", "--report", out, *more)

    def test_has_what_compare_prints(self):
        out = os.path.join(folders.path, "comparison")
        done = self.compare(out, "--tolerance", "1", "--yaml")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(read(out, "comparison.yaml"), done.stdout)
        html = page_of(out)
        self.assertEqual(set(yaml.safe_load(done.stdout)) - keys_on(html), {"a", "b", "common_extension"})
        self.assertTrue(command_of(html).endswith(f"curve_full.csv --report {out} --tolerance 1 --yaml"), command_of(html))
        for words in ("simulated: Straight rod, nylon", "Forces are in N and lengths in mm", "Curve A ends at its largest load"):
            self.assertIn(words, html)
        self.assertIn("Largest load", row_of(html, "peak_force")[0])
        self.assertEqual(script("report", out).returncode, 0)

    def test_takes_files_of_any_name(self):
        odd, out = os.path.join(folders.path, "a$b$ <c> it's_ä.csv"), os.path.join(folders.path, "odd")
        write(odd, read(single, "curve.csv"))
        bytes_only = os.fsencode(folders.path) + b"/\xff"
        shutil.copytree(os.fsencode(single), bytes_only)
        self.assertEqual(tool("compare", bytes_only + b"/curve.csv", odd, "--report", out).stderr, "")
        for words in ("a$b$ &lt;c&gt; it&#39;s_ä.csv", "/\\udcff/curve.csv", "simulated: Straight rod, nylon"):
            self.assertIn(words, page_of(out))


if __name__ == "__main__":
    unittest.main()
