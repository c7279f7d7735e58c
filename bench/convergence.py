"""Whether the readings hold still under mesh, step and tolerances, over perturbed starts; and whether the error that a
run gives beside a reading holds what a fine run finds."""
import statistics

import plots
import runs
import starts
from table import REFERENCE, Gate, Report, Table, at_least, at_most, is_missing
from tighten import SLIDES
from tightness import TightnessLaw, excess_length

MATERIALS = ["nylon", "polypropylene", "pink_vps", "green_vps"]
CONTACT_STIFFNESS = 300.0             # [k_b/h^4] what `material.contact_stiffness: auto` stands for
SHIPPED, DRAFT = "as shipped", "draft"
EDGE, STEP = 0.0032, 0.17             # as shipped, and of `normal` [m, s]


def variants_of(material):
    """What is halved is that of `normal` for loops that slide, or that stretch [h, h, k_b/h^2]."""
    contact_tolerance, presliding, residual = (0.005, 2e-3, 1e-4) if SLIDES.get(material, True) else (0.08, 1e-2, 2e-4)
    return {
        "edges x3/4": {"specimen.edge_length": 0.75 * EDGE},
        "edges x1/2": {"specimen.edge_length": EDGE / 2},
        "longest step halved": {"physics.max_step": STEP / 2},
        "contact tolerance halved": {"physics.contact.tolerance": contact_tolerance / 2},
        "presliding halved": {"physics.friction.presliding": presliding / 2},
        "residual /10": {"physics.residual": residual / 10},
        DRAFT: {"physics.accuracy": "draft"},
        "fine": {"physics.accuracy": "fine"},
    }


HALVED = ("edges x1/2", "longest step halved", "contact tolerance halved", "presliding halved")
FINE_RUN = {"physics.accuracy": "fine", "specimen.refinement": 4.5}
PRELOADS = [0.7, 1.5]                 # of the material's own
PRELOAD = "pre-load x"
# Loops that no estimate of an error was chosen for.
OTHER_LOOPS = {"opposite hands": {"specimen.handedness": "opposite"},
               "longer loop": {"specimen.end_to_end": 0.35, "specimen.tail": 0.04}}
FRICTION = 1.3                        # times the material's own

GATED = ["polypropylene"]
CHANGE_GATES = {"true_plateau_force": at_most(0.03), "lock_extension": at_most(0.02), "locked_stiffness": at_most(0.01)}
RIPPLE_GATE = at_most(0.1)
HONEST_GATE = at_least(0.9)           # of the true differences lie within the errors given

READINGS = {"true_plateau_force": ("plateau force", "N"), "true_peak_force": ("peak force", "N"),
            "lock_extension": ("lock extension", "m"), "locked_stiffness": ("locked stiffness", "N/m")}
WITH_ERROR = ["true_plateau_force", "lock_extension", "locked_stiffness"]


def readings_of(material):
    """Knots that do not slide have no plateau and no lock."""
    return WITH_ERROR if SLIDES.get(material, True) else ["true_peak_force", "locked_stiffness"]


def report(runner, materials, seeds=3):
    tables, curves, all_cases, failures = [], {}, [], []
    for material in materials:
        variants, cases = run_all(runner, material, seeds)
        tables.append(table_of(material, variants, tightness_law(variants, cases)))
        all_cases += cases
        failures += failures_of(material, variants, cases)
        curves[material] = {name: with_millimetres(starts[0]) for name, starts in variants.items()}
    tables += [errors_of(material, [case for case in all_cases if case.material == material])
               for material in materials]
    tables.append(honesty(materials, all_cases))
    if failures:
        tables.append(table_of_failures(failures))
    return Report("Convergence of the readings",
                  f"`config/tighten.yaml` from tying to the end of the pull, {seeds} starts of each variant: the knots "
                  f"{1e3 * starts.SHIFT:g} mm further apart from one start to the next. Each run ties its own knot. Means and "
                  "changes of means are over the starts whose runs went to their end, changes over those that both "
                  "variants have; a gate also fails where a start is missing. Ripple, CPU time and real-time factor "
                  "are the worst of the starts. At the same excess length: the plateau against that as shipped at the "
                  "pre-load that leaves as much rod in the knots (the parabola through three pre-loads; missing beyond them), "
                  "so that what moves the sliding is told apart from what moves the tying. Errors: the reading's true difference to a fine run "
                  "(`physics.accuracy=fine`, `specimen.refinement=4.5`) of the same start, pre-load and loop, against the "
                  "error that the run itself gives; one that only one of them has counts as not within, what neither has does not count. "
                  f"No error was chosen after {', '.join(OTHER_LOOPS)} and friction x{FRICTION:g}. The picture has the "
                  "first start of each variant.", tables,
                  lambda file: plots.panels(file, curves, "extension s [mm]", "load F [N]"))


def keys_with_error(material):
    return [key for key in readings_of(material) if key in WITH_ERROR]


def run_all(runner, material, seeds):
    """The variants, name -> one run a start; and the cases in which errors are judged."""
    def from_starts(name, settings):
        folder = f"{material}/{name.replace(' ', '_').replace('/', '_')}"
        return [runner.run(f"{folder}/{k}", {"material": material, **starts.start(k), **settings})
                for k in range(seeds)]

    variants = {SHIPPED: from_starts(SHIPPED, {})}
    first = variants[SHIPPED][0]
    for name, settings in {**variants_of(material), **stiffer(first)}.items():
        variants[name] = from_starts(name, settings)
    fine = from_starts("fine run", FINE_RUN)
    cases = [Case(material, name, variants[name], fine) for name in (DRAFT, SHIPPED)]
    for name, settings in {**other_preloads(first), **OTHER_LOOPS, **rougher(first)}.items():
        fine = from_starts("fine run, " + name, {**FINE_RUN, **settings})
        cases.append(Case(material, name, from_starts(name, settings), fine))
    return variants, cases


def changed_material(shipped, name, change):
    """The material as it was resolved, with what `change` makes of it."""
    material = shipped.method.get("material")
    return {name: {"material": {**material, **change(material)}}} if isinstance(material, dict) else {}


def stiffer(shipped):
    return changed_material(shipped, "contact stiffness x3", lambda material: {
        "contact_stiffness": 3.0 * CONTACT_STIFFNESS * material["bending_stiffness"] / material["radius"] ** 4})


def rougher(shipped):
    return changed_material(shipped, f"friction x{FRICTION:g}", lambda material: {
        "friction_coefficient": FRICTION * material["friction_coefficient"]})


def other_preloads(shipped):
    preload = shipped.value("preload")
    return {} if preload is None else {f"{PRELOAD}{factor:g}": {"specimen.preload": factor * preload}
                                       for factor in PRELOADS}


def tightness_law(variants, cases):
    """Of the runs as shipped at their three pre-loads."""
    tied = [variants[SHIPPED]] + [case.starts for case in cases if case.name.startswith(PRELOAD)]
    return TightnessLaw([(mean(excess_lengths(starts)), mean(readings(starts, "true_plateau_force")))
                         for starts in tied])


def excess_lengths(starts):
    """Of the runs that have a plateau."""
    return [None if reading(run, "true_plateau_force") is None else excess_length(run) for run in starts]


def change_at_same_tightness(law, starts):
    return runs.relative_change(mean(readings(starts, "true_plateau_force")),
                                law.force_at(mean(excess_lengths(starts))))


def reading(run, key):
    """Of a run that went to its end; what another left is not a reading."""
    value = run.value(key) if run.exit_code == 0 else None
    return None if is_missing(value) else value


def readings(starts, key):
    return [reading(run, key) for run in starts]


def present(values):
    return [value for value in values if value is not None]


def mean(values):
    known = present(values)
    return statistics.fmean(known) if known else None


def scatter(values):
    """Standard deviation over mean."""
    known = present(values)
    return runs.divide(statistics.stdev(known), mean(known)) if len(known) > 1 else None


def pairs(values, others):
    """Of the starts that both have."""
    return [(value, other) for value, other in zip(values, others) if value is not None and other is not None]


def change_of_means(values, shipped):
    both = pairs(values, shipped)
    return runs.relative_change(mean([value for value, _ in both]), mean([other for _, other in both]))


def over_every_start(gate, *values):
    """The gate, which a missing start fails."""
    if all(value is not None for starts in values for value in starts):
        return gate
    return Gate(f"{gate.words}, of every start", lambda _: False)


def ripple(starts):
    return [runs.divide(reading(run, "plateau_force_sd"), reading(run, "true_plateau_force")) for run in starts]


def worst(choose, values):
    return choose(present(values), default=None)


def table_of(material, variants, law=None):
    """`law`: of tightness; none where all variants are tied alike."""
    each = list(variants.values())

    def gates(bound, values_of, names):
        """Where the material is gated, of the variants named."""
        return [over_every_start(bound, *values_of(starts)) if bound and material in GATED and name in names else None
                for name, starts in variants.items()]

    table = Table(material, list(variants))
    table.add("exit codes", "-", [listed([run.exit_code for run in starts]) for starts in each])
    table.add("motion pattern", "-", [" / ".join(sorted({str(run.value("motion_pattern")) for run in starts}))
                                      for starts in each])
    for key in readings_of(material):
        words, unit = READINGS[key]
        shipped = readings(variants[SHIPPED], key)
        table.add(words, unit, [mean(readings(starts, key)) for starts in each])
        table.add(f"scatter of the {words}", "-", [scatter(readings(starts, key)) for starts in each], None, ".2g")
        table.add(f"relative change of the {words}", "-",
                  [REFERENCE] + [change_of_means(readings(starts, key), shipped) for starts in each[1:]],
                  gates(CHANGE_GATES.get(key), lambda starts, k=key, s=shipped: (readings(starts, k), s), HALVED),
                  ".2g")
        if key == "true_plateau_force" and law:
            table.add("excess length of the tied knots", "m", [mean(excess_lengths(starts)) for starts in each],
                      None, ".6f")
            table.add("relative change of the plateau force at the same excess length", "-",
                      [REFERENCE] + [change_at_same_tightness(law, starts) for starts in each[1:]],
                      gates(CHANGE_GATES[key], lambda starts, s=shipped: (readings(starts, "true_plateau_force"), s), HALVED),
                      ".2g")
        if key == "true_plateau_force":
            table.add("ripple of the plateau", "-", [worst(max, ripple(starts)) for starts in each],
                      gates(RIPPLE_GATE, lambda starts: (ripple(starts),), [SHIPPED, *HALVED]), ".2g")
    table.add("CPU time", "s", [worst(max, [run.cpu_time for run in starts if run.exit_code == 0]) for starts in each],
              None, ".2f")
    table.add("real-time factor", "-",
              [worst(min, [run.real_time_factor() for run in starts if run.exit_code == 0]) for starts in each],
              None, ".1f")
    return table


class Case:
    """Runs whose own errors are judged by fine runs of the same starts and pre-load."""

    def __init__(self, material, name, starts, fine):
        self.material, self.name, self.starts, self.fine = material, name, starts, fine

    def differences(self, key):
        return [None if value is None or fine is None else abs(value - fine)
                for value, fine in zip(readings(self.starts, key), readings(self.fine, key))]

    def errors(self, key):
        return readings(self.starts, key.replace("true_", "") + "_error")

    def count(self, key):
        """Starts within, missing, and all; where neither run has a reading, as knots that come open in both, there is
        nothing to judge."""
        judged = [each for each in zip(readings(self.starts, key), readings(self.fine, key)) if each != (None, None)]
        both = pairs(self.differences(key), self.errors(key))
        return Count(sum(difference <= error for difference, error in both), len(judged) - len(both), len(judged))


class Count:
    def __init__(self, within=0, missing=0, total=0):
        self.within, self.missing, self.total = within, missing, total

    def __add__(self, other):
        return Count(self.within + other.within, self.missing + other.missing, self.total + other.total)

    def text(self):
        return f"{self.within} of {self.total}" if self.total else "none to judge"


def errors_of(material, cases):
    table = Table(f"Errors: {material}", [case.name for case in cases])
    for key in keys_with_error(material):
        words, unit = READINGS[key]
        table.add(f"{words}: true difference at each start", unit, [listed(case.differences(key)) for case in cases])
        table.add(f"{words}: error given", unit, [listed(case.errors(key)) for case in cases])
        table.add(f"{words}: differences within", "-", [case.count(key).text() for case in cases])
    return table


def honesty(materials, cases):
    """One column a reading and one for all."""
    def count(material, key):
        own = [case for case in cases if case.material == material and key in keys_with_error(material)]
        return sum((case.count(key) for case in own), Count())

    counts = {material: [count(material, key) for key in WITH_ERROR] for material in materials}
    for row in counts.values():
        row.append(sum(row, Count()))
    table = Table("Errors: how many true differences lie within", [READINGS[key][0] for key in WITH_ERROR] + ["all"])
    for material, row in counts.items():
        table.add(material, "-", [count.text() for count in row])
    together = [sum(column, Count()) for column in zip(*counts.values())]
    table.add("missing", "-", [count.missing for count in together])
    table.add("share within", "-", [runs.divide(count.within, count.total) for count in together],
              [HONEST_GATE if count.total else None for count in together], ".2f")
    return table


def failures_of(material, variants, cases):
    """Of all runs, each once, those that have not all readings: name, exit code, reason."""
    named = {f"{material}, {name}, start {k}": run for name, starts in variants.items() for k, run in enumerate(starts)}
    for case in cases:
        named.update({f"{material}, fine run{'' if case.name in variants else ', ' + case.name}, start {k}": run
                      for k, run in enumerate(case.fine)})
        named.update({f"{material}, {case.name}, start {k}": run for k, run in enumerate(case.starts)})
    return [(name, run.exit_code, reason_of(run, material)) for name, run in named.items()
            if None in [reading(run, key) for key in readings_of(material)]]


def reason_of(run, material):
    if run.exit_code != 0:
        return run.value("reason") or run.said or "none given"
    lacks = [READINGS[key][0] for key in readings_of(material) if reading(run, key) is None]
    return f"{run.value('motion_pattern')}: no {', no '.join(lacks)}"


def table_of_failures(failures):
    table = Table("Runs that failed, or lack a reading", ["exit code", "reason"])
    for name, exit_code, reason in failures:
        table.add(name, "-", [exit_code, reason.replace("\n", " ").replace("|", "/")])
    return table


def listed(values):
    return ", ".join("missing" if value is None else format(value, ".3g") for value in values)


def with_millimetres(run):
    s, load = runs.pulled(run)
    return [1e3 * value for value in s], load
