"""The stability matrix: what became of tests drawn at random over everything that a method may say."""
import math
import statistics

import plots
from draws import PAPER_RADIUS, PAPER_SPEED, Draw
from outcomes import GAVE_UP, NEVER, STATUS, Outcome, run_all
from table import Report, Table, at_most

GAVE_UP_SHARE = 0.01  # of the runs that the solver may give up, each with its reason
COLOURS = {"ended": "tab:green", "refused": "0.6", "not at rest": "tab:orange", "solver": "tab:red"}  # else black
MAP_AXES = {"radius": "radius h [m]", "bending_stiffness": "k_b [N m²]", "stretching": "k_s h²/k_b",
            "friction_coefficient": "μ", "bending_time": "h² √(ρA/k_b) [s]", "speed": "speed / (1.04 h/s)"}


class Matrix:
    """The table that a report (table.py) is made of: in the CSV one row a run, in the text how many of them held."""

    def __init__(self, outcomes):
        self.outcomes = outcomes
        self.drawn = list(dict.fromkeys(key for outcome in outcomes for key in outcome.draw.values))
        self.CSV_HEADER = ["run"] + self.drawn + Outcome.FACTS + Outcome.READINGS
        self.tables = [self.statuses(), self.readings(), self.shares()]

    def csv_rows(self):
        for outcome in self.outcomes:
            values = [outcome.get(key) for key in self.CSV_HEADER[1:]]
            yield [outcome.draw.number] + ["" if value is None else value for value in values]

    def failed(self):
        return [line for table in self.tables for line in table.failed()]

    def markdown(self):
        meaning = "\n".join(f"- **{status}**: {words}" for status, words in STATUS.items())
        return "\n".join([table.markdown() for table in self.tables] + [meaning + "\n", self.diagnoses()])

    def with_status(self, *statuses):
        return [outcome for outcome in self.outcomes if outcome.status in statuses]

    def statuses(self):
        knots = sorted({outcome.get("knot") for outcome in self.outcomes})
        table = Table("What became of the runs", ["all"] + knots)

        def add(name, outcomes, gate):
            counts = [len(outcomes)] + [sum(o.get("knot") == knot for o in outcomes) for knot in knots]
            table.add(name, "runs", counts, [gate] + [None] * len(knots))

        add("all", self.outcomes, None)
        for status in STATUS:
            gate = at_most(0) if status in NEVER else None
            if status == GAVE_UP:
                gate = at_most(math.floor(GAVE_UP_SHARE * len(self.outcomes)))
            add(status, self.with_status(status), gate)
        measured = [outcome for outcome in self.outcomes if outcome.get("knot_type_preserved") is not None]
        add("knot kept", [outcome for outcome in measured if outcome.get("knot_type_preserved")], None)
        add("knot came undone", [outcome for outcome in measured if not outcome.get("knot_type_preserved")], None)
        return table

    def readings(self):
        table = Table("Of those that ended", ["median", "90 %", "largest"])
        ended = self.with_status("ended", "not at rest")
        for name, unit, values in [("penetration", "h", [o.get("max_penetration") for o in ended]),
                                   ("energy balance error", "-", [o.get("energy_balance_error") for o in ended]),
                                   ("Newton iterations a step", "-", [o.work() for o in ended]),
                                   ("rejected steps", "-", [o.get("rejected_steps") for o in ended]),
                                   ("CPU time", "s", [o.cpu_time for o in ended])]:
            table.add(name, unit, quantiles([value for value in values if value is not None]), digits=".3g")
        return table

    def shares(self):
        """Where runs did not end: what they have in common shows."""
        table = Table("Runs that did not end, of those with the same choice", ["did not end", "of"])
        for key in ["knot", "grips", "friction.law", "contact.law", "twist", "accuracy"]:
            for option in sorted({str(o.get(key)) for o in self.outcomes if o.get(key) is not None}):
                chosen = [outcome for outcome in self.outcomes if str(outcome.get(key)) == option]
                table.add(f"{key}: {option}", "runs",
                          [sum(o.status not in ("ended", "refused") for o in chosen), len(chosen)])
        return table

    def diagnoses(self):
        lines = ["## Each run that did not end or was refused", ""]
        for status in STATUS:
            if status != "ended":
                lines += [f"- {status}: {o.draw.number}, {o.get('knot')}, {o.phase or 'not begun'}: {o.reason}"
                          for o in self.with_status(status)]
        return "\n".join(lines if len(lines) > 2 else lines + ["None."]) + "\n"

    def draw(self, file):
        def points(x, y):
            return {status: [(o.get(x), o.get(y)) for o in self.with_status(status)]
                    for status in reversed(STATUS) if self.with_status(status)}

        ended = self.with_status("ended", "not at rest")
        plots.statuses(
            file, {status: COLOURS.get(status, "black") for status in STATUS},
            {(MAP_AXES[x], MAP_AXES[y]): points(x, y)
             for x, y in [("radius", "bending_stiffness"), ("stretching", "friction_coefficient"),
                          ("bending_time", "speed")]},
            {"penetration [h]": [o.get("max_penetration") for o in ended],
             "energy balance error": [o.get("energy_balance_error") for o in ended],
             "Newton iterations a step": [o.work() for o in ended]}, linear=[MAP_AXES["friction_coefficient"]])


def quantiles(values):
    if not values:
        return [None] * 3
    ordered = sorted(values)
    return [statistics.median(ordered), ordered[math.ceil(0.9 * len(ordered)) - 1], ordered[-1]]


def report(runner, seed, numbers, jobs, quick=False, keep=False):
    matrix = Matrix(run_all(runner, [Draw(seed, number, quick) for number in numbers], jobs, keep))
    introduction = (
        f"{len(matrix.outcomes)} tests drawn by seed {seed} over radius (0.3 to 6 mm), k_b (1e-7 to 1e-3 N m²), "
        "k_s h²/k_b (4 to 3e4), friction (0 to 1.5), density (500 to 2000 kg/m³), pre-load (0.2 to 8 k_b/h²), edges (0.5 "
        "to 2 h), speed (x0.1 to x30), and all knots, grips, laws, accuracies and ways with twist. Every length is drawn "
        f"in radii; speed x1 is the source paper's {1e3 * PAPER_SPEED:g} mm/s for h = {1e3 * PAPER_RADIUS:g} mm, "
        f"{PAPER_SPEED / PAPER_RADIUS:.3g} h/s. Each pulls its specimen by some 10 h, overhands by as much as they hide, "
        "and ends at a load of 500 k_b/h² at the latest. `scripts/stress --only RUN` repeats one.")
    return Report("Stability", introduction, [matrix], matrix.draw)
