"""Similar specimens of any size and stiffness: their readings, in units of their radius h and of F_0 = k_b/h^2."""
import math
import os

import plots
import runs
import yaml
from runs import divide, mean
from table import Report, Table, at_most, is_

# A solid rod stretches at once, and its loop is read by peak and stiffness alone.
MATERIALS = ["nylon", "polypropylene", "pink_vps"]
LEAST, LARGEST = 0.00025, 0.04  # diameters of a thread and of a hawser [m]
FORCES = (1e-5, 1e4)  # F_0, nine decades of it [N]
SAME_SHARE = 0.01
SAME_WORK = at_most(0.2)
LITTLE = at_most(0.001)
SLOW_ENOUGH = at_most(0.02)
SPEEDS = (0.1, 0.3, 3.0, 10.0)  # times the default
LOOP, OVERHAND = "config/tighten.yaml", "config/overhand.yaml"
NUMBERS = ("radius", "density", "stretching_stiffness", "bending_stiffness", "twisting_stiffness",
           "friction_coefficient", "tying_preload")  # nothing breaks
READINGS = [("plateau force (true)", "true_plateau_force", "F_0"), ("lock extension", "lock_extension", "h"),
            ("locked stiffness", "locked_stiffness", "F_0/h"), ("peak force (true)", "true_peak_force", "F_0")]
SHARES = [("share of drag in the force", "drag_share"), ("share of inertia in it", "inertia_share")]
SAMPLING_RATE = 3.0  # the default [Hz]
STARTS = 5           # of each speed


def draws():
    """Diameter [m] and F_0 [N], each spread evenly over its range by the logarithm, in unlike orders."""
    count = 12
    sizes = [LEAST * (LARGEST / LEAST) ** (k / (count - 1)) for k in range(count)]
    forces = [FORCES[0] * (FORCES[1] / FORCES[0]) ** (5 * k % count / (count - 1)) for k in range(count)]
    corners = [(LEAST, FORCES[1]), (LARGEST, FORCES[0]), (LARGEST, FORCES[1])]
    return list(zip(sizes, forces)) + corners


def report(runner, materials):
    curves = {}
    tables = [of_sizes(runner, LOOP, material, curves) for material in materials]
    tables.append(of_sizes(runner, OVERHAND, materials[-1], curves))
    tables += [of_speeds(runner, material) for material in materials]
    return Report("Any size, any stiffness",
                  "`config/tighten.yaml`, and at the end of them `config/overhand.yaml`, with rods that have the groups "
                  "k_s h²/k_b, k_t/k_b, μ and F_p h²/k_b of a shipped material, its density, and any other diameter "
                  "and F_0 = k_b/h²; every length and speed is the default. The first column has the shipped diameter "
                  "and stiffness, and the others are compared with it. The own bending time is h² √(ρ A/k_b). The mass "
                  "that is accelerated is that of a bending time of 2e-4 s; with its own mass, which light rods have by "
                  "default, each would be another specimen. Readings of speeds are means over "
                  f"{STARTS} starts, whose knots are tied 0.37 mm further apart from one to the next. A speed that moves the "
                  "plateau by more than a gate allows must have been warned of.",
                  tables, lambda file: plots.ratios(file, curves, "F_0 [N]", "reading / that of the first column",
                                                    SAME_SHARE))


def of_sizes(runner, method, material, curves):
    with open(os.path.join(runner.root, "config/materials", material + ".yaml"), encoding="utf-8") as text:
        # YAML of this library takes 7.34e4 for a text.
        shipped = {key: float(value) for key, value in yaml.safe_load(text).items() if key in NUMBERS}
    combinations = [(2.0 * shipped["radius"], bending_force(shipped))] + draws()
    knot = "loop" if method == LOOP else "open overhand"
    each = [runner.run(f"{material}_{knot.split()[-1]}/{k}", settings_of(shipped, d, force), method)
            for k, (d, force) in enumerate(combinations)]
    title = f"{material}, {knot}"
    table = Table(title, [f"{1e3 * d:.3g} mm, {force:.2g} N" for d, force in combinations])
    table.add("own bending time", "s", [own_time(shipped, d, force) for d, force in combinations], None, ".2g")
    table.add("exit code", "-", [run.exit_code for run in each], is_(0))
    table.add("motion pattern", "-", [run.value("motion_pattern") for run in each],
              is_(each[0].value("motion_pattern")))
    curves[title] = {}
    for words, key, unit in READINGS:
        units = [{"F_0": force, "h": d / 2.0, "F_0/h": 2.0 * force / d}[unit] for d, force in combinations]
        values = [divide(run.value(key), one) for run, one in zip(each, units)]
        if values[0] is None:
            continue
        add_changes(table, words, unit, values, at_most(SAME_SHARE))
        points = sorted((force, value / values[0]) for (_, force), value in zip(combinations, values) if value)
        curves[title][words] = tuple(zip(*points))
    add_changes(table, "Newton iterations", "-", [run.value("newton_iterations") for run in each], SAME_WORK)
    for words, key in SHARES:
        table.add(words, "-", [run.value(key) for run in each], LITTLE, ".2g")
    table.add("warnings", "-", [len(run.value("warnings") or []) for run in each])
    return table


def of_speeds(runner, material):
    """What pulling and tying more slowly and faster than by default moves: means over starts, as one of them scatters."""
    def over_starts(name, settings):
        return [runner.run(f"{material}_speeds/{name}/{k}", {"material": material, **settings, **runs.start(k)})
                for k in range(STARTS)]

    each = {"default": over_starts("default", {})}
    program = each["default"][0].method.get("program", [])
    for step in ("pull", "tie"):
        speed = next((entry[step]["speed"] for entry in program if step in entry), None)
        for times in SPEEDS if speed else []:
            settings = {f"program.{step}.speed": times * speed}
            if step == "pull":      # the load is read at the same extensions
                settings["machine.load_cell"] = {"sampling_rate": times * SAMPLING_RATE}
            each[f"{step} x{times:g}"] = over_starts(f"{step}_{times:g}", settings)
    table = Table(f"{material}, speeds", list(each))
    table.add("exit code", "-", [max(run.exit_code for run in some) for some in each.values()], is_(0))
    warned = [any("radii a second" in text or "inertia" in text for run in some
                  for text in run.value("warnings") or []) for some in each.values()]
    table.add("warned of speed", "-", warned)
    for words, key, unit in READINGS[:3]:
        values = [mean(run.value(key) for run in some) for some in each.values()]
        if values[0] is not None:
            add_changes(table, words, {"F_0": "N", "h": "m", "F_0/h": "N/m"}[unit], values,
                        [None if told else SLOW_ENOUGH for told in warned])
    for words, key in SHARES:
        table.add(words, "-", [mean(run.value(key) for run in some) for some in each.values()], None, ".2g")
    return table


def add_changes(table, words, unit, values, gate):
    table.add(words, unit, values)
    table.add(f"{words}: relative change", "-", [runs.relative_change(value, values[0]) for value in values], gate, ".2g")


def bending_force(material):
    return material["bending_stiffness"] / material["radius"] ** 2


def own_time(shipped, diameter, force):
    """h^2 sqrt(rho A/k_b) [s]"""
    return diameter / 2.0 * math.sqrt(shipped["density"] * math.pi * (diameter / 2.0) ** 2 / force)


def settings_of(shipped, diameter, force):
    """A rod similar to the shipped one, of its density and friction."""
    forces, lengths = force / bending_force(shipped), diameter / 2.0 / shipped["radius"]
    scales = {"radius": lengths, "stretching_stiffness": forces, "tying_preload": forces,
              "bending_stiffness": forces * lengths ** 2, "twisting_stiffness": forces * lengths ** 2}
    return {"material": {key: value * scales.get(key, 1.0) for key, value in shipped.items()},
            "physics.inertia": (2e-4 / own_time(shipped, diameter, force)) ** 2}
