"""The names of runs. They tell content: what would change a run changes its name."""
import functools
import hashlib
import json
import os

from knot_utm import tool
from knot_utm.yaml_text import load

# Keys whose text may name a file, and the folder of the package's own.
NAMING = {"material": "materials", "other_material": "materials", "load_cell": "load_cells", "knot": "knots", "file": "", "record": ""}


def addresses(method, every):
    """The names of the runs of a method's file. `every`: [{dotted key: value}], over what the method says."""
    given, folder, read = load(method), os.path.dirname(os.path.abspath(method)), functools.cache(_read)

    def address(settings):
        files, nodes = {}, [given, settings]  # checksums of all files that these name, or that those name
        while nodes:
            for name, kind in _names(nodes.pop()):
                path, named = _find(folder, name, kind), f"{kind}/{name}"
                if path is not None and named not in files:
                    files[named], content = read(path)
                    nodes.append(content)
        content = {"version": tool.version(), "method": given, "set": settings, "files": files}
        return hashlib.sha256(json.dumps(content, sort_keys=True, default=str).encode()).hexdigest()[:16]

    return [address(settings) for settings in every]


def _find(folder, name, kind):
    """As tensile_test looks for it; it is run in the method's folder."""
    folders = (folder, os.path.join(folder, "config"), os.path.join(folder, "../config"), tool.CONFIG)
    ends = [(kind, name + ".yaml"), (name,)] if kind else [(name,)]
    return next(filter(os.path.isfile, (os.path.join(one, *end) for one in folders for end in ends)), None)


def _read(path):
    """(checksum, what it says, where it is YAML)"""
    with open(path, "rb") as file:
        return hashlib.sha256(file.read()).hexdigest(), load(path) if path.endswith(".yaml") else None


def _names(node):
    """(text, folder) of all values below a node that may name a file."""
    if isinstance(node, list):
        for entry in node:
            yield from _names(entry)
    if isinstance(node, dict):
        for key, value in node.items():
            kind = NAMING.get(key.split(".")[-1])
            if kind is not None and isinstance(value, str):
                yield value, kind
            else:
                yield from _names(value)
