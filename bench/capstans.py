"""How the force that a strand around a cylinder presses with, and by which it slides, grows with the tension of its ends."""
import math

from predictions import CPU_LIMIT, STARTS, Row, mean_of_all
from runs import read_yaml
from table import above, below, within

METHOD = "config/validation/capstan_pressure.yaml"


def rows(runner, facts):
    return rows_of({turns: [of_start(runner, turns, facts, factor) for factor in STARTS] for turns in facts["turns"]}, facts)


def of_start(runner, turns, facts, factor):
    """Exponents of the normal force between the two light and the two strong tensions."""
    forces = {tension: pressed(runner, turns, tension, factor) for tension in facts["lightly"] + facts["tightly"]}
    return [exponent(forces, *facts[where]) for where in ("lightly", "tightly")]


def pressed(runner, turns, tension, factor):
    """Normal force on the cylinder. With little friction it is what friction adds to the tension, over its coefficient."""
    specimen, rod = (read_yaml(METHOD)[key] for key in ("specimen", "material"))
    radius, tail = specimen["post_diameter"] / 2 + rod["radius"], specimen["tail"] * factor  # that of the centreline
    run = runner.run(f"capstan/{turns:g}_{tension:g}_{factor:g}", {
        "specimen.wrap": 2 * math.pi * turns, "specimen.tail_load": tension * (float(rod["bending_stiffness"]) / radius ** 2),
        "specimen.tail": tail, "specimen.end_to_end": tail}, METHOD, cpu_limit=CPU_LIMIT)
    ratio = run.reading("force_ratio")
    return None if ratio is None else (ratio - 1.0) * tension / run.method["machine"]["roller_friction"]


def exponent(forces, low, high):
    if None in (forces[low], forces[high]) or min(forces[low], forces[high]) <= 0.0:
        return None
    return math.log(forces[high] / forces[low]) / math.log(high / low)


def rows_of(starts, facts):
    """`starts`: {turns: exponents of each start}, the smallest turns first."""
    light, tight = ({turns: mean_of_all([start[at] for start in each]) for turns, each in starts.items()} for at in (0, 1))
    smallest, *others, largest = starts
    bound, source = facts["linear_within"], facts["source"]
    ratio = None if None in light[smallest] + light[largest] else (light[smallest][0] - 1.0) / (light[largest][0] - 1.0)
    return [Row(f"{facts['what']}: {turns:g} turns, touching lightly", "> 1", *light[turns], "", above(1.0), source)
            for turns in others + [largest]] + [
        Row(f"{facts['what']}: excess over 1 of {smallest:g} turns over that of {largest:g}, touching lightly", "< 1", ratio, "", "",
            below(1.0), source)] + [
        Row(f"{facts['what']}: {turns:g} turns, touching all along", "1", *tight[turns], tight[turns][0], within(1 - bound, 1 + bound),
            source) for turns in starts]
