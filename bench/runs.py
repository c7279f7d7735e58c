"""Runs of tensile_test on one core: what they took, and what they left."""
import csv
import json
import math
import os
import shutil
import subprocess
import sys

import yaml


class Runner:
    """Starts tensile_test on one core, one run after the other."""

    def __init__(self, root, tool, core, folder, overrides):
        self.root, self.tool, self.core, self.folder, self.overrides = root, tool, core, folder, overrides

    def run(self, name, settings, method="config/tighten.yaml"):
        """`settings`: dotted key -> value, on top of which come those of the command line."""
        out = os.path.join(self.folder, name)
        shutil.rmtree(out, ignore_errors=True)
        os.makedirs(os.path.dirname(out), exist_ok=True)
        # JSON is YAML too.
        sets = [f"{key}={json.dumps(value)}" for key, value in settings.items()] + self.overrides
        # Relative to the root, so that no message names a folder of this machine.
        command = [os.path.abspath(self.tool), method, "--quiet", "--out", os.path.relpath(out, self.root)]
        for entry in sets:
            command += ["--set", entry]
        print(f"{name}: tensile_test {method} " + " ".join(f"--set {entry}" for entry in sets), file=sys.stderr,
              flush=True)
        process = subprocess.Popen(command, cwd=self.root, stderr=subprocess.PIPE, text=True,
                                   preexec_fn=lambda: os.sched_setaffinity(0, {self.core}))
        said = process.stderr.read()
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        run = Run(out, usage.ru_utime + usage.ru_stime, process.returncode, said.strip())
        print(f"{name}: exit {run.exit_code} after {run.cpu_time:.1f} s of CPU time" +
              (f": {run.said}" if run.said else ""), file=sys.stderr, flush=True)
        return run

    def command_line(self):
        """The command of this study, without folders of this machine."""
        script = "scripts/" + os.path.basename(sys.argv[0])
        return " ".join([script] + [os.path.basename(word) if os.path.isabs(word) else word
                                    for word in sys.argv[1:]])

    def commit(self):
        try:
            return subprocess.run(["git", "-C", self.root, "describe", "--always", "--dirty", "--abbrev=10"],
                                  check=True, capture_output=True, text=True).stdout.strip()
        except (OSError, subprocess.CalledProcessError):
            return "missing (no git here)"

    def machine(self):
        """CPU model, cores and how busy they were."""
        facts = {}
        try:
            listed = subprocess.run(["lscpu", "-J"], check=True, capture_output=True, text=True).stdout
            for field in json.loads(listed)["lscpu"]:
                facts[field["field"].rstrip(":")] = field["data"]
        except (OSError, ValueError, KeyError, subprocess.CalledProcessError):
            pass
        return (f"{facts.get('Model name', 'CPU model missing')}, {os.cpu_count()} cores, run on core {self.core}; "
                f"load average when written {os.getloadavg()[0]:.1f}")


class Run:
    """One finished run. Everything that it did not leave is None."""

    def __init__(self, folder, cpu_time, exit_code, said):
        self.folder, self.cpu_time, self.exit_code, self.said = folder, cpu_time, exit_code, said
        self.result = read_yaml(os.path.join(folder, "result.yaml"))
        self.method = read_yaml(os.path.join(folder, "method.yaml"))
        self.curve = read_curve(os.path.join(folder, "curve_full.csv"))

    def value(self, key):
        """A key of result.yaml."""
        return self.result.get(key)

    def ratio(self, key, other):
        """A number of result.yaml over another number."""
        return divide(self.value(key), other)

    def real_time_factor(self):
        """Simulated over CPU time."""
        return divide(self.value("simulated_time"), self.cpu_time)

    def phase(self, name):
        """Rows of curve_full.csv in a phase, as columns."""
        rows = [i for i, phase in enumerate(self.curve.get("phase", [])) if phase == name]
        return {key: [column[i] for i in rows] for key, column in self.curve.items()}

    def slope_of_knot_distance(self):
        """de/ds: what result.yaml says of knots that slide, else by least squares over the whole pull."""
        if self.value("motion_pattern") == "sliding":
            return self.value("plateau_slope")
        pull = self.phase("pull")
        return least_squares_slope([(s, e) for s, e in zip(pull.get("extension", []), pull.get("knot_distance", []))
                                    if math.isfinite(e)])


def divide(value, by):
    return None if value is None or by is None or by == 0 else value / by


def relative_change(value, reference):
    """|value - reference|/|reference|"""
    return None if value is None or not reference else abs(value - reference) / abs(reference)


def least_squares_slope(points):
    if len(points) < 3:
        return None
    mean_x = sum(x for x, _ in points) / len(points)
    mean_y = sum(y for _, y in points) / len(points)
    spread = sum((x - mean_x) ** 2 for x, _ in points)
    return divide(sum((x - mean_x) * (y - mean_y) for x, y in points), spread)


def read_yaml(file):
    try:
        with open(file, encoding="utf-8") as text:
            return yaml.safe_load(text) or {}
    except OSError:
        return {}


def read_curve(file):
    """Columns by name; the phase as text, all else as numbers."""
    try:
        with open(file, encoding="utf-8", newline="") as text:
            rows = list(csv.reader(text))
    except OSError:
        return {}
    if len(rows) < 2:
        return {}
    columns = zip(*rows[2:]) if len(rows) > 2 else [()] * len(rows[0])
    return {name: list(column) if name == "phase" else [float(cell) for cell in column]
            for name, column in zip(rows[0], columns)}
