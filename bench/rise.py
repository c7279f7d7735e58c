"""Why the force of knots that slide rises: sliding turns them about the strand that they slide along, and the strands
between them, which wind about each other, resist the more the nearer the knots come."""
import math

import numpy as np
import plots
from table import Report, Table, at_most

MATERIALS = ["nylon", "polypropylene"]
# End-to-end distance and knot distance [m], and the extensions at which the pull is stopped and looked at [m].
LOOPS = {"e from 0.15 m": ({"specimen.end_to_end": 0.5, "specimen.knot_distance": 0.15},
                           [0.01, 0.025, 0.04, 0.055]),
         "e from 0.4 m": ({"specimen.end_to_end": 0.8, "specimen.knot_distance": 0.4},
                          [0.01, 0.03, 0.05, 0.07, 0.1, 0.13, 0.16, 0.175])}
STEADY = ("e from 0.4 m", 0.05, 0.07)  # between these extensions knots that are far apart slide steadily
STEADY_GATE = at_most(0.06)
MOUTH = 5.0    # radii from a knot's middle to where both strands run free of its coil
LATELY = 0.003  # [m] of the way over which the force is a mean


def report(runner, materials):
    tables, forces = [], {}
    for material in materials:
        for loop, (settings, extensions) in LOOPS.items():
            readings = [look(runner, material, loop, settings, s) for s in extensions]
            tables.append(table_of(f"{material}, {loop}", extensions, readings, steady(loop, extensions, readings)))
            known = [(1e3 * r["e"], r["force"]) for r in readings if None not in (r["e"], r["force"])]
            forces[f"{material}, {loop}"] = tuple(zip(*known)) if known else ((), ())
    return Report("Why the force rises while knots slide",
                  "Pulls of `config/tighten.yaml` that stop at several extensions. The winding is the angle by which the "
                  f"line from one strand to the other turns between the knots, up to {MOUTH:g} radii from their middles.",
                  tables, lambda file: plots.curves_together(file, forces, "knot distance e [mm]", "load F [N]"))


def look(runner, material, loop, settings, extension):
    """One pull, stopped at an extension."""
    name = f"{material}/{loop.replace(' ', '_')}_at_{1e3 * extension:g}_mm"
    run = runner.run(name, {"material": material, **settings,
                            "program.pull.until": {"extension": extension, "break": True}})
    pull = run.phase("pull")
    lately = [load for s, load in zip(pull.get("extension", []), pull.get("load", []))
              if s > extension - LATELY]
    e = pull["knot_distance"][-1] if pull.get("knot_distance") else None
    excess = run.value("final_excess_length")
    radius = run.method.get("material", {}).get("radius")
    return {"force": sum(lately) / len(lately) if lately else None, "e": e,
            "excess": sum(excess) / len(excess) if isinstance(excess, list) and excess else None,
            "winding": winding(run.shape, e, radius) if run.shape and e and radius else None}


def winding(shape, e, radius):
    """[degrees] None where the knots are too near."""
    x = np.array([shape["x"], shape["y"], shape["z"]]).T
    middle = np.mean(0.5 * (x[:, 2] + x[::-1, 2]))  # the knots are mirrored by a half turn
    half = 0.5 * e - MOUTH * radius
    near_side = x[:, 0] > np.mean(x[:, 0])
    angles = []
    for z in np.linspace(middle - half, middle + half, 50) if half > radius else ():
        above = x[:, 2] > z
        edges = [i for i in np.flatnonzero(above[1:] != above[:-1]) if near_side[i]]
        if len(edges) != 2:
            return None  # a tail or a coil lies between, too
        a, b = (x[i] + (z - x[i, 2]) / (x[i + 1, 2] - x[i, 2]) * (x[i + 1] - x[i]) for i in edges)
        angles.append(math.atan2(b[1] - a[1], b[0] - a[0]))
    turned = np.unwrap(angles)
    return math.degrees(turned[-1] - turned[0]) if len(turned) else None


def steady(loop, extensions, readings):
    """Relative change of the force between the two extensions of STEADY; None of another loop."""
    if loop != STEADY[0]:
        return None
    first, last = (readings[extensions.index(s)]["force"] for s in STEADY[1:])
    return math.nan if None in (first, last) else abs(last / first - 1.0)


def table_of(title, extensions, readings, change):
    table = Table(title, [f"s = {1e3 * s:g} mm" for s in extensions])
    for key, quantity, unit in (("e", "knot distance e", "m"), ("force", "load F", "N"),
                                ("excess", "excess length, mean of both knots", "m"),
                                ("winding", "winding of the strands between the knots", "degrees")):
        table.add(quantity, unit, [reading[key] for reading in readings])
    if change is not None:
        at = extensions.index(STEADY[2])
        table.add(f"change of the load since {1e3 * STEADY[1]:g} mm", "-",
                  [change if i == at else "" for i in range(len(extensions))],
                  [STEADY_GATE if i == at else None for i in range(len(extensions))])
    return table
