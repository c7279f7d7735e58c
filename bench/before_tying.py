#!/usr/bin/python3
"""What is said before tying (machine/before_tying.hpp), against what tests that are run all the same come to.

examples:
    bench/before_tying.py --study rates      methods drawn at random: refused, warned of or not, and what became of them
    bench/before_tying.py --study coils      how far a pre-load closes a coil, over friction
    bench/before_tying.py --study meshes     knots with coarser and coarser edges
    bench/before_tying.py --runs 200 --seed 2

A method that is refused is run by a second program, --unchecked, which has no such check; without one it is only counted.
Prints one line a run and the rates. Takes the programs that stand in build/ (scripts/build tensile_test).

exit codes: 0 no method that works was refused; 1 one was
"""
import argparse
import concurrent.futures
import math
import os
import random
import subprocess
import sys
import tempfile

import yaml

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
RADIUS, BENDING = 0.003175, 4.31e-5  # of the shipped nylon [m], [N m2]


def rod(radius, ratio, friction, density=1150.0, bending=BENDING):
    """A material as --set takes it; ratio: k_s h^2/k_b."""
    return (f"{{radius: {radius!r}, density: {density!r}, stretching_stiffness: {ratio * bending / radius**2!r}, "
            f"bending_stiffness: {bending!r}, twisting_stiffness: {bending!r}, friction_coefficient: {friction!r}}}")


def run(tool, settings, timeout):
    """Exit code, result and what was said of one test."""
    with tempfile.TemporaryDirectory() as folder:
        words = [tool, os.path.join(ROOT, "config/tighten.yaml"), "--out", folder, "--overwrite", "--quiet"]
        for key, value in settings.items():
            words += ["--set", f"{key}={value}"]
        try:
            answer = subprocess.run(words, capture_output=True, text=True, timeout=timeout)
        except subprocess.TimeoutExpired:
            return None, {}, "timeout"
        try:
            with open(os.path.join(folder, "result.yaml"), encoding="utf-8") as file:
                return answer.returncode, yaml.safe_load(file), answer.stderr
        except FileNotFoundError:
            return answer.returncode, {}, answer.stderr


def draw(number, seed):
    """One method over friction, pre-load, size, stiffness and hand."""
    chance = random.Random(1000 * seed + number)
    radius, friction = 10 ** chance.uniform(-3.3, -1.9), chance.uniform(0.1, 1.2)
    bending = BENDING * (radius / RADIUS) ** 4 * 10 ** chance.uniform(-1, 1)
    preload = 10 ** chance.uniform(-2.3, 1.3)
    return {"material": rod(radius, 10 ** chance.uniform(0.6, 4.3), friction, bending=bending),
            "specimen.preload": preload * bending / radius**2,
            "specimen.handedness": chance.choice(["same", "opposite"]),
            "physics.accuracy": "draft"}


def outcome(code, result):
    """untied: nothing was there to pull; given up: by the solver, or hung; undone: while pulled; works: the rest."""
    if code is None or result.get("ended_by") == "solver":
        return "given up"
    if result.get("ended_by") == "untangled":
        return "untied"
    return "undone" if result.get("untangled_at") is not None else "works"


def rates(args):
    def one(number):
        settings = draw(number, args.seed)
        code, result, said = run(args.tool, settings, args.timeout)
        verdict = "silent"
        if code == 2:
            verdict = "refused"
            code, result, _ = run(args.unchecked, settings, args.timeout) if args.unchecked else (2, {}, "")
        elif "leaves the coils open" in said:
            verdict = "warned"
        return number, verdict, "not run" if code == 2 else outcome(code, result), said.strip().split("\n")[0]

    count = {}
    with concurrent.futures.ThreadPoolExecutor(args.jobs) as pool:
        for number, verdict, became, said in pool.map(one, range(args.runs)):
            count[verdict, became] = count.get((verdict, became), 0) + 1
            print(number, verdict, became, said[:120], flush=True)
    for (verdict, became), many in sorted(count.items()):
        print(f"{verdict:8} {became:9} {many}")
    return 1 if count.get(("refused", "works")) else 0


def coils(args):
    print("mu, F_p h^2/k_b, excess length over h once tied, over that at the highest pre-load, as radius of the coil")
    for friction in (0.1, 0.3, 0.46, 0.8):
        tightest = None
        for preload in (20.0, 5.0, 2.0, 0.8, 0.4, 0.25, 0.18, 0.125):
            _, result, _ = run(args.tool, {"material": rod(RADIUS, 1.7e4, friction),
                                           "specimen.preload": preload * BENDING / RADIUS**2,
                                           "physics.accuracy": "draft",
                                           "program": "[{tie: {}}, {hold: {duration: 0.1}}]"}, args.timeout)
            excess = result["excess_length"][0] / RADIUS
            tightest = excess if tightest is None else tightest
            closing = math.exp(math.pi * friction) / 8.0
            print(f"{friction} {preload} (closes at {closing:.3f}) {excess:.2f} {(excess - tightest) / (2.5 * math.pi):.2f}",
                  flush=True)
    return 0


def meshes(args):
    radii = {}
    for name in ("nylon", "polypropylene", "pink_vps"):
        with open(os.path.join(ROOT, "config/materials", name + ".yaml"), encoding="utf-8") as file:
            radii[name] = yaml.safe_load(file)["radius"]
    print("material, edges in knots over h, plateau force, lock extension")
    for name, radius in radii.items():
        for edge in (0.5, 0.7, 0.9, 1.0, 1.4, 2.0):
            _, result, _ = run(args.tool, {"material": name, "specimen.edge_length": max(edge, 1.0) * radius,
                                           "specimen.refinement": max(1.0, 1.0 / edge)}, args.timeout)
            print(name, edge, result.get("plateau_force"), result.get("lock_extension"), flush=True)
    return 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--study", choices=("rates", "coils", "meshes"), default="rates")
    parser.add_argument("--runs", type=int, default=60)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=len(os.sched_getaffinity(0)))
    parser.add_argument("--timeout", type=float, default=120.0, help="of a test [s]; it counts as given up then")
    parser.add_argument("--tool", default=os.path.join(ROOT, "build/devel/lib/knot_utm/tensile_test"))
    parser.add_argument("--unchecked", help="a tensile_test without the checks, for what is refused")
    args = parser.parse_args()
    return {"rates": rates, "coils": coils, "meshes": meshes}[args.study](args)


if __name__ == "__main__":
    sys.exit(main())
