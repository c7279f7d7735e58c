"""Turns what a ruler, a weight and a kitchen scale tell of a rope into a material file (doc/measure.md; scripts/material)."""
import functools
import math
import sys

import numpy as np
import yaml
from scipy import integrate, optimize

from knot_utm.report.commands import OneLineParser, refuse, why_not

GRAVITY = 9.81  # [m/s2]
LEAST_ANGLE = math.radians(0.05)  # of the end of a cantilever: less is not seen
STIFFENING_DEPTH = 0.015  # of the radius, from which the simulated contact stiffens (doc/model.md)
SOLID = 10.0    # k_s h^2/k_b of less is a solid rod's, which is 4; ropes have hundreds

MOST_TURNS = 30.0  # [rad] of a capstan: already with mu = 0.2 the heavy mass would be four hundred times the light one

# What may be measured: of each group the keys, all of them needed.
GROUPS = {"diameter": None, "weighed": ("length", "mass"), "stretched": ("length", "mass", "elongation"),
          "cantilever": ("overhang", "drop"), "loop": ("length", "height"), "capstan": ("angle", "light", "heavy"),
          "pressed": ("mass", "approach"), "tied": ("mass",), "broken": ("force",)}
NEEDED = ("diameter", "weighed", "stretched", "capstan")


class Wrong(Exception):
    """The measurements cannot be used; the text says why."""


# ---- shapes of a heavy rod: w its weight per length ----------------------------------------------------------------


def sag(end):
    """(heaviness w l^3/k_b, drop over l) of a rod that is clamped level and whose free end hangs at an angle below the level.

    From the free end, where it is not bent, a rod in units of (k_b/w)^(1/3) is the same whatever its length: it is as long
    as it takes to come level."""
    def is_level(_, y):
        return y[0]

    is_level.terminal = True
    found = integrate.solve_ivp(lambda s, y: [y[1], -s * math.cos(y[0]), math.sin(y[0])], (0.0, 100.0), [end, 0.0, 0.0],
                                "LSODA", events=is_level, rtol=1e-9, atol=1e-12)
    length, drop = found.t[-1], found.y[2, -1]
    return length ** 3, drop / length


def cantilever_stiffness(weight, overhang, drop):
    least, share = sag(LEAST_ANGLE)[1], drop / overhang
    if not least < share < 0.9:
        raise Wrong(f"cantilever: the drop is {share:.4f} of the overhang, but must be between {least:.4f} and 0.9; "
                    "of a rope that hangs straight down, measure a loop")
    # The logarithm of the angle to straight down: of a rope it is tiny.
    steep = optimize.brentq(lambda u: sag(0.5 * math.pi - math.exp(u))[1] - share, math.log(1e-12),
                            math.log(0.5 * math.pi - 0.99 * LEAST_ANGLE))
    return weight * overhang ** 3 / sag(0.5 * math.pi - math.exp(steep))[0]


@functools.cache
def heights_of_loops():
    """(heaviness w L^3/k_b, height over L) of loops whose two ends are held side by side, straight up, from none on."""
    def end(clamp, heaviness):
        def slope(s, y):  # angle from straight down, its slope, sideways, down
            return [y[1], clamp[1] * math.cos(y[0]) + heaviness * (0.5 - s) * math.sin(y[0]), math.sin(y[0]), math.cos(y[0])]
        return integrate.solve_ivp(slope, (0.0, 0.5), [0.0, clamp[0], 0.0, 0.0], "LSODA", rtol=1e-8, atol=1e-10).y[:, -1]

    clamp, heaviness, table = [6.055, -39.65], 1e-3, []  # of the loop without weight
    while heaviness < 1e3:
        found = optimize.root(lambda at: end(at, heaviness)[[0, 2]] + [0.5 * math.pi, 0.0], clamp)
        if not found.success:
            break
        clamp = found.x
        table.append((heaviness, end(clamp, heaviness)[3]))
        heaviness *= 1.2 if heaviness > 1 else 4
    return np.array(table)


def loop_stiffness(weight, length, height):
    heaviness, heights = heights_of_loops().T
    if not heights[0] < height / length < heights[-1]:
        raise Wrong(f"loop: its height over its length is {height / length:.4f}, but must be between {heights[0]:.4f}, a "
                    f"loop without weight, and {heights[-1]:.4f}")
    return weight * length ** 3 / math.exp(np.interp(height / length, heights, np.log(heaviness)))


# ---- from measurements to properties -------------------------------------------------------------------------------


def properties(m):
    """All that follows from the measurements, whose values are plain numbers by (group, key)."""
    h = m["diameter", ""] / 2
    per_length = m["weighed", "mass"] / m["weighed", "length"]
    out = {"radius": h, "density": per_length / (math.pi * h * h),
           "stretching_stiffness": m["stretched", "mass"] * GRAVITY * m["stretched", "length"] / m["stretched", "elongation"],
           "friction_coefficient": math.log(m["capstan", "heavy"] / m["capstan", "light"]) / m["capstan", "angle"]}
    weight = per_length * GRAVITY
    if ("cantilever", "drop") in m:
        out["bending_stiffness"] = cantilever_stiffness(weight, m["cantilever", "overhang"], m["cantilever", "drop"])
    else:
        out["bending_stiffness"] = loop_stiffness(weight, m["loop", "length"], m["loop", "height"])
    solid = out["stretching_stiffness"] * h * h < SOLID * out["bending_stiffness"]
    out["twisting_stiffness"] = out["bending_stiffness"] * (2 / 3 if solid else 1)
    if ("pressed", "mass") in m:
        out["contact_stiffness"] = (3 * m["pressed", "mass"] * GRAVITY /
                                    (8 * math.sqrt(h) * m["pressed", "approach"] ** 1.5))
    if ("tied", "mass") in m:
        out["tying_preload"] = m["tied", "mass"] * GRAVITY
    if ("broken", "force") in m:
        out["breaking_force"] = m["broken", "force"]
    return out


def with_errors(values, errors):
    """The properties and their standard uncertainties: those of the measurements, independent, to first order."""
    here = properties(values)
    squares = dict.fromkeys(here, 0.0)
    for key, error in errors.items():
        if error > 0:
            step = 0.5 * error
            above = properties({**values, key: values[key] + step})
            below = properties({**values, key: values[key] - step})
            for name in here:
                squares[name] += (above[name] - below[name]) ** 2
    return here, {name: math.sqrt(square) for name, square in squares.items()}


# ---- files ---------------------------------------------------------------------------------------------------------


def measured(where, given):
    """[value, uncertainty], both positive."""
    try:
        value, error = (float(number) for number in given)
        if value > 0 and 0 <= error < value and math.isfinite(value):
            return value, error
    except (TypeError, ValueError):
        pass
    raise Wrong(f"{where} is {given}, but must be [value, uncertainty], the value above 0 and more than the uncertainty")


def read(text):
    given = yaml.safe_load(text)
    if not isinstance(given, dict):
        raise Wrong("the file must be a map with the keys " + ", ".join(["name", *GROUPS]))
    values, errors = {}, {}
    for group, content in given.items():
        if group in ("name", "notes"):
            continue
        if group not in GROUPS:
            raise Wrong(f"{group} is no measurement; the measurements are " + ", ".join(GROUPS))
        keys = GROUPS[group]
        if keys is None:
            values[group, ""], errors[group, ""] = measured(group, content)
            continue
        if not isinstance(content, dict) or set(content) != set(keys):
            raise Wrong(f"{group} must be a map with the keys " + ", ".join(keys))
        for key in keys:
            values[group, key], errors[group, key] = measured(f"{group}.{key}", content[key])
    missing = [group for group in NEEDED if group not in given]
    if not ({"cantilever", "loop"} & set(given)):
        missing.append("cantilever or loop")
    if missing:
        raise Wrong("missing: " + ", ".join(missing))
    if values["capstan", "heavy"] <= values["capstan", "light"]:
        raise Wrong("capstan: the heavy mass must be more than the light one")
    angle = values["capstan", "angle"]
    if angle > MOST_TURNS:
        raise Wrong(f"capstan.angle is {angle:g} rad, which are {angle / (2 * math.pi):.0f} turns; is it in degrees? {angle:g} degrees "
                    f"are {math.radians(angle):.4g} rad")
    # As a method takes it (doc/method.md): millimetres given as metres end here.
    low, high = 1e-5, 0.05
    if not low <= values["diameter", ""] / 2 <= high:
        raise Wrong(f"diameter is {values['diameter', '']:g} m, but must be {2 * low:g} to {2 * high:g} m; is it in metres?")
    return given, values, errors


UNITS = {"radius": "m", "density": "kg/m3", "stretching_stiffness": "N", "bending_stiffness": "N m2",
         "twisting_stiffness": "N m2", "friction_coefficient": "-", "contact_stiffness": "N/m2", "tying_preload": "N",
         "breaking_force": "N"}
HOW = {"radius": "measured: half the diameter", "density": "measured: mass over volume", "tying_preload": "measured",
       "stretching_stiffness": "measured: load over strain", "friction_coefficient": "measured: capstan",
       "bending_stiffness": "measured: sag under its own weight", "breaking_force": "measured",
       "twisting_stiffness": "assumed: k_b of a rope, 2/3 k_b of a solid rod", "contact_stiffness": "measured: pressed crosswise"}


def material(given, here, errors):
    lines = [f"# {given.get('name', 'A rope')}, from measurements by scripts/material; the uncertainties are one standard "
             "deviation."]
    for name, value in here.items():
        entry = f"{name}: {value:.6g}"
        lines.append(f"{entry:<38}# [{UNITS[name]}] +- {errors[name]:.2g}, {HOW[name]}")
    lines.append("notes: " + yaml.safe_dump(str(given.get("notes", "Measured with a ruler, a weight and a scale.")),
                                            width=10000).splitlines()[0])
    return "\n".join(lines) + "\n"


def in_words(here):
    """The rod in numbers that a person can check."""
    area = math.pi * here["radius"]**2
    return (f"{1e3 * here['density'] * area:.3g} g/m at a diameter of {2e3 * here['radius']:.3g} mm, E = {modulus(here):.2g} GPa "
            f"stretched, friction {here['friction_coefficient']:.2g}; bent a solid rod of this E would be "
            f"{here['stretching_stiffness'] * here['radius']**2 / (4 * here['bending_stiffness']):.2g} times as stiff")


def modulus(here):
    """Of the whole cross-section, stretched [GPa]."""
    return 1e-9 * here["stretching_stiffness"] / (math.pi * here["radius"]**2)


def questions(here):
    """What no rod is like: most likely a slip of a unit. The limits are those of src/verdict/foreseen.cpp."""
    if not 150 <= here["density"] <= 12000:
        yield (f"the density is {here['density']:.3g} kg/m3, and cork has 200, water 1000, steel 7850: is weighed.mass in kg, and are "
               "weighed.length and the diameter in m?")
    if not 1e-5 <= modulus(here) <= 1.5e3:
        yield (f"E is {modulus(here):.3g} GPa, and rubber has 0.001, nylon 2, steel 200: is stretched.mass in kg, are stretched.length "
               "and stretched.elongation in m?")
    stiffer = 4 * here["bending_stiffness"] / (here["stretching_stiffness"] * here["radius"]**2)
    if stiffer > 4 or stiffer < 1e-6:
        yield (f"it bends {stiffer:.2g} times as stiffly as a solid rod that stretches alike, and ropes do 0.0001 to 1 times: are all "
               "lengths in m, and masses in kg?")
    if not 0.01 <= here["friction_coefficient"] <= 2:
        yield f"the friction coefficient is {here['friction_coefficient']:.3g}, and ropes have 0.05 to 1: is capstan.angle in rad?"
    if here.get("breaking_force", here["stretching_stiffness"]) < 1e-4 * here["stretching_stiffness"]:
        yield f"it would break at a strain of {here['breaking_force'] / here['stretching_stiffness']:.1g}: is broken.force in N?"


def warnings(here, errors, values):
    yield from questions(here)
    h = here["radius"]
    if ("pressed", "approach") in values and values["pressed", "approach"] > STIFFENING_DEPTH * h:
        yield (f"the strands were pressed {values['pressed', 'approach'] / h:.3f} radii together; beyond {STIFFENING_DEPTH} the "
               "simulated contact stiffens by itself, so that it will be too stiff")
    for name, value in here.items():
        if errors[name] > 0.3 * value:
            yield f"{name} is uncertain by {100 * errors[name] / value:.0f} %"


def main():
    parser = OneLineParser(prog="material", description=__doc__)
    parser.add_argument("measurements", help="a YAML file as in doc/measure.md")
    parser.add_argument("--out", required=True, help="the material file to be written")
    parser.add_argument("--overwrite", action="store_true", help="write over a file that exists")
    asked = parser.parse_args()
    if why := why_not(asked.out, [asked.measurements], asked.overwrite):
        refuse("material", f"--out: {why}")
    try:
        with open(asked.measurements, encoding="utf-8") as file:
            given, values, errors = read(file.read())
        here, uncertain = with_errors(values, errors)
        with open(asked.out, "w", encoding="utf-8") as file:
            file.write(material(given, here, uncertain))
    except (Wrong, OSError, UnicodeDecodeError, yaml.YAMLError) as error:
        refuse("material", f"{asked.measurements}: {' '.join(str(error).split())}")
    print(f"{asked.out}: {in_words(here)}")
    for line in warnings(here, uncertain, values):
        print("material: " + line, file=sys.stderr)


if __name__ == "__main__":
    main()
