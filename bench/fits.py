"""Fits of curves whose parameters are known but hidden: how many of them lie within the intervals that scripts/fit gives."""
import math
import multiprocessing
import os
import random
import sys
import time

import plots
from table import Report, Table, at_least

MATERIALS = []
SEED, CASES = 29, 4  # of each kind
JOBS = 2             # records at a time
INSIDE = 0.9         # of the hidden values of a group: 18 of 20, 7 of 8
CLASS = 0.005        # of the cell: class 0.5

# Method, what is set, noise of the cell [N], and the hidden keys: from where the truth is drawn, and the range of the fit.
KINDS = {
    "straight rod": ("straight", {"program.pull.until.extension": 0.008}, 1.0,
                     {"material.stretching_stiffness": ((4e4, 7e4), None)}),
    "capstan": ("capstan", {}, 0.05, {"machine.roller_friction": ((0.15, 0.45), (0.05, 0.8))}),
    "overhand": ("overhand", {"physics.accuracy": "draft"}, 5e-5,
                 {"material.friction_coefficient": ((0.3, 0.8), (0.1, 1.5)),
                  "material.bending_stiffness": ((3e-6, 7e-6), None)}),
    "loop": ("tighten", {"physics.accuracy": "draft", "material": "polypropylene", "program.pull.until.extension": 0.05}, 0.03,
             {"material.friction_coefficient": ((0.58, 0.85), (0.5, 1.0))}),
    # Knots of a little less friction or pre-load open.
    "loop beside a jump": ("tighten", {"physics.accuracy": "draft"}, 0.5,
                           {"material.friction_coefficient": ((0.41, 0.44), (0.3, 0.6)),
                            "specimen.preload": ((155.0, 230.0), (50.0, 500.0))}),
}
GROUPS = {"All but those beside a jump": list(KINDS)[:-1], "Beside a jump": list(KINDS)[-1:]}


class Case:
    """One record, and what was found of its hidden keys."""

    def __init__(self, kind, number, draw):
        self.kind, self.title = kind, f"{kind} {number}"
        self.method, self.settings, noise, hidden = KINDS[kind]
        self.cell = {"machine.load_cell.accuracy": CLASS, "machine.load_cell.noise": noise}
        self.truth = {key: round(draw.uniform(*limits), 9) for key, (limits, _) in hidden.items()}
        self.free = [key if limits is None else f"{key}={limits[0]}:{limits[1]}" for key, (_, limits) in hidden.items()]
        # A specimen and a cell of its own.
        self.seeds = {"machine.load_cell.seed": 1000 + draw.randrange(1000), "specimens.seed": 1000 + draw.randrange(1000)}

    def measure(self, runner):
        """The first of two specimens: of one alone nothing scatters."""
        name = self.title.replace(" ", "_")
        runner.run(name, {**self.settings, **self.cell, **self.seeds, **self.truth}, f"config/{self.method}.yaml",
                   ["--specimens", "2"])
        return os.path.join(runner.folder, name, "specimen_001", "curve.csv")

    def fit(self, runner, fit):
        begun = time.process_time(), os.times()
        out = os.path.join(runner.folder, self.title.replace(" ", "_") + "_fit")
        self.fitted = fit(self.measure(runner), os.path.join(runner.root, "config", self.method + ".yaml"), self.free, out,
                          {**self.settings, **self.cell}, jobs=1, report=False)
        ended = os.times()
        self.cpu_time = time.process_time() - begun[0] + ended.children_user + ended.children_system \
            - begun[1].children_user - begun[1].children_system
        said = [f"{key} {truth:.5g}: {one.value:.5g} from {one.low} to {one.high}" for key, truth, one in self.rows()]
        print(f"{self.title}: {'; '.join(said)}; {self.cpu_time:.0f} s of CPU time", file=sys.stderr, flush=True)
        return self

    def rows(self):
        """(key, truth, what was found) of each hidden key."""
        return [(key, truth, self.fitted.found[key]) for key, truth in self.truth.items()]


def report(runner, _materials):
    os.environ["KNOT_UTM_TOOLS_DIR"] = os.path.dirname(os.path.abspath(runner.tool))
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    os.environ["KNOT_UTM_NO_CACHE"] = "1"  # what a fit takes is what it computes
    sys.path.insert(0, os.path.join(runner.root, "python"))
    from knot_utm import fit  # where the packages of scripts/sweep are installed
    draw = random.Random(SEED)
    cases = [Case(kind, number, draw) for kind in KINDS for number in range(1, CASES + 1)]
    with multiprocessing.Pool(JOBS) as pool:
        cases = pool.starmap(Case.fit, [(case, runner, fit) for case in cases], 1)
    return Report("Fits of curves with hidden parameters",
                  f"Curves of specimens whose values are drawn at random (seed {SEED}), read by a cell of class {100 * CLASS:g} "
                  "with noise, and what scripts/fit finds of them when it knows the method but for these values. The specimens are "
                  "others than those of the fit. An interval of 95 % should hold 19 of 20 values.",
                  [*summaries(cases), *tables(cases)], lambda file: plots.intervals(file, relative_to_the_truth(cases)))


def summaries(cases):
    for title, kinds in GROUPS.items():
        of_group = [case for case in cases if case.kind in kinds]
        inside = [is_inside(one, truth) for case in of_group for _, truth, one in case.rows()]
        table = Table(title, ["fits"])
        table.add("hidden values", "-", [len(inside)])
        table.add("of them within their interval", "-", [sum(inside)], at_least(math.floor(INSIDE * len(inside))))
        table.add("records that fit within the errors", "-", [sum(case.fitted.fits for case in of_group)])
        table.add("CPU time of all", "s", [sum(case.cpu_time for case in of_group)], None, ".0f")
        yield table


def tables(cases):
    for kind in KINDS:
        table = Table(kind.capitalize(), ["truth", "value", "low", "high", "half width, relative", "inside", "chi square",
                                          "CPU time [s]"])
        for case in cases:
            for key, truth, one in case.rows() if case.kind == kind else ():
                table.add(f"{case.title}: {key}", "-",
                          [truth, one.value, one.low, one.high,
                           0.5 * (one.high - one.low) / truth if one.identifiable else None, is_inside(one, truth),
                           f"{case.fitted.chi_square:.3g} of {case.fitted.degrees_of_freedom}", case.cpu_time])
        yield table


def is_inside(one, truth):
    """An interval that is open at one end does not count."""
    return one.identifiable and one.low <= truth <= one.high


def relative_to_the_truth(cases):
    """[(name, value, low, high)] of what was bounded, each over the truth."""
    return [(f"{case.title}: {key.rpartition('.')[2].replace('_', ' ')}", *(part / truth for part in (one.value, one.low, one.high)))
            for case in cases for key, truth, one in case.rows() if one.identifiable]
