"""The sliding force of a loop is a distribution, as on a real machine: specimens that differ as tied ones do, and
whether their mean holds still under mesh, step and tolerances."""
import random

import plots
from runs import deviation, divide, known, mean, median, standard_error
from table import REFERENCE, Gate, Report, Table, at_most
from tighten import KNOT_DISTANCE, MATERIALS, SLIDES

OTHER_PRELOADS = {"nylon": [130.0, 260.0]}              # beside the material's own [N]
SEED, COUNT = 19, 12
TAIL, TYING_SPEED = 0.03, 0.01                          # as shipped [m, m/s]
SCATTER = {"specimen.knot_distance": (KNOT_DISTANCE, 0.01), "specimen.tail": (TAIL, 0.05),
           "program.tie.speed": (TYING_SPEED, 0.1)}     # mean, standard deviation over mean
EDGE, STEP = 0.0032, 0.17                               # as shipped, and of `normal` [m, s]

NORMAL = "normal"
LARGEST_CHANGE = 0.02
RIPPLE = at_most(0.1)                                   # of a rope's plateau, at the median of the specimens
READINGS = {True: {"true_plateau_force": ("plateau force", "N"), "lock_extension": ("lock extension", "m"),
                   "locked_stiffness": ("locked stiffness", "N/m")},
            False: {"true_peak_force": ("peak force", "N"), "locked_stiffness": ("locked stiffness", "N/m")}}


def specimens(count):
    """Settings of each. The first ones are the same however many there are."""
    draw = random.Random(SEED)
    return [{key: round(draw.gauss(mean, share * mean), 9) for key, (mean, share) in SCATTER.items()}
            for _ in range(count)]


def gated_variants(material):
    """In a knot that slides, edges have half the length that is set, of loops that stretch the whole."""
    contact_tolerance, presliding = (0.02, 5e-3) if SLIDES.get(material, True) else (0.08, 1e-2)  # of `normal` [h]
    return {"edges x1/2": {"specimen.edge_length": EDGE / 2},
            "contact tolerance x1/4": {"physics.contact.tolerance": contact_tolerance / 4},
            "presliding x1/2": {"physics.friction.presliding": presliding / 2},
            "longest step x1/2": {"physics.max_step": STEP / 2}}


def meshes(material):
    """Of the distributions."""
    edges = {"edges h/3": {"specimen.refinement": 3}, "edges h/5": {"specimen.refinement": 5}}
    return edges if SLIDES.get(material, True) else {}


def cases_of(materials):
    """Name -> material and settings."""
    out = {}
    for material in materials:
        out[material] = material, {"material": material}
        for preload in OTHER_PRELOADS.get(material, []):
            out[f"{material}, {preload:g} N"] = material, {"material": material, "specimen.preload": preload}
    return out


def report(runner, materials, seeds=COUNT):
    tables, pictures = tables_of(runner, cases_of(materials), seeds)
    return Report("Specimens: how the readings scatter, and whether their mean holds still",
                  f"`config/tighten.yaml` with {seeds} specimens of each variant, whose knot distance (1 %), tails (5 %) "
                  f"and tying speed (10 %) are drawn, in brackets the standard deviation, with seed {SEED}. The change "
                  "of the mean is that of the same specimens, and its standard error is that of the mean of their "
                  "differences. A gate holds where the change is at most 2 % beyond its standard error and every "
                  "specimen has its reading. The picture has every specimen, and the mean with its standard error. Edges h/3 and h/5: the "
                  "edges in the knots are the radius over 3 and 5 long, where `normal` has h/2.25, and for nylon, which is tied hard, h/3.",
                  tables, lambda file: plots.strips(file, pictures, "plateau or peak force [N]"))


def tables_of(runner, cases, seeds):
    tables, pictures = [], {}
    for name, (material, settings) in cases.items():
        gated = gated_variants(material)
        variants = {NORMAL: {}, **gated, **meshes(material)}
        folder = name.replace(", ", "_").replace(" ", "")
        done = runner.run_all([(f"{folder}/{variant.replace(' ', '_').replace('/', '_')}/{k}", {**settings, **specimen, **change})
                               for variant, change in variants.items() for k, specimen in enumerate(specimens(seeds))])
        each = {variant: done[i * seeds:(i + 1) * seeds] for i, variant in enumerate(variants)}
        keys = READINGS[SLIDES.get(material, True)]
        tables.append(table_of(name, each, keys, list(gated)))
        key = next(iter(keys))
        pictures[name] = {variant: known(run.reading(key) for run in some) for variant, some in each.items()
                          if variant not in gated}
    return tables, pictures


class Change:
    """Of the mean of those specimens that both have a reading of, and its standard error, over the reference's mean."""

    def __init__(self, values, reference):
        both = [(value, other) for value, other in zip(values, reference) if value is not None and other is not None]
        self.all = len(both) == len(values)
        self.relative = self.error = None
        if len(both) > 1:
            base = abs(mean([other for _, other in both]))
            differences = [value - other for value, other in both]
            self.relative = divide(mean(differences), base)
            self.error = divide(standard_error(differences), base)

    def gate(self):
        def holds(value):
            return self.all and abs(value) - self.error <= LARGEST_CHANGE
        return Gate(f"+/- {LARGEST_CHANGE:g} beyond its standard error, of every specimen", holds)


def table_of(name, each, keys, gated):
    """`each`: variant -> one run a specimen."""
    table = Table(name, list(each))
    for key, (words, unit) in keys.items():
        values = {variant: [run.reading(key) for run in some] for variant, some in each.items()}
        changes = {variant: Change(some, values[NORMAL]) for variant, some in values.items() if variant != NORMAL}
        table.add(f"specimens with a {words}", "-", [len(known(some)) for some in values.values()])
        table.add(f"mean {words}", unit, [mean(some) for some in values.values()])
        table.add("standard deviation", unit, [deviation(some) for some in values.values()], None, ".2g")
        table.add(f"relative change of the mean {words}", "-",
                  [REFERENCE] + [change.relative for change in changes.values()],
                  [None] + [change.gate() if variant in gated else None for variant, change in changes.items()], ".2g")
        table.add("its standard error, relative", "-", [REFERENCE] + [change.error for change in changes.values()],
                  None, ".2g")
        if key == "true_plateau_force":
            ripples = [median([divide(run.reading("plateau_force_sd"), run.reading(key)) for run in some]) for some in each.values()]
            table.add("ripple of the plateau, median", "-", ripples, RIPPLE if name == "polypropylene" else None, ".2g")
    table.add("mean CPU time of a run", "s", [mean([run.cpu_time for run in some]) for some in each.values()], None, ".2f")
    return table
