"""tensile_test, as this package calls it."""
import csv
import errno
import functools
import os
import shutil
import subprocess

from knot_utm.errors import WrongInput
from knot_utm.yaml_text import text_of

ROOT = os.path.realpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "../.."))
CONFIG = os.path.join(ROOT, "config")
REFUSED = 2  # its exit code for wrong input
DISK_IS_FULL = [os.strerror(code).lower() for code in (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)]


@functools.cache
def tensile_test():
    """The program: in the folder that KNOT_UTM_TOOLS_DIR names, else as scripts/build made it, else the one on the path."""
    folder = os.environ.get("KNOT_UTM_TOOLS_DIR") or os.path.join(ROOT, "build/devel/lib/knot_utm")
    place = os.path.join(folder, "tensile_test")
    found = place if os.access(place, os.X_OK) else shutil.which("tensile_test")
    if not found:
        raise WrongInput(f"{place} is not there: scripts/build tensile_test makes it")
    return os.path.abspath(found)


@functools.cache
def version():
    return _said("--version").strip()


@functools.cache
def result_keys():
    """[{key, unit, kind, group, meaning}] of result.yaml."""
    return list(csv.DictReader(_said("--list-results").splitlines()))


def find_method(name, folder):
    """The file of a method, from a folder, or of one that comes with the package, as tensile_test finds it. Raises WrongInput."""
    shipped = [CONFIG] if os.sep in name else [CONFIG, os.path.join(CONFIG, "standards")]
    places = [os.path.join(folder, name)] + [os.path.join(of, name + end) for of in shipped for end in ("", ".yaml")]
    for place in places:
        if os.path.isfile(place):
            return os.path.abspath(place)
    raise WrongInput(f"method is {name}, but must be a file, from {folder}, or the name of a method that comes with the "
                     "package")


def command(method, settings, out, *more):
    """The command line of one run; `settings`: {dotted key: value}."""
    return [tensile_test(), method, *_set(settings), "--out", out, *more]


def start(method, settings, out, *more):
    """A run under way, as a process. It is not in the terminal's group, whose Ctrl-C is for the caller, and dies with the caller."""
    words = command(method, settings, out, "--quiet", *more)
    return subprocess.Popen(["setpriv", "--pdeathsig", "KILL", *words], cwd=os.path.dirname(method), text=True, errors="replace",
                            process_group=0, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)


def refusal(method, settings):
    """Why tensile_test would refuse to run that, in a line; None where it would not."""
    done = _asked(method, settings, "--check")
    if done.returncode not in (0, REFUSED):
        raise RuntimeError(f"tensile_test could not check {method}: {said_by(done.stderr) or f'exit code {done.returncode}'}")
    return said_by(done.stderr) if done.returncode == REFUSED else None


def resolved(method, settings):
    """The text of the method with every value. Raises WrongInput where tensile_test would refuse to run it."""
    done = _asked(method, settings, "--check")
    if done.returncode != 0:
        raise WrongInput(said_by(done.stderr))
    return done.stdout


def key_units(method, settings):
    """{key: unit} of all numbers of a method, "-" where a number has none."""
    done = _asked(method, settings, "--list-keys")
    return {row["key"]: row["unit"] for row in csv.DictReader(done.stdout.splitlines())}


def said_by(stderr):
    """The last line that tensile_test said, without its name."""
    lines = stderr.strip().splitlines()
    return lines[-1].removeprefix("tensile_test: ") if lines else ""


def is_of_a_full_disk(said):
    return any(text in said.lower() for text in DISK_IS_FULL)


def _set(settings):
    return [word for key, value in settings.items() for word in ("--set", f"{key}={text_of(value)}")]


def _asked(method, settings, option):
    """What tensile_test says of a method without running it."""
    return subprocess.run([tensile_test(), method, *_set(settings), option], check=False, text=True, errors="replace",
                          cwd=os.path.dirname(method), stdin=subprocess.DEVNULL, capture_output=True)


def _said(option):
    return subprocess.run([tensile_test(), option], check=True, text=True, stdin=subprocess.DEVNULL, capture_output=True).stdout
