"""Knots from files: how far the load at which they slip or part is off, and whether the mesh decides which of both they do."""
import math

from runs import divide, mean, read_yaml, standard_error
from table import Report, Table, at_most

METHOD = "config/knot.yaml"
MATERIALS = ["pink_vps", "green_vps", "dyneema_2mm", "nylon", "polyester_cord"]
KNOTS = ["reef", "sheet_bend", "zeppelin", "carrick", "figure_eight_bend", "double_fisherman_bend", "bowline", "clove_hitch"]
TAILS = (1.0, 1.05, 0.95, 1.02)    # of the automatic ones, a start each
TAIL, EDGE = 30.0, 1.01            # automatic, before refinement [h]
FINER = 0.5                        # edges over those of `fine`
CPU_LIMIT = 600                    # of a run [s]
SURE = 2.0                         # standard errors that a difference may be by chance
LARGEST = 0.05                     # of a mean, beyond chance


def report(runner, materials, seeds=2, knots=None):
    return Report("Knots from files: `normal` against finer ones",
                  f"`{METHOD}`, {seeds} starts of each knot, whose tails differ by up to 5 %. Finer: `physics.accuracy: fine`, and edges "
                  f"{FINER:g} times as long as it has. Largest loads in the pull [N], means and their standard errors. Where a rope parts at "
                  "one of both and slips at the other, the mesh decides what the knot does, and the change says nothing. The gate holds for "
                  f"what is left of a change, over the mean, after {SURE:g} standard errors of the difference.",
                  [study(runner, material, seeds, knots or KNOTS) for material in materials])


def study(runner, material, seeds, knots):
    radius = read_yaml(f"config/materials/{material}.yaml")["radius"]
    levels = {"normal": {}, "finer": {"physics.accuracy": "fine", "specimen.edge_length": round(FINER * EDGE * radius, 9)}}
    runs = runner.run_all([(f"{material}/{knot}_{level}_{k}",
                            {"specimen.knot": knot, "material": material, "specimen.tail": round(TAIL * radius * TAILS[k], 9), **settings},
                            METHOD) for knot in knots for level, settings in levels.items() for k in range(seeds)],
                          cpu_limit=CPU_LIMIT)
    each = [runs[i * seeds:(i + 1) * seeds] for i in range(2 * len(knots))]
    normal, finer = each[0::2], each[1::2]
    table = Table(material, knots)
    loads = {}
    for name, starts in (("normal", normal), ("finer", finer)):
        loads[name] = [[run.reading("peak_force") for run in some] for some in starts]
        table.add(f"largest load, {name}", "N", [mean(one) for one in loads[name]])
        table.add(f"largest load, {name}: standard error", "N", [standard_error(one) for one in loads[name]], None, ".2g")
        table.add(f"parted, {name}", "-", [f"{sum(run.value('ended_by') == 'break' for run in some)} of {seeds}" for some in starts])
    table.add("the mesh decides", "-", ["no" if same_end(*pair) else "yes" for pair in zip(normal, finer)])
    table.add("change by the mesh", "-", [share(*pair) for pair in zip(loads["normal"], loads["finer"])], None, ".2g")
    table.add("change beyond chance", "-", [beyond_chance(*pair) if same_end(*ends) else 0.0
                                           for pair, ends in zip(zip(loads["normal"], loads["finer"]), zip(normal, finer))],
              at_most(LARGEST), ".2g")
    return table


def same_end(normal, finer):
    return {run.value("ended_by") for run in normal} == {run.value("ended_by") for run in finer}


def share(normal, finer):
    """(normal - finer)/finer of the means."""
    return divide(None if None in (mean(normal), mean(finer)) else mean(normal) - mean(finer), mean(finer))


def beyond_chance(normal, finer):
    by_chance = divide(math.hypot(standard_error(normal) or 0.0, standard_error(finer) or 0.0), mean(finer))
    return None if share(normal, finer) is None else max(0.0, abs(share(normal, finer)) - SURE * by_chance)
