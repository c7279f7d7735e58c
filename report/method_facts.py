"""A method as a person reads it: what was tested, on what, and how."""
from quantities import number
from run import is_number

# (label, unit, scale); keys that are not here are shown as they stand.
KEYS = {
    "handedness": ("Handedness of the two overhands", "", 1.0), "turns": ("Turns", "", 1.0),
    "knot_distance": ("Knot distance e", "mm", 1e3), "end_to_end": ("End to end L", "mm", 1e3),
    "length": ("Length of rod", "mm", 1e3), "tail": ("Tails", "mm", 1e3), "preload": ("Pre-load F_p", "N", 1.0),
    "edge_length": ("Edges of the mesh", "mm", 1e3), "refinement": ("Finer in knots by", "", 1.0),
    "file": ("Shape from", "", 1.0), "radius": ("Radius", "mm", 1e3), "density": ("Density", "kg/m³", 1.0),
    "stretching_stiffness": ("Stretching stiffness", "N", 1.0),
    "bending_stiffness": ("Bending stiffness", "N m²", 1.0),
    "twisting_stiffness": ("Twisting stiffness", "N m²", 1.0),
    "friction_coefficient": ("Friction coefficient", "", 1.0),
    "contact_stiffness": ("Contact stiffness", "N/m²", 1.0), "breaking_force": ("Breaking force", "N", 1.0),
    "grips": ("Grips", "", 1.0), "roller_diameter": ("Roller diameter", "mm", 1e3),
    "roller_friction": ("Roller friction", "", 1.0), "stiffness": ("Frame stiffness", "N/m", 1.0),
    "travel": ("Travel", "mm", 1e3), "capacity": ("Cell's capacity", "N", 1.0),
    "sampling_rate": ("Cell's readings", "Hz", 1.0), "resolution": ("Cell's resolution", "N", 1.0),
    "noise": ("Cell's noise, sd", "N", 1.0), "floor": ("Cell's floor, of capacity", "", 1.0),
    "accuracy": ("Accuracy", "", 1.0), "cell_accuracy": ("Cell's accuracy", "of the reading", 1.0), "speed": ("speed", "mm/s", 1e3),
    "duration": ("duration", "s", 1.0), "extension": ("extension", "mm", 1e3), "load": ("load", "N", 1.0),
    "load_rate": ("load rate", "N/s", 1.0), "time": ("time", "s", 1.0),
    "drift": ("Cell's drift", "N/s", 1.0), "overload": ("Cell's stop, of capacity", "", 1.0),
    "breaking_strain": ("Breaking strain", "", 1.0), "arming_load": ("Armed from", "N", 1.0),
    "sharp_drop_time": ("Sharp drop within", "s", 1.0), "drop_extension": ("Drop within", "mm", 1e3),
    "sharp_drop": ("Sharp drop by", "of the peak", 1.0), "drop": ("Drop by", "of the peak", 1.0),
    "break_at_fraction_of_peak": ("Break at no more than", "of the peak", 1.0),
    "gravity": ("Gravity", "m/s²", 1.0), "slip_tolerance": ("slip tolerance", "m/s", 1.0),
    "presliding": ("presliding", "of the radius", 1.0), "tolerance": ("tolerance", "of the radius", 1.0),
    "drag": ("Drag", "N s/m²", 1.0), "max_step": ("Longest step", "s", 1.0),
    "residual": ("Residual", "k_b/h²", 1.0), "twist": ("Twist", "", 1.0)}
OF_KNOT = {"fisherman": ("handedness", "knot_distance", "end_to_end", "tail", "preload", "edge_length", "refinement"),
           "overhand": ("turns", "length", "end_to_end", "edge_length", "refinement"),
           "straight": ("length", "edge_length"), "file": ("file", "closed", "edge_length")}
KNOTS = {"fisherman": "Fisherman's knot", "overhand": "Overhand knot", "straight": "Straight rod",
         "file": "Rod of a shape from a file"}
NOT_FACTS = ("name", "notes", "tying_preload", "seed", "load_cell")


def text_of(key, value):
    _, unit, scale = KEYS.get(key, ("", "", 1.0))
    if is_number(value):
        return f"{number(value * scale)} {unit}".strip()
    if value is True:
        return "yes"
    if value is False:
        return "no"
    if value in (float("inf"), ".inf"):
        return "rigid" if key == "stiffness" else "∞"
    if isinstance(value, dict):
        return ", ".join(f"{KEYS.get(name, (name.replace('_', ' '),))[0]} {text_of(name, part)}"
                         for name, part in value.items())
    if isinstance(value, list):
        return vector(value, unit, scale) if all(map(is_number, value)) else ", ".join(map(str, value))
    return "–" if value is None else str(value)


def vector(values, unit, scale):
    return f"[{', '.join(number(value * scale) for value in values)}] {unit}".strip()


def facts(section, keys=None):
    """[(label, text)] of the keys that are there."""
    names = [key for key in (keys or section) if key in section and key not in NOT_FACTS]
    return [(sentence(KEYS.get(key, (key.replace("_", " "),))[0]), text_of(key, section[key])) for key in names]


def sentence(label):
    return label[:1].upper() + label[1:]


def knot_of(method):
    return KNOTS.get(method["specimen"]["knot"], str(method["specimen"]["knot"]))


def method_facts(method):
    """[(title, [(label, text)], remark)]"""
    specimen, material, machine = method["specimen"], method["material"], method["machine"]
    cell = machine.get("load_cell")
    cell = cell if isinstance(cell, dict) else {}
    # `accuracy` of the physics is another thing.
    readings = {"cell_accuracy" if key == "accuracy" else key: value for key, value in cell.items()}
    return [
        ("Specimen", [("Knot", knot_of(method)), *facts(specimen, OF_KNOT.get(specimen["knot"]))], ""),
        ("Material", [("Name", str(material.get("name", "own"))), *facts(material)], material.get("notes") or ""),
        ("Machine", [*facts({key: value for key, value in machine.items() if key != "load_cell"}),
                     ("Load cell", str(cell.get("name", "–"))), *facts(readings)], cell.get("notes") or ""),
        ("Physics", facts(method.get("physics", {})), ""),
        *([("Ends of the test", facts(method["ends"]), "")] if method.get("ends") else []),
    ]


def program(method):
    """[(step, what it asks for)]"""
    return [(name, step_text(keys or {})) for step in method.get("program", []) for name, keys in step.items()]


def step_text(keys):
    parts = []
    for key, value in keys.items():
        if key == "until" and isinstance(value, dict):
            ends = ["break" if name == "break" else f"{KEYS.get(name, (name,))[0]} {text_of(name, part)}"
                    for name, part in value.items() if part is not False]
            parts.append("until " + " or ".join(ends))
        else:
            parts.append(f"{KEYS.get(key, (key.replace('_', ' '),))[0]} {text_of(key, value)}")
    return ", ".join(parts)
