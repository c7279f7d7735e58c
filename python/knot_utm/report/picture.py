"""Draws runs of one test: the rod as a shaded tube on its rollers, and its curve with its phases. The PNG carries what it shows and
how it was made as texts, which a test holds against what the program says today."""
import contextlib
import os
import re
import shlex
import signal
import socket
import string
import subprocess
import sys
import tempfile
import time

import numpy as np
from matplotlib import pyplot
from matplotlib.colors import to_rgb
from PIL import Image
from PIL.PngImagePlugin import PngInfo

from knot_utm import tool
from knot_utm.errors import refuse_if
from knot_utm.report.commands import in_one_line, OneLineParser
from knot_utm.report.curves import course, force_extension
from knot_utm.report.marks import mark_at
from knot_utm.report.method_facts import materials_of
from knot_utm.report.rod_pictures import draw_rod
from knot_utm.report.run import read_yaml, Run
from knot_utm.report.shapes import final_shape
from knot_utm.report.style import BLUE, image_of, new_figure, ORANGE, WIDTH
from knot_utm.report.tube import to_picture

# The rod's two halves, each with one knot.
FIRST_HALF, SECOND_HALF = np.array(to_rgb(ORANGE)), np.array(to_rgb(BLUE))
READINGS = {"plateau_force": "N", "lock_extension": "m"}
COLUMNS = 5  # of the knots
# Who must listen before the test begins: else its curve would be none.
LISTENERS = {"/knot/markers": "rviz", "/view/panel": "rviz", "/utm/load_cell": "panel_node"}


def facts_of_run(folder, command):
    """The texts of a picture of a run, by name."""
    result, method = (read_yaml(os.path.join(folder, name)) for name in ("result.yaml", "method.yaml"))
    readings = {key: "none" if result.get(key) is None else f"{result[key]:.6g} {unit}" for key, unit in READINGS.items()}
    described = f"{method['specimen']['knot']}, {materials_of(method)}"
    return {**readings, "version": str(result["version"]), "method": described, "command": command}


def main():
    parser = OneLineParser(prog="picture", description=__doc__)
    parser.add_argument("words", nargs="*", metavar="RUN")
    parser.add_argument("--knots", action="store_true", help="all shipped knots instead")
    parser.add_argument("--rviz", action="store_true", help="what rviz shows at the end of a test; the words are arguments of its launch")
    parser.add_argument("--out", required=True, metavar="PNG")
    parser.add_argument("--overwrite", action="store_true", help="write over a picture that exists")
    asked = parser.parse_args()
    of_runs = not asked.knots and not asked.rviz
    for word in () if of_runs else asked.words:
        refuse_if(asked.knots or not re.match(r"(?!record:|out:)\w+:=", word),
                  f"--{'knots' if asked.knots else 'rviz'} takes no {word} (scripts/picture --help)")
    parser.require_room("--out", asked.out, asked.words if of_runs else (), asked.overwrite)
    command = shlex.join(["scripts/picture", *(word for word in sys.argv[1:] if word != "--overwrite")])
    if of_runs:
        return draw([Run(folder) for folder in asked.words], asked.out, command)
    with tempfile.TemporaryDirectory() as folder:
        shot = os.path.join(folder, "shot.png")
        facts = shot_of_knots(folder, shot) if asked.knots else shot_of_rviz(folder, shot, asked.words)
        with Image.open(shot) as picture:
            save(picture.convert("RGB"), asked.out, {**facts, "command": command})


def rods(runs, letters):
    """Their final shapes, on one scale for all of them."""
    shapes = [final_shape(run) for run in runs]
    figure = new_figure(WIDTH, 1.45 * len(runs))
    figure.subplots_adjust(left=0.01, right=0.99, top=1.0 - 0.3 / (1.45 * len(runs)), bottom=0.0)
    drawn = 1e3 * np.vstack([to_picture(shape.points) for shape in shapes])[:, :2]
    (left, low), (right, high) = drawn.min(axis=0) - 2e3 * runs[-1].thickest(), drawn.max(axis=0) + 2e3 * runs[-1].thickest()
    for number, (letter, run, shape) in enumerate(zip(letters, runs, shapes), 1):
        axes = figure.add_subplot(len(runs), 1, number)
        draw_rod(axes, run, shape, lambda node, half=0.5 * (len(shape.points) - 1): np.where(
            (node < half)[:, None], FIRST_HALF, SECOND_HALF), (left, right, low, high))
        axes.set_title(f"{letter}   s = {1e3 * run.curve.pull()['extension'][-1]:.1f} mm", loc="left")
    return figure


def draw(runs, file, command):
    refuse_if(not runs, "name a folder of a run (scripts/picture --help)")
    for run in runs:
        refuse_if(not len(run.curve.pull()), f"{run.folder}: a run in which nothing was pulled")
    last, ends = runs[-1], [mark_at(run.curve.pull(), -1, letter=letter) for letter, run in zip(string.ascii_lowercase, runs)]
    images = [image_of(figure) for figure in (rods(runs, [end.letter for end in ends]), course(last), force_extension(last, ends))]
    save(Image.fromarray(np.vstack(images)), file, facts_of_run(last.folder, command))


def save(picture, file, facts):
    texts = PngInfo()
    for name, text in facts.items():
        texts.add_itxt(name, text)
    picture.save(file, "PNG", pnginfo=texts)


def shot_of_knots(folder, shot):
    """The pictures of all drawings on one page."""
    names = sorted(os.path.splitext(name)[0] for name in os.listdir(os.path.join(tool.CONFIG, "knots")))
    page, axes = pyplot.subplots(-(-len(names) // COLUMNS), COLUMNS, figsize=(12, 2.4 * -(-len(names) // COLUMNS)), layout="tight")
    for one in axes.flat:
        one.set_axis_off()
    for name, one in zip(names, axes.flat):
        subprocess.run([tool.tensile_test(), "--draw", name, "--out", folder], check=True, stdout=subprocess.DEVNULL)
        one.imshow(pyplot.imread(os.path.join(folder, name + ".png")), interpolation="antialiased")
    page.savefig(shot, dpi=100)
    return {"version": tool.version(), "method": "--draw of all knots"}


def shot_of_rviz(folder, shot, words):
    """The end of a test with these words, on a display that only this program sees."""
    in_ros = [os.path.join(os.path.dirname(tool.tensile_test()), "../../env.sh")]
    run = os.path.join(folder, "run")

    def answer(*words):
        return subprocess.run(in_ros + list(words), check=False, capture_output=True, text=True).stdout

    def begins():
        return all(f" /{node} " in answer("rostopic", "info", topic).partition("Subscribers")[2] for topic, node in LISTENERS.items()
                   ) and "accepted: True" in answer("rosservice", "call", "/utm/start_test", "{}")

    with contextlib.ExitStack() as started:  # the display ends last: rviz would not outlive it in peace
        def start(*words, **options):
            process = started.enter_context(subprocess.Popen(words, **options))
            started.callback(process.send_signal, signal.SIGINT)
            return process

        display = start("Xvfb", "-displayfd", "1", "-screen", "0", "1280x900x24", "+extension", "GLX", "-nolisten", "tcp",
                        stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True).stdout.readline().strip()
        if not display:
            raise RuntimeError("Xvfb did not start")
        with socket.create_server(("127.0.0.1", 0)) as free:
            port = str(free.getsockname()[1])
        os.environ.update(DISPLAY=f":{display}", LIBGL_ALWAYS_SOFTWARE="1", QT_X11_NO_MITSHM="1", XDG_RUNTIME_DIR=folder, ROS_LOG_DIR=folder,
                          ROS_HOSTNAME="localhost", ROS_MASTER_URI=f"http://localhost:{port}")
        launch = start(*in_ros, "roslaunch", "-p", port, "knot_utm", "tighten.launch", "real_time_factor:=0", *words, "rviz:=true",
                       "autostart:=false", "exit_at_end:=false", "record:=true", f"out:={run}", stdout=sys.stderr)
        for reached in (begins, lambda: os.path.exists(os.path.join(run, "result.yaml"))):
            while not reached():
                if launch.poll() is not None:
                    raise RuntimeError("the test has no result")
                time.sleep(1)
        time.sleep(5)  # rviz draws what came last
        subprocess.run(["import", "-window", "root", shot], check=True)
    return facts_of_run(run, "")


if __name__ == "__main__":
    with in_one_line("picture"):
        main()
