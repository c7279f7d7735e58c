"""Cost of a step and memory against nodes at a fixed density of contacts, and two tests on two cores."""
import csv
import math
import os
import time

import plots
import runs
from table import REFERENCE, Report, Table, at_most, is_

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
GROWTH = 1.1 * KNOTS[-1]       # of cost and memory from one knot to the most: nodes x 1.1

SINGLE, FILE, LOOP = "config/overhand.yaml", "config/from_file.yaml", "config/tighten.yaml"
KNOT = {"specimen.length": NODES_A_KNOT * EDGE, "specimen.end_to_end": NODES_A_KNOT * EDGE - 0.3,
        "machine.grips": "nodes"}


def report(runner, _):
    files = rows_of_knots(runner)
    curves = {}
    tables = [steps(runner, files, curves, RESIDUAL), steps(runner, files, curves), tests(runner, files, curves), at_once(runner)]
    return Report("Growth with nodes, and two tests at once",
                  "An overhand is tightened, its shape put end to end with itself up to 16 times, and the whole row "
                  "pulled in steps of equal length at a speed that grows with the number of knots: contacts a node, "
                  "and what happens to each knot, are the same at every length. First the steps alone, to a residual that "
                  "leaves every step something to solve and to that of a test, timed inside a "
                  f"process, the least of {ROUNDS} runs; then whole tests, which also watch the type of the knot, a "
                  "polynomial whose cost grows faster than the nodes. Wall times of two tests at once say something "
                  "only where the machine has two cores to spare: see the load average.", tables,
                  lambda file: plots.curves_together(file, curves, "nodes", "over that of one knot", log=True))


def rows_of_knots(runner):
    tied = runner.run("one_knot", {**KNOT, "program.pull.until": {"extension": 0.2}}, SINGLE)
    files = [os.path.join(runner.folder, f"{knots}_knots.csv") for knots in KNOTS]
    for knots, file in zip(KNOTS, files):
        row_of_knots(tied.shape, knots, file)
    return files


def steps(runner, files, curves, residual=None):
    """The physics alone; `residual`: none for that of a test."""
    own = ["--residual", residual] if residual else []
    words = f", residual {residual:g}" if residual else ""
    each = [min((runner.bench_tool("row_of_knots_bench",
                                   [os.path.relpath(file, runner.root), "--edge", ROOM * EDGE, "--step", STEP,
                                    "--speed", knots * SPEED, "--duration", PULL, *own]) for _ in range(ROUNDS)),
                key=lambda found: found.get("cpu_time", math.inf)) for knots, file in zip(KNOTS, files)]

    def per(key):
        return [runs.divide(found.get("cpu_time"), found.get(key)) for found in each]

    cost, memory = per("steps"), [found.get("peak_memory") for found in each]
    nodes = [found.get("nodes") for found in each]
    table = Table(f"Steps: overhands in a row{words}", [f"{knots}" for knots in KNOTS])
    table.add("nodes", "-", nodes)
    table.add("points of contact that touch", "-", [found.get("touching") for found in each])
    table.add("time steps", "-", [found.get("steps") for found in each])
    table.add("Newton iterations a step", "-",
              [runs.divide(found.get("newton_iterations"), found.get("steps")) for found in each], None, ".2f")
    table.add("CPU time a step", "ms", [one and 1e3 * one for one in cost], None, ".3g")
    table.add("CPU time an iteration", "ms", [one and 1e3 * one for one in per("newton_iterations")], None, ".3g")
    table.add("peak memory", "MB", [one and 1e-6 * one for one in memory], None, ".3g")
    over_one(table, curves, f"nodes{words}", nodes, nodes)
    over_one(table, curves, f"CPU time a step{words}", cost, nodes, at_most(GROWTH))
    over_one(table, curves, f"CPU time an iteration{words}", per("newton_iterations"), nodes)
    over_one(table, curves, f"peak memory{words}", memory, nodes, at_most(GROWTH))
    return table


def tests(runner, files, curves):
    """With everything that a test does besides."""
    each = []
    for knots, file in zip(KNOTS, files):
        settings = {"specimen.file": os.path.relpath(file, os.path.join(runner.root, os.path.dirname(FILE))),
                    "specimen.edge_length": ROOM * EDGE, "machine.grips": "nodes", "physics.max_step": STEP,
                    "machine.load_cell": {"sampling_rate": 1}, "physics.residual": RESIDUAL,
                    "program": program(knots * SPEED)}
        each.append(runner.run(f"{knots}_knots", settings, FILE))
    table = Table("Whole tests: overhands in a row", [f"{knots}" for knots in KNOTS])
    table.add("exit code", "-", [run.exit_code for run in each], is_(0))
    table.add("knot type kept", "-", [run.value("knot_type_preserved") for run in each], is_(True))
    table.add("time steps", "-", [run.value("steps") for run in each])
    table.add("Newton iterations", "-", [run.value("newton_iterations") for run in each])
    cost = [runs.divide(run.cpu_time, run.value("steps")) for run in each]
    table.add("CPU time a step", "ms", [one and 1e3 * one for one in cost], None, ".3g")
    table.add("peak memory", "MB", [run.ratio("peak_memory", 1e6) for run in each], None, ".3g")
    nodes = [run.nodes() for run in each]
    over_one(table, curves, "CPU time a step, whole test", cost, nodes)
    over_one(table, curves, "peak memory, whole test", [run.value("peak_memory") for run in each], nodes)
    return table


def over_one(table, curves, words, values, nodes, gate=None):
    ratios = [runs.divide(value, values[0]) for value in values]
    table.add(f"{words} over that of one knot", "-", [REFERENCE] + ratios[1:], [None] * (len(values) - 1) + [gate],
              ".3g")
    if None not in ratios and None not in nodes:
        curves[words] = (nodes, ratios)


def program(speed):
    return [{"balance": {}}, {"hold": {"duration": 2.0}}, {"pull": {"speed": speed, "until": {"time": PULL}}}]


def row_of_knots(shape, knots, file):
    """The shape put end to end with itself along z."""
    height = shape["z"][-1] - shape["z"][0]
    with open(file, "w", encoding="utf-8", newline="") as out:
        writer = csv.writer(out)
        writer.writerow(["x", "y", "z"])
        for knot in range(knots):
            for x, y, z in list(zip(shape["x"], shape["y"], shape["z"]))[1 if knot else 0:]:
                writer.writerow([repr(ROOM * value) for value in (x, y, z + knot * height)])


def at_once(runner):
    """The shipped test twice: one after the other on one core, and at once on two."""
    cores = sorted(os.sched_getaffinity(0))[-2:]
    began = time.monotonic()
    after_another = [runner.run(f"after_another_{i}", {"material": "polypropylene"}, LOOP) for i in range(2)]
    in_turn = time.monotonic() - began
    began = time.monotonic()
    started = [runner.start(f"at_once_{core}", {"material": "polypropylene"}, LOOP, core) for core in cores]
    together = [one.wait() for one in started]
    at_once_time = time.monotonic() - began
    table = Table("The shipped polypropylene test, twice", ["one after the other", f"at once on {len(cores)} cores"])
    table.add("exit codes", "-", [sum(run.exit_code for run in each) for each in (after_another, together)], is_(0))
    table.add("CPU time of both", "s", [sum(run.cpu_time for run in each) for each in (after_another, together)], None,
              ".3g")
    table.add("wall time of both", "s", [in_turn, at_once_time], None, ".3g")
    table.add("one after the other over this", "-", [REFERENCE, runs.divide(in_turn, at_once_time)], None, ".2f")
    table.add("same curve as the first", "-",
              [REFERENCE, all(run.curve == after_another[0].curve for run in together)], [None, is_(True)])
    return table
