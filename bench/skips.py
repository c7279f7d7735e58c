"""The same scene with and without what it does not need: what a skip saves, and what it changes."""
import plots
import runs
from table import REFERENCE, Report, Table, at_most, is_

MATERIALS = []
OVERHAND, STRAIGHT, LOOP = "bench/open_overhand.yaml", "config/straight.yaml", "config/tighten.yaml"
NODES = 500
TINY = 1e-12
# A shorter pull is enough for a cost: 20 s.
SHORT = {"program.pull.until": {"extension": 0.24}, "machine.grips": "nodes"}
NO_FRICTION = {"radius": 0.0016, "density": 1180, "stretching_stiffness": 1.4476, "bending_stiffness": 9.265e-7,
               "twisting_stiffness": 6.177e-7, "friction_coefficient": 0.0}
TIMES = 3

# What is skipped; the scene; the settings that let it be skipped, and those that do not.
PAIRS = {
    "twist, overhand held by nodes": (OVERHAND, {**SHORT, "physics.twist": "auto"}, {**SHORT, "physics.twist": "on"}),
    "twist, loop on rollers": (LOOP, {"material": "polypropylene"}, {"material": "polypropylene",
                                                                     "physics.twist": "on"}),
    "friction at mu = 0": (OVERHAND, {**SHORT, "material": NO_FRICTION},
                           {**SHORT, "material": {**NO_FRICTION, "friction_coefficient": TINY}}),
    "gravity": (OVERHAND, SHORT, {**SHORT, "physics.gravity": [0.0, 0.0, -TINY]}),
    "roller friction at mu = 0": (LOOP, {"material": "polypropylene"},
                                  {"material": "polypropylene", "machine.roller_friction": TINY}),
    # Steps as long as the period of 100 Hz on both sides: what is left is the reading itself.
    "load-cell readings, 5 Hz and 100 Hz": (OVERHAND,
                                            {**SHORT, "physics.max_step": 0.01, "machine.load_cell.sampling_rate": 5},
                                            {**SHORT, "physics.max_step": 0.01,
                                             "machine.load_cell.sampling_rate": 100}),
    "short steps for a load cell of 100 Hz": (STRAIGHT, {"machine.load_cell": {"sampling_rate": 3}},
                                              {"machine.load_cell": {"sampling_rate": 100}}),
}
MOST_FOR_ROLLING = 1.6  # of the CPU time of a test
ROLLING = {f"friction at the surface, {material}": (LOOP, {"material": material},
                                                    {"material": material, "material.friction_couple": TINY})
           for material in ("nylon", "polypropylene", "pink_vps")}
PAIRS.update(ROLLING)
ROD = [0.7, 1.4, 2.8]  # [m] of rod with one knot: all that is added is straight
KNOT = 0.3             # [m] of it in the knot


def report(runner, _):
    pairs = [Pair(runner, name, *scene) for name, scene in PAIRS.items()]
    table = Table("Whole tests with and without", [pair.name for pair in pairs])
    table.add("exit code, skipped", "-", [pair.skipped.exit_code for pair in pairs], is_(0))
    table.add("exit code, not skipped", "-", [pair.asked_for.exit_code for pair in pairs], is_(0))
    table.add("CPU time, skipped", "s", [pair.skipped.cpu_time for pair in pairs], None, ".3g")
    table.add("CPU time, not skipped", "s", [pair.asked_for.cpu_time for pair in pairs], None, ".3g")
    table.add("ratio", "-", [pair.ratio() for pair in pairs],
              [at_most(MOST_FOR_ROLLING) if pair.name in ROLLING else None for pair in pairs], ".2f")
    table.add("Newton iterations, skipped", "-", [pair.skipped.value("newton_iterations") for pair in pairs])
    table.add("Newton iterations, not skipped", "-", [pair.asked_for.value("newton_iterations") for pair in pairs])
    table.add("mean relative change of the load while pulled", "-", [pair.change() for pair in pairs], None, ".2g")
    table.add("change of the peak force", "-", [pair.peak_change() for pair in pairs], None, ".2g")
    return Report("What a scene does not need",
                  "Each column is one scene twice: as shipped, where the thing is skipped, and with a setting that "
                  f"asks for it although it does nothing ({TINY:g} of friction, of its couple or of gravity). CPU time is that of the "
                  f"whole process, the least of {TIMES} runs. \"exact\": bit-identical curves. The parts of a step "
                  "are timed inside a process. A headless run has no markers or messages to skip.",
                  [table, parts(runner), straight_strands(runner)],
                  lambda file: plots.bars(file, {pair.name: pair.ratio() for pair in pairs},
                                          "CPU time, not skipped over skipped"))


class Pair:
    """One scene without something, and with it asked for."""

    def __init__(self, runner, name, method, skipped, asked_for):
        self.name = name
        folder = name.replace(" ", "_").replace(",", "").replace("=", "")
        self.skipped = runner.run(folder + "/skipped", skipped, method, TIMES)
        self.asked_for = runner.run(folder + "/not_skipped", asked_for, method, TIMES)

    def ratio(self):
        return runs.divide(self.asked_for.cpu_time, self.skipped.cpu_time)

    def change(self):
        first, other = self.skipped.curve, self.asked_for.curve
        if not first.get("load") or not other.get("load"):
            return None
        if all(first[key] == other[key] for key in ("time", "extension", "load", "load_lower")):
            return "exact"
        return runs.mean_relative_difference(runs.pulled(self.asked_for), runs.pulled(self.skipped))

    def peak_change(self):
        return runs.relative_change(self.asked_for.value("true_peak_force"), self.skipped.value("true_peak_force"))


def parts(runner):
    """Of one step of a straight rod."""
    found = runner.bench_tool("step_parts_bench", ["--nodes", NODES])
    step, rolled = found.get("step"), found.get("step_with_roller")
    table = Table(f"One step of a straight rod of {NODES} nodes", ["result"])
    table.add("step", "ms", [step], None, ".3g")
    table.add("Newton iterations", "-", [found.get("iterations")])
    table.add("search for contacts that cannot be", "ms", [found.get("contact_search")], None, ".3g")
    table.add("its share of the step", "-", [runs.divide(found.get("contact_search"), step)], None, ".2g")
    table.add("contacts found", "-", [found.get("contacts")], is_(0))
    table.add("step with a roller far away", "ms", [rolled], None, ".3g")
    table.add("over that without", "-", [runs.divide(rolled, step)], None, ".3g")
    table.add("bit-identical with the roller", "-", [found.get("same_with_roller")], is_(True))
    table.add("readings of each step: energies, fastest node", "ms", [found.get("reading")], None, ".3g")
    table.add("their share of the step", "-", [runs.divide(found.get("reading"), step)], None, ".2g")
    return table


def straight_strands(runner):
    """The same knot in ever longer rods."""
    each = [runner.run(f"strands/{length:g}",
                       {"specimen.length": length, "specimen.end_to_end": length - KNOT, "physics.max_step": 0.02,
                        "machine.grips": "nodes", "program.pull.until": {"extension": 0.1}}, OVERHAND, TIMES)
            for length in ROD]
    table = Table(f"Straight strands: one overhand with {KNOT:g} m of rod in it", [f"{length:g} m" for length in ROD])
    table.add("exit code", "-", [run.exit_code for run in each], is_(0))
    table.add("nodes", "-", [run.nodes() for run in each])
    table.add("Newton iterations", "-", [run.value("newton_iterations") for run in each])
    cost = [runs.divide(1e3 * run.cpu_time, run.value("newton_iterations")) for run in each]
    table.add("CPU time an iteration", "ms", cost, None, ".3g")
    table.add("over the shortest rod's", "-", [REFERENCE] + [runs.divide(one, cost[0]) for one in cost[1:]], None,
              ".3g")
    table.add("nodes over the shortest rod's", "-",
              [REFERENCE] + [runs.divide(run.nodes(), each[0].nodes()) for run in each[1:]], None, ".3g")
    return table
