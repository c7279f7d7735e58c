"""Small tests of tensile_test, and what made of them, for the tests of the report."""
import os
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = os.path.realpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "../.."))
SCRIPT = os.path.join(ROOT, "scripts/report")
TOOLS = os.environ["KNOT_UTM_TOOLS_DIR"]

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(ROOT, "report"))

STRAIGHT = ["config/straight.yaml", "--set", "physics.accuracy=draft", "--set", "material.breaking_force=none"]
# Coarse and heavy-handed, but tied, slid and locked in a second or two.
FISHERMAN = ["config/tighten.yaml", "--set", "material=polypropylene", "--set", "material.breaking_force=none"]


def tool(name, *arguments):
    return subprocess.run([os.path.join(TOOLS, name), *arguments], cwd=ROOT, capture_output=True, text=True,
                          errors="surrogateescape", check=False)


def script(*arguments):
    return subprocess.run([SCRIPT, *arguments], cwd=ROOT, capture_output=True, text=True, check=False)


def page_of(folder):
    """report.html with images cut short, as no message should be a megabyte long."""
    return re.sub(r'(src="data:[^"]{80})[^"]*', r"\1…", read(folder, "report.html"))


def read(*parts):
    with open(os.path.join(*parts), encoding="utf-8") as text:
        return text.read()


def write(text, *parts):
    with open(os.path.join(*parts), "w", encoding="utf-8") as out:
        out.write(text)


def put_into(folder, name, old, new):
    """Changes a file that must hold `old`."""
    text = read(folder, name)
    assert old in text, f"{name} holds no {old}"
    write(text.replace(old, new, 1), folder, name)


class Folders:
    """A folder for runs, and copies of them to be changed."""

    def __init__(self):
        self.path = tempfile.mkdtemp(prefix="knot_utm_report_")
        self.copies = 0

    def run(self, name, method, *more):
        out = os.path.join(self.path, name)
        done = tool("tensile_test", *method, "--quiet", "--out", out, *more)
        assert done.returncode == 0, done.stderr
        return out

    def copy(self, of):
        self.copies += 1
        return shutil.copytree(of, f"{of}-{self.copies}")

    def remove(self):
        shutil.rmtree(self.path)
