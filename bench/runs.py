"""Runs of tensile_test, on one core or several at a time: what they took, and what they left."""
import concurrent.futures
import math
import os
import resource
import shlex
import shutil
import statistics
import subprocess
import sys

import numpy as np

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(ROOT, "python"))

from knot_utm.errors import WrongInput  # noqa: E402
from knot_utm.runs import read_table  # noqa: E402
from knot_utm.yaml_text import load, text_of  # noqa: E402

# A process counts the memory of the one it was forked from as its own: a shell is smaller than this.
SHELLS_CHILD = ["/bin/sh", "-c", '"$@"; exit $?', "sh"]
METHOD = "config/tighten.yaml"
JOBS = 2  # runs at a time where their CPU time is not what is judged


class Runner:
    """Starts tensile_test. `core`: None for any; `verbose`: says what it starts and what became of it."""

    def __init__(self, root, tool, core, folder, overrides, verbose=True):
        self.root, self.tool, self.core, self.folder, self.overrides = root, tool, core, folder, overrides
        self.verbose = verbose

    def run_all(self, todo, jobs=JOBS, cpu_limit=None, made_of=lambda place, run: run):
        """The runs of [(name, settings)] or [(name, settings, method)] in their order, some at a time on any core.
        `made_of`: what is kept of each, at its place among them."""
        runner = Runner(self.root, self.tool, None, self.folder, self.overrides, self.verbose)
        with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
            return list(pool.map(lambda place, one: made_of(place, runner.run(*one, cpu_limit=cpu_limit)),
                                 range(len(todo)), todo))

    def run(self, name, settings, method=METHOD, more=(), cpu_limit=None):
        """`settings`: dotted key -> value, on top of which come those of the command line; `more`: further words of it.
        `cpu_limit` [s]: more, and the run is ended by SIGXCPU, however busy the machine."""
        settings = [f"{key}={text_of(value)}" for key, value in settings.items()] + list(self.overrides)
        words = [word for setting in settings for word in ("--set", setting)] + list(more)
        out = os.path.join(self.folder, name)
        shutil.rmtree(out, ignore_errors=True)
        os.makedirs(os.path.dirname(out), exist_ok=True)
        # Relative to the root, so that no message names a folder of this machine.
        command = [os.path.abspath(self.tool), method, "--quiet", "--out", os.path.relpath(out, self.root), *words]
        self.say(f"{name}: {os.path.basename(self.tool)} {method} {shlex.join(words)}")
        environment = {**os.environ, "KNOT_UTM_NO_CACHE": "1"}  # takes up no tied specimen: each costs what it computes
        process = subprocess.Popen(SHELLS_CHILD + command, cwd=self.root, stderr=subprocess.PIPE, text=True, env=environment,
                                   preexec_fn=lambda: confine(self.core, cpu_limit))
        with process.stderr as stream:
            said = stream.read().replace(self.root + os.sep, "")
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        run = Run(out, usage.ru_utime + usage.ru_stime, process.returncode, said.strip())
        self.say(f"{name}: exit {run.exit_code} after {run.cpu_time:.1f} s of CPU time" +
                 (f": {run.said}" if run.said else ""))
        return run

    def say(self, line):
        if self.verbose:
            print(line, file=sys.stderr, flush=True)


def confine(core, cpu_limit):
    if core is not None:
        os.sched_setaffinity(0, {core})
    if cpu_limit is not None:
        resource.setrlimit(resource.RLIMIT_CPU, (cpu_limit, cpu_limit + 5))


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

    def reading(self, key):
        """The same of a run that went to its end; what another left is not a reading."""
        value = self.value(key) if self.exit_code == 0 else None
        return None if is_missing(value) else value

    def real_time_factor(self):
        """Simulated over CPU time."""
        return divide(self.value("simulated_time"), self.cpu_time)

    def cost(self):
        """CPU time a simulated second."""
        return divide(self.cpu_time, self.value("simulated_time"))

    def nodes(self):
        return len(self.shape["x"]) if self.shape else None

    def last_shape(self):
        """Columns of shapes.csv at the last of its times."""
        shapes = {name: np.array(column) for name, column in read_curve(os.path.join(self.folder, "shapes.csv")).items()}
        return {name: column[shapes["time"] == shapes["time"][-1]] for name, column in shapes.items()}

    def pulled(self, *keys):
        """Columns of the pull: extension and load, or those named."""
        rows = [i for i, phase in enumerate(self.curve.get("phase", [])) if phase == "pull"]
        return tuple([self.curve[key][i] for i in rows] if key in self.curve else [] for key in keys or ("extension", "load"))

    def slope_of_knot_distance(self):
        """de/ds: what result.yaml says of knots that slide, else by least squares over the whole pull."""
        if self.value("motion_pattern") == "sliding":
            return self.value("plateau_slope")
        points = [(s, e) for s, e in zip(*self.pulled("extension", "knot_distance")) if math.isfinite(e)]
        return float(np.polyfit(*zip(*points), 1)[0]) if len(points) > 2 else None


def is_missing(value):
    return value is None or (isinstance(value, float) and math.isnan(value))


def divide(value, by):
    return None if value is None or by is None or by == 0 else value / by


def known(values):
    return [value for value in values if value is not None]


def of_known(function, least=1):
    """The function of the values that are there; None of too few."""
    return lambda values: function(there) if len(there := known(values)) >= least else None


mean, median, deviation = of_known(statistics.fmean), of_known(statistics.median), of_known(statistics.stdev, 2)
standard_error = of_known(lambda there: statistics.stdev(there) / math.sqrt(len(there)), 2)


def relative_change(value, reference):
    """|value - reference|/|reference|"""
    return None if value is None or not reference else abs(value - reference) / abs(reference)


def mean_relative_difference(curve, reference, parts=200, averaged=1):
    """Mean of |y - y_ref|/|y_ref| over equal parts of x, as far as both curves go; y is the mean of so many places of a
    part. Curves: (x, y), x rising."""
    if not curve[0] or not reference[0]:
        return None
    low, high = max(curve[0][0], reference[0][0]), min(curve[0][-1], reference[0][-1])
    if low >= high:
        return None
    x = low + (np.arange(parts * averaged) + 0.5) * (high - low) / (parts * averaged)
    own, expected = (np.interp(x, *one).reshape(parts, averaged).mean(axis=1) for one in (curve, reference))
    return float(np.mean(np.abs(own - expected) / np.abs(expected)))


def read_yaml(file):
    """`file`: may be relative to the root of the package, as for read_curve."""
    try:
        return load(os.path.join(ROOT, file)) or {}
    except WrongInput:
        return {}


def read_curve(file):
    """Columns by name, as lists."""
    path = os.path.join(ROOT, file)
    return read_table(path).to_dict("list") if os.path.exists(path) else {}
