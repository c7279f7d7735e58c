#!/usr/bin/python3
"""knot_utm.rank and scripts/rank: knots in one rope, pulled alike, in a table. Skipped, with exit code 77, where a module is
not installed."""
import glob
import os
import subprocess
import unittest

from sweeps import ROOT, Sweeps

import numpy as np

import knot_utm
from knot_utm import ranking
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
        for knots, specimens, why in ((["reef", "reef"], 2, "must be a list of different knots"), ([], 2, "different knots"),
                                      (["reef"], 1, "at least 2: one start is no reading"), (["reeff"], 2, "did you mean reef?")):
            with self.assertRaisesRegex(knot_utm.WrongInput, why.replace("?", r"\?")):
                knot_utm.rank(knots, "green_vps", specimens=specimens, out=self.path("none"))
        self.assertFalse(os.path.exists(self.path("none")))

    def test_the_command_prints_the_table_and_writes_it(self):
        settings = [word for key, value in QUICK.items() for word in ("--set", f"{key}={value}")]
        done = subprocess.run([os.path.join(ROOT, "scripts/rank"), "reef", "grief", "--material", "green_vps", "--specimens", "2",
                               "--out", self.path("command"), *settings], env=self.environment, cwd=self.folder, text=True,
                              capture_output=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"knot +broke +slip load \[N\].*\n(reef|grief) +0 of 2 +(at least )?\S+ ± \S+ +- +- +\S+ ± \S+\n")
        with open(self.path("command", "rank.csv"), encoding="utf-8") as file:
            self.assertEqual(file.readline().strip().split(","), list(ranking.COLUMNS))
        for word in ("no", "specimen.preload=["):
            refused = subprocess.run([os.path.join(ROOT, "scripts/rank"), "reef", "--set", word], env=self.environment,
                                     cwd=self.folder, text=True, capture_output=True)
            self.assertEqual((refused.returncode, refused.stderr.count("\n")), (2, 1), refused.stderr)


if __name__ == "__main__":
    unittest.main()
