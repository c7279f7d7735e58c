"""The sliding force of a loop is a distribution, as on a real machine: specimens that differ as tied ones do, and
whether their mean holds still under mesh, step and tolerances."""
import random
import statistics

import plots
from convergence import EDGE, STEP, present, reading
from table import REFERENCE, Gate, Report, Table
from tighten import SLIDES

MATERIALS = ["nylon", "polypropylene", "pink_vps", "green_vps"]
OTHER_PRELOADS = {"nylon": [130.0, 260.0]}              # beside the material's own [N]
COUPLES = {"polypropylene": [0.1], "pink_vps": [0.25], "green_vps": [0.25]}  # eta with which knots keep closed
SEED, COUNT = 19, 12
KNOT_DISTANCE, TAIL, TYING_SPEED = 0.15, 0.03, 0.01     # as shipped [m, m, m/s]
SCATTER = {"specimen.knot_distance": (KNOT_DISTANCE, 0.01), "specimen.tail": (TAIL, 0.05),
           "program.tie.speed": (TYING_SPEED, 0.1)}     # mean, standard deviation over mean

NORMAL, THIRDS, FIFTHS = "normal", "edges h/3", "edges h/5"
JOBS = 2
LARGEST_CHANGE = 0.02
READINGS = {True: {"true_plateau_force": ("plateau force", "N")},
            False: {"true_peak_force": ("peak force", "N"), "locked_stiffness": ("locked stiffness", "N/m")}}


def specimens(count):
    """Settings of each. The first ones are the same however many there are."""
    draw = random.Random(SEED)
    return [{key: round(draw.gauss(mean, share * mean), 9) for key, (mean, share) in SCATTER.items()}
            for _ in range(count)]


def variants_of(material):
    """In a knot that slides, edges have half the length that is set, of loops that stretch the whole. The gated ones
    come first, then the meshes of the distributions."""
    slides = SLIDES.get(material, True)
    contact_tolerance, presliding = (0.005, 2e-3) if slides else (0.08, 1e-2)  # of `normal` [h]
    gated = {
        "edges x1/2": {"specimen.edge_length": EDGE / 2},
        "contact tolerance x1/4": {"physics.contact.tolerance": contact_tolerance / 4},
        "presliding x1/2": {"physics.friction.presliding": presliding / 2},
        "longest step x1/2": {"physics.max_step": STEP / 2},
    }
    meshes = {THIRDS: {"specimen.refinement": 3}, FIFTHS: {"specimen.refinement": 5}} if slides else {}
    return gated, meshes


def cases_of(materials):
    """Name -> material and settings."""
    out = {}
    for material in materials:
        out[material] = material, {"material": material}
        for preload in OTHER_PRELOADS.get(material, []):
            out[f"{material}, {preload:g} N"] = material, {"material": material, "specimen.preload": preload}
        for couple in COUPLES.get(material, []):
            out[f"{material}, eta {couple:g}"] = material, {"material": material, "material.friction_couple": couple}
    return out


def report(runner, materials, seeds=COUNT):
    tables, pictures = [], {}
    for name, (material, settings) in cases_of(materials).items():
        gated, meshes = variants_of(material)
        runs = run_all(runner, name, settings, {NORMAL: {}, **gated, **meshes}, specimens(seeds))
        keys = READINGS[SLIDES.get(material, True)]
        tables.append(table_of(name, runs, keys, list(gated)))
        key = next(iter(keys))
        pictures[name] = {variant: present([reading(run, key) for run in runs[variant]])
                          for variant in [NORMAL, *meshes]}
    return Report("Specimens: how the readings scatter, and whether their mean holds still",
                  f"`config/tighten.yaml` with {seeds} specimens of each variant, whose knot distance (1 %), tails (5 %) "
                  f"and tying speed (10 %) are drawn, in brackets the standard deviation, with seed {SEED}. The change "
                  "of the mean is that of the same specimens, and its standard error is that of the mean of their "
                  "differences. A gate holds where the change is at most 2 % beyond its standard error and every "
                  "specimen has its reading. Edges h/3 and h/5: the edges in the knots are the radius over 3 and 5 "
                  "long, where `normal` has h/2.25, and for nylon, which is tied hard, h/3. eta is "
                  "`material.friction_couple`, friction at the surface. The picture has every "
                  "specimen, and the mean with its standard error.", tables,
                  lambda file: plots.strips(file, pictures, "plateau or peak force [N]"))


def run_all(runner, name, settings, variants, drawn):
    """Variant -> one run a specimen; JOBS at a time, on any core."""
    folder = name.replace(", ", "_").replace(" ", "")
    todo = [(variant, k, {**settings, **specimen, **change}) for variant, change in variants.items()
            for k, specimen in enumerate(drawn)]
    runs, under_way = {variant: [] for variant in variants}, []
    for variant, k, words in todo:
        if len(under_way) == JOBS:
            finish(runs, under_way)
        out = f"{folder}/{variant.replace(' ', '_').replace('/', '_')}/{k}"
        under_way.append((variant, runner.start(out, words, "config/tighten.yaml", None)))
    while under_way:
        finish(runs, under_way)
    return runs


def finish(runs, under_way):
    variant, started = under_way.pop(0)
    runs[variant].append(started.wait())


def standard_error(values):
    return statistics.stdev(values) / len(values) ** 0.5 if len(values) > 1 else None


def mean(values):
    return statistics.fmean(values) if values else None


class Change:
    """Of the mean of those specimens that both have a reading of, and its standard error, over the reference's mean."""

    def __init__(self, values, reference):
        both = [(value, other) for value, other in zip(values, reference) if value is not None and other is not None]
        self.all = len(both) == len(values)
        self.relative = self.error = None
        if len(both) > 1:
            base = abs(statistics.fmean(other for _, other in both))
            differences = [value - other for value, other in both]
            self.relative = statistics.fmean(differences) / base
            self.error = standard_error(differences) / base

    def gate(self):
        def holds(value):
            return self.all and abs(value) - self.error <= LARGEST_CHANGE
        return Gate(f"+/- {LARGEST_CHANGE:g} beyond its standard error, of every specimen", holds)


def table_of(name, runs, keys, gated):
    table = Table(name, list(runs))
    for key, (words, unit) in keys.items():
        values = {variant: [reading(run, key) for run in each] for variant, each in runs.items()}
        known = [present(each) for each in values.values()]
        changes = {variant: Change(each, values[NORMAL]) for variant, each in values.items() if variant != NORMAL}
        table.add(f"specimens with a {words}", "-", [len(each) for each in known])
        table.add(f"mean {words}", unit, [mean(each) for each in known])
        table.add("its standard error", unit, [standard_error(each) for each in known], None, ".2g")
        table.add("standard deviation", unit, [statistics.stdev(each) if len(each) > 1 else None for each in known],
                  None, ".2g")
        table.add("smallest, largest", unit,
                  [f"{min(each):.4g}, {max(each):.4g}" if each else None for each in known])
        table.add(f"relative change of the mean {words}", "-",
                  [REFERENCE] + [change.relative for change in changes.values()],
                  [None] + [change.gate() if variant in gated else None for variant, change in changes.items()], ".2g")
        table.add("its standard error, relative", "-", [REFERENCE] + [change.error for change in changes.values()],
                  None, ".2g")
    table.add("mean CPU time of a run", "s", [mean([run.cpu_time for run in each]) for each in runs.values()], None,
              ".2f")
    return table
