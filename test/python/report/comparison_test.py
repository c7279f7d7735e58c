#!/usr/bin/python3
"""The report of a comparison."""
import os
import shutil
import unittest

from runs import STRAIGHT, Folders, command_of, keys_on, page_of, read, row_of, script, tool, write

import yaml


def setUpModule():
    global folders, straight
    folders = Folders()
    straight = folders.run("straight", STRAIGHT)


class PageOfAComparison(unittest.TestCase):
    def compare(self, out, *more):
        return tool("compare", f"{straight}/curve.csv", f"{straight}/curve_full.csv", "--report", out, *more)

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
        write(read(straight, "curve.csv"), odd)
        bytes_only = os.fsencode(folders.path) + b"/\xff"
        shutil.copytree(os.fsencode(straight), bytes_only)
        self.assertEqual(tool("compare", bytes_only + b"/curve.csv", odd, "--report", out).stderr, "")
        for words in ("a$b$ &lt;c&gt; it&#39;s_ä.csv", "/\\udcff/curve.csv", "simulated: Straight rod, nylon"):
            self.assertIn(words, page_of(out))

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


if __name__ == "__main__":
    unittest.main()
