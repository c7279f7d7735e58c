#!/usr/bin/python3
"""README.md: its command gives the numbers that it shows, its lines read the curve, and the pictures are of this program."""
import csv
import glob
import os
import pathlib
import re
import shlex
import subprocess
import tempfile
import unittest

import numpy  # which the lines of the README use
import pandas
import yaml
from PIL import Image

ROOT = os.path.realpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "../.."))
TOOLS = os.environ["KNOT_UTM_TOOLS_DIR"]
os.environ["KNOT_UTM_NO_CACHE"] = "1"  # a test takes up nothing that another one has left
IMAGES = os.path.join(ROOT, "doc/images")
UNITS = {"N": 1.0, "mm": 1e-3, "kN/m": 1e3}


def readme():
    with open(os.path.join(ROOT, "README.md"), encoding="utf-8") as text:
        return text.read()


def section(heading):
    return re.search(rf"^## {heading}\n(.*?)(?=^## |\Z)", readme(), re.MULTILINE | re.DOTALL)[1]


def block(text):
    """The first indented block."""
    lines = re.search(r"(?:^    .*\n)+", text, re.MULTILINE)[0]
    return re.sub(r"^    ", "", lines, flags=re.MULTILINE)


def tensile_test(*arguments):
    return subprocess.run([os.path.join(TOOLS, "tensile_test"), *arguments, "--quiet"], cwd=ROOT, capture_output=True, text=True,
                          check=False)


def step(number):
    """One unit of its last digit."""
    return 10.0 ** -len(number.partition(".")[2])


def texts_of(picture):
    with Image.open(picture) as image:
        return dict(image.text)


def pages():
    files = glob.glob(os.path.join(ROOT, "doc/**/*.md"), recursive=True)
    return "\n".join(pathlib.Path(file).read_text(encoding="utf-8") for file in files)


class Readme(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.home = tempfile.TemporaryDirectory(prefix="knot_utm_readme_")
        cls.addClassCleanup(cls.home.cleanup)
        program, *arguments = shlex.split(block(section("What comes out")))
        assert os.path.basename(program) == "tensile_test", program
        cls.run_folder = os.path.join(cls.home.name, "run")
        arguments[arguments.index("--out") + 1] = cls.run_folder
        arguments.remove("--report")  # which report_test makes
        cls.done = tensile_test(*arguments)

    def setUp(self):
        self.assertEqual(self.done.returncode, 0, self.done.stderr)

    def result(self):
        with open(os.path.join(self.run_folder, "result.yaml"), encoding="utf-8") as text:
            return yaml.safe_load(text)

    @staticmethod
    def rows():
        """Of the table: key, value, unit, error, its unit."""
        return re.findall(r"^\|.*\(`(\w+)`\) \| ([\d.]+) (\S+) \| ± ([\d.]+) (\S+) \|$", section("What comes out"), re.MULTILINE)

    def test_numbers_are_those_that_come_out(self):
        result, rows = self.result(), self.rows()
        self.assertEqual(len(rows), 3)
        for key, value, unit, error, error_unit in rows:
            self.assertAlmostEqual(float(value), result[key] / UNITS[unit], delta=step(value), msg=key)
            self.assertAlmostEqual(float(error), result[key + "_error"] / UNITS[error_unit], delta=step(error), msg=key)

    def test_pictures_are_of_this_program(self):
        """Each PNG carries what it was made of (facts_of_run of knot_utm.report.picture). The two of a test are of the run above."""
        result, steps = self.result(), {key: step(value) * UNITS[unit] for key, value, unit, _, _ in self.rows()}
        seen = set()
        for name in sorted(os.listdir(IMAGES)):
            facts = texts_of(os.path.join(IMAGES, name))
            self.assertLessEqual({"version", "method", "command"}, set(facts), f"{name} does not say what it was made of")
            self.assertIn(f"doc/images/{name}", facts["command"])
            command = re.sub(r"picture-(knots|rviz) ", r"picture --\1 --out ", facts["command"])  # as it was when they were made
            self.assertIn(command, pages(), f"{name}: no page has the command that made it")
            for key in ("plateau_force", "lock_extension"):
                if key in facts:
                    seen.add(name)
                    self.assertEqual(facts["method"], "fisherman, polypropylene")
                    self.assertAlmostEqual(float(facts[key].split()[0]), result[key], delta=steps[key], msg=f"{name}: {key}")
        self.assertEqual(seen, {"rviz.png", "tighten.png"})

    def test_lines_read_the_curve(self):
        here = os.getcwd()
        self.addCleanup(os.chdir, here)
        os.chdir(self.run_folder)  # a line says just "curve.csv"
        with open("curve.csv", encoding="utf-8") as text:
            names, _, *rows = csv.reader(text)
        lines = dict(re.findall(r"^\| (\w+) \| `([^`]+)` \|$", section("Reading the curve elsewhere"), re.MULTILINE))
        for program, module in (("pandas", pandas), ("NumPy", numpy)):
            curve = eval(lines[program], {module.__name__: module})  # pylint: disable=eval-used
            for column, name in enumerate(names):
                said = [row[column] for row in rows]
                if name == "phase":
                    self.assertEqual(list(curve[name]), said, program)
                else:  # the parser of pandas rounds in its own way
                    numpy.testing.assert_allclose(curve[name], [float(number) for number in said], 1e-12, 0.0, err_msg=program)


if __name__ == "__main__":
    unittest.main()
