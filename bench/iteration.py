"""What an iteration of Newton's method costs over the bare factorisation and solve of its matrix."""
import math

import runs
from table import Report, Table, at_most

MATERIALS = ["nylon", "polypropylene", "pink_vps", "green_vps"]
ROUNDS = 3
MOST = 3.0  # bare factorisations and solves that an iteration may cost
TWIST = {"without twist": "off", "with twist": "on"}  # -> physics.twist
MOST_OF_TWIST = 1.6  # iterations without twist that one with it may cost
TINY = 1e-12         # couple of friction at the surface that does nothing but cost
MOST_GROWTH = 1.0    # of an iteration over its bare factorisation and solve, by friction at the surface


def report(runner, materials):
    plain = [cheapest(runner, "config/tighten.yaml", "material", material) for material in materials]
    ropes = table_of("Iterations of the pull", materials, plain)
    rolling = [cheapest(runner, "config/tighten.yaml", "material", material, {"material.friction_couple": TINY})
               for material in materials]
    surface = table_of("Iterations of the pull with friction at the surface", materials, rolling)
    growth = [runs.divide(ratio(there), ratio(here)) for there, here in zip(rolling, plain)]
    surface.add("over that with friction on the centrelines", "-", growth, at_most(MOST_GROWTH), ".3f")
    each = [cheapest(runner, "config/overhand.yaml", "physics.twist", twist) for twist in TWIST.values()]
    overhand = table_of("Iterations of the pull of an overhand", list(TWIST), each)
    without, twisted = (found.get("iteration") for found in each)
    overhand.add("iteration with twist over one without", "-", ["", runs.divide(twisted, without)],
                 [None, at_most(MOST_OF_TWIST)], ".2f")
    return Report("What an iteration costs",
                  "`config/tighten.yaml` and `config/overhand.yaml`: CPU time of the pull over its iterations, so with all "
                  "that a step takes besides: rejected iterations, prediction, patterns, checks, readings, the type of the "
                  "knot; and that of the factorisation and solve alone of the matrix at every tenth command of the pull, "
                  f"again and again in a warm cache. The least of {ROUNDS} runs. Friction at the surface has a couple of "
                  f"{TINY:g}.", [ropes, surface, overhand])


def table_of(title, columns, each):
    table = Table(title, columns)
    table.add("nodes", "-", [found.get("nodes") for found in each])
    table.add("iterations", "-", [found.get("iterations") for found in each])
    table.add("CPU time an iteration", "ms", [found.get("iteration") for found in each], None, ".3g")
    table.add("bare factorisation and solve", "ms", [found.get("solve") for found in each], None, ".3g")
    table.add("iteration over bare factorisation and solve", "-",
              [ratio(found) for found in each], at_most(MOST), ".2f")
    return table


def ratio(found):
    return runs.divide(found.get("iteration"), found.get("solve"))


def cheapest(runner, method, key, value, others=None):
    """Of several runs of one method."""
    settings = {key: value, **(others or {})}
    return min((cost(runner, method, settings) for _ in range(ROUNDS)),
               key=lambda found: found.get("iteration", math.inf))


def cost(runner, method, settings):
    return runner.bench_tool("iteration_cost_bench", [method] + runs.words_of("--set", settings))
