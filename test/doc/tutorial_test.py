#!/usr/bin/python3
"""doc/tutorial.md: its five commands, as they stand there, one after the other in one shell. What scripts/build makes in
the first one is what it has made of this tree, which the clone gets: building twice would double the time of all tests."""
import os
import re
import shutil
import subprocess
import tempfile
import unittest

import yaml

ROOT = os.path.realpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "../.."))


# Where there is no git, or nothing to clone, a copy stands for the clone; ${*: -2:1} is where from.
CLONE = ('command git "$@"' if shutil.which("git") and os.path.exists(os.path.join(ROOT, ".git")) else
         'mkdir knot_utm && tar -C "${*: -2:1}" -c --exclude="./build*" --exclude=./out . | tar -C knot_utm -x')


def commands():
    """The indented blocks."""
    with open(os.path.join(ROOT, "doc/tutorial.md"), encoding="utf-8") as text:
        blocks = re.findall(r"(?:^    .*\n|^\n(?=    ))+", text.read(), re.MULTILINE)
    return [re.sub(r"^    ", "", block, flags=re.MULTILINE).strip() for block in blocks if block.strip()]


class Tutorial(unittest.TestCase):
    def test_five_commands_lead_from_nothing_to_the_page(self):
        self.assertEqual(len(commands()), 5)
        with tempfile.TemporaryDirectory(prefix="knot_utm_tutorial_") as home:
            opened = os.path.join(home, "opened")
            browser = os.path.join(home, "browser")
            with open(browser, "w", encoding="utf-8") as script:
                script.write(f'#!/bin/sh\nprintf %s "$1" >"{opened}"\n')
            os.chmod(browser, 0o755)
            # A desktop would open the page in its own way, and git trusts no folder of another user.
            environment = {**os.environ, "KNOT_UTM": ROOT, "KNOT_UTM_SKIP_BUILD": "1", "KNOT_UTM_NO_CACHE": "1",
                           "BROWSER": browser, "GIT_CONFIG_COUNT": "1", "GIT_CONFIG_KEY_0": "safe.directory", "GIT_CONFIG_VALUE_0": "*"}
            for name in ("DISPLAY", "WAYLAND_DISPLAY", "XDG_CURRENT_DESKTOP"):
                environment.pop(name, None)
            with_build = f'git() {{ {CLONE} && ln -s "{ROOT}/build" knot_utm/build; }}'
            clone = os.path.join(home, "knot_utm")
            self.follow([with_build] + commands(), home, environment)
            self.is_what_it_says(clone, opened, "mine")
            # Once more in the same clone, with a rod that is another one: what follows is read of the new run.
            edit = "grep -q 'friction_coefficient: 0.6 ' my_test.yaml && sed -i 's/\\(friction_coefficient: 0.\\)6/\\17/' my_test.yaml"
            self.follow([edit] + commands()[2:], clone, environment)
            self.is_what_it_says(clone, opened, "mine-2")

    def follow(self, lines, folder, environment):
        done = subprocess.run(["/bin/bash", "-ec", "\n".join(lines)], cwd=folder, env=environment, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stdout)

    def is_what_it_says(self, clone, opened, run):
        with open(opened, encoding="utf-8") as name:
            page = os.path.join(clone, name.read().replace("file://", ""))
        self.assertTrue(os.path.samefile(page, os.path.join(clone, "out/beside/report.html")))
        for folder in (run, "beside"):
            for ending in ("html", "pdf"):
                self.assertGreater(os.path.getsize(os.path.join(clone, "out", folder, f"report.{ending}")), 10000)
        with open(os.path.join(clone, "out", run, "result.yaml"), encoding="utf-8") as text:
            result = yaml.safe_load(text)
        self.assertEqual(result["ended_by"], "load")
        self.assertEqual(result["warnings"], [])
        with open(os.path.join(clone, "out/beside/comparison.yaml"), encoding="utf-8") as text:
            comparison = yaml.safe_load(text)
        for key in ("peak_force", "plateau_force", "lock_extension_by_load", "locked_stiffness"):
            self.assertIsNotNone(comparison[key]["difference"], key)
        self.assertEqual(comparison["peak_force"]["b"], result["peak_force"], "the comparison is of this run")


class Sample(unittest.TestCase):
    def test_says_that_nobody_measured_it(self):
        with open(os.path.join(ROOT, "doc/examples/Specimen_RawData_1.csv"), encoding="utf-8") as text:
            self.assertIn("synthetic", text.readline())


if __name__ == "__main__":
    unittest.main()
