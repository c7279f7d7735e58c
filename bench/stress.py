"""The stability matrix: what became of tests drawn at random over everything that a method may say."""
import math
import os
import shutil
import signal
import sys

import numpy as np
from draws import METHODS, PAPER_RADIUS, PAPER_SPEED, Draw
from runs import known, median
from table import Report, Table, at_most

CPU_LIMIT = 300         # [s] of CPU time; more is a hang
DEEP = {"round": 0.5, "soft": 1.2}  # [h] overlap that counts as tunnelling
SHELL_SIGNAL = 128      # a shell's exit code for a command that a signal ended, less the signal

# Worst first: a run is what comes first of these.
STATUS = {
    "crash": "ended by a signal, or without an exit code that it may have",
    "hang": f"still running after {CPU_LIMIT} s of CPU time",
    "nan": "a result or a curve has a number that is none",
    "tunnelled": f"the rod ran through itself, or strands overlap by more than {DEEP['round']} h (soft ones {DEEP['soft']} h)",
    "mute": "exit 1 without a result, or refused by anything but one line",
    "solver": "the physics gave up; what was measured is written with the reason",
    "refused": "the input cannot be tested; one line says why",
    "not at rest": "ran to an end, but tying or release did not come to rest in time, which the result says",
    "ended": "the test ran to an end that the method allows",
}
NEVER = ["crash", "hang", "nan", "tunnelled", "mute"]
GAVE_UP = "solver"
GAVE_UP_SHARE = 0.01  # of the runs that the solver may give up, each with its reason


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
    if crossed or (run.value("max_penetration") or 0.0) > DEEP[run.method.get("material", {}).get("section", "round")]:
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


class Matrix:
    """The table that a report (table.py) is made of: in the CSV one row a run, in the text how many of them held."""

    def __init__(self, outcomes):
        self.outcomes = outcomes
        self.drawn = list(dict.fromkeys(key for outcome in outcomes for key in outcome.draw.values))
        self.CSV_HEADER = ["run"] + self.drawn + Outcome.FACTS + Outcome.READINGS
        self.tables = [self.statuses(), self.readings()]

    def csv_rows(self):
        for outcome in self.outcomes:
            values = [outcome.get(key) for key in self.CSV_HEADER[1:]]
            yield [outcome.draw.number] + ["" if value is None else value for value in values]

    def failed(self):
        return [line for table in self.tables for line in table.failed()]

    def markdown(self):
        meaning = "\n".join(f"- **{status}**: {words}" for status, words in STATUS.items())
        return "\n".join([table.markdown() for table in self.tables] + [meaning + "\n", self.diagnoses()])

    def with_status(self, *statuses):
        return [outcome for outcome in self.outcomes if outcome.status in statuses]

    def statuses(self):
        knots = sorted({outcome.get("knot") for outcome in self.outcomes})
        table = Table("What became of the runs", ["all"] + knots)

        def add(name, outcomes, gate):
            counts = [len(outcomes)] + [sum(o.get("knot") == knot for o in outcomes) for knot in knots]
            table.add(name, "runs", counts, [gate] + [None] * len(knots))

        add("all", self.outcomes, None)
        for status in STATUS:
            gate = at_most(0) if status in NEVER else None
            if status == GAVE_UP:
                gate = at_most(math.floor(GAVE_UP_SHARE * len(self.outcomes)))
            add(status, self.with_status(status), gate)
        measured = [outcome for outcome in self.outcomes if outcome.get("knot_type_preserved") is not None]
        add("knot kept", [outcome for outcome in measured if outcome.get("knot_type_preserved")], None)
        add("knot came undone", [outcome for outcome in measured if not outcome.get("knot_type_preserved")], None)
        return table

    def readings(self):
        table = Table("Of those that ended", ["median", "90 %", "largest"])
        ended = self.with_status("ended", "not at rest")
        for name, unit, values in [("penetration", "h", [o.get("max_penetration") for o in ended]),
                                   ("energy balance error", "-", [o.get("energy_balance_error") for o in ended]),
                                   ("Newton iterations a step", "-", [o.work() for o in ended]),
                                   ("rejected steps", "-", [o.get("rejected_steps") for o in ended]),
                                   ("CPU time", "s", [o.cpu_time for o in ended])]:
            table.add(name, unit, quantiles(known(values)), digits=".3g")
        return table

    def diagnoses(self):
        lines = ["## Each run that did not end or was refused", ""]
        for status in STATUS:
            if status != "ended":
                lines += [f"- {status}: {o.draw.number}, {o.get('knot')}, {o.phase or 'not begun'}: {o.reason}"
                          for o in self.with_status(status)]
        return "\n".join(lines if len(lines) > 2 else lines + ["None."]) + "\n"


def quantiles(values):
    if not values:
        return [None] * 3
    ordered = sorted(values)
    return [median(ordered), ordered[math.ceil(0.9 * len(ordered)) - 1], ordered[-1]]


def report(runner, seed, numbers, jobs, quick=False, keep=False):
    matrix = Matrix(run_all(runner, [Draw(seed, number, quick) for number in numbers], jobs, keep))
    introduction = (
        f"{len(matrix.outcomes)} tests drawn by seed {seed} over radius (0.3 to 6 mm), k_b (1e-7 to 1e-3 N m²), "
        "k_s h²/k_b (4 to 3e4), friction (0 to 1.5), density (500 to 2000 kg/m³), pre-load (0.2 to 8 k_b/h²), edges (0.5 "
        "to 2 h), speed (x0.1 to x30), and all knots, grips, laws, accuracies and ways with twist. Every length is drawn "
        f"in radii; speed x1 is the source paper's {1e3 * PAPER_SPEED:g} mm/s for h = {1e3 * PAPER_RADIUS:g} mm, "
        f"{PAPER_SPEED / PAPER_RADIUS:.3g} h/s. Each pulls its specimen by some 10 h, overhands by as much as they hide, "
        "and ends at a load of 500 k_b/h² at the latest. `scripts/stress --only RUN` repeats one.")
    return Report("Stability", introduction, [matrix])
