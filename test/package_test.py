#!/usr/bin/python3
"""find_package(knot_utm), from what `cmake --install` puts into an empty folder, which is then moved: examples/ is built with it
and runs, with the readings of the installed tensile_test. package_test.py BUILD_FOLDER"""
import os
import re
import subprocess
import sys
import tempfile
import unittest

import yaml

ROOT = os.path.realpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
BUILD = sys.argv.pop(1)
# The loop is tied and pulled far enough for a plateau, by coarse time steps.
SETTINGS = ["physics.accuracy=draft", "program.pull.until.extension=0.03"]


def run(*command):
    return subprocess.run(command, check=False, text=True, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE)


def included(header):
    with open(header, encoding="utf-8") as file:
        return re.findall(r'#include "knot_utm/([^"]+)"', file.read())


def public_headers():
    with open(os.path.join(ROOT, "cmake/public_headers.txt"), encoding="utf-8") as file:
        return [line.strip() for line in file if not line.startswith("#") and line.strip()]


class Package(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        first, cls.prefix, cls.built = (os.path.join(folder.name, name) for name in ("first", "usr", "example"))
        cls.must("cmake", "--install", BUILD, "--prefix", first)
        os.rename(first, cls.prefix)
        with open(os.path.join(BUILD, "CMakeCache.txt"), encoding="utf-8") as cache:
            compiler = re.search(r"^CMAKE_CXX_COMPILER:\w+=(.+)$", cache.read(), re.MULTILINE).group(1)
        cls.must("cmake", "-S", os.path.join(ROOT, "examples"), "-B", cls.built, f"-DCMAKE_PREFIX_PATH={cls.prefix}",
                 f"-DCMAKE_CXX_COMPILER={compiler}")
        cls.must("cmake", "--build", cls.built)
        cls.example = os.path.join(cls.built, "pull_a_knot")

    @classmethod
    def must(cls, *command):
        done = run(*command)
        if done.returncode:
            raise AssertionError(f"{command}\n{done.stdout}{done.stderr}")

    def test_example_has_the_plateau_of_tensile_test(self):
        said = run(self.example, "tighten", *SETTINGS)
        self.assertEqual((said.returncode, said.stderr), (0, ""))
        rows = re.findall(r"^ +([\d.-]+) +([\d.e+-]+)$", said.stdout, re.MULTILINE)
        self.assertGreater(len(rows), 1, said.stdout)
        extensions = [float(row[0]) for row in rows]
        self.assertEqual(extensions, sorted(extensions), "it is pulled further and further")
        out = os.path.join(self.built, "out")
        self.must(os.path.join(self.prefix, "lib/knot_utm/tensile_test"), "tighten", "--quiet", "--out", out,
                  *(word for setting in SETTINGS for word in ("--set", setting)))
        with open(os.path.join(out, "result.yaml"), encoding="utf-8") as file:
            plateau = yaml.safe_load(file)["plateau_force"]
        self.assertTrue(said.stdout.endswith(f"the test ended by extension\nplateau force: {plateau:.4g} N\n"),
                        f"{said.stdout}{plateau}")

    def test_example_says_in_one_line_what_is_wrong(self):
        for words, reason in ((["nothing"], "the method is \"nothing\""), (["tighten", "material=nyln"], "nylon"),
                              (["tighten", "specimen.turns=7"], "specimen.turns")):
            said = run(self.example, *words)
            self.assertEqual((said.returncode, said.stdout, said.stderr.count("\n")), (2, "", 1), said.stderr)
            self.assertIn(reason, said.stderr)

    def test_public_headers_are_installed_and_no_others(self):
        place = os.path.join(self.prefix, "include/knot_utm")
        found = sorted(os.path.relpath(os.path.join(where, name), place)
                       for where, _, names in os.walk(place) for name in names if name.endswith(".hpp"))
        self.assertEqual(found, sorted(public_headers()))

    def test_public_headers_include_one_another_only(self):
        headers = public_headers()
        for header in headers:
            for other in included(os.path.join(self.prefix, "include/knot_utm", header)):
                self.assertIn(other, headers, header)


if __name__ == "__main__":
    unittest.main()
