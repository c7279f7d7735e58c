"""Runs of tensile_test on one core: what they took, and what they left."""
import csv
import json
import math
import os
import resource
import shlex
import shutil
import subprocess
import sys

import numpy as np
import yaml

# A process counts the memory of the one it was forked from as its own: a shell is smaller than this.
SHELLS_CHILD = ["/bin/sh", "-c", '"$@"; exit $?', "sh"]


class Runner:
    """Starts tensile_test on one core, one run after the other. `core`: None for any; `verbose`: says what it starts
    and what became of it."""

    def __init__(self, root, tool, core, folder, overrides, verbose=True):
        self.root, self.tool, self.core, self.folder, self.overrides = root, tool, core, folder, overrides
        self.verbose = verbose

    def run(self, name, settings, method="config/tighten.yaml", times=1):
        """`settings`: dotted key -> value, on top of which come those of the command line. Of several `times`, whose
        readings are the same, the one of the least CPU time: what other work on the machine adds is no part of it."""
        runs = [self.start(name, settings, method, self.core).wait() for _ in range(times)]
        return min(runs, key=lambda run: run.cpu_time)

    def start(self, name, settings, method, core, cpu_limit=None):
        """`cpu_limit` [s]: more, and the run is ended by SIGXCPU, however busy the machine."""
        return self.launch(self.tool, name, method, words_of("--set", settings, self.overrides), core, cpu_limit,
                           ["--quiet"])

    def bench_run(self, tool, name, method, settings, others):
        """A small executable beside tensile_test that leaves what that leaves. `others`: option -> settings."""
        words = words_of("--set", settings, self.overrides)
        for option, more in others.items():
            words += words_of(option, more)
        return self.launch(self.beside(tool), name, method, words, self.core).wait()

    def beside(self, tool):
        path = os.path.join(os.path.dirname(os.path.abspath(self.tool)), tool)
        if not os.access(path, os.X_OK):
            sys.exit(f"scripts/bench: {tool} is not built; configure with -DKNOT_UTM_BENCH=ON")
        return path

    def launch(self, tool, name, method, words, core, cpu_limit=None, unsaid=()):
        """`unsaid`: arguments that a reader of the log has no need of."""
        out = os.path.join(self.folder, name)
        shutil.rmtree(out, ignore_errors=True)
        os.makedirs(os.path.dirname(out), exist_ok=True)
        # Relative to the root, so that no message names a folder of this machine.
        command = [os.path.abspath(tool), method, *unsaid, "--out", os.path.relpath(out, self.root), *words]
        if self.verbose:
            print(f"{name}: {os.path.basename(tool)} {method} {shlex.join(words)}", file=sys.stderr, flush=True)

        def confine():
            if core is not None:
                os.sched_setaffinity(0, {core})
            if cpu_limit is not None:
                resource.setrlimit(resource.RLIMIT_CPU, (cpu_limit, cpu_limit + 5))

        process = subprocess.Popen(SHELLS_CHILD + command, cwd=self.root, stderr=subprocess.PIPE, text=True,
                                   preexec_fn=confine)
        return Started(name, out, process, self.verbose, self.root)

    def bench_tool(self, tool, arguments):
        """What a small executable beside tensile_test prints as YAML."""
        command = [self.beside(tool)] + [str(word) for word in arguments]
        print(" ".join([tool] + command[1:]), file=sys.stderr, flush=True)
        done = subprocess.run(SHELLS_CHILD + command, cwd=self.root, stdout=subprocess.PIPE, text=True, check=False,
                              preexec_fn=lambda: os.sched_setaffinity(0, {self.core}))
        return (yaml.safe_load(done.stdout) or {}) if done.returncode == 0 else {}

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

    def where(self):
        return "run on any core" if self.core is None else f"run on core {self.core}"

    def machine(self):
        """CPU model, cores and how busy they were."""
        facts = {}
        try:
            listed = subprocess.run(["lscpu", "-J"], check=True, capture_output=True, text=True).stdout
            for field in json.loads(listed)["lscpu"]:
                facts[field["field"].rstrip(":")] = field["data"]
        except (OSError, ValueError, KeyError, subprocess.CalledProcessError):
            pass
        return (f"{facts.get('Model name', 'CPU model missing')}, {os.cpu_count()} cores, {self.where()}; "
                f"load average when written {os.getloadavg()[0]:.1f}")


def words_of(option, settings, more=()):
    """Of a command line, with the option before each; JSON is YAML too."""
    entries = [f"{key}={json.dumps(value)}" for key, value in settings.items()] + list(more)
    return [word for entry in entries for word in (option, entry)]


class Started:
    """A run under way."""

    def __init__(self, name, out, process, verbose, root):
        self.name, self.out, self.process, self.verbose, self.root = name, out, process, verbose, root

    def wait(self):
        with self.process.stderr as stream:
            said = stream.read().replace(self.root + os.sep, "")  # tables name no folder of this machine
        _, status, usage = os.wait4(self.process.pid, 0)
        self.process.returncode = os.waitstatus_to_exitcode(status)
        run = Run(self.out, usage.ru_utime + usage.ru_stime, self.process.returncode, said.strip())
        if self.verbose:
            print(f"{self.name}: exit {run.exit_code} after {run.cpu_time:.1f} s of CPU time" +
                  (f": {run.said}" if run.said else ""), file=sys.stderr, flush=True)
        return run


class Run:
    """One finished run. Everything that it did not leave is None."""

    def __init__(self, folder, cpu_time, exit_code, said):
        self.folder, self.cpu_time, self.exit_code, self.said = folder, cpu_time, exit_code, said
        self.result = read_yaml(os.path.join(folder, "result.yaml"))
        self.method = read_yaml(os.path.join(folder, "method.yaml"))
        self.curve = read_curve(os.path.join(folder, "curve_full.csv"))
        self.shape = read_curve(os.path.join(folder, "final_shape.csv"))

    def value(self, key):
        """A key of result.yaml."""
        return self.result.get(key)

    def ratio(self, key, other):
        """A number of result.yaml over another number."""
        return divide(self.value(key), other)

    def real_time_factor(self):
        """Simulated over CPU time."""
        return divide(self.value("simulated_time"), self.cpu_time)

    def cost(self):
        """CPU time a simulated second."""
        return divide(self.cpu_time, self.value("simulated_time"))

    def nodes(self):
        return len(self.shape["x"]) if self.shape else None

    def phase(self, name):
        """Rows of curve_full.csv in a phase, as columns, and with them the true force on the lower grip."""
        rows = [i for i, phase in enumerate(self.curve.get("phase", [])) if phase == name]
        columns = {key: [column[i] for i in rows] for key, column in self.curve.items()}
        if "load_lower" in columns:
            balanced = columns.get("balance_offset", [0.0] * len(rows))
            columns["lower_force"] = [load + offset for load, offset in zip(columns["load_lower"], balanced)]
        return columns

    def slope_of_knot_distance(self):
        """de/ds: what result.yaml says of knots that slide, else by least squares over the whole pull."""
        if self.value("motion_pattern") == "sliding":
            return self.value("plateau_slope")
        pull = self.phase("pull")
        return least_squares_slope([(s, e) for s, e in zip(pull.get("extension", []), pull.get("knot_distance", []))
                                    if math.isfinite(e)])


def divide(value, by):
    return None if value is None or by is None or by == 0 else value / by


def least(values):
    return min((value for value in values if value is not None), default=None)


def largest(values):
    return max((value for value in values if value is not None), default=None)


def relative_change(value, reference):
    """|value - reference|/|reference|"""
    return None if value is None or not reference else abs(value - reference) / abs(reference)


def pulled(run):
    """Extension and load while pulled."""
    pull = run.phase("pull")
    return pull.get("extension", []), pull.get("load", [])


def mean_relative_difference(curve, reference, points=200):
    """Mean of |y - y_ref|/|y_ref| over x, as far as both curves go. Curves: (x, y), x rising."""
    if not curve[0] or not reference[0]:
        return None
    low, high = max(curve[0][0], reference[0][0]), min(curve[0][-1], reference[0][-1])
    if low >= high:
        return None
    x = np.linspace(low, high, points)
    expected = np.interp(x, *reference)
    return float(np.mean(np.abs(np.interp(x, *curve) - expected) / np.abs(expected)))


def mean_relative_difference_of_parts(curve, reference, parts):
    """The same of the means of y over so many equal parts of x."""
    if not curve[0] or not reference[0]:
        return None
    low, high = max(curve[0][0], reference[0][0]), min(curve[0][-1], reference[0][-1])
    if low >= high:
        return None
    x = low + (np.arange(parts * 50) + 0.5) * (high - low) / (parts * 50)
    mean, expected = (np.interp(x, *one).reshape(parts, 50).mean(axis=1) for one in (curve, reference))
    return float(np.mean(np.abs(mean - expected) / np.abs(expected)))


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
