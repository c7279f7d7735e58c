#!/usr/bin/python3
"""What `cmake --install` puts into an empty folder, which is then moved. By find_package(knot_utm) examples/pull_a_knot.cpp is
built with it and runs, with the readings of the installed tensile_test; by import knot_utm Python runs the installed tensile_test with
the installed files. package_test.py BUILD_FOLDER"""
import importlib.util
import os
import re
import subprocess
import sys
import tempfile
import unittest

import yaml

ROOT = os.path.realpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
BUILD = os.path.realpath(sys.argv.pop(1))
# The loop is tied and pulled far enough for a plateau, by coarse time steps.
SETTINGS = ["physics.accuracy=draft", "program.pull.until.extension=0.03"]

HAS_PANDAS = all(importlib.util.find_spec(name) for name in ("pandas", "tables", "scipy", "tqdm", "matplotlib"))
HAS_MESSAGES = os.path.isdir(os.path.join(BUILD, "devel/lib/python3/dist-packages/knot_utm/msg"))
RUN = """
import os
import knot_utm
from knot_utm import tool
run = knot_utm.run("straight", "run", **{"physics.accuracy": "draft"})
print(knot_utm.__file__, tool.tensile_test(), tool.find_method("usp_881_knot_pull", ""), os.path.dirname(knot_utm.__file__) + "/report/__main__.py",
      run.results["peak_force"])
"""
MESSAGES = """
import sys
from knot_utm.msg import Crosshead
print(Crosshead._type, "pandas" in sys.modules)
"""


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
        cls.packages = os.path.join(cls.prefix, "lib/python3/dist-packages")
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

    def python(self, *words, path, env=()):
        """Debian's Python, which finds packages in `path`, too; `env`: a program that sets up more."""
        shell = {"PATH": "/usr/sbin:/usr/bin:/sbin:/bin", "PYTHONPATH": path}
        return subprocess.run([*env, "/usr/bin/python3", "-sB", *words], check=False, text=True, cwd=self.built, env=shell,
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE)

    @unittest.skipUnless(HAS_PANDAS, "what scripts/sweep installs is not there")
    def test_python_runs_what_was_installed_with_it(self):
        said = self.python("-c", RUN, path=self.packages)
        self.assertEqual(said.returncode, 0, said.stderr)
        *places, force = said.stdout.split()
        for place in places:
            self.assertTrue(place.startswith(self.prefix + "/"), said.stdout)
            self.assertTrue(os.path.isfile(place), said.stdout)
        self.assertGreater(float(force), 0)

    @unittest.skipUnless(HAS_PANDAS, "what scripts/sweep installs is not there")
    def test_commands_of_scripts_are_there_without_the_scripts(self):
        study = os.path.join(self.built, "study.yaml")
        with open(study, "w", encoding="utf-8") as file:
            file.write("method: straight\nvary: {physics.accuracy: [draft]}\n")
        said = self.python("-m", "knot_utm.sweep_command", study, "--out", "sweep", path=self.packages)
        self.assertEqual((said.returncode, said.stdout), (0, "1 runs, 0 of which failed: the table is in sweep/table.csv and "
                                                             "sweep/table.h5\n"), said.stderr)
        for command in ("sweep", "fit", "rank"):
            said = self.python("-m", f"knot_utm.{command}_command", path=self.packages)
            self.assertEqual(said.returncode, 2, said.stderr)
            self.assertIn(f"(usage: python3 -m knot_utm.{command}_command", said.stderr)

    @unittest.skipUnless(HAS_MESSAGES, "built without messages of ROS")
    def test_messages_of_ros_are_in_the_same_package(self):
        for path, env in ((self.packages, ()), ("", [os.path.join(BUILD, "devel/env.sh")])):
            said = self.python("-c", MESSAGES, path=path, env=env)
            self.assertEqual((said.returncode, said.stdout), (0, "knot_utm/Crosshead False\n"), said.stderr)

    @unittest.skipUnless(HAS_MESSAGES and HAS_PANDAS, "built without messages of ROS, or python3-pandas is not installed")
    def test_python_of_a_workspace_runs_what_was_built_in_it(self):
        devel = os.path.join(BUILD, "devel")
        said = self.python("-c", "from knot_utm import tool, run; print(tool.tensile_test(), tool.CONFIG, callable(run))", path="",
                           env=[os.path.join(devel, "env.sh")])
        self.assertEqual(said.stdout.split(), [devel + "/lib/knot_utm/tensile_test", os.path.join(ROOT, "config"), "True"],
                         said.stderr)

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
