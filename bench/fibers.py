"""Checks that the authors of Frictional-Fibers name for their program, made with this one: capstan, open knot with friction, plied yarn.

Their repository holds none of these three, so that numbers of the scenes are ours, and the references are closed forms."""
import csv
import math
import os

import numpy as np

from predictions import CPU_LIMIT, STARTS, Row, mean_of_all
from runs import read_yaml
from table import within

CAPSTAN, KNOT, YARN = (f"config/validation/{name}.yaml" for name in ("thin_capstan", "open_overhand", "two_ply_yarn"))


def rows(runner, facts):
    return capstans(runner, facts["thin_capstans"]) + branches(runner, facts["open_knot"]) + yarns(runner, facts["yarns"])


def answers(run):
    """Samples of a run, one for each command; none where it gave up."""
    if run.exit_code != 0:
        return []
    with open(os.path.join(run.folder, "samples.csv"), encoding="utf-8", newline="") as text:
        return [row for row in csv.DictReader(text) if row["row"].startswith("answer")]


# ---- Capstan -----------------------------------------------------------------------------------------------------------

def capstans(runner, facts):
    """Logarithm of the ratio of tensions, over friction times angle: 1 for a thread."""
    specimen, rod = (read_yaml(CAPSTAN)[key] for key in ("specimen", "material"))
    thickness = rod["radius"] / (specimen["post_diameter"] / 2 + rod["radius"])
    out = []
    for friction in facts["friction"]:
        thick = rate_of_a_thick_strand(friction, thickness) / friction
        for turns in facts["turns"]:
            angle = 2 * math.pi * turns
            ratios = [runner.run(f"thin/{friction:g}_{turns:g}_{factor:g}", {
                "specimen.wrap": angle, "machine.roller_friction": friction,
                "specimen.tail_load": round(specimen["tail_load"] * factor, 9)}, CAPSTAN, cpu_limit=CPU_LIMIT).reading("force_ratio")
                for factor in STARTS]
            value, error = mean_of_all([None if ratio is None else math.log(ratio) / (friction * angle) for ratio in ratios])
            out.append(Row(f"{facts['what']}: friction {friction:g}, {turns:g} turns", f"1 (a thread), {thick:.4f} (as thick as ours)",
                           value, error, value, within(thick - facts["within"], thick + facts["within"]), facts["source"]))
    return out


def rate_of_a_thick_strand(friction, thickness):
    """x of T ~ exp(x angle), friction acting at its surface: R15 of doc/references.md. `thickness`: radius over that of its bend."""
    return (math.sqrt(1 + 4 * friction ** 2 * thickness * (1 - thickness)) - 1) / (2 * friction * thickness)


# ---- Open knot ---------------------------------------------------------------------------------------------------------

def branches(runner, facts):
    """Half the sum and half the difference of the forces out and back, over what bending and friction make of the leading order in
    eps, extrapolated to eps = 0."""
    starts = [[both(runner, facts, eps, factor) for eps in facts["eps"]] for factor in STARTS]
    out = []
    for part, words in enumerate(("half the sum, over bending", "half the difference, over friction")):
        value, error = mean_of_all([None if None in start else at_zero([point[0] for point in start], [point[1 + part] for point in start])
                                    for start in starts])
        out.append(Row(f"{facts['what']}: {words}", "1", value, error, value, within(1 - facts["within"], 1 + facts["within"]),
                       facts["source"]))
    return out


def both(runner, facts, eps, factor):
    """eps in the middle of the way, and both ratios; None where the run gave up. eps^2: radius of the rod over that of the loop."""
    rod = read_yaml(KNOT)["material"]
    radius, friction = rod["radius"] / eps ** 2, eps * facts["friction"]
    apart = round(facts["apart"] * radius * factor, 9)
    length, speed = apart + 2 * math.pi * radius, facts["speed"] * radius
    run = runner.run(f"branches/{eps:g}_{factor:g}", {
        "specimen.end_to_end": apart, "specimen.length": length, "material.friction_coefficient": friction,
        "program": [{"balance": {}}, {"hold": {"duration": 6}},
                    {"pull": {"speed": speed, "until": {"extension": facts["way"] * radius}}},
                    {"return": {"speed": speed, "extension": 0}}]}, KNOT, cpu_limit=CPU_LIMIT)
    half, means = facts["way"] * radius / 2, []
    for phase, second_half in (("pull", half.__lt__), ("return", half.__gt__)):
        points = [(loop_of(sample, length, rod), float(sample["force_upper"]) * rod["radius"] ** 2 / float(rod["bending_stiffness"]))
                  for sample in answers(run) if sample["phase"] == phase and second_half(float(sample["extension"]))]
        means.append([np.mean([loop for loop, _ in points]), np.mean([force / loop ** 4 for loop, force in points])] if points else None)
    if None in means:
        return None
    (eps_out, out), (eps_back, back) = means
    at = (eps_out + eps_back) / 2
    return at, (out + back) / 2 / 0.5, (out - back) / 2 / (friction * facts["sigma"] / at)


def loop_of(sample, length, rod):
    """eps, by the end shortening."""
    return math.sqrt(2 * math.pi * rod["radius"] / (length - float(sample["end_to_end"])))


def at_zero(x, y):
    """Value at 0 of the polynomial through all points (Lagrange)."""
    return sum(value * math.prod(-other / (at - other) for other in x if other != at) for at, value in zip(x, y))


# ---- Plied yarn --------------------------------------------------------------------------------------------------------

def yarns(runner, facts):
    out = []
    for friction, turns in facts["cases"]:
        found = [yarn(runner, friction, turns, factor) for factor in STARTS]
        case = f"{turns} turns, friction {friction:g}"
        for part, (words, gate) in enumerate((
                ("torque", lambda ends: within(1 - facts["within"], 1 + facts["within"])),
                ("sine of its angle", lambda ends: within(1 - facts["within"], 1 + facts["within"] + ends)))):
            value, error = mean_of_all([one and one[part] for one in found])
            ends = max((one[2] for one in found if one), default=0.0)
            out.append(Row(f"{facts['what']}, {words}: {case}", "1", value, error, value, gate(ends), facts["source"]))
    return out


def yarn(runner, friction, turns, factor):
    """Torque over that of the closed form for the middle half of the yarn as it is; sine of the angle between strand and axis there over
    that of two helices from clamp to clamp; by what share clamps, which keep ends straight, may shorten the helix. None where the run gave
    up."""
    method = read_yaml(YARN)
    program = method["program"]
    program[1]["twist"]["turns"] = turns
    run = runner.run(f"yarn/{friction:g}_{turns}_{factor:g}", {
        "material.friction_coefficient": friction, "program": program,
        "specimen.end_to_end": round(method["specimen"]["end_to_end"] * factor, 9)}, YARN, more=["--shapes"], cpu_limit=CPU_LIMIT)
    samples = answers(run)
    if not samples:
        return None
    rod, last = method["material"], samples[-1]
    radius, angle, twist = middle_of(run.last_shape())
    force, torque, turn = (float(last[name]) for name in ("force_upper", "torque", "turn"))
    length = next(float(sample["end_to_end"]) for sample in samples if sample["phase"] == "twist")
    k_b, k_t = (float(rod[name]) for name in ("bending_stiffness", "twisting_stiffness"))
    return (torque / torque_of(force, radius, angle, twist, k_b, k_t), math.sin(angle) * length / (turn * rod["radius"]),
            2 * math.sqrt(k_b / (force / 2)) / length)


def torque_of(force, radius, angle, twist, k_b, k_t):
    """Of two strands that are helices around one axis, opposite each other, under a force on both. Their energy for each length of
    strand is k_b kappa^2 + k_t twist^2, kappa = sin^2 angle/radius, and what changes of it with the angle is the work of force and
    torque: strands are turned by sin angle/radius and reach cos angle far."""
    sine, cosine = math.sin(angle), math.cos(angle)
    return force * radius * sine / cosine + 4 * k_b * sine ** 3 / radius + 2 * k_t * twist * math.cos(2 * angle) / cosine


def middle_of(shape):
    """Of the middle half of the two strands: radius, angle [rad] and twist [rad/m]."""
    columns = np.array([shape[name] for name in ("x", "y", "z", "twist")])
    strands = [columns[:, shape["rope"] == number] for number in (1, 2)]
    strands[1] = strands[1][:, ::-1]  # drawn downwards
    nodes = strands[0].shape[1]
    one, other = (strand[:, nodes // 4:3 * nodes // 4] for strand in strands)
    across = (one - other)[:2] / 2
    radius = np.hypot(*across).mean()
    turns = np.polyfit((one[2] + other[2]) / 2, np.unwrap(np.arctan2(across[1], across[0])), 1)[0]
    return radius, math.atan(radius * turns), (one[3].mean() + other[3].mean()) / 2
