#!/usr/bin/python3
"""The report of a comparison."""
import os
import shutil
import unittest

from runs import STRAIGHT, Folders, command_of, keys_on, page_of, put_into, read, row_of, script, tool, write

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
        self.assertEqual(set(yaml.safe_load(done.stdout)) - keys_on(html), set())
        self.assertTrue(command_of(html).endswith(f"curve_full.csv --report {out} --tolerance 1 --yaml"), command_of(html))
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
