"""Makes a movie of a test, or of two side by side: the rod above its curve, which is drawn as far as the test has come.

    scripts/movie RUN [RUN] [--out FILE.mp4] [--seconds S] [--rate FPS] [--color NAME] [--overwrite]

RUN is the folder of a test with shapes.csv (tensile_test --shapes) or test.bag. Two tests are shown at the same time since
their pull began, with the same colours and the same axes.
"""
import argparse
import multiprocessing
import os
import shutil
import subprocess
import sys

from knot_utm.report.commands import CannotReport, files_of, in_one_line, OneLineParser, why_not

SIZE = (1920, 1080)
NAMES = ("tension", "curvature", "twist", "contact_force")


def asked():
    parser = OneLineParser(prog="movie", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("runs", nargs="+", metavar="RUN", help="the folder of a test; at most two")
    parser.add_argument("--out", default="movie.mp4", help="the file [movie.mp4]")
    parser.add_argument("--seconds", type=float, default=12.0, help="that the movie takes [12]")
    parser.add_argument("--rate", type=int, default=25, help="pictures a second [25]")
    parser.add_argument("--color", choices=NAMES, default="tension", help="what the colours show [tension]")
    parser.add_argument("--overwrite", action="store_true", help="write over a file that exists")
    found = parser.parse_args()
    if len(found.runs) > 2:
        parser.error(f"{found.runs[2]}: two runs have room side by side")
    for folder in found.runs:
        if not os.path.isdir(folder):
            parser.error(f"{folder}: no such folder")
    if not found.out.endswith(".mp4"):
        parser.error(f"--out {found.out}: the name of the file must end with .mp4")
    if why := why_not(found.out, [file for folder in found.runs for file in files_of(folder)], found.overwrite):
        parser.error(f"--out: {why}")
    if not 1 <= found.rate <= 120:
        parser.error(f"--rate {found.rate}: from 1 to 120 are allowed")
    if not 1.0 <= found.seconds * found.rate <= 1e5:
        parser.error(f"--seconds {found.seconds:g}: from 1 to 100000 pictures are allowed")
    return found


def main():
    arguments = asked()
    with in_one_line("movie"):
        make(arguments)


def make(arguments):
    from knot_utm.report.movie_frame import Stage

    if shutil.which("ffmpeg") is None:
        raise CannotReport("there is no ffmpeg: install Debian's package ffmpeg")
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
         "-r", str(rate), "-i", "-", "-c:v", "libx264", "-pix_fmt", "yuv420p", "-crf", "18", "-movflags", "+faststart",
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
        raise CannotReport(f"{file}: ffmpeg: {said.decode(errors='replace')}")


if __name__ == "__main__":
    main()
