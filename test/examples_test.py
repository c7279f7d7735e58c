#!/usr/bin/python3
"""examples/: each says in its head what it shows, how it is run, and how it is tested. What stands there after `Test:` is run as a user
does it, and must print what stands after `Prints:`, a regular expression. Where that is a file of test/, that one tests the example."""
import os
import re
import subprocess
import tempfile
import unittest

ROOT = os.path.realpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
TOOLS = os.environ["KNOT_UTM_TOOLS_DIR"]
EXAMPLES = sorted(name for name in os.listdir(os.path.join(ROOT, "examples")) if name != "CMakeLists.txt")
WRITES_BAGS = os.path.exists(os.path.join(TOOLS, "knot_node"))  # with ROS only


def head(name):
    """{"Run": command, "Test": command, "Prints": what}, each of one or more lines."""
    with open(os.path.join(ROOT, "examples", name), encoding="utf-8") as file:
        lines = [re.sub(r"^(//|#) ?|\"\"\"$", "", line.rstrip()) for line in file.read().splitlines()[:12]]
    found = re.findall(r"^(Run|Test|Prints): +(.*(?:\n {6}.*)*)", "\n".join(lines), re.MULTILINE)
    return {key: re.sub(r"\n +", " ", text) for key, text in found}


class Examples(unittest.TestCase):
    def run_as_a_user(self, name):
        said = head(name)
        self.assertIn("Run", said)
        if re.fullmatch(r"test/\S+_test\.py", said["Test"]):
            with open(os.path.join(ROOT, said["Test"]), encoding="utf-8") as test:
                self.assertIn(os.path.splitext(name)[0], test.read())
            return
        if ".bag" in said["Test"] and not WRITES_BAGS:
            self.skipTest("built without ROS")
        with tempfile.TemporaryDirectory() as folder:  # looks like the folder of the package, and has an out/ of its own
            for entry in os.listdir(ROOT):
                if entry not in ("build", "out"):
                    os.symlink(os.path.join(ROOT, entry), os.path.join(folder, entry))
            os.makedirs(os.path.join(folder, "build/devel/lib"))
            os.symlink(TOOLS, os.path.join(folder, "build/devel/lib/knot_utm"))
            done = subprocess.run(["/bin/bash", "-c", said["Test"]], cwd=folder, env={**os.environ, "KNOT_UTM_SKIP_BUILD": "1"},
                                  stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertRegex(done.stdout, said["Prints"].replace("\\\\", "\\"))

    def test_readme_lists_them_all(self):
        with open(os.path.join(ROOT, "README.md"), encoding="utf-8") as file:
            self.assertEqual(sorted(re.findall(r"\]\(examples/([^)]+)\)", file.read())), EXAMPLES)


for one in EXAMPLES:
    setattr(Examples, f"test_{os.path.splitext(one)[0]}", lambda self, name=one: self.run_as_a_user(name))

if __name__ == "__main__":
    unittest.main()
