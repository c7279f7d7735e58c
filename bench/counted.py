"""Newton iterations of short tests: work that is the same on every machine but for what rounding does to it.

Another compiler, CPU or mathematical library rounds otherwise: without the FMA instructions in the C library's sines one run of nylon
takes 4.7 % fewer iterations. The starts of a test here differ by a billionth of a length, which does the same. The iterations of one run
of nylon then scatter by 2 % (standard deviation), and those of a capstan not at all. A test is therefore held by the mean over some
starts, and the more it scatters the more starts it has.
"""
import csv
import math
import os

from runs import JOBS, METHOD, deviation, divide, known, mean
from table import Report, Table, at_most, is_

MATERIALS = []
STARTS = 12         # of each test, of which the mean and the scatter are kept
NUDGE = 1e-9        # by which a length differs from one start to the next, relative
LEAST_BOUND = 0.03  # by which iterations may differ: changes of the solver that are worth a look move them by more
SIGMAS = 4.0        # that the bound is wide, where the starts scatter more: other rounding alone fails one test in ten thousand
WIDEST = 0.05       # that a bound may become; above it a test needs more starts
TABLE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "results/counted.csv")
ITERATIONS, SCATTER, STEPS, REJECTED = ("Newton iterations, mean", "standard deviation of one start over the mean", "time steps, mean",
                                        "rejected steps, mean")
RENEW = "scripts/bench counted"


class CountedTest:
    """`length`: the key and the value of the length in which the starts differ; `checked`: how many of them counted_work_test runs."""

    def __init__(self, method, settings, length, checked):
        self.method, self.settings, self.length, self.checked = method, settings, length, checked

    def start(self, k):
        key, value = self.length
        return {**self.settings, key: value * (1.0 + k * NUDGE)}


def loop(material, checked):
    return CountedTest(METHOD, {"material": material, "physics.accuracy": "draft"}, ("specimen.knot_distance", 0.15), checked)


TESTS = {
    "nylon": loop("nylon", 6),
    "polypropylene": loop("polypropylene", 2),
    "pink_vps": loop("pink_vps", 3),
    "green_vps": loop("green_vps", 6),
    "open overhand": CountedTest("bench/open_overhand.yaml", {"program.2.pull.until": {"extension": 0.3}}, ("specimen.length", 1.0), 6),
    "capstan": CountedTest("config/capstan.yaml", {}, ("specimen.wrap", 2.0 * math.pi), 1),
    "straight rod": CountedTest("config/straight.yaml", {}, ("specimen.length", 0.25), 1),
}


class Count:
    """What the starts of a test took."""

    def __init__(self, runs):
        self.ended = all(run.exit_code == 0 for run in runs)
        self.iterations, self.steps, self.rejected = ([run.value(key) for run in runs]
                                                      for key in ("newton_iterations", "steps", "rejected_steps"))


class Held:
    """A row of the table: what a test took when the table was written."""

    def __init__(self, values):
        self.iterations, self.scatter, self.steps, self.rejected = (float(values.get(key) or "nan")
                                                                    for key in (ITERATIONS, SCATTER, STEPS, REJECTED))


def counts(runner, starts):
    """{test: Count}; `starts`: {test: how many}."""
    places = [(name, k) for name in TESTS for k in range(starts[name])]
    runs = runner.run_all([(f"{name.replace(' ', '_')}/{k}", TESTS[name].start(k), TESTS[name].method) for name, k in places], JOBS)
    return {name: Count([run for (its, _), run in zip(places, runs) if its == name]) for name in TESTS}


def bound(scatter, starts):
    """By which the mean of so many starts may differ from that of the table, relative."""
    return max(LEAST_BOUND, SIGMAS * scatter * math.sqrt(1.0 / starts + 1.0 / STARTS))


def held():
    """{test: Held}; empty where there is no table."""
    rows = {}
    try:
        with open(TABLE, encoding="utf-8", newline="") as text:
            for row in csv.DictReader(text):
                rows.setdefault(row["run"], {})[row["quantity"]] = row["value"]
    except OSError:
        return {}
    return {name: Held(values) for name, values in rows.items()}


def departures(table, found):
    """A line for each test that did not end, that the table has not, or whose iterations differ from it by more than the bound."""
    lines = []
    for name, count in found.items():
        if not count.ended or len(known(count.iterations)) < len(count.iterations):
            lines.append(f"{name}: a run failed")
        elif name not in table:
            lines.append(f"{name}: the table has no such test")
        else:
            now, before = mean(count.iterations), table[name].iterations
            allowed = bound(table[name].scatter, len(count.iterations))
            if not abs(now / before - 1.0) <= allowed:  # a value that is missing fails
                lines.append(f"{name}: {now:.0f} Newton iterations instead of {before:.0f}: {100.0 * (now / before - 1.0):+.1f} %, "
                             f"and {100.0 * allowed:.1f} % are allowed")
    return lines + [f"{name}: the table has it, and no test has" for name in table if name not in found]


def side_by_side(table, found):
    """Lines to look at: what each test takes, and took."""
    lines = [f"{'':14}{'iterations':>20}{'steps':>16}{'rejected':>16}   now and in the table"]
    for name, count in found.items():
        before = table.get(name)
        pairs = [(mean(values), getattr(before, key, math.nan)) for key, values in
                 (("iterations", count.iterations), ("steps", count.steps), ("rejected", count.rejected))]
        cells = [f"{math.nan if now is None else now:.0f} {then:.0f}" for now, then in pairs]
        lines.append(f"{name:14}{cells[0]:>20}{cells[1]:>16}{cells[2]:>16}")
    return "\n".join(lines)


def report(runner, _):
    before, found = held(), counts(runner, {name: STARTS for name in TESTS})
    table = Table(f"Work of {STARTS} starts", list(TESTS))
    add, each = table.add, list(found.values())
    scatter = [divide(deviation(count.iterations), mean(count.iterations)) for count in each]
    add("every start ended", "-", [count.ended for count in each], is_(True))
    add(ITERATIONS, "-", [mean(count.iterations) for count in each], digits=".1f")
    add("least", "-", [min(known(count.iterations), default=None) for count in each])
    add("largest", "-", [max(known(count.iterations), default=None) for count in each])
    add(SCATTER, "-", scatter, digits=".2g")
    add(STEPS, "-", [mean(count.steps) for count in each], digits=".1f")
    add(REJECTED, "-", [mean(count.rejected) for count in each], digits=".1f")
    add("iterations over those of the table before", "-",
        [divide(mean(count.iterations), before[name].iterations) if name in before else None for name, count in found.items()])
    add("starts that counted_work_test runs", "-", [test.checked for test in TESTS.values()])
    add("change that it allows", "-",
        [None if one is None else bound(one, test.checked) for one, test in zip(scatter, TESTS.values())], at_most(WIDEST), ".3f")
    return Report("Counted work",
                  f"The four materials through `{METHOD}` at `draft`, an open overhand, a capstan and a straight rod, {STARTS} times "
                  f"each. A length differs by {NUDGE:g} of itself from one start to the next, which changes little but the rounding, as "
                  "another compiler or CPU does. `counted_work_test` runs fewer starts and holds the mean of their iterations against "
                  f"the mean in `counted.csv`. It may differ by {100.0 * LEAST_BOUND:g} % in either direction, or by {SIGMAS:g} standard "
                  f"deviations of this difference where that is more. No time is tested. `{RENEW}` renews the table.", [table])
