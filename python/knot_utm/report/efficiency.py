"""How much of its strength a rope keeps with a knot in it: a reading of one batch of specimens over that of another."""
import math
import os
import statistics
import sys

from scipy.stats import t

from knot_utm.report.batch import read_specimens
from knot_utm.report.commands import CannotReport, in_one_line, OneLineParser, refuse
from knot_utm.report.quantities import is_number
from knot_utm.report.run import read_yaml


class Sample:
    """Readings of one batch: n, mean, sd over n - 1, and cv, which is sd over the mean."""

    def __init__(self, readings):
        self.n, self.mean, self.sd = len(readings), statistics.fmean(readings), statistics.stdev(readings)
        self.cv = self.sd / self.mean

    def share(self):
        """The variance of the logarithm of the mean, to first order."""
        return self.cv ** 2 / self.n


def ratio_of_means(a, b):
    """(ratio, low, high) of the means of two samples, both above 0, and the 95 % interval of the ratio.

    The logarithm of the ratio has, to first order, the variance v = cv_a^2/n_a + cv_b^2/n_b. Its interval is Student's with
    the degrees of freedom of Welch (1947), v^2/((cv_a^2/n_a)^2/(n_a - 1) + (cv_b^2/n_b)^2/(n_b - 1)). So the interval has
    no end below 0, and the inverse ratio has the inverse interval."""
    ratio, parts = a.mean / b.mean, (a.share(), b.share())
    variance = sum(parts)
    if variance == 0.0:
        return ratio, ratio, ratio
    largest = max(parts)  # squares of tiny shares are 0
    degrees = (variance / largest) ** 2 / sum((part / largest) ** 2 / (of.n - 1) for part, of in zip(parts, (a, b)))
    reach = math.exp(t.ppf(0.975, degrees) * math.sqrt(variance))
    return ratio, ratio / reach, ratio * reach


def sample(folder, key):
    """The readings of the specimens that count, and their unit."""
    if not os.path.isfile(os.path.join(folder, "specimens.csv")):
        refuse("efficiency", f"{folder}: no folder of a batch that has ended: it has no specimens.csv")
    specimens, units = read_specimens(folder)
    counted = [one for one in specimens if not one.rejected]
    if key not in specimens[0].readings:
        refuse("efficiency", f"{folder}: --key {key} is no reading; readings are the columns behind motion_pattern of specimens.csv")
    readings = [one.readings[key] for one in counted if one.readings[key] is not None]
    if len(readings) < 2:
        refuse("efficiency", f"{folder}: {len(readings)} of {len(specimens)} specimens count and have {key}, but at least 2 must")
    if min(readings) <= 0.0:
        refuse("efficiency", f"{folder}: {key} is {min(readings):g} of a specimen, but a ratio needs readings above 0")
    whole = sum(one.ended_by != "break" for one in counted)
    if key == "peak_force" and whole:
        print(f"efficiency: {folder}: {whole} of {len(counted)} specimens did not break, so that their largest load is no strength",
              file=sys.stderr)
    return Sample(readings), units[key]


OF_THE_BREAK = ("peak_force", "true_peak_force", "break_extension", "elongation_at_break", "energy_to_peak", "energy_to_break")


def repeats_what_was_given(folder, key):
    """Whether the readings follow from material.breaking_force, because tension alone parts the rod."""
    file = os.path.join(folder, "method.yaml")
    if key not in OF_THE_BREAK or not os.path.isfile(file):
        return False
    parted = any(one.ended_by == "break" and not one.rejected for one in read_specimens(folder)[0])
    method = read_yaml(file)
    return parted and any(parts_by_tension(method.get(of) or {}) for of in ("material", "other_material"))


def parts_by_tension(material):
    law = (material.get("breaking") or {}).get("law", "tension")
    return law == "tension" and is_number(material.get("breaking_force"))


def line(name, of):
    return f"{name}: {{n: {of.n}, mean: {of.mean:.6g}, sd: {of.sd:.4g}, cv: {of.cv:.4g}}}"


def main():
    parser = OneLineParser(prog="efficiency", description="A reading of one batch of specimens over that of another.")
    parser.add_argument("knotted", metavar="KNOTTED", help="the batch whose reading is above the line")
    parser.add_argument("straight", metavar="STRAIGHT", help="the batch whose reading is below it")
    parser.add_argument("--key", default="peak_force", help="a number of result.yaml [peak_force]")
    asked = parser.parse_args()
    try:
        knotted, unit = sample(asked.knotted, asked.key)
        straight, _ = sample(asked.straight, asked.key)
    except CannotReport as why:
        refuse("efficiency", why)
    ratio, low, high = ratio_of_means(knotted, straight)
    print(f"key: {asked.key}  # [{unit}]")
    print(line("knotted", knotted))
    print(line("straight", straight))
    if repeats_what_was_given(asked.knotted, asked.key):
        print("ratio: null  # not predicted: the knotted rod parts where its tension is material.breaking_force, which was given")
        return
    pair = math.hypot(knotted.cv, straight.cv)
    print(f"ratio: {{of_means: {ratio:.4g}, low: {low:.4g}, high: {high:.4g}, cv: {pair:.4g}}}")


if __name__ == "__main__":
    with in_one_line("efficiency"):
        main()
