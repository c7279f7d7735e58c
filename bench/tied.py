"""Whether the readings hold still where one tied knot is pulled under other tolerances than it was tied under."""
import convergence
import plots
import starts
from table import Report

MATERIALS = ["polypropylene", "nylon"]
NOT_ON_THE_WAY = ("edges x3/4", "edges x1/2", convergence.DRAFT, "fine")  # other nodes than the tied ones have


def report(runner, materials, seeds=3):
    tables, curves = [], {}
    for material in materials:
        variants = {convergence.SHIPPED: {}, **convergence.variants_of(material)}
        runs = {name: [pulled(runner, material, name, k, settings) for k in range(seeds)]
                for name, settings in variants.items() if name not in NOT_ON_THE_WAY}
        tables.append(convergence.table_of(material, runs))
        curves[material] = {name: convergence.with_millimetres(each[0]) for name, each in runs.items()}
    return Report("Convergence from one tied state",
                  f"`config/tighten.yaml`, {seeds} starts: each ties its knots once, as shipped, and is pulled from "
                  "that state, to the bit the same one, with one tolerance changed. The mesh cannot be changed on the way: "
                  "convergence.md has it, over the whole history. Halving the contact tolerance changes what the tied "
                  "contacts, as they are, press with; friction's memory is kept in m, so that half of the presliding "
                  "lets it hold twice as much.",
                  tables, lambda file: plots.panels(file, curves, "extension s [mm]", "load F [N]"))


def pulled(runner, material, name, k, settings):
    return runner.bench_run("tied_state_bench", f"{material}/{name.replace(' ', '_').replace('/', '_')}/{k}",
                            "config/tighten.yaml", {"material": material, **starts.start(k)}, {"--pull": settings})
