"""Cost of a step and memory against nodes at a fixed density of contacts."""
import csv
import math
import os

import plots
from runs import divide
from table import REFERENCE, Report, Table, at_most

MATERIALS = []
KNOTS = [1, 2, 4, 8, 16]       # overhands in a row in one rod
NODES_A_KNOT = 250
EDGE = 0.0032                  # [m] about one radius of the shipped material
STEP = 0.02                    # [s] short enough for all rows to take the same steps
SPEED = 1.6e-3                 # [m/s] a knot
RESIDUAL = 1e-6                # [k_b/h^2] so small that every step has something to solve
PULL = 10.0                    # [s]
ROUNDS = 5
ROOM = 1.05                    # the shape is drawn larger, so that resampling leaves no strands closer than touching
GROWTH = at_most(1.1 * KNOTS[-1])  # of cost and memory from one knot to the most: nodes x 1.1

KNOT = {"specimen.length": NODES_A_KNOT * EDGE, "specimen.end_to_end": NODES_A_KNOT * EDGE - 0.3,
        "machine.grips": "nodes", "program.pull.until": {"extension": 0.2}}


def report(runner, _):
    tied = runner.run("one_knot", KNOT, "config/overhand.yaml")
    files = [os.path.join(runner.folder, f"{knots}_knots.csv") for knots in KNOTS]
    for knots, file in zip(KNOTS, files):
        row_of_knots(tied.shape, knots, file)
    curves = {}
    return Report("Growth with nodes",
                  "An overhand is tightened, its shape put end to end with itself up to 16 times, and the whole row "
                  "pulled in steps of equal length at a speed that grows with the number of knots: contacts a node, "
                  "and what happens to each knot, are the same at every length. The steps alone, to a residual that "
                  "leaves every step something to solve and to that of a test, timed inside a "
                  f"process, the least of {ROUNDS} runs.", [steps(runner, files, curves, RESIDUAL), steps(runner, files, curves)],
                  lambda file: plots.panels(file, {"growth": curves}, "nodes", "over that of one knot"))


def steps(runner, files, curves, residual=None):
    """`residual`: none for that of a test."""
    own = ["--residual", residual] if residual else []
    words = f", residual {residual:g}" if residual else ""
    each = [min((runner.bench_tool("row_of_knots_bench",
                                   [os.path.relpath(file, runner.root), "--edge", ROOM * EDGE, "--step", STEP,
                                    "--speed", knots * SPEED, "--duration", PULL, *own]) for _ in range(ROUNDS)),
                key=lambda found: found.get("cpu_time", math.inf)) for knots, file in zip(KNOTS, files)]
    table = Table(f"Steps: overhands in a row{words}", [f"{knots}" for knots in KNOTS])
    for quantity, key in (("nodes", "nodes"), ("points of contact that touch", "touching"), ("time steps", "steps")):
        table.add(quantity, "-", [found.get(key) for found in each])
    table.add("Newton iterations a step", "-",
              [divide(found.get("newton_iterations"), found.get("steps")) for found in each], None, ".2f")
    nodes = [found.get("nodes") for found in each]
    for quantity, unit, values, gate in (
            ("CPU time a step", "ms", [divide(found.get("cpu_time"), 1e-3 * found.get("steps", 0)) for found in each], GROWTH),
            ("CPU time an iteration", "ms",
             [divide(found.get("cpu_time"), 1e-3 * found.get("newton_iterations", 0)) for found in each], None),
            ("peak memory", "MB", [divide(found.get("peak_memory"), 1e6) for found in each], GROWTH)):
        growth = [divide(value, values[0]) for value in values]
        table.add(quantity, unit, values, None, ".3g")
        table.add(f"{quantity} over that of one knot", "-", [REFERENCE] + growth[1:], [None] * (len(KNOTS) - 1) + [gate], ".3g")
        if None not in growth + nodes:
            curves[quantity + words] = (nodes, growth)
    return table


def row_of_knots(shape, knots, file):
    """The shape put end to end with itself along z."""
    height = shape["z"][-1] - shape["z"][0]
    with open(file, "w", encoding="utf-8", newline="") as out:
        writer = csv.writer(out)
        writer.writerow(["x", "y", "z"])
        for knot in range(knots):
            for x, y, z in list(zip(shape["x"], shape["y"], shape["z"]))[1 if knot else 0:]:
                writer.writerow([repr(ROOM * value) for value in (x, y, z + knot * height)])
