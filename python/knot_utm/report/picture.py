"""Draws runs of one test: the rod as a shaded tube on its rollers, and its curve with its phases. The PNG carries what it shows and
how it was made as texts, which a test holds against what the program says today."""
import os
import shlex
import string
import sys

import numpy as np
from matplotlib.colors import to_rgb

from knot_utm.report.commands import CannotReport, files_of, in_one_line, OneLineParser, refuse, why_not
from knot_utm.report.curves import draw as draw_line, phases_of
from knot_utm.report.method_facts import materials_of
from knot_utm.report.rod_pictures import draw_rollers, Tubes
from knot_utm.report.run import read_yaml, Run
from knot_utm.report.shapes import final_shape, pieces, ropes, series_of
from knot_utm.report.style import BLUE, FAINT, GREEN, INK, new_figure, ORANGE, PHASES, SMALL, USUAL, VIOLET
from knot_utm.report.tube import to_picture

# The rod's two halves, each with one knot.
FIRST_HALF, SECOND_HALF = np.array(to_rgb(ORANGE)), np.array(to_rgb(BLUE))
READINGS = {"plateau_force": "N", "lock_extension": "m"}


def facts_of_run(folder, command):
    """The texts of a picture of a run, by name."""
    result, method = (read_yaml(os.path.join(folder, name)) for name in ("result.yaml", "method.yaml"))
    readings = {key: "none" if result.get(key) is None else f"{result[key]:.6g} {unit}" for key, unit in READINGS.items()}
    described = f"{method['specimen']['knot']}, {materials_of(method)}"
    return {**readings, "version": str(result["version"]), "method": described, "command": command}


def main():
    parser = OneLineParser(prog="picture", description=__doc__)
    parser.add_argument("runs", nargs="+", metavar="RUN")
    parser.add_argument("--out", required=True, metavar="PNG")
    parser.add_argument("--overwrite", action="store_true", help="write over a picture that exists")
    asked = parser.parse_args()
    if why := why_not(asked.out, [file for folder in asked.runs for file in files_of(folder)], asked.overwrite):
        refuse("picture", f"--out: {why}")
    try:
        runs = [Run(folder) for folder in asked.runs]
    except CannotReport as error:
        refuse("picture", str(error))
    for run in runs:
        if not len(run.pull()):
            refuse("picture", f"{run.folder}: a run in which nothing was pulled")
    draw(runs, asked.out, shlex.join(["scripts/picture", *(word for word in sys.argv[1:] if word != "--overwrite")]))


def draw_shape(axes, run, shape):
    """Its ropes, and a rod that has parted in its pieces."""
    broke, series = run.time_of_break() is not None, series_of(run)[0]
    parts = pieces(shape, series.shape(0)) if broke else ropes(shape)
    Tubes(shape.points, parts, run.radii(shape, parts), lambda node: np.where(
        (node < 0.5 * (len(shape.points) - 1))[:, None], FIRST_HALF, SECOND_HALF)).draw(axes)
    if run.method["specimen"]["knot"] == "fisherman":
        draw_rollers(axes, run, shape)
    axes.set_aspect("equal")
    axes.axis("off")


def until_break(run):
    """Behind a break, with which the readings end, the ends recoil."""
    broke = run.time_of_break()
    return run.curve if broke is None else run.curve.where(run.curve["time"] <= broke)


def draw_phases(axes, run):
    curve = until_break(run)
    time = curve["time"]
    for name, begin, end in phases_of(curve):
        axes.axvspan(time[begin], time[end], color=PHASES.get(name, FAINT), lw=0)
        if time[end] - time[begin] > 0.04 * time[-1]:
            axes.text(0.5 * (time[begin] + time[end]), 0.5, name, ha="center", va="center", fontsize=SMALL,
                      transform=axes.get_xaxis_transform())
    axes.set(xlim=(time[0], time[-1]), yticks=[], xlabel="time [s]")
    axes.grid(False)


def draw_curve(axes, runs):
    run = runs[-1]
    pull, lock, pattern = run.pull(), run.value("lock_extension"), run.result.get("motion_pattern")
    s, load = 1e3 * pull["extension"], pull["load"]
    draw_line(axes, s, load, color=BLUE, lw=1.4)
    # Logarithmic, and linear around zero: the load of sliding knots is a thousandth of that of locked ones.
    usual = np.median(np.abs(load))
    axes.set_yscale("symlog", linthresh=10.0 ** np.floor(np.log10(usual)) if usual > 0.0 else 1.0)
    axes.set(xlabel="extension s [mm]", ylabel="load F [N]", xlim=(0.0, s[-1]))
    if lock is not None:
        axes.axvline(1e3 * lock, color=INK, lw=0.9, ls=(0, (4, 3)))
        axes.text(1e3 * lock, 1.02, f"lock {1e3 * lock:.1f} mm", ha="center", fontsize=SMALL, transform=axes.get_xaxis_transform())
    for letter, other in zip(string.ascii_lowercase, runs):
        end = 1e3 * other.pull()["extension"][-1], other.pull()["load"][-1]
        axes.plot(*end, "o", color="white", mec=INK, ms=11, clip_on=False, zorder=5)
        axes.annotate(letter, end, ha="center", va="center_baseline", fontsize=SMALL, zorder=6, annotation_clip=False)
    second = axes.twinx()
    draw_line(second, s, 1e3 * pull["knot_distance"], color=VIOLET, lw=1.2)
    second.set_ylabel("knot distance e [mm]", color=VIOLET)
    second.spines["right"].set_visible(True)
    second.grid(False)
    axes.set_zorder(second.get_zorder() + 1)
    axes.patch.set_visible(False)
    if pattern not in (None, "none"):
        axes.text(0.45, 0.96, f"motion pattern: {pattern}", transform=axes.transAxes, va="top", color=GREEN)


def draw(runs, file, command):
    shapes = [final_shape(run) for run in runs]
    figure = new_figure(9.0, 1.45 * len(runs) + 4.9)
    grid = figure.add_gridspec(len(runs) + 2, 1, height_ratios=[1.45] * len(runs) + [0.26, 3.4], hspace=0.35)
    for number, (letter, run, shape) in enumerate(zip(string.ascii_lowercase, runs, shapes)):
        axes = figure.add_subplot(grid[number])
        draw_shape(axes, run, shape)
        axes.set_title(f"{letter}   s = {1e3 * until_break(run)['extension'][-1]:.1f} mm", loc="left")
    # One scale for all of them.
    drawn = 1e3 * np.vstack([to_picture(shape.points) for shape in shapes])[:, :2]
    margin = 2e3 * runs[-1].thickest()
    for axes in figure.axes:
        axes.set_xlim(drawn[:, 0].min() - margin, drawn[:, 0].max() + margin)
        axes.set_ylim(drawn[:, 1].min() - margin, drawn[:, 1].max() + margin)
    draw_phases(figure.add_subplot(grid[-2]), runs[-1])
    draw_curve(figure.add_subplot(grid[-1]), runs)
    figure.subplots_adjust(left=0.09, right=0.91, top=0.92, bottom=0.08)
    preload = runs[-1].result.get("preload")
    figure.suptitle(f"{runs[-1].method['material'].get('name', '')}, F_p = {preload:g} N" if preload else "", fontsize=USUAL, y=0.985)
    figure.savefig(file, dpi=120, metadata={"Software": None, **facts_of_run(runs[-1].folder, command)})


if __name__ == "__main__":
    with in_one_line("picture"):
        main()
