"""Whether words are keys of a method, and which key was meant by one that is none."""
import difflib
import re

from knot_utm import tool
from knot_utm.errors import WrongInput

NUMBER = re.compile(r"\.\d+(?=\.|$)")  # of a step of a program, or of an entry of a list
STEP = re.compile(r"program\.[^.]+")      # which may have no keys, so that it is not listed
ALIKE = 0.85  # of difflib's ratio, from which one word is a slip of the other


def require_known(keys, where):
    """Raises WrongInput where one of them is mistyped; `where` it stands begins the line. Keys of sections that are not listed are
    left to tensile_test."""
    for key in keys:
        name = NUMBER.sub("", key)
        if name in tool.method_keys() or _keys_of(name) or STEP.fullmatch(name):
            continue
        meant, section = _meant(name), _section(name)
        if meant:
            raise WrongInput(f"{where}{key} is no key of a method; did you mean {meant}?")
        if section:
            raise WrongInput(f"{where}{key} is no key of a method; the keys of {section} are {', '.join(_keys_of(section))}")


def _keys_of(section):
    """The names that stand in it; none where it is no section that is listed."""
    inside = [key.removeprefix(section + ".") for key in tool.method_keys() if key.startswith(section + ".")]
    return list(dict.fromkeys(key.partition(".")[0] for key in inside))


def _section(name):
    """The innermost listed one that a key is said to be in; empty where there is none."""
    while name and not _keys_of(name):
        name = name.rpartition(".")[0]
    return name


def _meant(name):
    """The key that is spelt nearly so, or the only one that ends so; None where there is none. Whoever leaves the section out means
    the first material."""
    end_so = [key for key in tool.method_keys() if key.endswith("." + name) and not key.startswith("other_material.")]
    if len(end_so) == 1:
        return end_so[0]
    return next(iter(difflib.get_close_matches(name, tool.method_keys(), 1, ALIKE)), None)
