"""Turns what a ruler, a weight and a kitchen scale tell of a rope into a material file (doc/measure.md; scripts/material)."""
import functools
import math
import sys

import numpy as np
import yaml
from scipy import integrate, optimize

from knot_utm.errors import refuse_if, WrongInput
from knot_utm.report.commands import in_one_line, OneLineParser
from knot_utm.yaml_text import read_text

GRAVITY = 9.81  # [m/s2]
LEAST_ANGLE = math.radians(0.05)  # of the end of a cantilever: less is not seen
STIFFENING_DEPTH = 0.015  # of the radius, from which the simulated contact stiffens (doc/model.md)
SOLID = 10.0    # k_s h^2/k_b of less is a solid rod's, which is 4; ropes have hundreds
ROPE = 100.0    # k_s h^2/k_b of more is a rope's

MOST_TURNS = 30.0  # [rad] of a capstan: already with mu = 0.2 the heavy mass would be four hundred times the light one
OVERCOME = 1.3     # by which a cantilever must be bent over the moment at which fibres slide to show k_b
STICK_RATIO = 20.0, 10.0  # and its uncertainty, where none is measured: knots hardly feel whether it is 5 or 60
TWIST_OF_ROPE, TWIST_OF_ROD = 1 / 4, 2 / 3  # k_t/k_b where k_t is not measured: of fibres twice their G/E, 0.22 to 0.27; nu = 1/2
PRESSED = 10.0     # [N/m] of strands in knots at the least

# What may be measured: of each group the keys, and others that will do as well; none of a reading that stands alone.
GROUPS = {"diameter": (), "weighed": (("length", "mass"),), "stretched": (("length", "mass", "elongation"),),
          "cantilever": (("overhang", "drop"),),
          "capstan": (("angle", "light", "heavy"), ("angle", "light", "heavy", "post_radius")),
          "mandrel": (("radius", "kept_radius"), ("radius", "chord", "sag")), "light_cantilever": (("overhang", "drop"),),
          "pulled": (("mass", "kept_radius"), ("mass", "chord", "sag")), "rolled": (("masses", "rises", "run", "length"),),
          "twisted": (("length", "mass", "radius", "period"),), "creeping": (("masses", "speeds"),),
          "pressed": (("mass", "approach"),), "tied": (("mass",),), "broken": (("force",),)}
# The keys with a list of readings, and how many are needed.
SEVERAL = {("rolled", "masses"): 1, ("rolled", "rises"): 1, ("creeping", "masses"): 2, ("creeping", "speeds"): 2}
NEEDED = ("diameter", "weighed", "stretched", "cantilever", "capstan")
NEEDS = {"light_cantilever": "mandrel", "pulled": "mandrel"}  # of these groups, the one without which they tell nothing

# Of each property its unit and how it is found; where it may come out wrong, what a method takes (doc/method.md), and of which group.
PROPERTIES = {
    "radius": ("m", "measured: half the diameter"), "density": ("kg/m3", "measured: mass over volume"),
    "stretching_stiffness": ("N", "measured: load over strain"), "friction_coefficient": ("-", "measured: capstan", 0.0, 5.0, "capstan"),
    "bending_stiffness": ("N m2", "measured: sag under its own weight"), "friction_moment": ("k_b/h", "measured: kept bend"),
    "stick_ratio": ("-", "measured: light over heavy cantilever", 1.01, 1e3, "light_cantilever"),
    "compaction": ("-", "measured: kept bend after a pull", 0.0, 1.0, "pulled"),
    "twisting_stiffness": ("N m2", "assumed: k_b/4 of a rope, 2/3 k_b of a solid rod"),
    "contact_stiffness": ("N/m2", "measured: pressed crosswise"), "tying_preload": ("N", "measured"), "breaking_force": ("N", "measured"),
    "rolling_resistance": ("-", "measured: rolled", 0.0, 1.0, "rolled"),
    "rolling_hysteresis": ("-", "measured: rolled, grows as the root of the load", 0.0, 1.0, "rolled"),
    "rate": ("-", ""), "rate_speed": ("m/s", "", 1e-9, 1.0, "creeping")}  # of the law of friction, which is a method's


# ---- shapes of a heavy rod: w its weight per length ----------------------------------------------------------------


def sag(end, kept=0.0, ratio=2.0):
    """(heaviness w l^3/k_b, drop over l, moment at the clamp) of a rod that is clamped level and whose free end hangs at an
    angle below the level.

    From the free end, where it is not bent, a rod in units of (k_b/w)^(1/3) is the same whatever its length: it is as long
    as it takes to come level. Its fibres may rub: it bends ratio times as stiffly until they slide, and keeps the curvature
    `kept` of a far bend."""
    slides = kept * ratio / (ratio - 1.0)

    def bent(s, y):  # angle below the level, moment, down
        return [-(y[1] / ratio if y[1] < slides else y[1] - kept), s * math.cos(y[0]), math.sin(y[0])]

    def is_level(_, y):
        return y[0]

    is_level.terminal = True
    found = integrate.solve_ivp(bent, (0.0, 100.0), [end, 0.0, 0.0], "LSODA", events=is_level, rtol=1e-9, atol=1e-12)
    length, moment, drop = found.t[-1], *found.y[1:, -1]
    return length ** 3, drop / length, moment


def steepness(share):
    """The logarithm of the angle to straight down, of the free end of the elastic rod whose drop is this share of its overhang: of a
    rope this angle is tiny."""
    return optimize.brentq(lambda u: sag(0.5 * math.pi - math.exp(u))[1] - share, math.log(1e-12),
                           math.log(0.5 * math.pi - 0.99 * LEAST_ANGLE))


@functools.cache
def cantilever_stiffness(weight, overhang, drop, group="cantilever"):
    """k_b of a rod without friction among fibres; s k_b of a rope that is bent so little that they stick."""
    least, share = sag(LEAST_ANGLE)[1], drop / overhang
    refuse_if(not least < share < 0.9, f"{group}: the drop is {share:.4f} of the overhang, but must be between {least:.4f} and 0.9; "
              "of a rope that hangs straight down, measure a shorter piece")
    return weight * overhang ** 3 / sag(0.5 * math.pi - math.exp(steepness(share)))[0]


@functools.cache
def rubbing_stiffness(weight, overhang, drop, kept, stuck, ratio):
    """k_b of a cantilever whose fibres rub, and slide where it is bent most: kept [1/m] is the curvature of a bend that was let go,
    stuck the bending stiffness of a small bend or None, whose ratio to k_b is then given."""
    most = cantilever_stiffness(weight, overhang, drop)  # friction only makes it stiffer
    if stuck and stuck < 1.001 * most:
        raise WrongInput(f"light_cantilever: its bending stiffness comes out as {stuck:.3g} N m2, but must be more than that of cantilever, "
                         f"{most:.3g} N m2: a rope whose fibres rub is stiffest where it is hardly bent")

    def hangs(at, kept):
        steep, k_b = min(max(at[0], math.log(1e-12)), 0.4), most * math.exp(min(max(at[1], -9.0), 5e-4))
        unit = (k_b / weight) ** (1 / 3)
        heaviness, share, moment = sag(0.5 * math.pi - math.exp(steep), kept * unit, stuck / k_b if stuck else ratio)
        return [math.log(heaviness * unit ** 3 / overhang ** 3), share - drop / overhang], k_b, moment / unit

    for parts in ((1.0,), (0.25, 0.5, 0.75, 1.0)):  # of the friction: at once, else little by little
        at = [steepness(drop / overhang), 0.0]
        for part in parts:
            at = optimize.root(lambda at: hangs(at, part * kept)[0], at).x
        left, k_b, moment = hangs(at, kept)
        if max(map(abs, left)) < 1e-6:
            break
    overcome = moment / kept * (1 - (k_b / stuck if stuck else 1 / ratio))
    refuse_if(max(map(abs, left)) > 1e-6 or overcome < OVERCOME,
              f"cantilever: at the clamp it is bent by less than {OVERCOME} times the moment at which the fibres slide, as the kept "
              "bend tells, so that it does not show k_b; measure a longer overhang")
    return k_b


# ---- friction: around a post, among fibres, and the speed of creep -----------------------------------------------


def capstan_friction(m, h, heavy):
    """mu, of which a mass `heavy` is the one that just does not slide. Friction acts at the surface of the rope and its tension at
    the centreline, so that the tension grows by the factor e^(x angle) with mu h' x^2 + x = mu (1 - h'), where h' is the radius of
    the rope over that of its centreline (doc/references.md, R15). Of a post whose radius is not given, h' = 0."""
    grown = math.log(heavy / m["capstan", "light"]) / m["capstan", "angle"]
    if ("capstan", "post_radius") not in m:
        return grown
    thick = h / (m["capstan", "post_radius"] + h)
    left = 1 - thick * (1 + grown ** 2)
    refuse_if(left <= 0, f"capstan: around a post as thin as {m['capstan', 'post_radius']:.3g} m no friction at the surface of the rope gives "
              "this ratio of the masses; is post_radius in m? Else take a thicker post")
    return grown / left


def kept_curvature(m, group):
    """The curvature of the arc in which the rope lies once it is let go: its radius, or its chord and the sag of it, was read."""
    if (group, "chord") in m:
        chord, sagged = m[group, "chord"], m[group, "sag"]
        return 1 / (chord ** 2 / (8 * sagged) + 0.5 * sagged)
    return 1 / m[group, "kept_radius"]


def least_bend(kept, ratio):
    """The curvature of the mandrel from which on a rope keeps all it can, kept = M_y/k_b. Let go, the moment of friction falls
    by (s - 1) k_b for each 1/m, from M_y to -M_y, if there is room: from kept + 2 M_y/((s - 1) k_b) on."""
    return kept * (ratio + 1) / (ratio - 1)


def bending(m, weight, h):
    """The keys of bending."""
    if ("mandrel", "radius") not in m:
        return {"bending_stiffness": cantilever_stiffness(weight, m["cantilever", "overhang"], m["cantilever", "drop"])}
    kept, stuck, ratio = kept_curvature(m, "mandrel"), None, m.get(("stick_ratio", ""))
    refuse_if(h * kept > 1, f"mandrel: the rope keeps a radius of {1 / kept:.3g} m, but must keep one of more than its own, {h:.3g} m")
    if ratio is None:
        stuck = cantilever_stiffness(weight, m["light_cantilever", "overhang"], m["light_cantilever", "drop"], "light_cantilever")
    k_b = rubbing_stiffness(weight, m["cantilever", "overhang"], m["cantilever", "drop"], kept, stuck, ratio)
    out = {"bending_stiffness": k_b, "friction_moment": h * kept, "stick_ratio": ratio or stuck / k_b}
    if ("pulled", "mass") in m:
        more = kept_curvature(m, "pulled") - kept
        refuse_if(more < 0, f"pulled: the rope keeps a radius of {1 / (kept + more):.3g} m, but after a pull it must keep at most the "
                  f"{1 / kept:.3g} m of mandrel")
        out["compaction"] = k_b * more / (h * m["pulled", "mass"] * GRAVITY)
    return out


def creep(loads, speeds):
    """(a, v_0 [m/s]) of v = v_0 (exp((q - 1)/a) - 1) for speeds v at loads q over the one that just does not creep: two readings
    have one answer, more the one of least squares of ln v."""
    over, seen = np.array(loads) - 1, np.log(speeds)
    refuse_if(min(over) <= 0, "creeping: within its uncertainty, every mass must be more than capstan.heavy, which does not creep")
    slope = np.polyfit(seen, over, 1)[0] if len(set(speeds)) > 1 else 0.0  # of fast creep, this is a
    refuse_if(not slope > 0, "creeping: a larger mass must creep faster")

    def left(at):  # ln a, ln v_0
        x = over / np.exp(at[0])
        return at[1] + x + np.log(-np.expm1(-x)) - seen

    start = [math.log(slope), np.mean(seen - over / slope)]
    found = optimize.least_squares(left, start, xtol=1e-14, ftol=1e-14, gtol=1e-14, bounds=([-20.0, -200.0], [20.0, 20.0]))
    rate, speed = (float(number) for number in np.exp(found.x))
    refuse_if(rate > 1, "creeping: the speeds grow too little with the masses for a rate of at most 1: with the logarithm of the mass over "
              "that of capstan.heavy, they must grow more than in proportion")
    return rate, speed


# ---- rolling and twisting -----------------------------------------------------------------------------------------


def power_of_rolling(values, errors):
    """The power n of the mass with which the slope grows at which the board runs away, mu_r ~ W^n, by least squares of logarithms, and
    its uncertainty, which is infinite where there is one mass."""
    masses, rises = (np.array(several(values, "rolled", key)) for key in ("masses", "rises"))
    of_masses, of_rises = (np.array([errors["rolled", f"{key}[{i}]"] for i in range(len(masses))]) for key in ("masses", "rises"))
    apart = np.log(masses) - np.mean(np.log(masses))
    if not np.ptp(apart) > 0:
        return 0.0, math.inf
    share = apart / np.sum(apart ** 2)
    power = float(share @ np.log(rises))
    return power, math.sqrt(share ** 2 @ ((of_rises / rises) ** 2 + (power * of_masses / masses) ** 2))


def rolling(m, out):
    """The key of rolling: pieces that roll between a board and a loaded board, each with the couple mu_r h p at both, let the upper one
    go by 2 h for each rad, so that its push is mu_r W whatever their radius (doc/developers/material_readings.md). Of a solid rod, whose
    mu_r grows as sqrt W, the share of work that contacts lose (RollingResistance::growth_of_hysteresis)."""
    masses, slopes = several(m, "rolled", "masses"), [rise / m["rolled", "run"] for rise in several(m, "rolled", "rises")]
    if limpness(out) >= SOLID:
        return {"rolling_resistance": slopes[masses.index(max(masses))] if m["rolled", "grows"] else sum(slopes) / len(slopes)}
    widths = [math.sqrt(3 * out["radius"] * line_load(m, mass) / out["stretching_stiffness"]) for mass in masses]  # a/h
    return {"rolling_hysteresis": sum(1.5 * math.pi * slope / width for slope, width in zip(slopes, widths)) / len(slopes)}


def line_load(m, mass):
    return mass * GRAVITY / m["rolled", "length"]


def twisting(m, out):
    """k_t: a disc on a rope swings as its J = mass radius^2/2 lets it. Its weight, spread over the section, turns the rope back as well,
    as two threads side by side do: by m g h^2/2 for each 1/m of twist."""
    if ("twisted", "period") not in m:
        return out["bending_stiffness"] * (TWIST_OF_ROD if limpness(out) < SOLID else TWIST_OF_ROPE)
    seen, of_weight = swing(m, out["radius"])
    refuse_if(seen <= of_weight,
              "twisted: the weight of the disc alone, which turns a twisted rope back, makes it swing as fast as that; take a lighter "
              "and wider disc; is twisted.period in s, there and back?")
    return seen - of_weight


def swing(m, h):
    """What a swinging disc shows, and the part of its weight."""
    disc = m["twisted", "mass"] * m["twisted", "radius"] ** 2 / 2
    return 4 * math.pi ** 2 * disc * m["twisted", "length"] / m["twisted", "period"] ** 2, m["twisted", "mass"] * GRAVITY * h * h / 2


# ---- from measurements to properties -------------------------------------------------------------------------------


def limpness(here):
    """k_s h^2/k_b."""
    return here["stretching_stiffness"] * here["radius"] ** 2 / here["bending_stiffness"]


def properties(m):
    """All that follows from the measurements, whose values are plain numbers by (group, key)."""
    h = m["diameter", ""] / 2
    per_length = m["weighed", "mass"] / m["weighed", "length"]
    out = {"radius": h, "density": per_length / (math.pi * h * h),
           "stretching_stiffness": m["stretched", "mass"] * GRAVITY * m["stretched", "length"] / m["stretched", "elongation"],
           "friction_coefficient": capstan_friction(m, h, m["capstan", "heavy"]), **bending(m, per_length * GRAVITY, h)}
    out["twisting_stiffness"] = twisting(m, out)
    measured_groups = {group for group, _ in m}
    if "pressed" in measured_groups:
        out["contact_stiffness"] = 3 * m["pressed", "mass"] * GRAVITY / (8 * math.sqrt(h) * m["pressed", "approach"] ** 1.5)
    if "tied" in measured_groups:
        out["tying_preload"] = m["tied", "mass"] * GRAVITY
    if "broken" in measured_groups:
        out["breaking_force"] = m["broken", "force"]
    if "rolled" in measured_groups:
        out.update(rolling(m, out))
    if "creeping" in measured_groups:
        loads = [capstan_friction(m, h, mass) / out["friction_coefficient"] for mass in several(m, "creeping", "masses")]
        out["rate"], out["rate_speed"] = creep(loads, several(m, "creeping", "speeds"))
    return out


def several(m, group, key):
    """The readings of a list."""
    return [m[group, f"{key}[{i}]"] for i in range(m[group, key])]


def usable(m, here):
    """Refuses readings from which the numbers do not follow, and numbers that no method takes (doc/method.md)."""
    for name, value in here.items():
        unit, _, *taken = PROPERTIES[name]
        if taken and not taken[0] <= value <= taken[1]:
            low, high, group, unit = *taken, "" if unit == "-" else f" {unit}"
            raise WrongInput(f"{group}: {name} comes out as {value:.3g}{unit}, but a method takes {low:g} to {high:g}{unit}")
    if "friction_moment" not in here:
        return
    h, ratio = here["radius"], here["stick_ratio"]
    mandrel = 1 / (m["mandrel", "radius"] + h)
    for group in ("mandrel", "pulled") if "compaction" in here else ("mandrel",):
        kept = kept_curvature(m, group)
        refuse_if(mandrel < least_bend(kept, ratio), f"{group}: the rope keeps a radius of {1 / kept:.4g} m, for which the mandrel's must be at most "
                  f"{1 / least_bend(kept, ratio) - h:.4g} m, so that all the friction of its fibres turns round as it is let go")
    weight = m["weighed", "mass"] / m["weighed", "length"] * GRAVITY
    longest = math.sqrt(2 * here["friction_moment"] / h * here["bending_stiffness"] * ratio / (ratio - 1) / weight)
    refuse_if(("light_cantilever", "drop") in m and m["light_cantilever", "overhang"] > longest,
              f"light_cantilever: its overhang must be at most {longest:.3g} m, so that no fibre slides")


def with_errors(values, errors):
    """The properties and their standard uncertainties: those of the measurements, independent, to first order."""
    here, squares = properties(values), 0.0
    for key, error in errors.items():
        if error > 0:
            above, below = (np.array([*properties({**values, key: values[key] + half}).values()]) for half in (0.5 * error, -0.5 * error))
            squares = squares + (above - below) ** 2
    return here, dict(zip(here, np.sqrt(squares + np.zeros(len(here)))))


# ---- files ---------------------------------------------------------------------------------------------------------


def measured(where, given):
    """[value, uncertainty], both positive."""
    try:
        value, error = (float(number) for number in given)
        if value > 0 and 0 <= error < value and math.isfinite(value):
            return value, error
    except (TypeError, ValueError):
        pass
    raise WrongInput(f"{where} is {given}, but must be [value, uncertainty], the value above 0 and more than the uncertainty")


def read_group(group, content):
    """The measured numbers by their keys, and of a list also its length, which is exact."""
    if not GROUPS[group]:
        return {"": measured(group, content)}
    refuse_if(not isinstance(content, dict) or all(set(content) != set(keys) for keys in GROUPS[group]),
              f"{group} must be a map with the keys " + ", or ".join(map(", ".join, GROUPS[group])))
    out, lists = {}, [key for key in content if (group, key) in SEVERAL]
    for key, reading in content.items():
        if key not in lists:
            out[key] = measured(f"{group}.{key}", reading)
            continue
        fewest, other = SEVERAL[group, key], lists[1 - lists.index(key)]
        refuse_if(not isinstance(reading, list) or len(reading) < fewest or len(reading) != len(content[lists[0]]),
                  f"{group}.{key} must be a list of {('one reading', 'two readings')[fewest - 1]} or more, as many as {group}.{other}")
        out[key] = len(reading), 0.0
        out.update({f"{key}[{i}]": measured(f"{group}.{key}[{i}]", one) for i, one in enumerate(reading)})
    return out


def read(text):
    given = yaml.safe_load(text)
    refuse_if(not isinstance(given, dict), "the file must be a map with the keys " + ", ".join(["name", *GROUPS]))
    values, errors = {}, {}
    for group, content in given.items():
        if group in ("name", "notes"):
            continue
        refuse_if(group not in GROUPS, f"{group} is no measurement; the measurements are " + ", ".join(GROUPS))
        for key, (value, error) in read_group(group, content).items():
            values[group, key], errors[group, key] = value, error
    refuse_if(missing := [group for group in NEEDED if group not in given], "missing: " + ", ".join(missing))
    for group, other in NEEDS.items():
        refuse_if(group in given and other not in given, f"{group} tells nothing without {other}")
    if "mandrel" in given and "light_cantilever" not in given:
        values["stick_ratio", ""], errors["stick_ratio", ""] = STICK_RATIO
    if "rolled" in given:
        power, error = power_of_rolling(values, errors)
        values["rolled", "grows"], errors["rolled", "grows"] = abs(power) > 2 * error, 0.0  # or falls, with the load
    angle, diameter = values["capstan", "angle"], values["diameter", ""]
    density = values["weighed", "mass"] / values["weighed", "length"] / (math.pi * (diameter / 2) ** 2)
    for is_so, why in (
            (values["capstan", "heavy"] > values["capstan", "light"], "capstan: the heavy mass must be more than the light one"),
            (angle <= MOST_TURNS, f"capstan.angle is {angle:g} rad, which are {angle / (2 * math.pi):.0f} turns; is it in degrees? {angle:g} "
             f"degrees are {math.radians(angle):.4g} rad"),
            # As a method takes it (doc/method.md): millimetres given as metres end here, and before what follows from it grams as kilograms.
            (2e-5 <= diameter <= 0.1, f"diameter is {diameter:g} m, but must be 2e-05 to 0.1 m; is it in metres?"),
            (10 <= density <= 25e3, f"the density is {density:.3g} kg/m3, and cork has 200, water 1000, steel 7850: is weighed.mass in kg, and "
             "are weighed.length and the diameter in m? A method takes 10 to 25000 kg/m3")):
        refuse_if(not is_so, why)
    return given, values, errors


def rates(here, errors):
    """The law of friction, which is a method's and not the material's."""
    return (f"--set physics.friction='{{law: rate, rate: {here['rate']:.4g}, rate_speed: {here['rate_speed']:.4g}}}'  # +- "
            f"{errors['rate']:.2g}, +- {errors['rate_speed']:.2g} m/s, measured: creeping capstan")


def how_found(name, given, values):
    if name == "stick_ratio" and "light_cantilever" not in given:
        return "assumed"
    if name == "twisting_stiffness" and "twisted" in given:
        return "measured: torsion pendulum"
    return PROPERTIES[name][1] + (", under the heaviest mass" if name == "rolling_resistance" and values["rolled", "grows"] else "")


def material(given, here, errors, values):
    lines = [f"# {given.get('name', 'A rope')}, from measurements by scripts/material; the uncertainties are one standard "
             "deviation."]
    for name, value in here.items():
        if name == "friction_moment":
            lines.append(f"{'bending_law: frictional':<38}# because a rope that keeps a bend has fibres that rub")
        if how := how_found(name, given, values):
            lines.append(f"{f'{name}: {value:.6g}':<38}# [{PROPERTIES[name][0]}] +- {errors[name]:.2g}, {how}")
    if "rate" in here:
        lines.append("# for a method: " + rates(here, errors))
    lines.append("notes: " + yaml.safe_dump(str(given.get("notes", "Measured with a ruler, a weight and a scale.")),
                                            width=10000).splitlines()[0])
    return "\n".join(lines) + "\n"


def in_words(here):
    """The rod in numbers that a person can check; E is that of the whole cross-section."""
    area = math.pi * here["radius"]**2
    limp, modulus = limpness(here) / 4, 1e-9 * here["stretching_stiffness"] / area  # [GPa]
    bent = f"1/{float(f'{limp:.2g}'):.0f}" if limp > 2 else f"{1 / limp:.2g} times"
    return (f"{1e3 * here['density'] * area:.3g} g/m at a diameter of {2e3 * here['radius']:.3g} mm, E = {modulus:.2g} GPa "
            f"stretched, friction {here['friction_coefficient']:.2g}; in bending {bent} as stiff as a solid rod of this E"
            + (", as ropes are" if ROPE < limpness(here) < 4e6 else ""))


def doubts_of_rolling(here, values, errors):
    power, error = power_of_rolling(values, errors)
    if math.isinf(error):
        yield "rolled: one mass does not tell whether the resistance to rolling grows with the load: add one that is four times as heavy"
    elif values["rolled", "grows"] and "rolling_resistance" in here:
        yield (f"rolled: the rises grow as the mass to the power {power:.2g} +- {error:.2g}: that of the heaviest mass is taken; are the "
               "pieces straight, and do they roll?")
    pressed = line_load(values, max(several(values, "rolled", "masses")))
    if pressed < PRESSED:
        yield (f"rolled: the pieces bear at most {pressed:.2g} N/m, and strands in knots {PRESSED:g} to 1e5: take a heavier board; are "
               "rolled.masses in kg, and rolled.length in m?")


def warnings(here, uncertain, values, errors):
    """`uncertain` is of the properties, `errors` of the readings."""
    h = here["radius"]
    if limpness(here) > ROPE and "friction_moment" not in here:
        yield ("it is a rope, but its bends are taken as elastic, with which the knots of most ropes open: measure cantilever and mandrel, "
               "which tell how its fibres rub")
    if ("rolled", "run") in values:
        yield from doubts_of_rolling(here, values, errors)
    elif limpness(here) > ROPE:
        yield "it is a rope, but its strands are taken to roll without resistance: measure rolled"
    if ("twisted", "period") in values and here["twisting_stiffness"] < 0.7 * swing(values, h)[0]:
        yield ("twisted: more than 30 % of the swing is due to the weight of the disc, not the stiffness of the rope: take a lighter and "
               "wider disc")
    if ("pressed", "approach") in values and values["pressed", "approach"] > STIFFENING_DEPTH * h:
        yield (f"the strands were pressed {values['pressed', 'approach'] / h:.3f} radii together; beyond {STIFFENING_DEPTH} the "
               "simulated contact stiffens by itself, so that it will be too stiff")
    for name, value in here.items():
        if uncertain[name] > 0.3 * value:
            yield f"{name} is uncertain by {100 * uncertain[name] / value:.0f} %"


def main():
    parser = OneLineParser(prog="material", description=__doc__)
    parser.add_argument("measurements", help="a YAML file as in doc/measure.md")
    parser.add_argument("--out", required=True, help="the material file to be written")
    parser.add_argument("--overwrite", action="store_true", help="write over a file that exists")
    asked = parser.parse_args()
    parser.require_room("--out", asked.out, [asked.measurements], asked.overwrite)
    text = read_text(asked.measurements)
    try:
        given, values, errors = read(text)
        usable(values, properties(values))
        here, uncertain = with_errors(values, errors)
    except (WrongInput, yaml.YAMLError) as error:
        raise WrongInput(f"{asked.measurements}: {' '.join(str(error).split())}") from error
    with open(asked.out, "w", encoding="utf-8") as file:
        file.write(material(given, here, uncertain, values))
    print(f"{asked.out}: {in_words(here)}")
    if "rate" in here:
        print("for a method: " + rates(here, uncertain))
    for line in warnings(here, uncertain, values, errors):
        print("material: " + line, file=sys.stderr)


if __name__ == "__main__":
    with in_one_line("material"):
        main()
