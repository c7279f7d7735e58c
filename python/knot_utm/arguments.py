"""What functions of this package and its commands are given: each refuses what cannot be meant in one line."""
import contextlib
import os
from numbers import Integral

from knot_utm import tool
from knot_utm.errors import refuse_if, WrongInput


def shown(value):
    """In one line, which is not long."""
    text = " ".join(repr(value).split())
    return text if len(text) <= 60 else text[:57] + "..."


def whole(name, value, least, why=""):
    refuse_if(not isinstance(value, Integral) or isinstance(value, bool) or value < least,
              f"{name} is {shown(value)}, but must be a whole number from {least}{why}")
    return int(value)


def jobs_of(jobs):
    """How many runs go at a time; None: as many as there are cores."""
    return len(os.sched_getaffinity(0)) if jobs is None else whole("jobs", jobs, 1)


def folder_of(out, usual):
    """The absolute path of the folder to write to; `usual`: where none is given."""
    return os.path.abspath(os.fspath(out or usual))


def make_folder(path):
    """With those above it. Raises WrongInput where it cannot be, and OSError where the disk is full."""
    try:
        os.makedirs(path, exist_ok=True)
    except OSError as error:
        if tool.is_of_a_full_disk(error.strerror):
            raise
        raise WrongInput(f"cannot make the folder {error.filename}: {error.strerror.lower()}") from error


def write_whole(path, content):
    """The bytes of a file, which is there whole or as it was. Raises OSError, which names it."""
    part = path + ".part"
    try:
        with open(part, "wb") as file:
            file.write(content)
        os.replace(part, path)
    except OSError as error:
        with contextlib.suppress(OSError):
            os.remove(part)
        raise OSError(error.errno, error.strerror, path) from error
