"""At which load a figure-eight knot that stops a rod in a hole flips, and what that load depends on."""
import plots
from table import REFERENCE, Report, Table, above, at_most

MATERIALS = []
TOOL = "capsizing_bench"
EDGE = round(1 / 3, 4)              # of all runs but those that compare edges [h]
EDGES = {"h": 1.0, "h/1.5": round(1 / 1.5, 4), "h/2": 0.5, "h/3": EDGE, "h/4": 0.25, "h/5": 0.2, "h/8": 0.125}
FRICTIONS = (0.2, 0.3)
SOLID = round(2 / 3, 4)             # k_t/k_b of a solid rod that keeps its volume
COUPLES = (0.0, 0.5, 0.75, 1.0)
TWISTING = (0.3, 1.0, 3.0)          # of the solid rod's k_t
SCENES = {"mu 0.1": {"friction": 0.1}, "mu 0.15": {"friction": 0.15}, "mu 0.2": {"friction": 0.2}, "mu 0.3": {},
          "preload 0.5": {"preload": 0.5}, "preload 2": {"preload": 2.0},
          "k_s h^2/k_b 12": {"stretching": 12.0}, "overhand": {"knot": "overhand"},
          "overhand, eta 0": {"knot": "overhand", "couple": 0.0}}
MACHINE = {"as above": {}, "hole 2.5 h wide": {"gap": 2.5}, "edges of the hole 2 h": {"rim": 2.0},
           "clamp 10 h below": {"below": 10.0}, "clamp 40 h below": {"below": 40.0}}
AGAIN = {"friction": 0.15, "flips": 3, "farthest": 60.0}
NUMERICS = {"as above": {}, "clamp half as fast": {"speed": 0.25}, "clamp twice as fast": {"speed": 1.0},
            "steps of a quarter": {"longest-step": 0.05}, "residual of a tenth": {"residual": 1e-5},
            "edges 4 % shorter": {"edge": 0.32}, "edges 5 % longer": {"edge": 0.35},
            "presliding halved": {"presliding": 1e-3}, "contact tolerance halved": {"contact-tolerance": 0.01}}
CONVERGED = at_most(0.05)           # change of the load from edges of h/3, or shorter, to the shortest ones
BEYOND = above(1.5)                 # load that is borne without the couple, over the one at which it flips with it


def report(runner, _):
    tables, curves = [], {}
    for mu in FRICTIONS:
        found = {name: run(runner, {"edge": edge, "friction": mu}) for name, edge in EDGES.items()}
        tables.append(edges_table(mu, found))
    reference = found["h/3"]        # mu = 0.3
    for mu in FRICTIONS:
        couples = {f"eta {couple:g}": run(runner, {"couple": couple, "friction": mu}) for couple in COUPLES}
        tables.append(couples_table(mu, couples))
    twisted = {f"{factor:g} k_t": run(runner, {"twisting": round(factor * SOLID, 4)}) for factor in TWISTING}
    tables.append(results(Table("Twisting stiffness", list(twisted)), twisted))
    scenes = {name: run(runner, settings) for name, settings in SCENES.items()}
    tables.append(results(Table("Friction, preload, stretching and another knot", list(scenes)), scenes))
    machine = {name: run(runner, settings) for name, settings in MACHINE.items()}
    table = results(Table("Hole and clamp", list(machine)), machine)
    table.add("change of the load", "-", changes(machine, reference), None, ".2g")
    tables.append(table)
    tables.append(again_table(run(runner, AGAIN)))
    numerics = {name: run(runner, settings) for name, settings in NUMERICS.items()}
    table = results(Table("Speed, steps and tolerances", list(numerics)), numerics)
    table.add("change of the load", "-", changes(numerics, reference), None, ".2g")
    tables.append(table)
    for name, one in [("eta 1", reference), ("eta 0", couples["eta 0"]), ("eta 1, 0.3 k_t", twisted["0.3 k_t"]),
                      ("eta 1, 3 k_t", twisted["3 k_t"]), ("overhand, eta 1", scenes["overhand"])]:
        curve = one.get("curve") or []
        curves[name] = ([row[0] for row in curve], [row[1] for row in curve])
    return Report("The load at which a stopper knot flips",
                  "A figure-eight knot in a solid rod (k_s h^2/k_b = 4, k_t = 2/3 k_b) stops it in a square hole 2.2 h wide, "
                  "whose edges are cylinders with a radius of 4 h (`test/sim/stopper_knot.hpp`). It is tightened by a pull "
                  "of k_b/h^2 at its tail and drawn onto the hole; the tail is let go; then the clamp below, which cannot "
                  "spin, is pulled by h/2 a second. Loads are in k_b/h^2, torques and energies in k_b/h. It flips where the force falls "
                  "by more than a tenth within a way of h, and the shape of the 28 h of rod above the hole is another one after "
                  "that (more than h apart in the root mean square, once laid onto each other). Unless a table says "
                  "otherwise, mu is 0.3, the couple eta is 1 and edges are h/3 long. Pulls without a flip end after 80 h.",
                  tables, lambda file: plots.curves_and_shapes(
                      file, curves, {"before the flip": reference.get("before"), "after it": reference.get("after")},
                      "way of the clamp [h]", "force [k_b/h^2]"))


def run(runner, settings):
    words = []
    for key, value in {"edge": EDGE, **settings}.items():
        words += [f"--{key}", value]
    found = runner.bench_tool(TOOL, words)
    first = (found.get("flips") or [{}])[0]
    return {**found, **{f"flip_{key}": value for key, value in first.items()}}


def edges_table(mu, found):
    table = results(Table(f"Edges, mu = {mu:g}", list(found)), found)
    shortest = list(found.values())[-1]
    table.add("change of the load against the shortest edges", "-",
              [REFERENCE if one is shortest else change for one, change in zip(found.values(), changes(found, shortest))],
              [CONVERGED if name in ("h/3", "h/4", "h/5") else None for name in found], ".2g")
    table.add("CPU time", "s", [one.get("cpu_time") for one in found.values()], None, ".2g")
    return table


def couples_table(mu, found):
    table = results(Table(f"Without the couple, and with less of it, mu = {mu:g}", list(found)), found)
    whole = list(found.values())[-1]
    table.add("largest load, over the load at which it flips with eta 1", "-",
              [divide(one.get("largest_force"), whole.get("flip_force")) for one in found.values()],
              [BEYOND if couple == 0.0 else None for couple in COUPLES], ".3g")
    return table


def results(table, found):
    runs = found.values()
    table.add("load at which it flips", "k_b/h^2",
              [one.get("flip_force", none(one)) for one in runs])
    table.add("way of the clamp until then", "h", [one.get("flip_way", "-") for one in runs], None, ".3g")
    table.add("rod that passes the hole in the flip", "h", [one.get("flip_passed", "-") for one in runs], None, ".3g")
    table.add("change of shape", "h", [one.get("flip_change_of_shape", "-") for one in runs], None, ".3g")
    table.add("torque of the clamp before it", "k_b/h", [one.get("flip_torque", "-") for one in runs], None, ".2g")
    table.add("largest energy of twist", "k_b/h", [one.get("largest_twisting") for one in runs], None, ".2g")
    return table


def again_table(found):
    """The same knot, pulled on."""
    flips = found.get("flips") or [{}]
    table = Table("One flip after another, mu = 0.15", [f"flip {k + 1}" for k in range(len(flips))])
    for key, unit, digits in (("force", "k_b/h^2", ".3g"), ("way", "h", ".3g"), ("passed", "h", ".3g"),
                              ("change_of_shape", "h", ".3g"), ("torque", "k_b/h", ".2g")):
        table.add({"force": "load", "way": "way of the clamp", "passed": "rod that passes the hole",
                   "change_of_shape": "change of shape", "torque": "torque of the clamp before it"}[key], unit,
                  [flip.get(key) for flip in flips], None, digits)
    table.add("load after another 10 h", "k_b/h^2", ["-"] * (len(flips) - 1) + [found.get("end_force")], None, ".2g")
    return table


def none(one):
    return f"none up to {one['largest_force']:.3g}" if "largest_force" in one else None


def changes(found, reference):
    """Of the loads, against one; None where either did not flip."""
    wanted = reference.get("flip_force")
    return [abs(one["flip_force"] / wanted - 1.0) if wanted and "flip_force" in one else None for one in found.values()]


def divide(value, by):
    return value / by if value and by else None
