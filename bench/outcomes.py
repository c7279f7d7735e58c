"""Runs of drawn tests (draws.py), and what became of each."""
import math
import os
import shutil
import signal
import sys

import numpy as np
from draws import METHODS

CPU_LIMIT = 300         # [s] of CPU time; more is a hang
DEEP = 0.5              # [h] overlap that counts as tunnelling
SHELL_SIGNAL = 128      # a shell's exit code for a command that a signal ended, less the signal

# Worst first: a run is what comes first of these.
STATUS = {
    "crash": "ended by a signal, or without an exit code that it may have",
    "hang": f"still running after {CPU_LIMIT} s of CPU time",
    "nan": "a result or a curve has a number that is none",
    "tunnelled": f"the rod ran through itself, or strands overlap by more than {DEEP} h",
    "mute": "exit 1 without a result, or refused by anything but one line",
    "solver": "the physics gave up; what was measured is written with the reason",
    "refused": "the input cannot be tested; one line says why",
    "not at rest": "ran to an end, but tying or release did not come to rest in time, which the result says",
    "ended": "the test ran to an end that the method allows",
}
NEVER = ["crash", "hang", "nan", "tunnelled", "mute"]
GAVE_UP = "solver"


class Outcome:
    """A draw and what became of it."""

    READINGS = ["motion_pattern", "knot_type_preserved", "max_penetration", "energy_balance_error",
                "force_balance_error", "steps", "rejected_steps", "newton_iterations", "simulated_time"]
    FACTS = ["status", "reason", "phase", "nodes", "cpu_time"]

    def __init__(self, draw, run):
        self.draw = draw
        self.cpu_time = run.cpu_time
        self.readings = {key: run.value(key) for key in self.READINGS}
        self.nodes = run.nodes()
        self.phase = (run.curve.get("phase") or [None])[-1]
        self.status, self.reason = classify(run)

    def get(self, key):
        """A drawn value, a reading or a fact; None where it has none."""
        if key in self.FACTS:
            return getattr(self, key)
        return self.readings.get(key, self.draw.values.get(key))

    def work(self):
        """Newton iterations a step."""
        steps, iterations = self.get("steps"), self.get("newton_iterations")
        return iterations / steps if steps else None

    def line(self):
        return (f"{self.draw.number}: {self.draw.values['knot']}: {self.status} after {self.cpu_time:.1f} s of CPU "
                f"time: {self.reason}")


def classify(run):
    """Status, and the line that explains it."""
    said = run.said.splitlines()
    last = said[-1] if said else ""
    if run.exit_code == SHELL_SIGNAL + signal.SIGXCPU:
        return "hang", f"{run.cpu_time:.0f} s of CPU time"
    if run.exit_code not in (0, 1, 2):
        return "crash", f"exit code {run.exit_code}: {last}"
    if run.exit_code == 2:
        clear = len(said) == 1 and not run.result and not run.curve
        return ("refused" if clear else "mute"), last
    if not run.result or not run.curve:
        return "mute", last
    wrong = not_a_number(run)
    if wrong:
        return "nan", wrong
    crossed = [line for line in run.value("warnings") or [] if "ran through itself" in line]
    if crossed or (run.value("max_penetration") or 0.0) > DEEP:
        return "tunnelled", crossed[0] if crossed else f"strands overlap by {run.value('max_penetration')} h"
    if run.exit_code == 1 and run.value("ended_by") != "untangled":
        return "solver", run.value("reason") or ""
    return ("not at rest" if run.value("not_equilibrated") else "ended"), run.value("ended_by")


def not_a_number(run):
    """Which key or column has one; empty where none has. Without two knots there is no knot distance."""
    for key, value in run.result.items():
        for number in value if isinstance(value, list) else [value]:
            if isinstance(number, float) and not math.isfinite(number):
                return f"result.yaml: {key} is {number}"
    knots = run.method.get("specimen", {}).get("knot") == "fisherman"
    for column, values in list(run.curve.items()) + list(run.shape.items()):
        if column != "phase" and (knots or column != "knot_distance") and not all(map(math.isfinite, values)):
            return f"{column} has a number that is none"
    return ""


def run_all(runner, draws, jobs, keep=False):
    """Outcomes in the order of the draws. `keep`: what every run left stays, else only of those that did not end."""
    def made_of(place, run):
        outcome = Outcome(draws[place], run)
        print(outcome.line(), file=sys.stderr, flush=True)
        if not keep and outcome.status in ("ended", "not at rest", "refused"):
            shutil.rmtree(run.folder, ignore_errors=True)
        return outcome

    return runner.run_all([task_of(runner, draw) for draw in draws], jobs, CPU_LIMIT, made_of)


def task_of(runner, draw):
    """Name, settings and method of a draw's run."""
    name = f"{draw.seed}_{draw.number}" + ("_quick" if draw.quick else "")
    settings = dict(draw.settings)
    if draw.shape is not None:
        file = os.path.abspath(os.path.join(runner.folder, name + ".csv"))
        os.makedirs(os.path.dirname(file), exist_ok=True)
        np.savetxt(file, draw.shape, "%.9g", ",", header="x,y,z\nm,m,m", comments="")
        settings["specimen.file"] = file
    return name, settings, METHODS[draw.values["knot"]]
