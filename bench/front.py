"""What a reading costs against how wrong it is: the open overhand, the capstan and the loop."""
import math

import plots
import runs
from table import REFERENCE, Report, Table, at_most, is_

MATERIALS = ["polypropylene"]
OVERHAND, CAPSTAN, LOOP = "bench/open_overhand.yaml", "config/capstan.yaml", "config/tighten.yaml"
EQUAL_ERROR = 0.03                              # up to which the cheapest run is looked for
SWINGS = 12                                     # of the loose loop during the pull

FINE = {"physics.accuracy": "fine", "physics.residual": 1e-6}
FINE_RUN = {**FINE, "specimen.edge_length": 0.0016, "physics.max_step": 0.01}
FINER_RUN = {**FINE, "specimen.edge_length": 0.0008, "physics.max_step": 0.005}
LOOP_FINE = {"physics.accuracy": "fine", "specimen.edge_length": 0.0012, "physics.max_step": 0.025}
LOOP_FINER = {**LOOP_FINE, "specimen.edge_length": 0.0008, "physics.max_step": 0.0125}
# Without twist nothing can roll; and the closed form of the capstan has its friction on the centreline.
ON_CENTRELINES = {"physics.friction.at": "centreline", "material.bending_law": "elastic"}
VARIANTS = {
    "draft": {"physics.accuracy": "draft"},
    "normal": {},
    "fine": {"physics.accuracy": "fine"},
    "normal, edges x3/4": {"specimen.edge_length": 0.0024},
    "normal, edges x1/2": {"specimen.edge_length": 0.0016},
    "smoothed friction": {"physics.friction.law": "smoothed"},
}
OVERHAND_VARIANTS = {
    **VARIANTS,
    "fine, step of 10 ms": {"physics.accuracy": "fine", "physics.max_step": 0.01},
    "normal, twist off": {"physics.twist": "off", **ON_CENTRELINES},
    "draft, twist off": {"physics.accuracy": "draft", "physics.twist": "off", **ON_CENTRELINES},
}
LOOP_VARIANTS = {**VARIANTS, "normal, twist on": {"physics.twist": "on"}}

TAIL_LOAD = 4.28                                # [N]
CAPSTAN_VARIANTS = {name: settings for name, settings in VARIANTS.items() if "edges" not in name}
CAPSTAN_VARIANTS["normal, edges x1/2"] = {"specimen.edge_length": 0.0025}

# CPU seconds a simulated second, and error of the force, as they are on record: an independent measurement in which all programs ran on
# one core of one machine, each at several steps, and all errors are means over ten windows against one tight run. The peers are no
# packages. Both were built with -O3 -march=native and KLU, whose analysis was kept while the pattern stayed, with SymEngine's functions
# compiled ahead: DisMech at ea6b818, with a contact stiffness of 300 to 1000 N/m (the 1e5 of its example loses the knot) and held ends
# moved by position, and imc-der at 3f34f5c.
MACHINE = "AMD EPYC (Zen 5), 2 virtual cores, this program at bb5d3676"
OURS = "ours, normal, shape from a file"
PEERS = {
    OURS: (0.0198, 0.0048),
    "DisMech, step of 0.2 s, tolerance 1e-3": (0.0523, 0.0069),
    "DisMech, step of 0.1 s, tolerance 3e-3, 300 N/m": (0.0865, 0.0042),
    "DisMech, step of 0.05 s, 1000 N/m": (0.175, 0.0039),
    "imc-der, step of 0.2 s": (0.227, 0.0045),
    "imc-der, step of 0.1 s": (0.367, 0.0037),
    "imc-der, step of 0.05 s": (0.626, 0.0022),
}


def report(runner, materials):
    scenes = {}
    tables = [*overhand(runner, scenes), capstan(runner, scenes), *(loop(runner, material, scenes) for material in materials)]
    return Report("Run time against error",
                  "Cost is the CPU time of the whole process over the simulated time, the least of two runs. The overhand's error is the mean "
                  "of |F - F_fine|/F_fine over the twelfths of the pull, F the mean over one, F_fine that of a run of our own with half the "
                  "edges, a residual of a twentieth and steps of 10 ms, which solves for twist. A twelfth takes 5 s: in that time the loose "
                  "loop, which nothing damps, swings to and fro once. `bench/front.py` says who measured the other simulators, and how they "
                  "were built. The capstan's error is against the elastic capstan law, the loop's against a fine run, tying included.",
                  tables, lambda file: plots.work_precision(file, scenes))


def run_all(runner, folder, base, variants, method):
    """Name -> run: of two, whose readings are the same, the one of the least CPU time: what other work adds is no part of it."""
    return {name: min((runner.run(f"{folder}/{name.replace(', ', '_').replace(' ', '_').replace('/', '_')}", {**base, **settings}, method)
                       for _ in range(2)), key=lambda run: run.cpu_time) for name, settings in variants.items()}


def overhand(runner, scenes):
    finer = runner.run("overhand/finer", FINER_RUN, OVERHAND)
    all_runs = run_all(runner, "overhand", {}, {"fine run": FINE_RUN, **OVERHAND_VARIANTS}, OVERHAND)
    fine = all_runs["fine run"]
    errors = {name: difference(run, fine) for name, run in all_runs.items() if run is not fine}
    table = table_of("Open overhand, loose to tight", all_runs, errors)
    table.add("peak force", "N", [run.value("true_peak_force") for run in all_runs.values()])

    verdict = Table("Open overhand: at equal error", ["result"])
    verdict.add("fine run against one of half its edges and steps: change of force", "-",
                [difference(fine, finer)], at_most(EQUAL_ERROR / 3), ".2g")
    cheap = {name: run.cost() for name, run in all_runs.items() if "twist off" not in name
             and errors.get(name) is not None and run.exit_code == 0 and errors[name] <= EQUAL_ERROR}
    verdict.add(f"least cost of an error up to {EQUAL_ERROR:g}, solving for twist", "s/s",
                [min(cheap.values(), default=None)], None, ".3g")
    verdict.add("that is", "-", [min(cheap, key=cheap.get, default=None)])
    scenes["open overhand, against a fine run"] = {
        "points": points(all_runs, errors),
        "others": {f"{name} ({MACHINE})": (error, cost) for name, (cost, error) in PEERS.items()}}
    return [table, verdict, side_by_side()]


def difference(run, reference):
    return runs.mean_relative_difference(run.pulled(), reference.pulled(), SWINGS, 50)


def side_by_side():
    table = Table(f"Open overhand: side by side, all with twist; {MACHINE}", ["CPU time a simulated second [s/s]", "error", "over ours"])
    for name, (cost, error) in PEERS.items():
        table.add(name, "-", [cost, error, cost / PEERS[OURS][0]], None, ".3g")
    return table


def capstan(runner, scenes):
    all_runs = run_all(runner, "capstan", {"specimen.tail_load": TAIL_LOAD, **ON_CENTRELINES}, CAPSTAN_VARIANTS, CAPSTAN)
    laws = {name: elastic_capstan(run.method) for name, run in all_runs.items()}
    errors = {name: runs.relative_change(run.value("force_ratio"), laws[name]) for name, run in all_runs.items()}
    table = table_of("Capstan of nylon, one turn: load over that of the tail", all_runs, errors)
    table.add("force ratio", "-", [run.value("force_ratio") for run in all_runs.values()], None, ".5g")
    table.add("elastic capstan law", "-", list(laws.values()), None, ".5g")
    scenes["capstan, against its law"] = {"points": points(all_runs, errors)}
    return table


def elastic_capstan(method):
    """R8 of doc/references.md; None of a run that left no method."""
    if not method:
        return None
    rod, specimen, mu = method["material"], method["specimen"], method["machine"]["roller_friction"]
    rho = 0.5 * specimen["post_diameter"] + rod["radius"]
    load = specimen["tail_load"] * rho ** 2 / rod["bending_stiffness"]

    def angle(tension):
        return math.acos(1.0 - 0.5 / tension)

    ratio = math.exp(mu * specimen["wrap"])
    for _ in range(100):
        slack, tight = angle(load), angle(ratio * load)
        ratio = (math.cos(slack) + mu * math.sin(slack)) * math.exp(mu * (specimen["wrap"] - slack - tight)) \
            / (math.cos(tight) - mu * math.sin(tight))
    return ratio


def loop(runner, material, scenes):
    base = {"material": material}
    finer = runner.run(f"{material}/finer", {**base, **LOOP_FINER})
    all_runs = run_all(runner, material, base, {"fine run": LOOP_FINE, **LOOP_VARIANTS}, LOOP)
    plateaus = {name: run.value("true_plateau_force") for name, run in all_runs.items()}
    plateau = plateaus["fine run"]
    errors = {name: runs.relative_change(value, plateau) for name, value in plateaus.items() if name != "fine run"}
    table = table_of(f"Loop of {material}, tied and pulled: plateau force", all_runs, errors)
    table.add("plateau force", "N", list(plateaus.values()))
    table.add("change of the plateau in a run finer still", "-",
              [runs.relative_change(finer.value("true_plateau_force"), plateau)] + [None] * (len(all_runs) - 1), None, ".2g")
    scenes[f"loop of {material}, plateau against a fine run"] = {"points": points(all_runs, errors)}
    return table


def table_of(title, all_runs, errors):
    each = list(all_runs.values())
    table = Table(title, list(all_runs))
    table.add("exit code", "-", [run.exit_code for run in each],
              [is_(0) if "smoothed" not in name else None for name in all_runs])
    table.add("error", "-", [errors[name] if name in errors else REFERENCE for name in all_runs], None, ".2g")
    table.add("CPU time a simulated second", "s/s", [run.cost() for run in each], None, ".3g")
    table.add("time steps", "-", [run.value("steps") for run in each])
    table.add("Newton iterations", "-", [run.value("newton_iterations") for run in each])
    return table


def points(all_runs, errors):
    """Of the runs that went to their end."""
    return {name: (errors[name], run.cost()) for name, run in all_runs.items()
            if name in errors and run.exit_code == 0}
