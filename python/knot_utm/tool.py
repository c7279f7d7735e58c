"""tensile_test, as this package calls it."""
import csv
import difflib
import errno
import functools
import os
import re
import shutil
import subprocess

import knot_utm
from knot_utm.errors import refuse_if, WrongInput
from knot_utm.yaml_text import text_of

HERE = os.path.dirname(os.path.realpath(__file__))
IN_SOURCES = os.path.isdir(os.path.join(HERE, "../../config"))
# Of the sources, or of an installation: where config/ and report/ stand.
SHARE = os.path.realpath(os.path.join(HERE, "../.." if IN_SOURCES else "../../../../share/knot_utm"))
CONFIG = os.path.join(SHARE, "config")
COUNT = "specimens.count"  # how it is told of repeats
REFUSED = 2  # its exit code for wrong input
DISK_IS_FULL = [os.strerror(code).lower() for code in (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)]


@functools.cache
def tensile_test():
    """The program: in the folder that KNOT_UTM_TOOLS_DIR names, else as it was built or installed with this package, else the
    one on the path. Raises WrongInput."""
    given = os.environ.get("KNOT_UTM_TOOLS_DIR")
    places = [os.path.join(folder, "tensile_test") for folder in ([given] if given else _folders_of_tools())]
    for place in [*places, shutil.which("tensile_test")]:
        if place and os.access(place, os.X_OK):
            return os.path.abspath(place)
    raise WrongInput(f"{places[0]} is not there" + (": scripts/build tensile_test makes it" if IN_SOURCES else ""))


def _folders_of_tools():
    """The folders beside the places where this package is, in their order: a workspace of catkin has one beside the sources."""
    for place in knot_utm.__path__:
        built = IN_SOURCES and os.path.realpath(place) == HERE
        yield os.path.realpath(os.path.join(SHARE, "build/devel/lib/knot_utm") if built else os.path.join(place, "../../../knot_utm"))


def program(name):
    """How a user calls a command of this package from the current folder."""
    if not IN_SOURCES:
        return f"python3 -m knot_utm.{name}_command"
    script = os.path.join(SHARE, "scripts", name)
    near = os.path.relpath(script)
    return script if near.startswith(os.pardir) else near


@functools.cache
def version():
    return _asked("--version").stdout.strip()


def package_version():
    """The version of this package. An installation without ROS has no package.xml, so that its programs are asked."""
    try:
        with open(os.path.join(SHARE, "package.xml"), encoding="utf-8") as file:
            return re.search(r"<version>\s*([^\s<]+)", file.read())[1]
    except FileNotFoundError:
        return version()


@functools.cache
def listing(name):
    """A table that tensile_test prints, as rows by column: results, limits, fields, method-keys, knots or phases."""
    return list(csv.DictReader(_asked("--list-" + name).stdout.splitlines()))


def find_method(name, folder):
    """The file of a method, from a folder, or of one that comes with the package, as tensile_test finds it. Raises WrongInput."""
    shipped = [CONFIG] if os.sep in name else [CONFIG, os.path.join(CONFIG, "standards"), os.path.join(CONFIG, "validation")]
    places = [os.path.join(folder, name)] + [os.path.join(of, name + end) for of in shipped for end in ("", ".yaml")]
    for place in places:
        if os.path.isfile(place):
            return os.path.abspath(place)
    known = [os.path.splitext(file)[0] for of in shipped for file in os.listdir(of) if file.endswith(".yaml")]
    raise WrongInput(f"method is {name}, but must be a file, from {folder}, or the name of a method that comes with the "
                     f"package{hint(name, known)}")


def hint(word, known):
    """"; did you mean WORD?" of the known word that is spelt nearly so; empty where there is none."""
    near = difflib.get_close_matches(str(word), list(known), 1)
    return f"; did you mean {near[0]}?" if near else ""


def command(method, settings, out, *more):
    """The command line of one run; `settings`: {dotted key: value}."""
    return [tensile_test(), *_words(method, settings), "--out", out, *more]


def start(method, settings, out, *more):
    """A run under way, as a process. It is not in the terminal's group, whose Ctrl-C is for the caller, and dies with the caller."""
    words = command(method, settings, out, "--quiet", *more)
    return subprocess.Popen(["setpriv", "--pdeathsig", "KILL", *words], cwd=os.path.dirname(method), text=True, errors="replace",
                            process_group=0, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)


def refusal(method, settings, *more):
    """Why tensile_test would refuse to run that, in a line; None where it would not."""
    done = _asked("--check", *_words(method, settings), *more, folder=os.path.dirname(method))
    return said_by(done.stderr) if done.returncode == REFUSED else None


def resolved(method, settings):
    """The text of the method with every value. Raises WrongInput where tensile_test would refuse to run it."""
    done = _asked("--check", *_words(method, settings), folder=os.path.dirname(method))
    refuse_if(done.returncode == REFUSED, said_by(done.stderr))
    return done.stdout


def key_units(method, settings):
    """{key: unit} of all numbers of a method, "-" where a number has none; none where tensile_test would refuse to run it."""
    done = _asked("--list-keys", *_words(method, settings), folder=os.path.dirname(method))
    return {row["key"]: row["unit"] for row in csv.DictReader(done.stdout.splitlines())}


def said_by(stderr):
    """The last line that tensile_test said, without its name."""
    return next(reversed(lines_of(stderr)), "")


def lines_of(stderr):
    """All lines that tensile_test said, without its name."""
    return [line.removeprefix("tensile_test: ") for line in stderr.strip().splitlines()]


def is_of_a_full_disk(said):
    return any(text in said.lower() for text in DISK_IS_FULL)


def _words(method, settings):
    return [method, *(word for key, value in settings.items() for word in ("--set", f"{key}={text_of(value)}"))]


def _asked(option, *words, folder=None):
    """What tensile_test says without a run; of a method, seen from its folder, it may say that it refuses it. Raises RuntimeError with a
    line where it failed otherwise."""
    done = subprocess.run([tensile_test(), option, *words], check=False, text=True, errors="replace", cwd=folder,
                          stdin=subprocess.DEVNULL, capture_output=True)
    if done.returncode not in ((0, REFUSED) if folder else (0,)):
        raise RuntimeError(f"tensile_test failed at {option}: {said_by(done.stderr) or f'exit code {done.returncode}'}")
    return done
