"""Whether readings depend on the length of the loop and on the distance of its knots."""
import math

import numpy as np
import plots
from runs import divide, mean, standard_error
from table import REFERENCE, Report, Table, at_most, is_

MATERIALS = ["nylon", "polypropylene"]
SAME_DISTANCES = (0.08, 0.03)      # of the knots [m]: between these the mean force is the plateau compared here
DISTANCE, LENGTH = 0.15, 0.25      # e and L of the paper [m]
SHORTEST_GAP = 0.085               # L - e by which coils clear the rollers [m]
# Title -> [(L, e)], the reference first [m].
LOOPS = {"length of the loop": [(length, min(DISTANCE, length - SHORTEST_GAP)) for length in (LENGTH, 0.2, 0.3, 0.35, 0.5, 1.0, 2.0)],
         "distance of the knots": [(0.35, distance) for distance in (DISTANCE, 0.11, 0.13, 0.17, 0.19)]}
SHIFTS = [(0.0, 0.0), (1e-3, 2e-3), (-1e-3, -2e-3), (2e-3, -1e-3)]  # of e and of the tails, a start each [m]
TAIL = 0.03                        # [m]
SURE = 2.0                         # standard errors that a change may be by chance


def report(runner, materials, seeds=3):
    tables, curves = [], {}
    for material in materials:
        for title, loops in LOOPS.items():
            tables.append(study(runner, material, title, loops, seeds, curves))
    return Report("Readings against L and e",
                  f"`config/tighten.yaml`, {seeds} starts of each loop, whose knots are up to 2 mm further apart or "
                  "closer and whose tails are up to 2 mm longer or shorter; means and their standard errors. Loops are "
                  "compared where their knots are in the same state. That is at the same distance for the force, which "
                  "depends on it by the winding of the strands between the knots (doc/model.md), at the lock for this "
                  "distance itself, and at the same loads for the stiffness, because knots that bear more add less: the "
                  "largest load that every loop of a table bore, and half of it. "
                  "The stiffness k is that of a loop of two strands, 4 k_s over its length; what 4 k_s/k is longer than "
                  "the way around the rollers at the lock is what both knots add. A change must stay within the "
                  f"larger of the error that the run gives and of {SURE:g} standard errors of the difference. Rows "
                  "without a gate show what differs because the loops do: the part of the way to the lock over which a "
                  "slack loop straightens and no knot slides. Runs without a lock fail.",
                  tables, lambda file: plots.panels(file, curves, "L or e [mm]", "mean force [N]"))


def study(runner, material, title, loops, seeds, curves):
    done = runner.run_all([(f"{material}/{1e3 * length:g}_{1e3 * distance:g}_{k}",
                            {"material": material, "specimen.end_to_end": length, "specimen.knot_distance": distance + shift,
                             "specimen.tail": TAIL + tail})
                           for length, distance in loops for k, (shift, tail) in enumerate((SHIFTS * seeds)[:seeds])])
    each = [done[i * seeds:(i + 1) * seeds] for i in range(len(loops))]
    table = Table(f"{material}: {title}", [f"L {1e3 * length:g} mm, e {1e3 * distance:g} mm" for length, distance in loops])
    table.add("exit code", "-", [max(run.exit_code for run in starts) for starts in each], is_(0))
    forces = [[force_at_distances(run) for run in starts] for starts in each]
    add(table, "mean force at the same distances", "N", forces,
        [largest_share(starts, "plateau_force", "true_plateau_force", abs(mean(forces[0]) or 0.0)) for starts in each])
    add(table, "knot distance at the lock", "m", [[distance_at_lock(run) for run in starts] for starts in each],
        [max((2.0 * (run.reading("lock_extension_error") or 0.0) for run in starts)) for starts in each])
    table.add("part of the way to the lock on which no knot slides", "m",
              [mean(way_of_slack(run) for run in starts) for starts in each])
    borne = min(max(run.pulled("load")[0], default=0.0) for run in done)
    add(table, "rod that the knots add to the loop's stretching", "m",
        [[added_by_knots(run, borne) for run in starts] for starts in each],
        [largest_share(starts, "locked_stiffness", "locked_stiffness", mean(stretched_length(run, borne) for run in starts) or 0.0)
         for starts in each])
    table.add("warnings", "-", ["; ".join(sorted({warning.replace("|", "/") for run in starts
                                                  for warning in run.value("warnings") or []})) or "none" for starts in each])
    place = list(LOOPS).index(title)
    points = sorted((1e3 * loop[place], mean(some)) for loop, some in zip(loops, forces) if mean(some) is not None)
    curves[f"{material}, {title}"] = {"mean force": tuple(zip(*points)) or ((), ())}
    return table


def add(table, words, unit, values, errors):
    """`values`: of each loop, one a start; `errors`: that the runs give."""
    means, spreads = [mean(one) for one in values], [standard_error(one) for one in values]
    changes = [None if None in (one, means[0]) else one - means[0] for one in means]
    allowed = [max(error, SURE * math.hypot(spreads[0] or 0.0, spread or 0.0)) for error, spread in zip(errors, spreads)]
    table.add(words, unit, means)
    table.add(f"{words}: standard error", unit, spreads, None, ".2g")
    table.add(f"{words}: change", unit, [REFERENCE] + changes[1:], None, ".2g")
    table.add(f"{words}: size of the change over what it may be", "-",
              [REFERENCE] + [divide(None if change is None else abs(change), may) for change, may in list(zip(changes, allowed))[1:]],
              [None] + [at_most(1.0)] * (len(means) - 1), ".2g")


def largest_share(starts, key, reading, of):
    """The largest relative error given, of a value."""
    shares = [divide(run.reading(key + "_error"), run.reading(reading)) for run in starts]
    return max((abs(share) for share in shares if share is not None), default=0.0) * of


def force_at_distances(run):
    """Mean of the true force over the knots' distance, which falls while they slide."""
    distance, load = run.pulled("knot_distance", "load")
    if run.reading("lock_extension") is None or not distance:
        return None
    lowest = np.minimum.accumulate(distance)
    wanted = np.linspace(*SAME_DISTANCES, 500)
    if lowest[0] < wanted[0] or lowest[-1] > wanted[-1]:
        return None
    return float(np.mean(np.interp(-wanted, -lowest, load))) + (run.value("balance_offset") or 0.0)


def distance_at_lock(run):
    lock, (extension, distance) = run.reading("lock_extension"), run.pulled("extension", "knot_distance")
    return None if lock is None or not extension else float(np.interp(lock, extension, distance))


def way_of_slack(run):
    """Knots that slide come nearer by twice the extension; what is longer of the way is no sliding."""
    last = distance_at_lock(run)
    return None if last is None else run.value("lock_extension") - 0.5 * (run.pulled("knot_distance")[0][0] - last)


def stretched_length(run, load_at_end):
    """4 k_s over the slope of the chord from half of a load to that load, behind the lock [m]."""
    lock, material = run.reading("lock_extension"), run.method.get("material")
    behind = [(f, s) for s, f in zip(*run.pulled()) if lock is not None and s >= lock]
    if len(behind) < 2 or not isinstance(material, dict):
        return None
    force, way = np.maximum.accumulate([f for f, _ in behind]), [s for _, s in behind]
    loads = (0.5 * load_at_end, load_at_end)
    if force[0] > loads[0] or force[-1] < loads[1]:
        return None
    first, last = np.interp(loads, force, way)
    return 4.0 * material["stretching_stiffness"] * (last - first) / (loads[1] - loads[0])


def added_by_knots(run, load_at_end):
    length = stretched_length(run, load_at_end)
    if length is None:
        return None
    half_turns = math.pi * (0.5 * run.method["machine"]["roller_diameter"] + run.method["material"]["radius"])
    return length - 2.0 * (run.method["specimen"]["end_to_end"] + run.value("lock_extension") + half_turns)
