"""What doc/references.md says beside the source paper: pre-loads of nylon, the two locks, and the breaking forces."""
import numpy as np
import plots
import runs
from table import Report, Table

MATERIALS = ["nylon", "polypropylene"]
PRELOADS = {"nylon": [40.0, 60.0, 64.0, 66.0, 70.0, 100.0, 150.0, 495.0]}                # [N]
STARTS = [0.14985, 0.15, 0.15015]                       # knot distances, 0.1 % apart [m]
BREAKS_AT = {"nylon": 0.10, "polypropylene": 0.13}      # the paper's extensions [m]
MET_AT = 0.066                                          # where the paper's knots have met [m]
BEYOND = {"extension": 0.16}                            # until here a rod that cannot break is pulled [m]
BEFORE_TOUCH = 0.003                                    # of the way over which the load is a mean [m]


def report(runner, materials):
    tables, curves = [], {}
    for material in materials:
        if material in PRELOADS:
            tables.append(preloads(runner, material))
        if material in BREAKS_AT:
            run = unbroken(runner, material)
            tables.append(locks(run, material))
            s, force = runs.pulled(run)
            curves[material] = ([1e3 * x for x in s], force)
    return Report("Beside the source paper",
                  "`config/tighten.yaml`. The breaking forces follow from the paper's extensions at break and from our "
                  "curve of a rod that cannot break, in three ways of reading the 66 mm at which its knots have met.",
                  tables, lambda file: plots.curves_together(file, curves, "extension s [mm]", "load F [N]", log=True))


def preloads(runner, material):
    """Means over starts, of the starts that have the reading."""
    loads = PRELOADS[material]
    table = Table(f"{material}: pre-loads, {len(STARTS)} starts each", [f"{load:g} N" for load in loads])
    tested = [[runner.run(f"{material}/{load:g}_N_{1e3 * e:g}_mm",
                          {"material": material, "specimen.preload": load, "specimen.knot_distance": e})
               for e in STARTS] for load in loads]
    table.add("starts in which a knot jumps open", "-",
              [sum(run.value("jump_force") is not None for run in some) for some in tested])
    for key in ("jump_force", "force_after_jump", "plateau_force", "true_plateau_force"):
        table.add(key, "N", [mean(run.value(key) for run in some) for some in tested])
    return table


def mean(values):
    known = [value for value in values if value is not None]
    return sum(known) / len(known) if known else "-"


def unbroken(runner, material):
    return runner.run(f"{material}/cannot_break", {"material": material, "material.breaking_force": None,
                                                   "program.pull.until": BEYOND})


def locks(run, material):
    pull = run.phase("pull")
    s, load, e = (np.array(pull.get(key, [])) for key in ("extension", "load", "knot_distance"))
    touch, lock, stiffness = (run.value(key) for key in ("first_contact_extension", "lock_extension",
                                                         "locked_stiffness"))
    table = Table(f"{material}: where the knots meet, and what a strand bears at {BREAKS_AT[material]:g} m", ["value"])
    if None in (touch, lock, stiffness):
        table.add("locks", "-", [None])
        return table
    nests = (s >= touch) & (s <= lock)
    table.add("first contact", "m", [touch])
    table.add("knot distance there", "m", [float(np.interp(touch, s, e))])
    table.add("lock", "m", [lock])
    table.add("lock by load", "m", [run.value("lock_extension_by_load")])
    table.add("load before the first contact", "N", [float(load[(s > touch - BEFORE_TOUCH) & (s < touch)].mean())])
    table.add("smallest load from there to the lock", "N", [float(load[nests].min())])
    table.add("largest load from there to the lock", "N", [float(load[nests].max())])
    table.add("locked stiffness", "N/m", [stiffness])
    at = BREAKS_AT[material]
    table.add("strand at break, 66 mm is the first contact", "N", [0.5 * float(np.interp(at, s, load))])
    table.add("strand at break, 66 mm is the lock, curve moved", "N",
              [0.5 * float(np.interp(at + lock - MET_AT, s, load))])
    table.add("strand at break, 66 mm is the lock, straight line", "N", [0.5 * stiffness * (at - MET_AT)])
    return table
