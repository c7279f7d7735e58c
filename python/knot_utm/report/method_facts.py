"""A method as a person reads it: what was tested, on what, and how."""
import os

from knot_utm import tool
from knot_utm.report import quantities
from knot_utm.report.quantities import is_number, number, Unit, with_unit
from knot_utm.report.run import PULLING, read_yaml

# Labels and units of dotted keys.
LABELS = {row["key"]: row["label"] for row in tool.listing("method-keys")}
UNITS = {row["key"]: row["unit"] for row in tool.listing("method-keys")}
# What a knot is called, and the keys that are shown of it.
TITLES = {row["knot"]: row["title"] for row in tool.listing("knots")}
KEYS_OF_KNOTS = {row["knot"]: row["keys"].split() for row in tool.listing("knots")}
# How a unit of a method is shown, where that is not as in a result.
KINDS = {**quantities.KINDS, "m/s": "speed", "N/s": "force_rate", "of the radius": "of the radius",
         "of capacity": "of its capacity", "of k_b/h2": "k_b/h²"}
# Labels where the rod lies around a post.
ON_POST = {"machine.roller_friction": "Friction coefficient of the rod on the post"}
MATERIALS = {"Material": "material", "Material of the other ropes": "other_material"}
NOT_FACTS = ("name", "notes", "tying_preload", "seed", "load_cell")


def place_of(key):
    """A dotted key without the number of a step or of an entry."""
    return ".".join(part for part in key.split(".") if not part.isdigit())


def label_of(key):
    """The label of a dotted key. One that is not known here is shown as it stands."""
    return LABELS.get(place_of(key), key.split(".")[-1].replace("_", " "))


def unit_of(key, units):
    unit = UNITS.get(place_of(key), "-")
    written = unit.replace("2", "²").replace("3", "³")
    if key.startswith("physics.") and unit in ("N/m", "m/s"):
        return Unit(written)  # parameters of the model are in SI
    return units.of(KINDS.get(unit, written))


def text_of(key, value, units):
    unit = unit_of(key, units)
    if is_number(value):
        return f"{number(value * unit.scale)} {unit.name}".strip()
    if isinstance(value, bool):
        return "yes" if value else "no"
    if value in (float("inf"), ".inf"):
        return "rigid" if key == "machine.stiffness" else "∞"
    if isinstance(value, dict):
        return ", ".join(f"{label_of(f'{key}.{name}')} {text_of(f'{key}.{name}', part, units)}"
                         for name, part in value.items())
    if isinstance(value, list) and all(map(is_number, value)):
        return f"[{', '.join(number(one * unit.scale) for one in value)}] {unit.name}".strip()
    return ", ".join(map(str, value)) if isinstance(value, list) else str(value)


class Facts:
    """What is said of the keys of a method, in the units of a page."""

    def __init__(self, method, units):
        self.units, self.around_post = units, lies_around_post(method)
        self.automatic = method.get("automatic") or {}

    def of(self, place, section, keys=None):
        """[(label, text)] of the keys that are there and have a value. `place`: the section's dotted key."""
        not_facts = (*NOT_FACTS, "friction_coefficient", "friction_couple") if self.around_post else NOT_FACTS  # the post's own counts
        labels = ON_POST if self.around_post else {}
        return [(labels.get(key := f"{place}.{name}") or sentence(label_of(key)), self.text(key, section[name]))
                for name in keys or section if section.get(name) is not None and name not in not_facts]

    def text(self, key, value):
        """Says of a number whether anybody chose it."""
        return text_of(key, value, self.units) + (" (auto)" if key in self.automatic else "")


def sentence(label):
    return label[:1].upper() + label[1:]


def knot_of(method, folder=""):
    """What a person calls it. `folder`: of the run, where a user's own knot lies."""
    name = str(method["specimen"]["knot"])
    return TITLES.get(name) or str(drawing_of(method, folder).get("title") or name)


def knot_and_materials(method, folder=""):
    return f"{knot_of(method, folder)}, {materials_of(method)}"


def materials_of(method):
    """The name of its material; of two ropes those of both."""
    names = [str(method[of].get("name", "own material")) for of in ("material", "other_material") if of in method]
    return " and ".join(dict.fromkeys(names))


def drawing_of(method, folder=""):
    """What the file of its knot says; {} where the program draws it, or the file is gone."""
    name = str(method["specimen"]["knot"])
    files = (os.path.join(folder, name), os.path.join(tool.CONFIG, "knots", name + ".yaml"))
    return next((read_yaml(file) for file in files if name not in TITLES and os.path.isfile(file)), {})


def lies_around_post(method):
    return "post_diameter" in KEYS_OF_KNOTS.get(method.get("specimen", {}).get("knot"), ())


def post_diameter(method):
    """The diameter of the post around which the specimen lies [m]; None: there is none."""
    return method["specimen"]["post_diameter"] if lies_around_post(method) else None


def method_facts(method, units, folder=""):
    """[(title, [(label, text)], remark)]"""
    specimen, machine, facts = method["specimen"], method["machine"], Facts(method, units)
    cell = machine.get("load_cell") if isinstance(machine.get("load_cell"), dict) else {}
    # A knot that a file describes has the keys that are there.
    keys = KEYS_OF_KNOTS.get(specimen["knot"], [key for key in specimen if key != "knot"])
    materials = [(title, of, method[of]) for title, of in MATERIALS.items() if method.get(of)]
    return [("Specimen", [("Knot", knot_of(method, folder)), *facts.of("specimen", specimen, keys)], ""),
            *((title, [("Name", str(material.get("name", "own"))), *facts.of(of, material)], material.get("notes") or "")
              for title, of, material in materials),
            ("Machine", [*facts.of("machine", machine), *([("Load cell", str(cell["name"]))] if "name" in cell else []),
                         *facts.of("machine.load_cell", cell)], cell.get("notes") or ""),
            ("Physics", facts.of("physics", method.get("physics", {})), ""),
            *([("When the test ends", facts.of("ends", method["ends"]), "")] if method.get("ends") else [])]


def program(method, units):
    """[(step, what it asks for)]"""
    facts = Facts(method, units)

    def words(key, value):
        name = key.rpartition(".")[2]
        if name == "until" and isinstance(value, dict):
            return "until " + " or ".join(words(f"{key}.{end}", part) for end, part in value.items() if part is not False)
        return "break" if name == "break" else f"{label_of(key)} {facts.text(key, value)}"

    return [(f"{number + 1}. {name}", ", ".join(words(f"program.{number}.{name}.{key}", value) for key, value in (keys or {}).items()))
            for number, step in enumerate(method.get("program", [])) for name, keys in step.items()]


def particulars(report, method, gauge_length, units, specimens=""):
    """[(label, text)] of what a laboratory says of a test by a standard; empty where `report` names none."""
    if not report.get("standard"):
        return []
    # The last step that pulls has no speed where the load decides it.
    *_, last = {}, *(keys or {} for step in method.get("program", []) for name, keys in step.items() if name in PULLING)
    speed = None if is_number(last.get("load_rate")) else last.get("speed")
    measures = (("Gauge length", gauge_length, units.length), ("Speed of the crosshead", speed, units.rate))
    return [*((label, with_unit(value, unit)) for label, value, unit in measures if is_number(value)),
            *([("Specimens", specimens)] if specimens else [])]
