"""Draws runs of one test: the rod as a shaded tube on its rollers, and its curve with its phases. The PNG carries what it shows and
how it was made as texts, which a test holds against what the program says today."""
import os
import shlex
import string
import sys

import numpy as np
from matplotlib.colors import to_rgb
from PIL import Image
from PIL.PngImagePlugin import PngInfo

from knot_utm.report.commands import CannotReport, files_of, in_one_line, OneLineParser, refuse, why_not
from knot_utm.report.curves import course, force_extension
from knot_utm.report.marks import Mark
from knot_utm.report.method_facts import materials_of
from knot_utm.report.rod_pictures import draw_rollers, Tubes
from knot_utm.report.run import read_yaml, Run
from knot_utm.report.shapes import final_shape, pieces, ropes, series_of
from knot_utm.report.style import BLUE, image_of, new_figure, ORANGE, WIDTH
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


def rods(runs, letters):
    """Their final shapes, on one scale for all of them."""
    shapes = [final_shape(run) for run in runs]
    figure = new_figure(WIDTH, 1.45 * len(runs))
    figure.subplots_adjust(left=0.01, right=0.99, top=1.0 - 0.3 / (1.45 * len(runs)), bottom=0.0)
    drawn = 1e3 * np.vstack([to_picture(shape.points) for shape in shapes])[:, :2]
    (left, low), (right, high) = drawn.min(axis=0) - 2e3 * runs[-1].thickest(), drawn.max(axis=0) + 2e3 * runs[-1].thickest()
    for number, (letter, run, shape) in enumerate(zip(letters, runs, shapes), 1):
        axes = figure.add_subplot(len(runs), 1, number)
        draw_shape(axes, run, shape)
        axes.set_title(f"{letter}   s = {1e3 * run.pull()['extension'][-1]:.1f} mm", loc="left")
        axes.set(xlim=(left, right), ylim=(low, high))
    return figure


def draw(runs, file, command):
    last, ends = runs[-1], []
    for letter, run in zip(string.ascii_lowercase, runs):
        pull = run.pull()
        ends.append(Mark([], *(float(pull[name][-1]) for name in ("time", "extension", "load"))))
        ends[-1].letter = letter
    images = [image_of(figure) for figure in (rods(runs, [end.letter for end in ends]), course(last), force_extension(last, ends))]
    picture = Image.new("RGB", (images[0].width, sum(image.height for image in images)), "white")
    for number, image in enumerate(images):
        picture.paste(image, (0, sum(image.height for image in images[:number])))
    texts = PngInfo()
    for name, text in facts_of_run(last.folder, command).items():
        texts.add_itxt(name, text)
    picture.save(file, "PNG", pnginfo=texts)


if __name__ == "__main__":
    with in_one_line("picture"):
        main()
