"""What scripts/picture --knots and --rviz take a picture of. Its texts say how it was made, as those of a picture of runs do."""
import contextlib
import os
import re
import shlex
import signal
import socket
import subprocess
import sys
import tempfile
import time

from matplotlib import pyplot

from knot_utm import tool
from knot_utm.report.commands import CannotReport, in_one_line, OneLineParser, refuse, why_not
from knot_utm.report.picture import facts_of_run

COLUMNS = 5  # of the knots
# Who must listen before the test begins: else its curve would be none.
LISTENERS = {"/knot/markers": "rviz", "/view/panel": "rviz", "/utm/load_cell": "panel_node"}


def main():
    parser = OneLineParser(prog="picture")
    what = parser.add_mutually_exclusive_group(required=True)
    what.add_argument("--knots", action="store_true")
    what.add_argument("--rviz", action="store_true")
    parser.add_argument("words", nargs="*")
    parser.add_argument("--out", required=True)
    parser.add_argument("--overwrite", action="store_true")
    asked = parser.parse_args()
    for word in asked.words:
        if asked.knots or not re.match(r"(?!record:|out:)\w+:=", word):
            refuse("picture", f"--{'knots' if asked.knots else 'rviz'} takes no {word} (scripts/picture --help)")
    if why := why_not(asked.out, [], asked.overwrite):
        refuse("picture", f"--out: {why}")
    with tempfile.TemporaryDirectory() as folder:
        shot = os.path.join(folder, "shot.png")
        facts = shot_of_knots(folder, shot) if asked.knots else shot_of_rviz(folder, shot, asked.words)
        command = shlex.join(["scripts/picture", *(word for word in sys.argv[1:] if word != "--overwrite")])
        pyplot.imsave(asked.out, pyplot.imread(shot), format="png", metadata={"Software": None, **facts, "command": command})


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
            raise CannotReport("Xvfb did not start")
        with socket.create_server(("127.0.0.1", 0)) as free:
            port = str(free.getsockname()[1])
        os.environ.update(DISPLAY=f":{display}", LIBGL_ALWAYS_SOFTWARE="1", QT_X11_NO_MITSHM="1", XDG_RUNTIME_DIR=folder, ROS_LOG_DIR=folder,
                          ROS_HOSTNAME="localhost", ROS_MASTER_URI=f"http://localhost:{port}")
        launch = start(*in_ros, "roslaunch", "-p", port, "knot_utm", "tighten.launch", "real_time_factor:=0", *words, "rviz:=true",
                       "autostart:=false", "exit_at_end:=false", "record:=true", f"out:={run}", stdout=sys.stderr)
        for reached in (begins, lambda: os.path.exists(os.path.join(run, "result.yaml"))):
            while not reached():
                if launch.poll() is not None:
                    raise CannotReport("the test has no result")
                time.sleep(1)
        time.sleep(5)  # rviz draws what came last
        subprocess.run(["import", "-window", "root", shot], check=True)
    return facts_of_run(run, None)


if __name__ == "__main__":
    with in_one_line("picture"):
        main()
