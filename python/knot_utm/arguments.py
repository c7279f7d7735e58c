"""What functions of this package and its commands are given: each refuses what cannot be meant in one line."""
import os
from collections.abc import Mapping
from numbers import Integral

from knot_utm import tool
from knot_utm.errors import WrongInput


def shown(value):
    """In one line, which is not long."""
    text = " ".join(repr(value).split())
    return text if len(text) <= 60 else text[:57] + "..."


def whole(name, value, least, why=""):
    if not isinstance(value, Integral) or isinstance(value, bool) or value < least:
        raise WrongInput(f"{name} is {shown(value)}, but must be a whole number from {least}{why}")
    return int(value)


def jobs_of(jobs):
    """How many runs go at a time; None: as many as there are cores."""
    return len(os.sched_getaffinity(0)) if jobs is None else whole("jobs", jobs, 1)


def path_of(name, value, what):
    """As text. `what`: what it must be, in words."""
    if not isinstance(value, (str, os.PathLike)) or not isinstance(os.fspath(value), str):
        raise WrongInput(f"{name} is {shown(value)}, but must be {what}")
    return os.fspath(value)


def folder_of(out, usual):
    """The absolute path of the folder to write to; `usual`: where none is given."""
    return os.path.abspath((None if out is None else path_of("out", out, "the path of a folder")) or usual)


def method_of(method):
    return path_of("method", method, "a file, or the name of a method that comes with the package")


def settings_map(settings):
    """{key: value} over a method; None: there are none."""
    settings = {} if settings is None else settings
    if not isinstance(settings, Mapping) or not all(isinstance(key, str) for key in settings):
        raise WrongInput(f"settings is {shown(settings)}, but must be a dict such as {{'specimen.preload': 20}}")
    return dict(settings)


def make_folder(path):
    """With those above it. Raises WrongInput where it cannot be, and OSError where the disk is full."""
    try:
        os.makedirs(path, exist_ok=True)
    except OSError as error:
        if tool.is_of_a_full_disk(error.strerror):
            raise
        raise WrongInput(f"cannot make the folder {error.filename}: {error.strerror.lower()}") from error
