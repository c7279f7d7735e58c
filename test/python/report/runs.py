"""Small tests of tensile_test, and what made of them, for the tests of the report."""
import os
import re
import shutil
import subprocess
import tempfile
import unittest
from unittest import mock

import numpy as np
import yaml

from knot_utm.report import page
from knot_utm.report.quantities import Units
from knot_utm.report.run import Curve, Run

ROOT = os.path.realpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../.."))
SCRIPT = os.path.join(ROOT, "scripts/report")
TOOLS = os.environ["KNOT_UTM_TOOLS_DIR"]
os.environ["KNOT_UTM_NO_CACHE"] = "1"  # a test takes up nothing that another one has left


STRAIGHT = ["config/straight.yaml", "--set", "physics.accuracy=draft", "--set", "material.breaking_force=none"]
# Coarse and heavy-handed, but tied, slid and locked in a second or two.
FISHERMAN = ["config/tighten.yaml", "--set", "material=polypropylene", "--set", "material.breaking_force=none"]


def tool(name, *arguments):
    return subprocess.run([os.path.join(TOOLS, name), *arguments], cwd=ROOT, capture_output=True, text=True,
                          errors="surrogateescape", check=False)


def script(*arguments):
    return subprocess.run([SCRIPT, *arguments], cwd=ROOT, capture_output=True, text=True, check=False)


def page_of(folder):
    """report.html with images cut short and without its scripts, as no message should be a megabyte long."""
    return re.sub(r'(src="data:[^"]{80})[^"]*', r"\1…", without_scripts(read(folder, "report.html")))


def without_scripts(html):
    return re.sub(r"<script.*?</script>", "", html, flags=re.DOTALL)


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


def open_bytes(*parts):
    with open(os.path.join(*parts), "rb") as content:
        return content.read()


def html_of(folder, with_figures=False):
    """The page as the script makes it, without its scripts and the time that its PDF takes, and mostly without figures."""
    if with_figures:
        return without_scripts(page.report_on_run(folder, "of the test", ""))
    with mock.patch.object(page, "figures_of", lambda _, marks: {
            "curve": ["", ""] if marks else None, "course": None, "pictures": None, "note": "", "turnable": None}):
        return page.report_on_run(folder, "of the test", "")


def command_of(html):
    """That made the page, as it says itself."""
    return re.sub(r"</?span>", "", re.search(r'class="command">(.*?)</code>', html, re.DOTALL)[1]).strip()


def keys_on(html):
    return set(re.findall(r'data-key="(\w+)"', html))


def row_of(html, key, table=0):
    """Cells of the row of a key, in the first table that has it or in a later one."""
    rows = [row for row in re.findall(r"<tr>.*?</tr>", html, re.DOTALL) if f'data-key="{key}"' in row]
    return [re.sub(r"<[^>]+>", " ", cell).strip() for cell in re.findall(r"<td.*?</td>", rows[table], re.DOTALL)]


def a_pull(extension, load):
    columns = {"time": 10.0 * extension, "extension": extension, "load": load,
               "knot_distance": np.full(len(load), np.nan), "end_to_end": extension}
    return Curve(columns, np.full(len(load), "pull"))


class OfValues(Run):
    """A run that is not in a folder."""

    def __init__(self, curve, **result):
        self.curve, self.readings, self.result, self.units = curve, curve, result, Units()


class Folders:
    """A folder for the runs of a module of tests, and for copies of them to be changed."""

    def __init__(self):
        self.path = tempfile.mkdtemp(prefix="knot_utm_report_")
        self.copies = 0
        unittest.addModuleCleanup(shutil.rmtree, self.path)

    def run(self, name, method, *more):
        out = os.path.join(self.path, name)
        done = tool("tensile_test", *method, "--quiet", "--out", out, *more)
        assert done.returncode == 0, done.stderr
        return out

    def copy(self, of):
        self.copies += 1
        return shutil.copytree(of, f"{of}-{self.copies}")

    def with_report(self, of, report="", specification="", **results):
        """A copy of a run whose method has a report and a specification, and whose result has other values."""
        folder = self.copy(of)
        method = re.sub(r"^(report|specification):.*?(?=^\S|\Z)", "", read(folder, "method.yaml"), flags=re.M | re.S)
        write(f"{method}report: {{{report}}}\nspecification: {{{specification}}}\n", folder, "method.yaml")
        result = {**yaml.safe_load(read(folder, "result.yaml")), **results}
        write(yaml.safe_dump(result, sort_keys=False), folder, "result.yaml")
        return folder

def two_runs(*more):
    """Folders with a run of a straight rod and one of a loop, which takes `more` arguments: for setUpModule."""
    folders = Folders()
    return folders, folders.run("straight", STRAIGHT), folders.run("fisherman", FISHERMAN, *more)
