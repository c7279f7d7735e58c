#!/usr/bin/python3
"""Two thousand tests an hour and core: what does the sliding force of a loop depend on? Coarse steps, and tests that end once the
sliding force is known, are enough to see it. The same study may be asked for again: runs that are there are not run again.
Run:  PYTHONPATH=python /usr/bin/python3 examples/two_thousand_tests_an_hour.py 2000
Test: PYTHONPATH=python /usr/bin/python3 examples/two_thousand_tests_an_hour.py 4
Prints: 4 tests at \\d+ an hour"""
import os
import sys
import time

import matplotlib

import knot_utm

matplotlib.use("Agg")  # pictures go to files, with and without a display
OUT = "out/two_thousand_tests"
STUDY = """
method: tighten
design: sobol                  # points that lie evenly in all keys at once
runs: {runs}
vary:
  physics.accuracy: [draft]
  material.friction_coefficient: {{draw: uniform, from: 0.3, to: 0.6}}
  specimen.preload: {{draw: uniform, from: 50, to: 100}}  # [N]
"""
VARIED = ["material.friction_coefficient", "specimen.preload"]


def main(runs):
    os.makedirs(OUT, exist_ok=True)
    study = os.path.join(OUT, f"study_of_{runs}.yaml")
    with open(study, "w", encoding="utf-8") as file:
        file.write(STUDY.format(runs=runs))
    begin = time.monotonic()
    table = knot_utm.sweep(study, os.path.join(OUT, str(runs)), readings="plateau")  # on all cores; a pandas.DataFrame
    print(f"{runs} tests at {3600 * runs / (time.monotonic() - begin):.0f} an hour")

    slid = table.dropna(subset=["plateau_force"])  # of the others no_plateau_because says why
    print(f"{len(slid)} have a sliding force [{table.attrs['units']['plateau_force']}]; its rank correlation with")
    print(slid[VARIED].corrwith(slid["plateau_force"].astype(float), method="spearman").to_string())
    slid.plot.scatter(*VARIED, c="plateau_force").figure.savefig(os.path.join(OUT, f"{runs}.png"))


if __name__ == "__main__":
    try:
        main(int(sys.argv[1]))
    except knot_utm.WrongInput as wrong:
        sys.exit(f"two_thousand_tests_an_hour: {wrong}")
