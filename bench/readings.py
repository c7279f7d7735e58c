"""Whether the error that a run gives beside a reading holds what a finer run finds, over loops drawn at random, which nobody tuned
anything on."""
import os
import sys

import plots
from draws import PAPER_RADIUS, Draw, significant
from runs import divide, known, median
from table import Report, Table, at_least, at_most

MATERIALS = ["limp braid", "stiff braid", "cable", "solid"]  # kinds of rod; each test draws its own, or soft ones alone
SEED, COUNT = 19, 40
HALVED = {True: 4.0, False: 4.5}   # twice the refinement of a rope at `normal`, whose strands roll or not
PRESLIDING = {True: 1.25e-3, False: 5e-4}  # [h] a quarter of a rope's at `normal`
STEP = 0.025                       # [s] a seventh
TIED_HARD, FINEST = 6.0, 4 / 3     # pre-load [k_b/h^2] from which on `auto` has shorter edges, and by how much at most
CPU_LIMIT = 300                    # [s]
WITHIN = 0.95                      # of the true differences
WIDTH = 3.0                        # median error given over the median true difference
READINGS = {"plateau_force": ("plateau force", "true_plateau_force"),
            "lock_extension": ("lock extension", "lock_extension"),
            "locked_stiffness": ("locked stiffness", "locked_stiffness")}

# What is drawn: three of four loops have friction at the surface and among fibres, as shipped materials do, the others
# friction on centrelines and elastic bends.
ROLLS = 0.75
FIBRES = {"friction_moment": (0.03, 0.12), "stick_ratio": (5.0, 40.0), "compaction": (5e-4, 3e-3),
          "rolling_resistance": (0.1, 0.35)}  # of ropes
TWISTING = {True: (0.15, 0.4), False: (2 / 3, 2 / 3)}  # k_t/k_b of a rope, and of a solid rod with Poisson's ratio 1/2
HYSTERESIS = {"friction_moment": (0.01, 0.03), "stick_ratio": (4.0, 20.0), "rolling_hysteresis": (0.1, 0.3)}  # of solids
SIZES = [0.0005, PAPER_RADIUS, 0.016]  # radii of a thread, of the paper's ropes and of a hawser [m]
RODS = {"limp braid": (1e4, 5e4), "stiff braid": (1e3, 1e4), "cable": (10.0, 1e3), "solid": (4.0, 4.0),
        "soft": (4.0, 4.0)}  # k_s h^2/k_b; soft: a solid rod that always rolls
PRELOAD = {True: (0.5, 4.0), False: (2.0, 50.0)}  # of a solid rod, and of a rope [k_b/h^2]
DISTANCE = (0.11, 0.19)                # e for the paper's radius [m]
LONGEST_LOOP = 2.0                     # L for the paper's radius [m]
CLEARANCE = 26.0                       # L - e by which coils clear rollers of the default size [h]


def report(runner, kinds, seed=SEED, count=COUNT):
    unknown = [kind for kind in kinds if kind not in RODS]
    if unknown:
        print(f"scripts/bench: readings draws {', '.join(RODS)}, but no {unknown[0]}", file=sys.stderr)
        sys.exit(2)
    draws = [Stranger(seed, number, kinds) for number in range(count)]
    todo = [(f"{draw.seed}/{draw.number}/{name}", {**draw.settings, **settings}) for draw in draws
            for name, settings in (("normal", {}), ("fine", fine_run(draw)))]
    done = runner.run_all(todo, cpu_limit=CPU_LIMIT)
    pairs = list(zip(draws, done[::2], done[1::2]))
    judged = {key: [Judgement(key, *pair) for pair in pairs] for key in READINGS}
    tables = [summary(judged)] + [table_of(key, judged[key]) for key in READINGS] + [table_of_runs(pairs)]
    return Report("Errors beside readings",
                  f"{count} fisherman's loops drawn with seed {seed} (`--seed` draws others): both hands, friction "
                  "0.2 to 0.9, pre-load 2 to 50 k_b/h² (of a solid rod 0.5 to 4), "
                  "e from 0.11 to 0.19 m and L from where the coils clear the rollers to 2 m for the paper's radius, "
                  "three sizes, four kinds of rod. Each is run as it is by default and with "
                  "`physics.accuracy=fine`, edges in the knots half as long, a quarter of the presliding displacement "
                  f"and steps of {STEP:g} s at most. The true difference of a reading is "
                  "that between both; it is within where it is at most the error given. A reading that only one of "
                  "both has is not within, and neither is one without an error; one that neither has is. "
                  "Readings are in units of k_b/h², h and k_b/h³.", tables,
                  lambda file: plots.error_against_difference(file, {
                      READINGS[key][0]: [(one.difference, one.error, one.holds) for one in each]
                      for key, each in judged.items()}))


def fine_run(draw):
    """Edges in a rope's knots are half as long as by default, whatever its pre-load; those of a solid rod as in a
    rope. Presliding and steps are shorter than at `fine`, because both runs would share their error."""
    shorter = min(max((draw.preload / TIED_HARD) ** 0.25, 1.0), FINEST)
    return {"physics.accuracy": "fine", "specimen.refinement": round(HALVED[draw.rolls] * shorter, 4),
            "physics.friction.presliding": PRESLIDING[draw.rolls], "physics.max_step": STEP}


class Stranger(Draw):
    """A loop. Sections of solid rods are soft where friction is at the surface."""

    def __init__(self, seed, number, kinds=tuple(MATERIALS)):
        self.kinds = list(kinds)
        super().__init__(seed, number)

    def draw(self):
        rod = self.choice("rod", self.kinds)
        h = self.radius = self.choice("radius", SIZES)
        solid, soft = rod in ("solid", "soft"), rod == "soft"
        stretching = self.log_uniform("stretching", *RODS[rod])
        force = self.force = self.log_uniform("bending_force", 0.1, 20.0)
        low, high = PRELOAD[solid]
        self.preload = self.log_uniform("preload", low, min(high, stretching))
        friction = self.uniform("friction_coefficient", 0.2, 0.9)
        bending = significant(force * h ** 2)
        self.settings["material"] = {
            "radius": h, "density": self.uniform("density", 800.0, 1400.0),
            "stretching_stiffness": significant(stretching * force), "bending_stiffness": bending,
            "twisting_stiffness": significant(bending * self.uniform("twisting", *TWISTING[not solid])),
            "friction_coefficient": friction}
        scale = h / PAPER_RADIUS
        distance = self.uniform("knot_distance", *DISTANCE)
        length = self.log_uniform("end_to_end", distance + CLEARANCE * PAPER_RADIUS, LONGEST_LOOP)
        self.settings.update({
            "specimen.handedness": self.choice("handedness", ["same", "opposite"]),
            "specimen.preload": significant(self.preload * force),
            "specimen.knot_distance": significant(distance * scale),
            "specimen.end_to_end": significant(length * scale),
        })
        if solid:
            self.values["stretching"] = 4.0
        self.draw_section(HYSTERESIS if solid else FIBRES, always=soft)
        if solid and self.rolls:
            self.settings["material"].update(section="soft", stretching_law="neo_hookean")

    def draw_section(self, laws, always):
        self.rolls = self.keep("rolls", self.random.random() < ROLLS or always)
        drawn = {key: self.log_uniform(key, *ends) for key, ends in laws.items()}
        self.settings["material"].update(
            {"friction_couple": 1.0, "bending_law": "frictional", **drawn} if self.rolls else {"friction_couple": 0.0})

    def unit_of(self, key):
        """In which the reading of this key does not depend on the size [N, m or N/m]."""
        return {"plateau_force": self.force, "lock_extension": self.radius}.get(key, self.force / self.radius)

    def title(self):
        v = self.values
        section = f", M0 {v['friction_moment']:.3g}, mu_r {v.get('rolling_resistance', 0.0):.2g}" if self.rolls else ", centreline"
        return (f"{self.number}: {v['rod']}{section}, h {1e3 * v['radius']:.3g} mm, {v['handedness']} hands, mu "
                f"{v['friction_coefficient']:.2f}, F_p h^2/k_b {v['preload']:.3g}, e/h "
                f"{v['knot_distance'] / PAPER_RADIUS:.3g}, L/h {v['end_to_end'] / PAPER_RADIUS:.3g}")


class Judgement:
    """Of one reading of one test."""

    def __init__(self, key, draw, run, fine):
        unit = draw.unit_of(key)
        self.title = draw.title()
        self.reading, self.fine = (divide(one.reading(READINGS[key][1]), unit) for one in (run, fine))
        self.error = divide(run.reading(key + "_error"), unit)
        self.reason = reason_of(run, key + "_error") if self.error is None else ""
        both = self.reading is not None and self.fine is not None
        self.difference = abs(self.reading - self.fine) if both else None
        nothing = self.reading is None and self.fine is None
        self.holds = nothing or (both and self.error is not None and self.difference <= self.error)


def reason_of(run, key):
    """What result.yaml says, behind the null, of a reading that a run does not have."""
    if run.exit_code != 0:
        return run.said or f"exit {run.exit_code}"
    try:
        with open(os.path.join(run.folder, "result.yaml"), encoding="utf-8") as lines:
            found = [line for line in lines if line.startswith(key + ": null")]
    except OSError:
        found = []
    return found[0].partition("#")[2].strip() if found else ""


def summary(judged):
    table = Table("Errors that hold", [READINGS[key][0] for key in judged])
    each = list(judged.values())
    both = [[one for one in some if one.difference is not None and one.error is not None] for some in each]
    differences = [median(divide(one.difference, abs(one.fine)) for one in some) for some in both]
    errors = [median(divide(one.error, abs(one.reading)) for one in some) for some in both]
    table.add("tests", "-", [len(some) for some in each])
    table.add("within", "-", [sum(one.holds for one in some) for some in each],
              [at_least(WITHIN * len(some)) for some in each])
    table.add("of them without a reading in both runs", "-",
              [len(some) - len(known(one.reading if one.fine is None else one.fine for one in some)) for some in each])
    table.add("outside the error given", "-", [sum(not one.holds for one in some) for some in both])
    table.add("with a reading in one run only", "-",
              [sum((one.reading is None) != (one.fine is None) for one in some) for some in each])
    table.add("median true difference, relative", "-", differences, None, ".2g")
    table.add("median error given, relative", "-", errors, None, ".2g")
    table.add("median error given over median true difference", "-", [divide(*two) for two in zip(errors, differences)],
              at_most(WIDTH), ".2g")
    return table


def table_of(key, judged):
    table = Table(READINGS[key][0].capitalize(), ["reading", "fine run", "true difference", "error given", "within",
                                                  "reason where there is none"])
    for one in judged:
        table.add(one.title, "-", [one.reading, one.fine, one.difference, one.error, bool(one.holds), in_a_cell(one.reason)],
                  None, ".3g")
    return table


def table_of_runs(pairs):
    table = Table("Runs", ["exit code", "of the fine run", "motion pattern", "of the fine run: pattern", "CPU time [s]",
                           "of the fine run: CPU time [s]", "said"])
    for draw, run, fine in pairs:
        table.add(draw.title(), "-", [run.exit_code, fine.exit_code, run.value("motion_pattern"), fine.value("motion_pattern"),
                                      run.cpu_time, fine.cpu_time, in_a_cell(run.said or fine.said)], None, ".2f")
    return table


def in_a_cell(text):
    return text.replace("\n", " ").replace("|", "/")
