"""A method as a person reads it: what was tested, on what, and how."""
from quantities import number
from is_number import is_number

# (label, kind of its unit, as units.Units.of takes it); keys that are not here are shown as they stand.
KEYS = {
    "handedness": ("Handedness of the two overhands", ""), "turns": ("Turns", ""),
    "knot_distance": ("Knot distance e", "length"), "end_to_end": ("End to end L", "length"),
    "length": ("Length of rod", "length"), "tail": ("Tails", "length"), "preload": ("Pre-load F_p", "force"),
    "wrap": ("Angle around the post", "rad"), "post_diameter": ("Post diameter", "length"), "tail_load": ("Tail load", "force"),
    "edge_length": ("Edge length of the mesh", "length"), "refinement": ("Refinement within the knots", ""),
    "file": ("Shape from", ""), "radius": ("Radius", "length"), "density": ("Density", "kg/m³"),
    "stretching_stiffness": ("Stretching stiffness", "force"), "bending_stiffness": ("Bending stiffness", "N m²"),
    "twisting_stiffness": ("Twisting stiffness", "N m²"), "friction_coefficient": ("Friction coefficient", ""),
    "friction_couple": ("Share of friction's couple that sections take", ""), "bending_set": ("Share of the tied bend that sets", ""),
    "contact_stiffness": ("Contact stiffness", "N/m²"), "breaking_force": ("Breaking force", "force"),
    "grips": ("Grips", ""), "roller_diameter": ("Roller diameter", "length"),
    "roller_friction": ("Roller friction", ""), "roller_rotation": ("Rollers", ""),
    "roller_rate": ("Rate of the rollers", "rad/s"), "far_side": ("Far side of the loop", ""),
    "at": ("Friction acts at the", ""), "stiffness": ("Frame stiffness", "stiffness"),
    "travel": ("Travel", "length"), "capacity": ("Capacity of the cell", "force"),
    "sampling_rate": ("Readings of the cell", "Hz"), "resolution": ("Resolution of the cell", "force"),
    "noise": ("Noise of the cell, standard deviation", "force"), "floor": ("Floor of the cell", "of its capacity"),
    "accuracy": ("Accuracy", ""), "cell_accuracy": ("Accuracy of the cell", "of the reading"),
    "speed": ("speed", "speed"), "duration": ("duration", "s"), "extension": ("extension", "length"),
    "load": ("load", "force"), "load_rate": ("load rate", "force_rate"), "time": ("time", "s"),
    "drift": ("Drift of the cell", "force_rate"), "overload": ("Stop of the cell", "of its capacity"),
    "breaking_strain": ("Breaking strain", ""), "yield_strain": ("Yield strain", ""),
    "arming_load": ("A break counts from a load of", "force"),
    "sharp_drop_time": ("A sharp drop is one within", "s"), "drop_extension": ("A drop is one within", "length"),
    "sharp_drop": ("Sharp drop by", "of the peak"), "drop": ("Drop by", "of the peak"),
    "break_at_fraction_of_peak": ("Break at no more than", "of the peak"),
    "gravity": ("Gravity", "m/s²"), "slip_tolerance": ("slip tolerance", "m/s"),
    "presliding": ("presliding", "of the radius"), "tolerance": ("tolerance", "of the radius"),
    "drag": ("Drag", "N s/m²"), "max_step": ("Longest step", "s"),
    "residual": ("Residual", "k_b/h²"), "twist": ("Twist", "")}
OF_LOOP = ("handedness", "knot_distance", "end_to_end", "tail", "preload", "edge_length", "refinement")
OF_KNOT = {"fisherman": OF_LOOP, "multiple_fisherman": ("turns", *OF_LOOP),
           "capstan": ("wrap", "post_diameter", "tail_load", "tail", "end_to_end", "edge_length"),
           "overhand": ("turns", "length", "end_to_end", "edge_length", "refinement"),
           "straight": ("length", "edge_length"), "file": ("file", "closed", "edge_length")}
KNOTS = {"fisherman": "Fisherman's knot", "multiple_fisherman": "Multiple fisherman's knot",
         "capstan": "Strand around a post (capstan)", "overhand": "Overhand knot", "straight": "Straight rod",
         "file": "Rod of a shape from a file"}
NOT_FACTS = ("name", "notes", "tying_preload", "seed", "load_cell")


def text_of(key, value, units):
    unit = units.of(KEYS.get(key, ("", ""))[1])
    if is_number(value):
        return f"{number(value * unit.scale)} {unit.name}".strip()
    if isinstance(value, bool):
        return "yes" if value else "no"
    if value in (float("inf"), ".inf"):
        return "rigid" if key == "stiffness" else "none" if key == "overload" else "∞"
    if isinstance(value, dict):
        return ", ".join(f"{label_of(name)} {text_of(name, part, units)}" for name, part in value.items())
    if isinstance(value, list):
        return vector(value, unit) if all(map(is_number, value)) else ", ".join(map(str, value))
    return str(value)


def vector(values, unit):
    return f"[{', '.join(number(value * unit.scale) for value in values)}] {unit.name}".strip()


def label_of(key):
    return KEYS.get(key, (key.replace("_", " "),))[0]


def facts(section, units, keys=None):
    """[(label, text)] of the keys that are there and have a value."""
    names = [key for key in (keys or section) if section.get(key) is not None and key not in NOT_FACTS]
    return [(sentence(label_of(key)), text_of(key, section[key], units)) for key in names]


def sentence(label):
    return label[:1].upper() + label[1:]


def knot_of(method):
    return KNOTS.get(method["specimen"]["knot"], str(method["specimen"]["knot"]))


def post_diameter(method):
    """Of the post around which the specimen lies [m]; None: there is none."""
    specimen = method["specimen"]
    return specimen["post_diameter"] if "post_diameter" in OF_KNOT.get(specimen["knot"], ()) else None


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
    # `accuracy` of the physics is another thing.
    readings = {"cell_accuracy" if key == "accuracy" else key: value for key, value in cell.items()}
    return [
        ("Specimen", [("Knot", knot_of(method)), *facts(specimen, units, OF_KNOT.get(specimen["knot"]))], ""),
        ("Material", [("Name", str(material.get("name", "own"))), *facts(material, units)], material.get("notes") or ""),
        ("Machine", [*facts({key: value for key, value in machine.items() if key != "load_cell"}, units),
                     *([("Load cell", str(cell["name"]))] if "name" in cell else []), *facts(readings, units)],
         cell.get("notes") or ""),
        ("Physics", facts(method.get("physics", {}), units), ""),
        *([("When the test ends", facts(method["ends"], units), "")] if method.get("ends") else []),
    ]


def program(method, units):
    """[(step, what it asks for)]"""
    return [(name, step_text(keys or {}, units)) for step in method.get("program", []) for name, keys in step.items()]


def step_text(keys, units):
    parts = []
    for key, value in keys.items():
        if key == "until" and isinstance(value, dict):
            ends = ["break" if name == "break" else f"{label_of(name)} {text_of(name, part, units)}"
                    for name, part in value.items() if part is not False]
            parts.append("until " + " or ".join(ends))
        else:
            parts.append(f"{label_of(key)} {text_of(key, value, units)}")
    return ", ".join(parts)
