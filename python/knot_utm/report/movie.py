"""Makes a movie of a test, or of two side by side: the rod above its curve, which is drawn as far as the test has come. Two tests are
shown at the same time since their pull began, with the same colours and the same axes."""
import multiprocessing
import os
import shutil
import subprocess
import sys

import numpy as np

from knot_utm.errors import refuse_if
from knot_utm.report.colours import colour_scales, LABELS
from knot_utm.report.commands import file_ending, in_one_line, OneLineParser, test_in
from knot_utm.report.curves import small_loads
from knot_utm.report.method_facts import knot_and_materials
from knot_utm.report.rod_pictures import by_scale, draw_rod, view
from knot_utm.report.run import Run
from knot_utm.report.shapes import nearest, shapes_of
from knot_utm.report.style import BLUE, FAINT, new_figure, ORANGE, USUAL

SIZE = (1920, 1080)
# The colours of high-definition video: without conversion and marks players take one matrix for another, and reds and blues are off.
BT709 = ("-vf", "scale=out_color_matrix=bt709:out_range=tv", "-color_range", "tv", "-colorspace", "bt709", "-color_primaries", "bt709",
         "-color_trc", "bt709")
DPI = 120
VIEWS = 12  # shapes of a test that the frame of its pictures is made for


def asked():
    parser = OneLineParser(prog="movie", description=__doc__)
    parser.add_argument("runs", nargs="+", metavar="RUN", type=test_in, help="the folder of a test; at most two")
    parser.add_argument("--out", default="movie.mp4", type=file_ending(".mp4"), help="the file [movie.mp4]")
    parser.add_argument("--seconds", type=float, default=12.0, help="that the movie takes [12]")
    parser.add_argument("--rate", type=int, default=25, help="pictures a second [25]")
    parser.add_argument("--color", choices=LABELS, default="tension", help="what the colours show [tension]")
    parser.add_argument("--overwrite", action="store_true", help="write over a file that exists")
    found = parser.parse_args()
    if len(found.runs) > 2:
        parser.error(f"{found.runs[2]}: two runs have room side by side")
    parser.require_room("--out", found.out, found.runs, found.overwrite)
    if not 1 <= found.rate <= 120:
        parser.error(f"--rate {found.rate}: from 1 to 120 are allowed")
    if not 1.0 <= found.seconds * found.rate <= 1e5:
        parser.error(f"--seconds {found.seconds:g}: from 1 to 100000 pictures are allowed")
    return found


def main():
    arguments = asked()
    if shutil.which("ffmpeg") is None:
        raise RuntimeError("there is no ffmpeg: install Debian's package ffmpeg")
    stage = Stage(arguments.runs, arguments.color, SIZE)
    times = stage.times(round(arguments.seconds * arguments.rate))
    part = arguments.out + ".part"
    try:
        encode(stage, times, arguments.rate, part)
        os.replace(part, arguments.out)
    finally:
        if os.path.isfile(part):
            os.remove(part)
    print(f"{arguments.out}: {len(times)} pictures of {SIZE[0]} x {SIZE[1]}")


def encode(stage, times, rate, file):
    """All pictures in order, each as soon as a core has drawn it."""
    encoder = subprocess.Popen(
        ["ffmpeg", "-loglevel", "error", "-y", "-f", "rawvideo", "-pix_fmt", "rgba", "-s", f"{SIZE[0]}x{SIZE[1]}",
         "-r", str(rate), "-i", "-", *BT709, "-c:v", "libx264", "-pix_fmt", "yuv420p", "-crf", "18", "-movflags", "+faststart",
         "-fflags", "+bitexact", "-f", "mp4", file], stdin=subprocess.PIPE, stderr=subprocess.PIPE)
    try:
        with multiprocessing.get_context("fork").Pool() as pool:
            for number, picture in enumerate(pool.imap(stage.picture, times), 1):
                encoder.stdin.write(picture)
                if sys.stderr.isatty():
                    print(f"\r{number} of {len(times)} pictures ", end="", file=sys.stderr, flush=True)
        if sys.stderr.isatty():
            print("\r\033[K", end="", file=sys.stderr, flush=True)
    except BrokenPipeError:
        pass  # what the encoder says tells more
    _, said = encoder.communicate()
    if encoder.returncode != 0:
        raise RuntimeError(f"{file}: ffmpeg: {said.decode(errors='replace')}")


class Stage:
    """One or two tests, with what all of their pictures have in common."""

    def __init__(self, folders, name, size):
        self.size = size
        self.tests = [OneTest(folder) for folder in folders]
        first = self.tests[0].run
        scales = colour_scales([shape for test in self.tests for shape in test.shapes], first.method["material"]["radius"], first.units)
        refuse_if(name not in scales, f"{folders[0]}: --color {name}: it is not known, or nowhere different from zero; known are: "
                  f"{', '.join(scales)}")
        self.scale = scales[name]
        self.extensions, self.loads = ((min(0.0, *(one.min() for one in of_tests)), max(1e-9, *(one.max() for one in of_tests)))
                                       for of_tests in ([test.extension for test in self.tests], [test.load for test in self.tests]))
        small = [small_loads(test.run.value, test.tested["load"]) for test in self.tests]
        unit = first.units.force.scale
        self.small = (unit * min(low for low, _ in small), unit * max(high for _, high in small)) if all(small) else None

    def times(self, count):
        """Evenly spaced since the start of the pull [s]."""
        begin, end = ([test.shapes[i].time - test.begin for test in self.tests] for i in (0, -1))
        return np.linspace(min(begin), max(end), count)

    def picture(self, time):
        """Bytes, four a pixel."""
        figure = new_figure(self.size[0] / DPI, self.size[1] / DPI)
        figure.set_dpi(DPI)
        for column, test in enumerate(self.tests):
            self.draw(figure, column / len(self.tests), 1.0 / len(self.tests), test, time)
        self.scale.draw(figure.add_axes([0.35, 0.065, 0.3, 0.016]), USUAL + 3)
        figure.canvas.draw()
        return bytes(figure.canvas.buffer_rgba())

    def draw(self, figure, left, wide, test, time):
        shape = test.at(time)
        rod = figure.add_axes([left + 0.01, 0.47, wide - 0.02, 0.42])
        draw_rod(rod, test.run, shape, by_scale(self.scale, shape), test.box)
        figure.text(left + 0.5 * wide, 0.945, test.title, ha="center", fontsize=USUAL + 7, weight="bold")
        figure.text(left + 0.5 * wide, 0.905, test.run.words_at(shape.time), ha="center", fontsize=USUAL + 4)
        # Where the peak hides the plateau small loads are shown again, above.
        for loads, name, low in ((self.small, "small loads", 0.335), (self.loads, "load", 0.17)):
            if loads:
                axes = figure.add_axes([left + 0.06, low, wide - 0.08, 0.13 if self.small else 0.28])
                self.draw_curve(axes, test, shape, loads, name)
                axes.tick_params(labelsize=USUAL + 2, labelbottom=name == "load")
        axes.set_xlabel(f"extension [{test.run.units.length.name}]", fontsize=USUAL + 3)

    def draw_curve(self, axes, test, shape, loads, name):
        axes.plot(test.extension, test.load, color=FAINT, lw=2.0)
        if shape.time >= test.begin:
            extension, load = test.until(shape.time)
            axes.plot(extension, load, color=BLUE, lw=2.4)
            axes.plot(extension[-1], load[-1], "o", ms=9, color=ORANGE, clip_on=not loads[0] <= load[-1] <= loads[1], zorder=5)
        axes.set(xlim=self.extensions, ylim=(loads[0], loads[1] + 0.05 * (loads[1] - loads[0])))
        axes.set_ylabel(f"{name} [{test.run.units.force.name}]", fontsize=USUAL + 3)


class OneTest:
    def __init__(self, folder):
        self.run = run = Run(folder)
        self.shapes, note = shapes_of(run)
        self.tested = run.curve.tested()
        refuse_if(note or len(self.shapes) < 2, f"{folder}: it has no shapes over time; tensile_test --shapes keeps them")
        refuse_if(not len(self.tested), f"{folder}: the test ended before the specimen was pulled")
        self.begin = float(self.tested["time"][0])
        self.extension = run.units.length.scale * self.tested["extension"]
        self.load = run.units.force.scale * self.tested["load"]
        self.title = knot_and_materials(run.method, run.folder)
        some = np.unique(np.linspace(0, len(self.shapes) - 1, VIEWS).astype(int))
        views = np.array([view(run, self.shapes[i], run.thickest()) for i in some])
        self.box = (views[:, 0].min(), views[:, 1].max(), views[:, 2].min(), views[:, 3].max())

    def at(self, time):
        """The shape that was computed nearest to it."""
        return nearest(self.shapes, time + self.begin)

    def until(self, time):
        """Extension and load up to a time [s], in the units of the page."""
        times = self.tested["time"]
        past = times < time
        return [np.append(values[past], np.interp(time, times, values)) for values in (self.extension, self.load)]


if __name__ == "__main__":
    with in_one_line("movie"):
        main()
