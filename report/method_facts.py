"""A method as a person reads it: what was tested, on what, and how."""
import quantities
from key_tables import table
from quantities import number
from is_number import is_number
from units import Unit

# Labels and units of dotted keys. The program writes the file: tensile_test --list-method-keys.
LABELS = {row["key"]: row["label"] for row in table("method_keys.csv")}
UNITS = {row["key"]: row["unit"] for row in table("method_keys.csv")}
# What a knot is called, and the keys that are shown of it: tensile_test --list-knots.
TITLES = {row["knot"]: row["title"] for row in table("knots.csv")}
KEYS_OF_KNOTS = {row["knot"]: row["keys"].split() for row in table("knots.csv")}
# How a unit of method_keys.csv is shown, where that is not as in a result.
KINDS = {**quantities.KINDS, "m/s": "speed", "N/s": "force_rate", "of the radius": "of the radius",
         "of capacity": "of its capacity", "of k_b/h2": "k_b/h²", "of friction_coefficient": "of the friction coefficient"}
NOT_FACTS = ("name", "notes", "tying_preload", "seed", "load_cell")


def place_of(key):
    """A dotted key without the number of a step or of an entry."""
    return ".".join(part for part in key.split(".") if not part.isdigit())


def label_of(key):
    """Of a dotted key. One that is not known here is shown as it stands."""
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
        return {"machine.stiffness": "rigid", "machine.load_cell.overload": "none"}.get(key, "∞")
    if isinstance(value, dict):
        return ", ".join(f"{label_of(f'{key}.{name}')} {text_of(f'{key}.{name}', part, units)}"
                         for name, part in value.items())
    if isinstance(value, list):
        return vector(value, unit) if all(map(is_number, value)) else ", ".join(map(str, value))
    return str(value)


def vector(values, unit):
    return f"[{', '.join(number(value * unit.scale) for value in values)}] {unit.name}".strip()


def facts(place, section, units, keys=None):
    """[(label, text)] of the keys that are there and have a value. `place`: the section's dotted key."""
    names = [name for name in (keys or section) if section.get(name) is not None and name not in NOT_FACTS]
    return [(sentence(label_of(f"{place}.{name}")), text_of(f"{place}.{name}", section[name], units)) for name in names]


def sentence(label):
    return label[:1].upper() + label[1:]


def knot_of(method):
    return TITLES.get(method["specimen"]["knot"], str(method["specimen"]["knot"]))


def post_diameter(method):
    """Of the post around which the specimen lies [m]; None: there is none."""
    specimen = method["specimen"]
    return specimen["post_diameter"] if "post_diameter" in KEYS_OF_KNOTS.get(specimen["knot"], ()) else None


def without_idle_keys(method):
    """Without the keys that do nothing in this method, and would say what it is not."""
    def without(section, *keys):
        return {key: value for key, value in section.items() if key not in keys}

    material, machine, physics = method["material"], method["machine"], method.get("physics", {})
    if not material.get("bending_set"):
        material = without(material, "bending_set")
    if not material.get("friction_couple") and isinstance(physics.get("friction"), dict):
        physics = {**physics, "friction": without(physics["friction"], "at")}
    if machine.get("roller_rotation", "fixed") != "turned":
        machine = without(machine, "roller_rate")
    if not machine.get("roller_friction"):
        machine = without(machine, "roller_rotation")
    return {**method, "material": material, "machine": machine, "physics": physics}


def method_facts(method, units):
    """[(title, [(label, text)], remark)]"""
    method = without_idle_keys(method)
    specimen, material, machine = method["specimen"], method["material"], method["machine"]
    cell = machine.get("load_cell")
    cell = cell if isinstance(cell, dict) else {}
    return [
        ("Specimen", [("Knot", knot_of(method)), *facts("specimen", specimen, units, KEYS_OF_KNOTS.get(specimen["knot"]))], ""),
        ("Material", [("Name", str(material.get("name", "own"))), *facts("material", material, units)], material.get("notes") or ""),
        ("Machine", [*facts("machine", machine, units),
                     *([("Load cell", str(cell["name"]))] if "name" in cell else []), *facts("machine.load_cell", cell, units)],
         cell.get("notes") or ""),
        ("Physics", facts("physics", method.get("physics", {}), units), ""),
        *([("When the test ends", facts("ends", method["ends"], units), "")] if method.get("ends") else []),
    ]


def program(method, units):
    """[(step, what it asks for)]"""
    return [(name, step_text(f"program.{name}", keys or {}, units)) for step in method.get("program", []) for name, keys in step.items()]


def step_text(step, keys, units):
    parts = []
    for name, value in keys.items():
        key = f"{step}.{name}"
        if name == "until" and isinstance(value, dict):
            ends = ["break" if end == "break" else f"{label_of(f'{key}.{end}')} {text_of(f'{key}.{end}', part, units)}"
                    for end, part in value.items() if part is not False]
            parts.append("until " + " or ".join(ends))
        else:
            parts.append(f"{label_of(key)} {text_of(key, value, units)}")
    return ", ".join(parts)
