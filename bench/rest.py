"""A hold while a knot slides: friction with memory keeps the force, smoothed friction creeps."""
import os

import plots
import yaml
from table import Report, Table, at_most, is_

MATERIALS = ["polypropylene"]
DURATION = 60.0                # [s]
AFTER = [1.0, 10.0, DURATION]  # [s] into the hold
CHANGE_GATE = at_most(0.001)
LOOP, OVERHAND = "config/tighten.yaml", "config/overhand.yaml"
EXTENSION = {LOOP: 0.03, OVERHAND: 0.05}  # [m] where the hold begins, the knots still sliding
LAWS = ["memory", "smoothed"]


def report(runner, materials):
    """The loop of each material. Smoothed friction may creep faster than its tying calls rest, so that it never counts
    as tied: the overhand between clamps, which needs no tying, shows the creep in any case."""
    tables, curves = [], {}
    for material in materials:
        tables.append(table_of(runner, LOOP, material, {"material": material}, curves))
    tables.append(table_of(runner, OVERHAND, "overhand", {}, curves))
    return Report("Rest", "Pulled into the sliding phase and held. Changes are in the true force on the lower grip, "
                  "which no balance has shifted. Where the crosshead stops, drag and inertia leave the force at once; "
                  "what changes from 1 s on is creep.", tables,
                  lambda file: plots.curves_together(file, curves, "time into the hold [s]",
                                                     "force / force before the hold"))


def table_of(runner, method, name, settings, curves):
    settings = {**settings, "program": held_program(runner.root, method)}
    each = [runner.run(f"{name}/{law}", {**settings, "physics.friction.law": law}, method) for law in LAWS]
    holds = [Hold(run) for run in each]

    def memory_only(gate):
        return [gate if law == "memory" else None for law in LAWS]

    table = Table(f"{name}, {DURATION:g} s of hold at s = {EXTENSION[method]:g} m", LAWS)
    table.add("exit code", "-", [run.exit_code for run in each], memory_only(is_(0)))
    table.add("reason", "-", [run.value("reason") or "as programmed" for run in each])
    table.add("force before the hold", "N", [hold.before for hold in holds])
    for seconds in AFTER:
        table.add(f"relative change after {seconds:g} s", "-", [hold.change(None, seconds) for hold in holds],
                  memory_only(CHANGE_GATE if method == LOOP and seconds == DURATION else None), ".2g")
    table.add(f"relative change from {AFTER[0]:g} s to {DURATION:g} s", "-",
              [hold.change(AFTER[0], DURATION) for hold in holds], memory_only(CHANGE_GATE), ".2g")
    table.add("change of the knot distance", "m", [hold.knot_motion() for hold in holds], None, ".2g")
    for law, hold in zip(LAWS, holds):
        if hold.before:
            curves[f"{name}, {law}"] = (hold.times, [force / hold.before for force in hold.forces])
    return table


def held_program(root, method):
    """The shipped program with its pull cut short and a hold behind it."""
    with open(os.path.join(root, method), encoding="utf-8") as text:
        program = yaml.safe_load(text)["program"]
    for step in program:
        if "pull" in step:
            step["pull"]["until"] = {"extension": EXTENSION[method]}
    return program + [{"hold": {"duration": DURATION}}]


class Hold:
    """The hold's part of a run."""

    def __init__(self, run):
        pull, hold = run.phase("pull"), run.phase("hold")
        held = bool(pull.get("lower_force")) and bool(hold.get("lower_force"))
        self.before = pull["lower_force"][-1] if held else None
        self.distance_before = pull["knot_distance"][-1] if held else None
        self.times = [time - pull["time"][-1] for time in hold["time"]] if held else []
        self.forces = hold["lower_force"] if held else []
        self.distances = hold["knot_distance"] if held else []

    def force_at(self, seconds):
        """Force at the last step within the first `seconds`; None where the hold is shorter."""
        if not self.times or self.times[-1] < seconds - 1e-6:
            return None
        return self.forces[max((i for i, time in enumerate(self.times) if time <= seconds + 1e-6), default=0)]

    def change(self, since, until):
        """|F(until) - F(since)| over the force before the hold; `since` None: against that force itself."""
        first = self.before if since is None else self.force_at(since)
        last = self.force_at(until)
        return None if first is None or last is None or not self.before else abs((last - first) / self.before)

    def knot_motion(self):
        return self.distances[-1] - self.distance_before if self.distances else None
