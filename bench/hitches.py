"""How the force that a clove hitch presses on its post with, and by which it slides along it, grows with the pre-load of both ends."""
import csv
import os

import numpy as np

from predictions import CPU_LIMIT, STARTS, Row, mean_of_all
from runs import read_yaml
from table import above, at_most, within

METHOD = "config/validation/clove_hitch_pressure.yaml"
WHERE = {"lightly": "touching lightly", "tightly": "touching all along"}


def rows(runner, facts):
    return rows_of({rope: [{where: [pressed(runner, rope, settings, tension, factor) for tension in facts[where]] for where in WHERE}
                           for factor in STARTS] for rope, settings in facts["ropes"].items()}, facts)


def pressed(runner, rope, settings, tension, factor):
    """Tension of the ends and normal force on the post [k_b/R^2, R radius of the strand's centreline]; None where the run gave up."""
    material = read_yaml(f"config/materials/{settings['material']}.yaml")
    scale = scale_of(material)
    tail = read_yaml(METHOD)["specimen"]["tail"]
    run = runner.run(f"hitch/{rope.replace(' ', '_')}_{tension:g}_{factor:g}", {
        **settings, "material.friction_coefficient": 0, "specimen.preload": tension * scale,
        "specimen.tail": round(tail * factor, 9)}, METHOD, more=["--shapes"], cpu_limit=CPU_LIMIT)
    if run.exit_code != 0:
        return None
    shape = run.last_shape()
    between = strands_on_strands(os.path.join(run.folder, "samples.csv"), shape["time"][0])
    stretch = stretch_of(shape["tension"][:-1] / float(material["stretching_stiffness"]), run.method["material"].get("stretching_law"))
    return tension_of(shape) / scale, post_force(shape, stretch, between) / scale


def scale_of(material):
    """k_b/R^2, the post being so many radii of the rod."""
    post = read_yaml("config/knots/clove_hitch.yaml")["posts"][0]["radius"]
    return float(material["bending_stiffness"]) / ((post + 1) * material["radius"]) ** 2


def strands_on_strands(samples, time):
    """Sum of normal forces of the rod on itself at that time of a test."""
    with open(samples, encoding="utf-8", newline="") as text:
        _, *answers = csv.DictReader(text)  # the first row has units
    return float(min(answers, key=lambda answer: abs(float(answer["time"]) - time))["normal_force"])


def tension_of(shape):
    """Mean of both ends."""
    return (shape["tension"][0] + shape["tension"][-2]) / 2


def stretch_of(pull, law):
    """Of edges under `pull`, their tension over k_s, by the law's name."""
    stretch = np.linspace(0.5, 10.0, 10001)
    return np.interp(pull, (stretch - stretch ** -2) / 3, stretch) if law == "neo_hookean" else 1 + pull


def post_force(shape, stretch, between):
    """Sum of normal forces on the post. Nodes bear their contacts per length at rest: the rod's with itself on both strands."""
    edges = np.linalg.norm(np.diff([shape[axis] for axis in "xyz"], axis=1), axis=0) / stretch
    lengths = (np.append(edges, 0.0) + np.append(0.0, edges)) / 2
    return float(lengths @ shape["contact_force"]) - 2 * between


def exponent(points):
    """Of the force over the tension, by least squares of their logarithms; None where one is missing or presses on nothing."""
    if any(point is None or min(point) <= 0.0 for point in points):
        return None
    return float(np.polyfit(*np.log(points).T, 1)[0])


def rows_of(starts, facts):
    """`starts`: {rope: {where: (tension, force) of each pre-load} of each start}"""
    bound = facts["linear_within"]
    gates = {"lightly": ("> 1", above(1.0)), "tightly": ("1", within(1 - bound, 1 + bound))}
    out = []
    for rope, each in starts.items():
        for where, (measured, gate) in gates.items():
            value, error = mean_of_all([exponent(start[where]) for start in each])
            out.append(Row(f"{facts['what']}: {rope}, {WHERE[where]}", measured, value, error, value if where == "tightly" else "", gate,
                           facts["source"], why=facts["if_it_fails"]))
    return out + [Row(f"{facts['what']}: largest over smallest force [k_b/R^2] of {len(starts)} ropes at one pre-load, {words}", "alike",
                      apart([each[1][where] for each in starts.values()]), "", "", at_most(1 + bound), facts["source"],
                      why=facts["if_it_fails"]) for where, words in WHERE.items()]


def apart(ropes):
    """Largest over smallest force over tension of all ropes, where it is largest. None where one is missing."""
    if any(point is None for rope in ropes for point in rope):
        return None
    shares = np.array([[force / tension for tension, force in rope] for rope in ropes])
    return float(max(shares.max(axis=0) / shares.min(axis=0)))
