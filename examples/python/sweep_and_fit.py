#!/usr/bin/python3
"""How a force depends on a key of the method, and which value of the key a measured curve has. The picture is OUT/sweep.png.

usage: sweep_and_fit.py [OUT]"""
import os
import sys

import matplotlib

import knot_utm

matplotlib.use("Agg")  # pictures go to files, with and without a display
from matplotlib import pyplot as plt

STUDY = """
method: straight
vary:
  material.stretching_stiffness: {from: 4e+4, to: 8e+4, steps: 5}  # [N]
  program.pull.until.extension: [0.008]  # [m]
"""
STIFFNESS = "material.stretching_stiffness"
# The test as it was done: how far the rod was pulled, and the errors of the load cell, without which no interval can be told.
TEST = {"program.pull.until.extension": 0.008, "machine.load_cell.accuracy": 0.005, "machine.load_cell.noise": 1.0}


def main(out="out/sweep_and_fit"):
    os.makedirs(out, exist_ok=True)

    # A study is a file. Runs that are there are not run again, so that a sweep may be asked for as often as one likes.
    study = os.path.join(out, "study.yaml")
    with open(study, "w", encoding="utf-8") as file:
        file.write(STUDY)
    table = knot_utm.sweep(study, os.path.join(out, "sweep"))
    units = table.attrs["units"]
    print(table[[STIFFNESS, "peak_force"]].to_string(index=False))

    figure, panel = plt.subplots(layout="constrained")
    panel.plot(table[STIFFNESS], table["peak_force"], "o-")
    panel.set_xlabel(f"{STIFFNESS} [{units[STIFFNESS]}]")
    panel.set_ylabel(f"peak_force [{units['peak_force']}]")
    figure.savefig(os.path.join(out, "sweep.png"))

    # The measured curve. Here a test stands in for the machine, with a stiffness that the fit does not know.
    measured = knot_utm.run("straight", os.path.join(out, "measured"), **TEST, **{STIFFNESS: 6.1e4})

    # The key moves in its range until the simulated curve is the measured one.
    fitted = knot_utm.fit(os.path.join(measured.folder, "curve.csv"), "straight", [f"{STIFFNESS}=4e+4:8e+4"],
                          os.path.join(out, "fit"), settings=TEST, report=False)
    found = fitted.found[STIFFNESS]
    # An end that the curve cannot tell is None.
    low, high = ("?" if end is None else f"{end:.5g}" for end in (found.low, found.high))
    print(f"{STIFFNESS}: {found.value:.5g} {units[STIFFNESS]}, from {low} to {high}")


if __name__ == "__main__":
    try:
        main(*sys.argv[1:])
    except knot_utm.WrongInput as wrong:  # such as a folder that holds a run already
        sys.exit(f"sweep_and_fit: {wrong}")
