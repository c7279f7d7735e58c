#!/usr/bin/python3
"""The constants of the errors given beside readings, from tables of draws that scripts/bench readings left.

    bench/fit_errors.py out/bench/readings/draws_19.csv [MORE.csv ...] [--check OTHER.csv]

For each reading, log10 of the relative true difference is taken to be a + sum b_i x_i plus chance; a and b_i by least
squares, with b_i held towards zero (ridge), so that a few tests cannot make a steep law. The error is that law, raised by
the factor below which COVERED of the tests lie that were left out one at a time. `--check` says how many of the tests of
other seeds it holds. The constants stand in src/machine/measured.hpp."""
import argparse
import csv
import math

import numpy as np

READINGS = ["plateau_force", "lock_extension", "locked_stiffness"]
FEATURES = {"log10 of F_p h^2/k_b over 10": lambda row: math.log10(float(row["preload"]) / 10.0),
            "friction coefficient less 0.5": lambda row: float(row["friction_coefficient"]) - 0.5,
            "opposite hands": lambda row: float(row["handedness"] == "opposite"),
            "log10 of k_s h^2/k_b over 1000": lambda row: math.log10(float(row["stretching"]) / 1e3)}
RIDGE = 3.0       # tests of a b_i of zero
COVERED = 0.96
LEAST = 1e-4      # a difference below is chance


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("draws", nargs="+")
    parser.add_argument("--check", action="append", default=[])
    args = parser.parse_args()
    rows, others = read(args.draws), read(args.check)
    for key in READINGS:
        x, y = table_of(rows, key)
        if len(y) <= len(FEATURES) + 1:
            print(f"{key}: {len(y)} tests have it in both runs, which are too few")
            continue
        law, left_out = fit(x, y), [y[i] - x[i] @ fit(np.delete(x, i, 0), np.delete(y, i)) for i in range(len(y))]
        raised = float(np.quantile(left_out, COVERED, method="higher"))
        print(f"{key}: {len(y)} tests, scatter of log10 {np.std(left_out):.2f}")
        print(f"  a = {law[0] + raised:.3f}")
        for name, b in zip(FEATURES, law[1:]):
            print(f"  b = {b:+.3f} times {name}")
        print("  " + how_good(x @ law + raised, y))
        if others:
            x, y = table_of(others, key)
            print("  others: " + how_good(x @ law + raised, y))


def read(files):
    rows = []
    for file in files:
        with open(file, encoding="utf-8", newline="") as text:
            rows += list(csv.DictReader(text))
    return rows


def table_of(rows, key):
    """Features and log10 of the relative difference, of the tests that have the reading in both runs."""
    x, y = [], []
    for row in rows:
        reading, fine = row[f"{key}_reading"], row[f"{key}_fine"]
        if reading and fine:
            x.append([1.0] + [feature(row) for feature in FEATURES.values()])
            y.append(math.log10(max(abs(float(reading) / float(fine) - 1.0), LEAST)))
    return np.array(x), np.array(y)


def fit(x, y):
    held = RIDGE * np.eye(x.shape[1])
    held[0, 0] = 0.0
    return np.linalg.solve(x.T @ x + held, x.T @ y)


def how_good(error, true):
    held = int(np.sum(error >= true))
    return (f"holds {held} of {len(true)}; median error {10 ** np.median(error):.2g}, median difference "
            f"{10 ** np.median(true):.2g}, {10 ** (np.median(error) - np.median(true)):.2g} times")


if __name__ == "__main__":
    main()
