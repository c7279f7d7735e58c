"""YAML as tensile_test reads and writes it."""
import math
import re

import yaml

from knot_utm.errors import refuse_if, WrongInput


class _Loader(getattr(yaml, "CSafeLoader", yaml.SafeLoader)):
    """1e-5 and 2e4 are numbers, as in YAML 1.2, and no key stands twice in a map."""

    def construct_mapping(self, node, deep=False):
        seen = set()
        for key_node, _ in node.value:
            key = self.construct_object(key_node, deep=True)
            if not isinstance(key, str):
                raise WrongInput(f"line {key_node.start_mark.line + 1}: {key_node.value or 'this'} is no key: a key is a word")
            refuse_if(key in seen, f"line {key_node.start_mark.line + 1}: {key} stands there twice")
            seen.add(key)
        return super().construct_mapping(node, deep)


class _Dumper(yaml.SafeDumper):
    """Writes a text that would read back as such a number in quotes."""


for _side in (_Loader, _Dumper):
    _side.add_implicit_resolver("tag:yaml.org,2002:float", re.compile(r"^[-+]?(\d+\.?\d*|\.\d+)[eE][-+]?\d+$"),
                                list("-+.0123456789"))


def read_text(path, errors="strict"):
    """What a file holds. Raises WrongInput, which names it."""
    try:
        with open(path, encoding="utf-8", errors=errors) as file:
            return file.read()
    except OSError as error:
        raise WrongInput(f"{path}: {error.strerror.lower()}") from error
    except UnicodeDecodeError as error:
        line = error.object.count(b"\n", 0, error.start) + 1
        raise WrongInput(f"{path}: line {line}: the byte 0x{error.object[error.start]:02x} is no text in UTF-8") from error


def printable(text):
    """Names of files are bytes, which need not be text: such bytes as YAML too writes them, and reads them back."""
    return text.encode("utf-8", "backslashreplace").decode("utf-8")


def load(path, errors="strict"):
    """What a YAML file says. Raises WrongInput, which names it."""
    text = printable(read_text(path, errors))
    try:
        return yaml.load(text, _Loader if errors == "strict" else yaml.SafeLoader)  # of names that are no text, C's reader has no idea
    except (yaml.YAMLError, WrongInput) as error:
        raise WrongInput(f"{path}: {' '.join(str(error).split())}") from error


def text_of(value):
    """A value in one line, which reads back as the same value."""
    try:
        text = yaml.dump(value, Dumper=_Dumper, default_flow_style=True, width=float("inf"), allow_unicode=True)
    except yaml.representer.RepresenterError as error:
        raise WrongInput(f"{' '.join(repr(value).split())} ({type(value).__name__}) cannot be the value of a key: give numbers, words, "
                         "lists and dicts of Python") from error
    return text.removesuffix("\n").removesuffix("...").rstrip("\n")


def described(settings):
    """{key: value} in words."""
    return ", ".join(f"{key}={text_of(value)}" for key, value in settings.items())


def require(is_so, name, value, allowed):
    """Raises WrongInput, which names the value and what is allowed, where it is not so."""
    refuse_if(not is_so, f"{name} is {text_of(value)}, but must be {allowed}")


def is_whole(value, low, high):
    return isinstance(value, int) and not isinstance(value, bool) and low <= value <= high


def is_number(value):
    """Whether a value that was read is one; infinity, yes and no are none."""
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)


def value_of(text):
    """What a text in YAML says. Raises yaml.YAMLError or WrongInput."""
    return yaml.load(text, _Loader)


def value_at(node, path):
    """The value of a dotted key of a method; a step of a program is found by its name or its number. None where there is none."""
    name, _, rest = path.partition(".")
    if isinstance(node, list):
        found = next((step[name] for step in node if isinstance(step, dict) and name in step), None)
        if found is None and name.isdigit() and int(name) < len(node):
            found = node[int(name)]
    else:
        found = node.get(name) if isinstance(node, dict) else None
    return value_at(found, rest) if rest and found is not None else found
