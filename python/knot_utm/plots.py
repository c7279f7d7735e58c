"""The pictures of a sweep, and the numbers that stand in them."""
import os

from knot_utm import curve_plots, number_plots, pattern_plots
from knot_utm.errors import WrongInput
from knot_utm.groups import dimensionless
from knot_utm.table import NUMBERS, result_columns


def require_plottable(results):
    """Raises WrongInput where one of these can not be drawn."""
    numbers = [name for name, _, kind in result_columns().values() if kind in NUMBERS]
    for result in results:
        if result not in (*numbers, pattern_plots.PATTERN, *curve_plots.ACROSS):
            raise WrongInput(f"--plot is {result}, but must be a number of result.yaml, such as plateau_force, or "
                             + ", ".join((pattern_plots.PATTERN, *curve_plots.ACROSS)))


def write_plots(table, study, result, folder, runs):
    """RESULT.png in the folder, the same in the units of the rod (RESULT_in_groups.png), and but for loads what stands in
    them (RESULT.csv). `runs`: the SweepFolder."""
    path = os.path.join(folder, result)
    rods = [runs.rod(name) for name in table["run"]]
    in_groups = dimensionless(table, rods)
    for end, shown, of in (("", table, None), ("_in_groups", in_groups, rods)):
        figure(shown, study.keys, result, study.cases, runs, of).savefig(path + end + ".png", dpi=150, bbox_inches="tight")
    said = numbers_of(table, study, result, in_groups, runs)
    if said is not None:
        said.to_csv(path + ".csv", index=False)


def figure(table, keys, result, cases=(), runs=None, rods=None):
    """`table`: of knot_utm.sweep, in the units of the picture."""
    if result == pattern_plots.PATTERN:
        return pattern_plots.figure(table, keys, cases)
    if result in curve_plots.ACROSS:
        return curve_plots.figure(table, keys, result, cases, runs, rods)
    return number_plots.figure(table, keys, result, cases)


def numbers_of(table, study, result, in_groups, runs):
    """What stands in a picture, as a table; None of loads over extensions and of too few runs."""
    if result == pattern_plots.PATTERN:
        return pattern_plots.numbers_of(table, study.keys, study.cases)
    if result == "knot_distance":
        return curve_plots.numbers_of(table, study.keys, study.cases, runs)
    if result in curve_plots.ACROSS:
        return None
    return number_plots.numbers_of(table, study, result, in_groups)
