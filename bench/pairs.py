"""What a test costs now over what it cost before: two builds in turn, and whether their readings are the same."""
import os

import runs
from runs import deviation, divide, mean, median, standard_error
from table import Report, Table, is_
from tighten import KNOT_DISTANCE, MATERIALS, SHIFT, SLIDES

READINGS = ["true_plateau_force", "lock_extension", "locked_stiffness", "true_peak_force"]
ROUNDS = 3  # of a test of which one start is as good as another
OTHERS = {"open overhand": "bench/open_overhand.yaml", "capstan": "config/capstan.yaml", "straight rod": "config/straight.yaml"}


def report(runner, materials, seeds=8, before=None):
    starts = {material: [{"material": material, "specimen.knot_distance": round(KNOT_DISTANCE + SHIFT * k, 9)} for k in range(seeds)]
              for material in materials}
    todo = {material: (runs.METHOD, each, ()) for material, each in starts.items()}
    todo |= {f"{material}, plateau": (runs.METHOD, each, ("--readings", "plateau"))
             for material, each in starts.items() if SLIDES.get(material, True)}
    todo |= {name: (method, [{}] * ROUNDS, ()) for name, method in OTHERS.items()}
    old = runs.Runner(runner.root, before, runner.core, os.path.join(runner.folder, "before"), runner.overrides)
    pairs = {name: [(old.run(f"{name}/{k}", start, method, more), runner.run(f"{name}/{k}", start, method, more))
                    for k, start in enumerate(each)] for name, (method, each, more) in todo.items()}
    cost = Table("Cost", list(pairs))

    def add(words, unit, function, digits=".3g", gate=None):
        cost.add(words, unit, [function(pairs[name]) for name in pairs], gate, digits)

    add("exit codes are 0", "-", lambda each: all(run.exit_code == 0 for pair in each for run in pair), gate=is_(True))
    add("CPU time, before", "s", lambda each: median(a.cpu_time for a, _ in each))
    add("CPU time, now", "s", lambda each: median(b.cpu_time for _, b in each))
    add("now over before, median of pairs", "-", lambda each: median(divide(b.cpu_time, a.cpu_time) for a, b in each))
    add("Newton iterations, now over before", "-", lambda each: median(
        divide(b.value("newton_iterations"), a.value("newton_iterations")) for a, b in each))
    add("share of iterations that are solved by half", "-", lambda each: mean(b.value("solved_by_half") for _, b in each))
    add("peak memory, now", "MB", lambda each: divide(median(b.value("peak_memory") for _, b in each), 1e6))
    add("files, now", "MB", lambda each: median(size_of(b.folder) for _, b in each) / 1e6)
    same = Table(f"Readings of {seeds} starts, now less before, over the standard error of that difference", materials)
    for key in READINGS:
        same.add(key, "-", [in_errors([(a.reading(key), b.reading(key)) for a, b in pairs[name]]) for name in materials], None, ".2g")
    return Report("Cost beside an earlier build",
                  "Both programs run the same methods in turn, on one core, each cold. The starts of a loop are tied "
                  f"{1e3 * SHIFT:g} mm further apart from one to the next.", [cost, same])


def size_of(folder):
    return sum(os.path.getsize(os.path.join(folder, name)) for name in os.listdir(folder))


def in_errors(readings):
    """Of readings before and now: the difference of their means over the standard errors of both."""
    before, now = ([reading for reading in each if reading is not None] for each in zip(*readings))
    if not deviation(before) or not deviation(now):
        return None
    return (mean(now) - mean(before)) / (standard_error(before) ** 2 + standard_error(now) ** 2) ** 0.5
