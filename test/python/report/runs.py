"""Small tests of tensile_test, and what made of them, for the tests of the report."""
import os
import re
import shutil
import subprocess
import tempfile
import unittest
from unittest import mock

from head import ROOT, TOOLS, read, write

import numpy as np
import yaml

from knot_utm.report import run_page
from knot_utm.report.quantities import Units
from knot_utm.report.run import Curve, Run

STRAIGHT = ["config/straight.yaml", "--set", "physics.accuracy=draft", "--set", "material.breaking_force=none"]
# Tied, slid and locked in a second or two.
FISHERMAN = ["config/tighten.yaml", "--set", "material=polypropylene", "--set", "material.breaking_force=none",
             "--set", "program.pull.until.extension=0.1"]  # its loads are within what the contacts are right for


def tool(name, *arguments):
    return subprocess.run([os.path.join(TOOLS, name), *arguments], cwd=ROOT, capture_output=True, text=True,
                          errors="surrogateescape", check=False)


def script(name, *arguments):
    return subprocess.run([os.path.join(ROOT, "scripts", name), *arguments], cwd=ROOT, capture_output=True, text=True, check=False,
                          env={**os.environ, "KNOT_UTM_SKIP_BUILD": "1"})


def without_data(html):
    """Without its scripts, and with images cut short, as no message should be a megabyte long."""
    return re.sub(r'(src="data:[^"]{80})[^"]*', r"\1…", re.sub(r"<script.*?</script>", "", html, flags=re.DOTALL))


def page_of(folder):
    return without_data(read(folder, "report.html"))


def html_of(folder):
    """The page of a run as the script makes it, without its figures, which take long."""
    with mock.patch.object(run_page, "figures_of", lambda *_: ([], [], None)):
        return run_page.report_on_run(folder, "of the test", "")


def command_of(html):
    """That made the page, as it says itself."""
    return re.sub(r"</?span>", "", re.search(r'class="command">(.*?)</code>', html, re.DOTALL)[1]).strip()


def keys_on(html):
    """Those whose values the rows of its tables show, and those that it names."""
    return {key for keys in re.findall(r'data-key="([\w. ]+)"', html) for key in keys.split()} | set(re.findall(r"<code>(\w+)</code>", html))


def cells_of(row):
    return [" ".join(re.sub(r"<[^>]+>", " ", cell).split()) for cell in re.findall(r"<t[dh].*?</t[dh]>", row, re.DOTALL)]


def row_of(html, key, table=0):
    """Cells of the row of a key without its name, in the first table that has it or in a later one."""
    rows = [row for row in re.findall(r"<tr.*?</tr>", html, re.DOTALL) if re.search(rf'data-key="(\w+ )*{key}[" ]', row)]
    return cells_of(re.sub(r'<td class="key">.*?</td>', "", rows[table]))


def tables_of(html, head):
    """Rows of all tables whose first head is that, beside each other."""
    tables = [[cells_of(row) for row in re.findall(r"<tr.*?</tr>", table, re.DOTALL)]
              for table in re.findall(r"<table.*?</table>", html, re.DOTALL)]
    return [[rows[0][0], *(cell for row in rows for cell in row[1:])] for rows in zip(*(rows for rows in tables if rows[0][0] == head))]


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

    def changed(self, of, name, **values):
        """A copy of a run, of whose YAML file some keys have other values."""
        folder = self.copy(of)
        write(os.path.join(folder, name), yaml.safe_dump({**yaml.safe_load(read(folder, name)), **values}, sort_keys=False))
        return folder
