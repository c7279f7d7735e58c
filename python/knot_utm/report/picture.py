#!/usr/bin/python3
"""Draws runs of one test: the rod as a shaded tube on its rollers, and its curve with its phases.

Each RUN is a folder that tensile_test or a recorder wrote. The curve is that of the last one; of each one the final
shape is drawn, and marked on the curve. Runs of one method that end at different extensions show how the knots move.
A rod that has parted is drawn in its pieces. The picture carries the readings of the last run as texts of its PNG.

examples:
    scripts/picture out/tighten --out tighten.png
    tensile_test config/tighten.yaml --out out/sliding --set 'program.pull.until={extension: 0.03}'
    tensile_test config/tighten.yaml --out out/tighten
    scripts/picture out/sliding out/tighten

exit codes: 0 the picture is written; 1 it could not be drawn; 2 a folder or an option is wrong
"""
import argparse
import csv
import os
import shlex
import sys


def asked():
    """The command line, read before what takes its time to import, and may not be installed."""
    parser = argparse.ArgumentParser(prog="scripts/picture", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("runs", nargs="+", metavar="RUN")
    parser.add_argument("--out", default="tighten.png", help="the picture [tighten.png]")
    parser.add_argument("--overwrite", action="store_true", help="write over a picture that exists")
    return parser, parser.parse_args()


ASKED = asked()
try:
    import matplotlib.pyplot as plt
    import numpy as np
    import yaml
    from matplotlib.collections import PolyCollection
    from matplotlib.colors import to_rgb

    from knot_utm.report.failure import CannotReport
    from knot_utm.report.new_file import files_of, why_not
    from knot_utm.report.picture_facts import facts_of_run
    from knot_utm.report.shapes import pieces, series_of
    from knot_utm.report.style import BLUE, FAINT, GREEN, HUB, INK, ORANGE, PHASES, ROLLER, SMALL, USUAL, VIOLET
    from knot_utm.report.tube import Tube, smooth, to_picture
except ModuleNotFoundError as missing:
    sys.exit(f"scripts/picture: {missing}; it needs python3-matplotlib and python3-yaml")

# The rod's two halves, each with one knot.
FIRST_HALF, SECOND_HALF = np.array(to_rgb(ORANGE)), np.array(to_rgb(BLUE))


class Run:
    def __init__(self, folder):
        self.folder = folder
        self.method = self.read_yaml("method.yaml")
        self.result = self.read_yaml("result.yaml")
        columns = self.read_columns("curve_full.csv")
        self.phase = np.array(columns.pop("phase"))
        self.curve = {name: np.array(column, dtype=float) for name, column in columns.items()}
        with open(os.path.join(folder, "final_shape.csv"), newline="", encoding="utf-8") as text:
            self.shape = np.array([row for row in list(csv.reader(text))[2:]], dtype=float)
        self.parts = [slice(0, len(self.shape))]
        if self.result.get("break_extension") is not None:
            # Behind the break, with which curve.csv ends, the ends recoil.
            kept = self.curve["time"] <= float(self.read_columns("curve.csv")["time"][-1])
            self.phase, self.curve = self.phase[kept], {name: column[kept] for name, column in self.curve.items()}
            series, _ = series_of(self)
            self.parts = pieces(series.shape(len(series) - 1), series.shape(0))
        if not self.pulled("load").size:
            raise ValueError(f"{folder}: a run in which nothing was pulled")

    def read_columns(self, name):
        with open(os.path.join(self.folder, name), newline="", encoding="utf-8") as text:
            rows = list(csv.reader(text))
        return dict(zip(rows[0], zip(*rows[2:])))

    def read_yaml(self, name):
        with open(os.path.join(self.folder, name), encoding="utf-8") as text:
            return yaml.safe_load(text)

    def pulled(self, column):
        return self.curve[column][self.phase == "pull"]


def draw_rod(axes, run):
    tubes = [(part, Tube(smooth(to_picture(run.shape[part])), run.method["material"]["radius"])) for part in run.parts]
    colours = np.concatenate([tube.shaded(halves(run, part, tube.along)) for part, tube in tubes])
    order = np.argsort(np.concatenate([tube.depth for _, tube in tubes]), kind="stable")
    outlines = np.concatenate([tube.outlines for _, tube in tubes])[order]
    axes.add_collection(PolyCollection(1e3 * outlines, facecolors=colours[order], edgecolors=colours[order], linewidths=0.3,
                                       zorder=2))
    if run.method["specimen"]["knot"] == "fisherman" and run.method["machine"]["grips"] == "rollers":
        radius = 0.5e3 * run.method["machine"]["roller_diameter"]
        for z in (0.0, 1e3 * run.curve["end_to_end"][-1]):
            axes.add_patch(plt.Circle((z, 0.0), radius, facecolor=ROLLER, edgecolor=HUB, zorder=1))
            axes.add_patch(plt.Circle((z, 0.0), 0.15 * radius, facecolor=HUB, edgecolor="none", zorder=1))
    axes.set_aspect("equal")
    axes.axis("off")


def halves(run, part, along):
    """The colours of the rod's halves at places along a part of it, 0 to 1."""
    node = part.start + along * (part.stop - 1 - part.start)
    return np.where((node < 0.5 * (len(run.shape) - 1))[:, None], FIRST_HALF, SECOND_HALF)


def draw_phases(axes, run):
    time, begin = run.curve["time"], 0
    changes = [i for i in range(1, len(time)) if run.phase[i] != run.phase[i - 1]]
    for end in changes + [len(time) - 1]:
        name = run.phase[begin]
        axes.axvspan(time[begin], time[end], color=PHASES.get(name, FAINT), lw=0)
        if time[end] - time[begin] > 0.04 * time[-1]:
            axes.text(0.5 * (time[begin] + time[end]), 0.5, name, ha="center", va="center", fontsize=SMALL, color=INK,
                      transform=axes.get_xaxis_transform())
        begin = end
    axes.set_xlim(time[0], time[-1])
    axes.set_yticks([])
    axes.set_xlabel("time [s]")
    axes.grid(False)


def draw_curve(axes, runs):
    run = runs[-1]
    s, load = 1e3 * run.pulled("extension"), run.pulled("load")
    axes.plot(s, load, color=BLUE, lw=1.4)
    # Logarithmic, and linear around zero: the load of sliding knots is a thousandth of that of locked ones.
    usual = np.median(np.abs(load))
    axes.set_yscale("symlog", linthresh=10.0 ** np.floor(np.log10(usual)) if usual > 0.0 else 1.0)
    axes.set_xlabel("extension s [mm]")
    axes.set_ylabel("load F [N]")
    axes.set_xlim(0.0, s[-1])
    lock, pattern = run.result.get("lock_extension"), run.result.get("motion_pattern")
    if lock is not None:
        axes.axvline(1e3 * lock, color=INK, lw=0.9, ls=(0, (4, 3)))
        axes.text(1e3 * lock, 1.02, f"lock {1e3 * lock:.1f} mm", ha="center", fontsize=SMALL, color=INK, transform=axes.get_xaxis_transform())
    for number, other in enumerate(runs):
        axes.plot(1e3 * other.pulled("extension")[-1], other.pulled("load")[-1], "o", color="white", mec=INK, ms=11,
                  clip_on=False, zorder=5)
        axes.annotate(chr(ord("a") + number), (1e3 * other.pulled("extension")[-1], other.pulled("load")[-1]),
                      ha="center", va="center_baseline", fontsize=SMALL, zorder=6, annotation_clip=False)
    second = axes.twinx()
    second.plot(s, 1e3 * run.pulled("knot_distance"), color=VIOLET, lw=1.2)
    second.set_ylabel("knot distance e [mm]", color=VIOLET)
    second.spines["right"].set_visible(True)
    second.grid(False)
    axes.set_zorder(second.get_zorder() + 1)
    axes.patch.set_visible(False)
    if pattern not in (None, "none"):
        axes.text(0.45, 0.96, f"motion pattern: {pattern}", transform=axes.transAxes, va="top", color=GREEN)


def draw(runs, file):
    figure = plt.figure(figsize=(9.0, 1.45 * len(runs) + 4.9))
    grid = figure.add_gridspec(len(runs) + 2, 1, height_ratios=[1.45] * len(runs) + [0.26, 3.4], hspace=0.35)
    for number, run in enumerate(runs):
        axes = figure.add_subplot(grid[number])
        draw_rod(axes, run)
        axes.set_title(f"{chr(ord('a') + number)}   s = {1e3 * run.curve['extension'][-1]:.1f} mm", loc="left")
    # One scale for all of them.
    drawn = 1e3 * np.vstack([to_picture(run.shape) for run in runs])[:, :2]
    margin = 2e3 * runs[-1].method["material"]["radius"]
    for axes in figure.axes:
        axes.set_xlim(drawn[:, 0].min() - margin, drawn[:, 0].max() + margin)
        axes.set_ylim(drawn[:, 1].min() - margin, drawn[:, 1].max() + margin)
    draw_phases(figure.add_subplot(grid[-2]), runs[-1])
    draw_curve(figure.add_subplot(grid[-1]), runs)
    figure.subplots_adjust(left=0.09, right=0.91, top=0.92, bottom=0.08)
    figure.suptitle(f"{runs[-1].method['material'].get('name', '')}, F_p = {runs[-1].result['preload']:g} N"
                    if runs[-1].result.get("preload") else "", fontsize=USUAL, y=0.985)
    command = shlex.join(["scripts/picture", *(word for word in sys.argv[1:] if word != "--overwrite")])
    figure.savefig(file, dpi=120, metadata={"Software": None, **facts_of_run(runs[-1].folder, command)})


def main():
    parser, args = ASKED
    if why := why_not(args.out, [file for folder in args.runs for file in files_of(folder)], args.overwrite):
        parser.exit(2, f"picture: --out: {why}\n")
    try:
        runs = [Run(folder) for folder in args.runs]
    except (OSError, KeyError, IndexError, ValueError, CannotReport) as error:
        parser.exit(2, f"picture: {error}\n")
    draw(runs, args.out)
    return 0


if __name__ == "__main__":
    sys.exit(main())
