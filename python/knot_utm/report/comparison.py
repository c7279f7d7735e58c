"""Two curves beside each other, as `compare --report` left them in a folder."""
import os
import re
from collections import namedtuple

import numpy as np
from markupsafe import Markup

from knot_utm.errors import WrongInput
from knot_utm.report.curves import load_axes, reach, small_loads
from knot_utm.report.method_facts import knot_and_materials
from knot_utm.report.page import Box, figure, Headline, no_value, render, Row, Table
from knot_utm.report.quantities import all_in_units, is_number, number, percent, quantity_of, shown, Units, units_of, with_unit
from knot_utm.report.run import read_table, read_yaml, texts_of
from knot_utm.report.style import BLUE, GREEN, GREY, INK, ORANGE, short, SMALL
from knot_utm.yaml_text import printable

READINGS = ("peak_force", "plateau_force", "plateau_force_low", "plateau_force_high", "plateau_force_slope",
            "breakaway_force", "largest_drop", "jump_force", "force_after_jump", "lock_extension_by_load",
            "locked_stiffness")


# A curve: extension [m] and load [N].
Pull = namedtuple("Pull", "extension load")
# The run that a curve is from.
Simulated = namedtuple("Simulated", "folder method report result")


class Side:
    """One of the curves. `file`: where it is from; `run`: a Simulated, None where the curve is from none."""

    def __init__(self, folder, name, file, colour):
        self.name, self.file, self.colour, self.run = name, printable(file), colour, run_beside(file)
        self.pull = Pull(**read_table(os.path.join(folder, name.lower() + ".csv"), Pull._fields))

    def ends_at_its_largest_load(self):
        """Whether the curve has no peak: its load was still rising where it ends, and no rod parted there."""
        load, parted = self.pull.load, self.run and self.run.result.get("ended_by") == "break"
        return not parted and int(np.argmax(load)) >= len(load) - 2


def run_beside(file):
    folder = os.path.dirname(file) or "."
    if os.path.basename(file) not in ("curve.csv", "curve_full.csv", "test.bag", "saved.bag"):
        return None
    method, result = (os.path.join(folder, name) for name in ("method.yaml", "result.yaml"))
    try:
        return Simulated(folder, read_yaml(method), texts_of(method, "report"), read_yaml(result))
    except WrongInput:
        return None


class Comparison:
    def __init__(self, folder):
        self.facts = read_yaml(os.path.join(folder, "comparison.yaml"), "a", "b", "common_extension", errors="surrogateescape")
        self.sides = [Side(folder, name, str(self.facts[name.lower()]), colour) for name, colour in (("A", ORANGE), ("B", BLUE))]
        asked = [units_of(side.run.report) for side in self.sides if side.run]
        self.units = next((units for units in asked if not units.are_default), Units())

    def number(self, key):
        value = self.facts.get(key)
        return value if is_number(value) else None

    def readings(self, key):
        """The readings of both curves that are numbers, by name."""
        both = self.facts.get(key)
        return {side.name: both[side.name.lower()] for side in self.sides
                if isinstance(both, dict) and is_number(both.get(side.name.lower()))}

    def difference(self):
        """Extensions that both have, and load of B less that of A there: both straight from point to point."""
        (low, high), (a, b) = self.facts["common_extension"], (side.pull for side in self.sides)
        s = np.union1d(a.extension, b.extension)
        s = np.concatenate([[low], s[(s > low) & (s < high)], [high]])
        return s, np.interp(s, b.extension, b.load) - np.interp(s, a.extension, a.load)


def overlay(comparison):
    """Both curves, again where loads are small beside the peak, and B less A over the extensions that both have."""
    units, length, force = comparison.units, comparison.units.length.scale, comparison.units.force.scale
    extension, load = (np.concatenate(both) for both in zip(*(side.pull for side in comparison.sides)))
    figure, axes = load_axes(units, small_loads(lambda key: max(comparison.readings(key).values(), default=None), load), [1.6], above=0.15)
    for one in axes[:-1]:
        for side in comparison.sides:
            one.plot(length * side.pull.extension, force * side.pull.load, color=side.colour, lw=1.4, label=f"{side.name}: {short(side.file)}")
            if (lock := comparison.readings("lock_extension_by_load").get(side.name)) is not None:
                one.axvline(length * lock, color=side.colour, lw=0.8, ls=(0, (4, 3)))
    axes[0].legend(loc="upper left")
    draw_difference(axes[-1], comparison)
    for one in axes:
        for s in comparison.facts["common_extension"]:
            one.axvline(length * s, color=GREY, lw=0.6, ls=":")
    reach(axes[-1], length * extension)
    return figure


def draw_difference(axes, comparison):
    length, force = comparison.units.length, comparison.units.force
    s, difference = comparison.difference()
    axes.axhline(0.0, color=INK, lw=0.8)
    axes.plot(length.scale * s, force.scale * difference, color=GREEN, lw=1.2)
    axes.fill_between(length.scale * s, force.scale * difference, color=GREEN, alpha=0.25, lw=0)
    at, largest = comparison.number("largest_difference_at"), comparison.number("largest_difference")
    if at is not None and largest is not None:
        side = "right" if at > np.mean(comparison.facts["common_extension"]) else "left"
        at, largest = length.scale * at, force.scale * largest
        axes.plot(at, largest, "o", ms=4, color=GREEN)
        axes.annotate(f"largest: {number(largest)} {force.name} at {number(at)} {length.name}", (at, largest), ha=side,
                      va="bottom", xytext=(-8 if side == "right" else 8, 3), textcoords="offset points", fontsize=SMALL, color=GREEN)
    axes.set_ylabel(f"B – A [{force.name}]")


def report_on_comparison(folder, command, version):
    comparison = Comparison(folder)
    facts, units = comparison.facts, comparison.units
    length, force = units.length, units.force
    rows = [comparison_row(comparison, key) for key in READINGS if comparison.readings(key)]
    rms, largest, at = ((comparison.number(key), unit) for key, unit in (("rms_difference", force), ("largest_difference", force),
                                                                          ("largest_difference_at", length)))
    share, common = percent(comparison.number("rms_difference_over_load")), [shown(s, length.scale) for s in facts["common_extension"]]
    rows += [Row("RMS difference", ["rms_difference", "rms_difference_over_load"], ["", "", shown(rms[0], force.scale), force.name, share]),
             Row(f"Largest difference, at {with_unit(*at)}", ["largest_difference", "largest_difference_at"],
                 ["", "", shown(largest[0], force.scale), force.name, ""])]
    remark = "".join([
        "The same code reads both curves, from extension and load alone. The RMS difference is compared with the largest load of A over the "
        f"common extension. Forces are in {force.name} and lengths in {length.name}", "." if units.are_default else "; all files are in SI units.",
        *(f" Curve {side.name} ends at its largest load, which is a peak only where the rod broke there."
          for side in comparison.sides if side.ends_at_its_largest_load())])
    return render(folder, command, version, "Comparison", "Comparison of two curves", [
        ("Both curves", [figure(
            overlay(comparison), "Both curves overlaid, and their difference",
            "The curves are the pulls alone: the rows that reach a new largest extension. A curve of knot_utm has its own zero; raw data are "
            "set to zero where their crosshead begins to move, unless the command below says --no-balance. The dashed lines mark the lock of "
            "each curve, as its load tells it. The dotted lines bound the extensions that both curves have; over these the difference is taken, "
            "with straight lines between the readings.")]),
        ("Readings of both curves", [
            Table(("Reading", "A", "B", "B – A", "Unit", "Share of A"), rows), remark,
            no_value("Neither curve has a", [key for key in READINGS if key in facts and not comparison.readings(key)])]),
        ("What the curves are", [part for side in comparison.sides for part in words_of(side, units)])],
        Markup("A <b>{}</b> · B <b>{}</b>").format(*(side.file for side in comparison.sides)), headlines=[
            Headline("RMS difference", shown(rms[0], force.scale), "", force.name, share and f"{share} of the largest load of A"),
            Headline("Largest difference, B – A", shown(largest[0], force.scale), "", force.name, f"at {with_unit(*at)}"),
            Headline("Common extension", " to ".join(common), "", length.name, "")])


def comparison_row(comparison, key):
    both, quantity, readings = comparison.facts[key], quantity_of(key), comparison.readings(key)
    unit = comparison.units.of(quantity.kind)
    rises = key == "peak_force" and any(side.ends_at_its_largest_load() for side in comparison.sides)
    values = [shown(readings[name], unit.scale) if name in readings else "none" for name in ("A", "B")]
    difference = shown(both["difference"], unit.scale) if is_number(both.get("difference")) else ""
    label = "Largest load" if rises else re.split("[,;]", quantity.label)[0]
    return Row(label, [key], [*values, difference, unit.name, percent(both.get("relative"))])


def words_of(side, units):
    """What a curve is from, and what its run warns of."""
    run = side.run
    origin = "this curve is a file of its own: no run of knot_utm stands beside it." if run is None else (
        f"this curve was simulated: {knot_and_materials(run.method, run.folder)}, knot_utm {run.result.get('version')}, "
        f"ended by {run.result.get('ended_by')}.")
    warnings = all_in_units(run.result.get("warnings") or [], units) if run else []
    return [Markup("<b>{}</b> <code>{}</code>: {}").format(side.name, side.file, origin), warnings and Box("warnings", warnings)]
