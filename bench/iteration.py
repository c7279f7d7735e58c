"""What an iteration of Newton's method costs over the bare factorisation and solve of its matrix."""
import math

from runs import divide, words_of
from table import Report, Table, at_most

MATERIALS = ["nylon", "polypropylene", "pink_vps", "green_vps"]
ROUNDS = 3
MOST = 3.0  # bare factorisations and solves that an iteration may cost
LOOP, OVERHAND = "config/tighten.yaml", "config/overhand.yaml"


def report(runner, materials):
    scenes = {"Iterations of the pull": {name: (LOOP, {"material": name}) for name in materials},
              "Iterations of the pull of an overhand":
                  {f"twist {twist}": (OVERHAND, {"physics.twist": twist}) for twist in ("off", "on")}}
    tables = []
    for title, columns in scenes.items():
        each = [min((runner.bench_tool("iteration_cost_bench", [method] + words_of(settings)) for _ in range(ROUNDS)),
                    key=lambda found: found.get("iteration", math.inf)) for method, settings in columns.values()]
        table = Table(title, list(columns))
        table.add("nodes", "-", [found.get("nodes") for found in each])
        table.add("iterations", "-", [found.get("iterations") for found in each])
        table.add("CPU time an iteration", "ms", [found.get("iteration") for found in each], None, ".3g")
        table.add("bare factorisation and solve", "ms", [found.get("solve") for found in each], None, ".3g")
        table.add("iteration over bare factorisation and solve", "-",
                  [divide(found.get("iteration"), found.get("solve")) for found in each], at_most(MOST), ".2f")
        tables.append(table)
    return Report("What an iteration costs",
                  "`config/tighten.yaml` and `config/overhand.yaml`: CPU time of the pull over its iterations, so with all "
                  "that a step takes besides: rejected iterations, prediction, patterns, checks, readings, the type of the "
                  "knot; and that of the factorisation and solve alone of the matrix at every tenth command of the pull, "
                  f"again and again in a warm cache. The least of {ROUNDS} runs.", tables)
