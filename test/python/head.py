"""The head of the tests in Python: where things are, and what of them more than one test needs. A test is skipped, with exit
code 77, where a package that scripts/sweep installs is not there."""
import os
import sys

ROOT = os.path.realpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "../.."))
TOOLS = os.environ.get("KNOT_UTM_TOOLS_DIR", os.path.join(ROOT, "build/devel/lib/knot_utm"))
sys.dont_write_bytecode = True
os.environ["KNOT_UTM_NO_CACHE"] = "1"  # a test takes up nothing that another one has left

try:
    import matplotlib  # noqa: F401
    import numpy  # noqa: F401
    import pandas  # noqa: F401
    import scipy  # noqa: F401
    import tables  # noqa: F401
    import tqdm  # noqa: F401
    import yaml  # noqa: F401
except ModuleNotFoundError as absent:
    print(f"skipped: {absent} (scripts/sweep installs it)")
    sys.exit(77)


def write(path, text):
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)
    return path


def read(*path):
    with open(os.path.join(*path), encoding="utf-8", newline="") as file:
        return file.read()
