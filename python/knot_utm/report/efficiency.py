#!/usr/bin/python3
"""How much of its strength a rope keeps with a knot in it: a reading of one batch of specimens over that of another.

KNOTTED and STRAIGHT are folders of batches (doc/results.md). Prints as YAML, in SI units, what both batches have, and the
ratio of their means with its 95 % interval; its cv is that of the ratio of one specimen to one other. Specimens that are
rejected, or lack the reading, are left out. The efficiency of a closed loop is half the ratio, because two strands bear its load.
Where the knotted rod parts at the breaking force that its material gives, its strength is not predicted, and there is no ratio.

examples:
    tensile_test config/tighten.yaml --specimens 8 --out out/knotted
    tensile_test config/straight.yaml --specimens 8 --out out/straight
    scripts/efficiency out/knotted out/straight
    scripts/efficiency out/knotted out/straight --key energy_to_break

exit codes: 0 the ratio is printed; 1 a module is not installed; 2 a folder is no batch, or has fewer than two readings
"""
import argparse
import math
import os
import sys


class OneLineParser(argparse.ArgumentParser):
    def error(self, message):
        refuse(message)


def refuse(why):
    print("efficiency:", why, file=sys.stderr)
    sys.exit(2)


def asked():
    """The command line, read before what may not be installed."""
    parser = OneLineParser(prog="scripts/efficiency", description=__doc__,
                           formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("knotted", metavar="KNOTTED", help="the batch whose reading is above the line")
    parser.add_argument("straight", metavar="STRAIGHT", help="the batch whose reading is below it")
    parser.add_argument("--key", default="peak_force", help="a number of result.yaml [peak_force]")
    return parser.parse_args()


ASKED = asked()
try:
    from knot_utm.report.batch import read_specimens
    from knot_utm.report.failure import CannotReport
    from knot_utm.report.is_number import is_number
    from knot_utm.report.ratio_of_means import Sample, ratio_of_means
    from knot_utm.report.run import read_yaml
except ModuleNotFoundError as absent:
    sys.exit(f"efficiency: {absent}; it needs python3-numpy and python3-yaml")


def sample(folder, key):
    """The readings of the specimens that count, and their unit."""
    if not os.path.isfile(os.path.join(folder, "specimens.csv")):
        refuse(f"{folder}: no folder of a batch that has ended: it has no specimens.csv")
    specimens, units = read_specimens(folder)
    counted = [one for one in specimens if not one.rejected]
    if key not in specimens[0].readings:
        refuse(f"{folder}: --key {key} is no reading; readings are the columns behind motion_pattern of specimens.csv")
    readings = [one.readings[key] for one in counted if one.readings[key] is not None]
    if len(readings) < 2:
        refuse(f"{folder}: {len(readings)} of {len(specimens)} specimens count and have {key}, but at least 2 must")
    if min(readings) <= 0.0:
        refuse(f"{folder}: {key} is {min(readings):g} of a specimen, but a ratio needs readings above 0")
    whole = sum(one.ended_by != "break" for one in counted)
    if key == "peak_force" and whole:
        print(f"efficiency: {folder}: {whole} of {len(counted)} specimens did not break, so that their largest load is no strength",
              file=sys.stderr)
    return Sample(readings), units[key]


OF_THE_BREAK = ("peak_force", "true_peak_force", "break_extension", "elongation_at_break", "energy_to_peak", "energy_to_break")


def repeats_what_was_given(folder, key):
    """Whether the readings follow from material.breaking_force, at which the rod parts."""
    file = os.path.join(folder, "method.yaml")
    if key not in OF_THE_BREAK or not os.path.isfile(file):
        return False
    parted = any(one.ended_by == "break" and not one.rejected for one in read_specimens(folder)[0])
    return parted and is_number((read_yaml(file).get("material") or {}).get("breaking_force"))


def line(name, of):
    return f"{name}: {{n: {of.n}, mean: {of.mean:.6g}, sd: {of.sd:.4g}, cv: {of.cv:.4g}}}"


def main():
    try:
        knotted, unit = sample(ASKED.knotted, ASKED.key)
        straight, _ = sample(ASKED.straight, ASKED.key)
    except CannotReport as why:
        refuse(why)
    ratio, low, high = ratio_of_means(knotted, straight)
    print(f"key: {ASKED.key}  # [{unit}]")
    print(line("knotted", knotted))
    print(line("straight", straight))
    if repeats_what_was_given(ASKED.knotted, ASKED.key):
        print("ratio: null  # not predicted: the knotted rod parts where its tension is material.breaking_force, which was given")
        return
    pair = math.hypot(knotted.cv, straight.cv)
    print(f"ratio: {{of_means: {ratio:.4g}, low: {low:.4g}, high: {high:.4g}, cv: {pair:.4g}}}")


main()
