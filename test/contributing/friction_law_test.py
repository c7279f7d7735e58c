#!/usr/bin/python3
"""The recipe for a friction law in CONTRIBUTING.md: its edits, made in a copy of the sources, add a law that works."""
import os
import re
import shutil
import subprocess
import tempfile
import unittest

ROOT = os.path.realpath(os.path.join(os.path.dirname(__file__), "../.."))
COMPILER = os.environ.get("CXX", "c++")
EIGEN = os.environ.get("KNOT_UTM_EIGEN", "/usr/include/eigen3")
FLAGS = ["-std=c++17", "-O0", "-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wshadow", "-Werror", "-Iinclude",
         "-isystem", EIGEN, '-DKNOT_UTM_VERSION="0"']

PROGRAM = r"""
#include <cmath>
#include <cstdio>

#include "knot_utm/contact/friction.hpp"

using namespace knot_utm;

int main() {
  for (const char* name : kFrictionLawNames) std::printf("%s ", name);
  FrictionOptions options;
  options.law = law_named("tresca");
  options.set("shear_limit", 2.0);
  const Friction friction = Friction::of(options, FrictionScales{0.5, 1e-3, 0.1});
  double worst = 0.0;
  friction.visit([&](const auto& law) {
    for (const double p : {1.0, 10.0})         // below the limit and beyond it
      for (const double slip : {3e-5, 3e-4}) {  // sticking and sliding
        const auto force = [&](double pressure, const Vec3& r) -> Vec3 {
          const auto t = law.traction(FrictionInput<Vec3>{pressure, r, Vec3::Zero(), Vec3::Zero(), 0.0, 1.0});
          return pressure * t.coefficient * t.z;
        };
        const Vec3 r(slip, 0.4 * slip, 0.0), v(1.0, -2.0, 0.0);
        const auto tangent = law.tangent(FrictionInput<Vec3>{p, r, Vec3::Zero(), Vec3::Zero(), 0.0, 1.0},
                                         Linearisation::kTangent);
        const double dp = 1e-6, dr = 1e-10;
        const Vec3 by_pressure = (force(p + dp, r) - force(p - dp, r)) / (2.0 * dp);
        const Vec3 by_slip = (force(p, r + dr * v) - force(p, r - dr * v)) / (2.0 * dr);
        const Vec3 slope = p * tangent.stiffness * tangent.slope_times(v);
        worst = std::fmax(worst, (by_pressure - tangent.by_pressure).norm());
        worst = std::fmax(worst, (by_slip - slope).norm() / (p * tangent.stiffness));
        std::printf("%.6f ", force(p, r).norm());
      }
  });
  std::printf("%s\n", worst < 1e-5 ? "true" : "wrong");
}
"""


def recipe():
    """The section of friction laws: the file that is a copy of an example, and that example; the file that a diff changes, and the diff."""
    with open(os.path.join(ROOT, "CONTRIBUTING.md"), encoding="utf-8") as file:
        section = re.search(r"^## A friction law\n(.*?)(?=^## )", file.read(), re.M | re.S)[1]
    return (re.search(r"^1\. [^\n]*`(\S+)`: a copy of \[\S+\]\((\S+)\)", section, re.M).groups(),
            re.search(r"^2\. [^\n]*`(\S+)`:\n\n```diff\n(.*?)^```", section, re.M | re.S).groups())


def in_full(text, line):
    """What a line with … stands for in the text, over as many lines as that takes, and what … stands for."""
    pattern = r"\s+".join(re.escape(word).replace("…", "([^;]*)") for word in line.split())
    found = re.findall(f"^({pattern}\n)", text, re.M)
    if len(found) != 1:
        raise AssertionError(f"{line!r} stands there {len(found)} times")
    return found[0]


def changed(text, diff):
    """The text with the lines of a diff, whose lines that stay or go must be there once. In a line that goes, … stands for
    what the recipe leaves out; in the line that takes its place, for the same."""
    before, left_out = None, ""
    for line in diff.splitlines():
        kind, content = line[0], line[1:] + "\n"
        if kind == "+":
            content = content.replace("…", left_out)
            text = text.replace(before, before + content) if before else text
            before = content
        else:
            if "…" in content:
                content, left_out = in_full(text, content)
            if text.count(content) != 1:
                raise AssertionError(f"{content!r} stands there {text.count(content)} times")
            if kind == "-":
                at = text.index(content)
                before = text[text.rindex("\n", 0, at - 1) + 1:at]
                text = text.replace(content, "")
            else:
                before = content
    return text


class FrictionLaw(unittest.TestCase):
    def test_the_recipe_adds_a_law(self):
        with tempfile.TemporaryDirectory() as folder:
            for room in ("words", "numeric", "rod", "contact"):
                shutil.copytree(f"{ROOT}/include/knot_utm/{room}", f"{folder}/include/knot_utm/{room}")
                shutil.copytree(f"{ROOT}/src/{room}", f"{folder}/src/{room}")
            (law, example), (registry, diff) = recipe()
            self.assertIn("law_of_your_own", example)
            self.assertFalse(os.path.exists(f"{folder}/{law}"))
            shutil.copy(f"{ROOT}/{example}", f"{folder}/{law}")
            with open(f"{ROOT}/{registry}", encoding="utf-8") as old, open(f"{folder}/{registry}", "w", encoding="utf-8") as new:
                new.write(changed(old.read(), diff))
            with open(f"{folder}/main.cpp", "w", encoding="utf-8") as program:
                program.write(PROGRAM)
            numeric = [f"src/{room}/{file}" for room in ("words", "numeric") for file in sorted(os.listdir(f"{folder}/src/{room}")) if file.endswith(".cpp")]
            built = subprocess.run([COMPILER, *FLAGS, "main.cpp", *numeric, "-lz", "-o", "main"], cwd=folder,
                                   capture_output=True, text=True, check=False)
            self.assertEqual(built.returncode, 0, built.stderr)
            said = subprocess.run([f"{folder}/main"], capture_output=True, text=True, check=True).stdout.split()
        self.assertEqual(said[-1], "true")
        self.assertEqual(said[-6:-5], ["tresca"])
        self.assertEqual(said[-2], "2.000000")  # slides beyond the limit
        self.assertEqual(said[-4], "0.500000")  # slides below it


if __name__ == "__main__":
    unittest.main()
