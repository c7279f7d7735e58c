"""What an iteration of Newton's method costs over the bare factorisation and solve of its matrix."""
import json
import math

import runs
from table import Report, Table, at_most

MATERIALS = ["nylon", "polypropylene", "pink_vps", "green_vps"]
ROUNDS = 3
MOST = 2.0  # bare factorisations and solves that an iteration may cost


def report(runner, materials):
    each = [min((cost(runner, material) for _ in range(ROUNDS)), key=lambda found: found.get("iteration", math.inf))
            for material in materials]
    table = Table("Iterations of the pull", materials)
    table.add("nodes", "-", [found.get("nodes") for found in each])
    table.add("iterations", "-", [found.get("iterations") for found in each])
    table.add("CPU time an iteration", "ms", [found.get("iteration") for found in each], None, ".3g")
    table.add("bare factorisation and solve", "ms", [found.get("solve") for found in each], None, ".3g")
    table.add("iteration over bare factorisation and solve", "-",
              [runs.divide(found.get("iteration"), found.get("solve")) for found in each], at_most(MOST), ".2f")
    return Report("What an iteration costs",
                  "`config/tighten.yaml`: CPU time of the pull over its iterations, so with all that a step takes besides: "
                  "rejected iterations, prediction, patterns, checks, readings, the type of the knot; and that of the "
                  "factorisation and solve alone of the matrix at every tenth command of the pull, again and again in a "
                  f"warm cache. The least of {ROUNDS} runs.", [table])


def cost(runner, material):
    return runner.bench_tool("iteration_cost_bench",
                             ["config/tighten.yaml", "--set", f"material={json.dumps(material)}"])
