#!/usr/bin/python3
"""From one test to the mean curve of eight specimens. The picture is OUT/curves.png.

usage: pull_a_batch.py [METHOD] [OUT]"""
import os
import sys

import matplotlib
import numpy as np
from scipy import stats

import knot_utm

matplotlib.use("Agg")  # pictures go to files, with and without a display
from matplotlib import pyplot as plt


def pulled(run):
    """Extension [m] and load [N] of the pull."""
    pull = run.curve[run.curve["phase"] == "pull"]
    return pull["extension"].to_numpy(), pull["load"].to_numpy()


def main(method="tighten", out="out/pull_a_batch"):
    # One test. knot_utm.read(folder) gives the same of any folder in which a test was left.
    run = knot_utm.run(method, os.path.join(out, "one"))
    units = run.results.attrs["units"]
    print(f"one test: {run.results['peak_force']:.4g} {units['peak_force']}")

    # Eight specimens, none of which is tied quite alike. Each of them is a run of its own.
    batch = knot_utm.batch(method, os.path.join(out, "batch"), specimens=8)
    peak = batch.statistics.loc["peak_force"]
    print(f"{peak['n']:.0f} specimens: {peak['mean']:.4g} {units['peak_force']}, from {peak['low']:.4g} to {peak['high']:.4g}")

    # The curves of the specimens that count, at the same extensions.
    counted = [run for run, rejected in zip(batch.runs, batch.specimens["rejected"]) if not rejected]
    curves = [pulled(run) for run in counted]
    extension = np.linspace(0, min(curve[0].max() for curve in curves), 200)
    loads = np.array([np.interp(extension, *curve) for curve in curves])

    # Their mean, with the interval that holds the mean of all such specimens with 95 % confidence.
    mean = loads.mean(axis=0)
    half = stats.t.ppf(0.975, len(loads) - 1) * stats.sem(loads, axis=0)

    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4), sharey=True, layout="constrained")
    left.plot(*pulled(run))
    left.set_title("one test")
    right.plot(extension, loads.T, color="0.7", linewidth=0.8)
    right.plot(extension, mean, label="mean")
    right.fill_between(extension, mean - half, mean + half, alpha=0.3, label="95 % interval of the mean")
    right.set_title(f"{len(loads)} specimens")
    right.legend()
    for panel in (left, right):
        panel.set_xlabel(f"extension [{run.curve.attrs['units']['extension']}]")
    left.set_ylabel(f"load [{run.curve.attrs['units']['load']}]")
    figure.savefig(os.path.join(out, "curves.png"))


if __name__ == "__main__":
    try:
        main(*sys.argv[1:])
    except knot_utm.WrongInput as wrong:  # such as a folder that holds a run already
        sys.exit(f"pull_a_batch: {wrong}")
