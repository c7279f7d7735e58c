#!/usr/bin/python3
"""knot_utm.rank and scripts/rank: knots in one rope, pulled alike, in a table. Skipped, with exit code 77, where a module is
not installed."""
import glob
import os
import subprocess
import unittest

from sweeps import ROOT, Sweeps

import numpy as np
import pandas as pd

import knot_utm
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

    def test_the_command_prints_the_table_and_writes_it(self):
        settings = [word for key, value in QUICK.items() for word in ("--set", f"{key}={value}")]

        def command(*words):
            return subprocess.run([os.path.join(ROOT, "scripts/rank"), "reef", *words], env=self.environment, cwd=self.folder, text=True,
                                  capture_output=True)
        done = command("grief", "--material", "green_vps", "--specimens", "2", "--out", self.path("command"), *settings)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue(done.stdout.startswith("in green_vps, by knot with physics.accuracy=draft, "), done.stdout)
        self.assertRegex(done.stdout, r":\n +knot +broke +slip load \[N\].*\n +(reef|grief) +0 +(at least )?\S+ ± \S+ +- +- +\S+ ± \S+\n")
        table = pd.read_csv(self.path("command", "rank.csv"))
        self.assertEqual((table["material"][0], table["method"][0], sorted(table["knot"])), ("green_vps", "knot", ["grief", "reef"]))
        for words, why in ((["--set", "no"], "--set: no is no KEY=VALUE"), (["--set", "specimen.preload=["], "is no YAML"),
                           (["--set", "specimen.knot=thief"], "specimen.knot cannot be a setting of a ranking"), (["reeff"], "did you mean reef?"),
                           (["reef"], "must be a list of different knots"), (["--specimens", "1"], "specimens is 1, but must be a whole number from 2"),
                           (["--frob"], "scripts/rank --help)"), (["--out", "/proc/x"], "cannot make the folder /proc/x")):
            refused = command(*words)
            self.assertEqual((refused.returncode, refused.stdout, refused.stderr.count("\n")), (2, "", 1), refused.stderr)
            self.assertIn(why, refused.stderr)
        self.assertFalse(os.path.exists(self.path("out")))


if __name__ == "__main__":
    unittest.main()
