"""Whether readings depend on the length of the loop and on the distance of its knots."""
import concurrent.futures
import math
import statistics

import numpy as np

import plots
import runs
from table import REFERENCE, Report, Table, at_most, is_, is_missing

MATERIALS = ["nylon", "polypropylene"]
SHARED = (0.2, 0.8)                # of the way to the lock: between these a mean force is shown
SAME_DISTANCES = (0.08, 0.03)      # of the knots [m]: between these the mean force is the plateau compared here
DISTANCE, LENGTH = 0.15, 0.25      # e and L of the paper [m]
LENGTHS = [0.2, 0.25, 0.3, 0.35, 0.5, 1.0, 2.0]          # L at the paper's e, at the shortest a closer pair [m]
DISTANCES = [0.11, 0.13, 0.15, 0.17, 0.19]               # e at one L [m]
LENGTH_OF_DISTANCES = 0.35
SHORTEST_GAP = 0.085               # L - e by which coils clear the rollers [m]
SHIFTS = [(0.0, 0.0), (1e-3, 2e-3), (-1e-3, -2e-3), (2e-3, -1e-3)]  # of e and of the tails, a start each [m]
TAIL = 0.03                        # [m]
SURE = 2.0                         # standard errors that a change may be by chance
JOBS = 2


def report(runner, materials, seeds=3):
    tables, curves = [], {}
    for material in materials:
        for title, loops in loops_of().items():
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
                  "without a gate show what differs because the loops do: the mean force from "
                  f"{SHARED[0]:g} to {SHARED[1]:g} of the way to the lock, and the part of this way over which a slack "
                  "loop straightens and no knot slides. Runs without a lock fail.",
                  tables, lambda file: plots.panels(file, curves, "L or e [mm]", "mean force [N]"))


def loops_of():
    """Title -> [(L, e)], the reference first."""
    lengths = sorted(LENGTHS, key=lambda length: length != LENGTH)
    distances = sorted(DISTANCES, key=lambda distance: distance != DISTANCE)
    return {"length of the loop": [(length, min(DISTANCE, length - SHORTEST_GAP)) for length in lengths],
            "distance of the knots": [(LENGTH_OF_DISTANCES, distance) for distance in distances]}


def study(runner, material, title, loops, seeds, curves):
    def run(loop, k):
        length, distance = loop
        shift, tail = SHIFTS[k % len(SHIFTS)]
        settings = {"material": material, "specimen.end_to_end": length, "specimen.knot_distance": distance + shift,
                    "specimen.tail": TAIL + tail}
        return runner.start(f"{material}/{1e3 * length:g}_{1e3 * distance:g}_{k}", settings, "config/tighten.yaml",
                            None).wait()

    with concurrent.futures.ThreadPoolExecutor(JOBS) as pool:
        each = list(pool.map(lambda loop: [run(loop, k) for k in range(seeds)], loops))
    table = Table(f"{material}: {title}", [f"L {1e3 * length:g} mm, e {1e3 * distance:g} mm" for length, distance in loops])
    table.add("exit code", "-", [max(run.exit_code for run in starts) for starts in each], is_(0))
    add(table, "mean force at the same distances", "N", [[force_at_distances(run) for run in starts] for starts in each],
        [shares_of(starts, "plateau_force", "true_plateau_force") for starts in each])
    show(table, "mean force at the same shares of the way", "N",
         [[force_on_the_way(run) for run in starts] for starts in each])
    add(table, "knot distance at the lock", "m", [[distance_at_lock(run) for run in starts] for starts in each],
        [shares_of(starts, "lock_extension", "lock_extension", 2.0) for starts in each], absolute=True)
    show(table, "part of the way to the lock on which no knot slides", "m",
         [[way_of_slack(run) for run in starts] for starts in each])
    borne = min(max(runs.pulled(run)[1], default=0.0) for starts in each for run in starts)
    add(table, "rod that the knots add to the loop's stretching", "m",
        [[added_by_knots(run, borne) for run in starts] for starts in each],
        [stiffness_error(starts, borne) for starts in each], absolute=True)
    table.add("plateau force as the run gives it", "N",
              [", ".join(text(run.value("plateau_force")) for run in starts) for starts in each])
    table.add("warnings", "-", ["; ".join(sorted({warning.replace("|", "/") for run in starts
                                                  for warning in run.value("warnings") or []})) or "none"
                                for starts in each])
    place = 0 if title == "length of the loop" else 1
    curves.setdefault(f"{material}, {title}", {})["mean force"] = with_places(
        [loop[place] for loop in loops], [mean([force_at_distances(run) for run in starts]) for starts in each])
    return table


def show(table, words, unit, values):
    """Without a gate: what differs because the loops do."""
    table.add(words, unit, [mean(one) for one in values])


def add(table, words, unit, values, errors, absolute=False):
    """`values`: of each loop, one a start; `errors`: that the runs give, relative, or in `unit`."""
    means, spreads = [mean(one) for one in values], [standard_error(one) for one in values]
    table.add(words, unit, means)
    table.add(f"{words}: standard error", unit, spreads, None, ".2g")
    if means[0] is None:
        table.add(f"{words}: change", unit, [REFERENCE] + [None] * (len(means) - 1), [None] + [at_most(0.0)] * (len(means) - 1))
        return
    changes = [None if one is None else one - means[0] for one in means]
    allowed = [max((error or 0.0) * (1.0 if absolute else abs(means[0])),
                   SURE * math.hypot(spreads[0] or 0.0, spread or 0.0)) for error, spread in zip(errors, spreads)]
    table.add(f"{words}: change", unit, [REFERENCE] + changes[1:], None, ".2g")
    table.add(f"{words}: size of the change over what it may be", "-",
              [REFERENCE] + [None if change is None else runs.divide(abs(change), may) for change, may in
                             list(zip(changes, allowed))[1:]], [None] + [at_most(1.0)] * (len(means) - 1), ".2g")


def force_at_distances(run):
    """Mean of the true force over the knots' distance, which falls while they slide."""
    distance, load = pulled_by_distance(run)
    if is_missing(run.value("lock_extension")) or not distance:
        return None
    lowest = np.minimum.accumulate(distance)
    wanted = np.linspace(*SAME_DISTANCES, 500)
    if lowest[0] < wanted[0] or lowest[-1] > wanted[-1]:
        return None
    return float(np.mean(np.interp(-wanted, -lowest, load))) + (run.value("balance_offset") or 0.0)


def force_on_the_way(run):
    """Mean of the true force over the way, and not over the steps, which are shorter where the force changes fast."""
    lock = run.value("lock_extension") if run.exit_code == 0 else None
    extension, load = runs.pulled(run)
    if is_missing(lock) or not extension:
        return None
    way = np.linspace(SHARED[0] * lock, SHARED[1] * lock, 500)
    return float(np.mean(np.interp(way, extension, load))) + (run.value("balance_offset") or 0.0)


def distance_at_lock(run):
    lock, extension = run.value("lock_extension"), runs.pulled(run)[0]
    if run.exit_code != 0 or is_missing(lock) or not extension:
        return None
    return float(np.interp(lock, extension, pulled_by_distance(run)[0]))


def way_of_slack(run):
    """Knots that slide come nearer by twice the extension; what is longer of the way is no sliding."""
    lock, last = run.value("lock_extension"), distance_at_lock(run)
    return None if last is None else lock - 0.5 * (pulled_by_distance(run)[0][0] - last)


def pulled_by_distance(run):
    """Distance of the knots and load at every reading of the pull."""
    pull = run.phase("pull")
    return pull.get("knot_distance", []), pull.get("load", [])


def stretched_length(run, load_at_end):
    """4 k_s over the slope of the chord from half of a load to that load, behind the lock [m]."""
    lock = run.value("lock_extension") if run.exit_code == 0 else None
    material = run.method.get("material")
    extension, load = runs.pulled(run)
    if is_missing(lock) or not isinstance(material, dict) or not extension:
        return None
    behind = [(f, s) for s, f in zip(extension, load) if s >= lock]
    force, way = np.maximum.accumulate([f for f, _ in behind]), [s for _, s in behind]
    loads = (0.5 * load_at_end, load_at_end)
    if len(behind) < 2 or force[0] > loads[0] or force[-1] < loads[1]:
        return None
    first, last = np.interp(loads, force, way)
    return 4.0 * material["stretching_stiffness"] * (last - first) / (loads[1] - loads[0])


def added_by_knots(run, load_at_end):
    length, lock = stretched_length(run, load_at_end), run.value("lock_extension")
    if length is None or is_missing(lock):
        return None
    half_turns = math.pi * (0.5 * run.method["machine"]["roller_diameter"] + run.method["material"]["radius"])
    return length - 2.0 * (run.method["specimen"]["end_to_end"] + lock + half_turns)


def stiffness_error(starts, load_at_end):
    """What it makes of the length [m]."""
    share = shares_of(starts, "locked_stiffness", "locked_stiffness")
    length = mean([stretched_length(run, load_at_end) for run in starts])
    return None if share is None or length is None else share * length


def shares_of(starts, key, reading, times=None):
    """The largest error given, over its reading; `times` as much of it as it is, where that is given."""
    known = []
    for run in starts:
        value, error = run.value(reading), run.value(key + "_error")
        if not is_missing(value) and not is_missing(error) and value:
            known.append(times * error if times else error / abs(value))
    return max(known, default=None)


def mean(values):
    known = [value for value in values if value is not None]
    return statistics.fmean(known) if known else None


def standard_error(values):
    known = [value for value in values if value is not None]
    return statistics.stdev(known) / math.sqrt(len(known)) if len(known) > 1 else None


def text(value):
    return "none" if is_missing(value) else format(value, ".3g")


def with_places(places, values):
    known = sorted((1e3 * place, value) for place, value in zip(places, values) if value is not None)
    return [place for place, _ in known], [value for _, value in known]
