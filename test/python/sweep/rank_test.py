#!/usr/bin/python3
"""knot_utm.rank and scripts/rank: knots in one rope, pulled alike, in a table. Skipped, with exit code 77, where a module is
not installed."""
import csv
import glob
import os
import subprocess
import unittest

from sweeps import ROOT, Sweeps

import numpy as np

import knot_utm
from knot_utm import ranking
from knot_utm.rank_command import mean_and_error
from knot_utm.yaml_text import load

# Short pulls of coarse knots: what they bear is not asked here.
QUICK = {"physics.accuracy": "draft", "program.3.pull.until.extension": 0.01}


class Rank(Sweeps):
    def rank(self, *knots, **more):
        return knot_utm.rank(list(knots), "green_vps", specimens=2, out=self.path("rank"), settings=QUICK, **more)

    def test_every_knot_has_a_row_in_the_order_of_what_it_bore(self):
        table = self.rank("grief", "reef")
        self.assertEqual(sorted(table["knot"]), ["grief", "reef"])
        self.assertEqual(list(table["slip_load"]), sorted(table["slip_load"], reverse=True))
        self.assertEqual((list(table["specimens"]), list(table["broke"]), list(table["failed"])), ([2, 2], [0, 0], [0, 0]))
        self.assertTrue(np.isfinite(table["slip_load_error"]).all() and np.isfinite(table["tail_slip"]).all())
        self.assertTrue(table[["break_load", "efficiency"]].isna().all(axis=None))
        self.assertEqual(table.attrs["units"]["slip_load"], "N")

    def test_a_mean_and_its_error_are_those_of_the_specimens(self):
        table = self.rank("reef")
        files = glob.glob(self.path("rank", "runs", "*", "specimen_*", "result.yaml"))
        loads = [load(file)["peak_force"] for file in files]
        self.assertEqual(len(loads), 2)
        self.assertAlmostEqual(table["slip_load"][0], np.mean(loads))
        self.assertAlmostEqual(table["slip_load_error"][0], np.std(loads, ddof=1) / np.sqrt(2))

    def test_a_load_that_still_rises_is_none_that_the_knot_slipped_at(self):
        self.assertEqual(list(self.rank("reef")["still_rose"]), [2])
        grief = knot_utm.rank(["grief"], "dyneema_2mm", specimens=2, out=self.path("slips"), settings=QUICK)
        self.assertEqual(list(grief["still_rose"]), [0])

    def test_wrong_words_are_refused_and_nothing_is_written(self):
        usual = {"knots": ["reef"], "material": "green_vps", "specimens": 2, "out": self.path("none")}
        for name, values, why in (
                ("knots", (["reef", "reef"], [], [1], ["reef", None], None, "reef"), "must be a list of different knots"),
                ("knots", (["reeff"],), "did you mean reef\\?"),
                ("specimens", (1, 2.5, "3", True, None), "must be a whole number from 2: one start is no reading"),
                ("jobs", ("x", -1, 0, 2.5), "jobs is .*, but must be a whole number from 1"),
                ("material", (None, 5, ""), "must be the name of a material"),
                ("method", (None, 3), "but must be a file, or the name of a method"),
                ("out", (5,), "out is 5, but must be the path of a folder"),
                ("out", ("/proc/x", "/dev/null/x"), "cannot make the folder /"),
                ("settings", (["a"], {1: 2}), "settings is .*, but must be a dict"),
                ("settings", ({"specimen.knot": "thief"}, {"specimen": {"knot": "thief"}}), "specimen.knot is told by KNOT \\(in Python by knots"),
                ("settings", ({"material": "nylon"},), "material is told by --material"),
                ("settings", ({"specimens.count": 4},), "specimens.count is told by --specimens"),
                ("settings", ({"specimen.preload": np.float64(2.0)},), "\\(float64\\) cannot be the value of a key")):
            for value in values:
                with self.assertRaisesRegex(knot_utm.WrongInput, why) as refused:
                    knot_utm.rank(**{**usual, name: value})
                self.assertNotIn("\n", str(refused.exception))
        self.assertFalse(os.path.exists(self.path("none")))

    def test_each_material_has_a_folder_of_its_own(self):
        for material, folder in (("nylon", "nylon"), ("ropes/my rope.yaml", "my_rope"), ({"name": "a/b"}, "b"), ({}, "own_material")):
            self.assertEqual(ranking.usual_folder(material), os.path.join("out", "rank", folder))

    def test_an_error_has_two_digits_and_its_mean_ends_at_the_same_place(self):
        for mean, error, text in ((24.1, 0.159, "24.10 ± 0.16"), (2501.0, 0.02861, "2501.000 ± 0.029"), (1234.0, 159.0, "1230 ± 160"),
                                  (0.5, 0.0996, "0.50 ± 0.10"), (12.345, np.nan, "12.3"), (12.345, 0.0, "12.35 ± 0"), (np.nan, np.nan, "-")):
            self.assertEqual(mean_and_error(mean, error), text)

    def test_the_command_prints_the_table_and_writes_it(self):
        settings = [word for key, value in QUICK.items() for word in ("--set", f"{key}={value}")]
        done = subprocess.run([os.path.join(ROOT, "scripts/rank"), "reef", "grief", "--material", "green_vps", "--specimens", "2",
                               "--out", self.path("command"), *settings], env=self.environment, cwd=self.folder, text=True,
                              capture_output=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue(done.stdout.startswith("in green_vps, by knot with physics.accuracy=draft, "), done.stdout)
        self.assertRegex(done.stdout, r":\nknot +broke +slip load \[N\].*\n(reef|grief) +0 of 2 +(at least )?\S+ ± \S+ +- +- +\S+ ± \S+\n")
        with open(self.path("command", "rank.csv"), encoding="utf-8") as file:
            self.assertEqual(file.readline().strip().split(","), list(ranking.COLUMNS))
            row = next(csv.DictReader([",".join(ranking.COLUMNS), *file]))
        self.assertEqual((row["material"], row["method"]), ("green_vps", "knot"))
        self.assertIn("physics.accuracy=draft", row["settings"])
        for words, why in ((["--set", "no"], "--set: no is no KEY=VALUE"), (["--set", "specimen.preload=["], "is no YAML"),
                           (["--set", "specimen.knot=thief"], "specimen.knot is told by KNOT"),
                           (["--set", "material=nylon", "--material", "dyneema_2mm"], "material is told by --material"),
                           (["--specimens", "x"], "scripts/rank --help)"), (["--frob"], "scripts/rank --help)"),
                           (["--out", "/proc/x"], "cannot make the folder /proc/x: no such file or directory"),
                           (["--out", self.path("command")], "rank.csv is of knots in green_vps, by knot with")):
            refused = subprocess.run([os.path.join(ROOT, "scripts/rank"), "reef", *words], env=self.environment,
                                     cwd=self.folder, text=True, capture_output=True)
            self.assertEqual((refused.returncode, refused.stdout, refused.stderr.count("\n")), (2, "", 1), refused.stderr)
            self.assertIn(why, refused.stderr)
        self.assertFalse(os.path.exists(self.path("out")))


if __name__ == "__main__":
    unittest.main()
