"""The names of runs. They tell content: what would change a run changes its name."""
import hashlib
import json
import os

from knot_utm import tool
from knot_utm.yaml_text import load

# Keys whose text may name a file, and the folder of the package's own.
NAMING = {"material": "materials", "other_material": "materials", "load_cell": "load_cells", "knot": "knots", "file": "", "record": ""}


class Addresses:
    """Names the runs of a method."""

    def __init__(self, method):
        self.method = load(method)
        self.folder = os.path.dirname(os.path.abspath(method))
        self.files = {}  # path -> (checksum, what it says, where it is YAML)

    def of(self, settings):
        """`settings`: {dotted key: value}, over what the method says."""
        files = {}
        self._add(self.method, files)
        self._add(settings, files)
        content = {"version": tool.version(), "method": self.method, "set": settings, "files": files}
        text = json.dumps(content, sort_keys=True, default=str)
        return hashlib.sha256(text.encode()).hexdigest()[:16]

    def _add(self, node, files):
        """Checksums of all files that a node names."""
        for name, kind in _names(node):
            path = self._find(name, kind)
            if path is not None and (named := f"{kind}/{name}") not in files:
                files[named], content = self._read(path)
                self._add(content, files)

    def _find(self, name, kind):
        """As tensile_test looks for it; it is run in the method's folder."""
        folders = (self.folder, os.path.join(self.folder, "config"), os.path.join(self.folder, "../config"), tool.CONFIG)
        ends = [(kind, name + ".yaml"), (name,)] if kind else [(name,)]
        return next(filter(os.path.isfile, (os.path.join(folder, *end) for folder in folders for end in ends)), None)

    def _read(self, path):
        if path not in self.files:
            with open(path, "rb") as file:
                checksum = hashlib.sha256(file.read()).hexdigest()
            content = load(path) if path.endswith(".yaml") else None
            self.files[path] = checksum, content
        return self.files[path]


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
