"""Two curves beside each other, as `compare --report` left them in a folder: what is known of them, their figure, their page."""
import os
import re

import numpy as np

from knot_utm.report.commands import CannotReport
from knot_utm.report.curve_figures import small_loads
from knot_utm.report.curves import few_points
from knot_utm.report.method_facts import knot_and_materials
from knot_utm.report.page import files_of, render
from knot_utm.report.quantities import all_in_units, is_number, number, percent, quantity_of, shown, Units, units_of
from knot_utm.report.run import numbers, printable, read_columns, read_yaml, texts_of
from knot_utm.report.style import as_svg, BLUE, GREEN, GREY, INK, LOOKS, ORANGE, short, SMALL, stacked

READINGS = ("peak_force", "plateau_force", "plateau_force_low", "plateau_force_high", "plateau_force_slope",
            "breakaway_force", "largest_drop", "jump_force", "force_after_jump", "lock_extension_by_load",
            "locked_stiffness")


class Pull:
    def __init__(self, file):
        columns = read_columns(file)
        for name in ("extension", "load"):
            if name not in columns:
                raise CannotReport(f"{file}: no column {name}")
        self.extension, self.load = (numbers(file, name, columns[name]) for name in ("extension", "load"))


class Comparison:
    def __init__(self, folder):
        self.folder = folder
        self.facts = read_yaml(os.path.join(folder, "comparison.yaml"), errors="surrogateescape")
        self.a, self.b = (Pull(os.path.join(folder, name)) for name in ("a.csv", "b.csv"))
        for key in ("a", "b", "common_extension"):
            if key not in self.facts:
                raise CannotReport(f"{os.path.join(folder, 'comparison.yaml')}: no key {key}")
        self.files = {name: str(self.facts[name]) for name in ("a", "b")}
        self.facts.update({name: printable(file) for name, file in self.files.items()})
        self.runs = {name: run_beside(file) for name, file in self.files.items()}
        asked = [units_of(run.report) for run in self.runs.values() if run]
        self.units = next((units for units in asked if not units.are_default), Units())

    def number(self, key):
        value = self.facts.get(key)
        return value if is_number(value) else None

    def ends_at_its_largest_load(self, name):
        """Whether the curve has no peak: its load was still rising where it ends, and no rod parted there."""
        load, run = {"a": self.a, "b": self.b}[name].load, self.runs[name]
        if run and run.result.get("ended_by") == "break":
            return False
        return int(np.argmax(load)) >= len(load) - 2

    def difference(self):
        """Extensions that both have, and load of B less that of A there: both straight from point to point."""
        low, high = self.facts["common_extension"]
        s = np.union1d(self.a.extension, self.b.extension)
        s = np.concatenate([[low], s[(s > low) & (s < high)], [high]])
        return s, np.interp(s, self.b.extension, self.b.load) - np.interp(s, self.a.extension, self.a.load)


class Simulated:
    """The run that a curve is from: its method, its result, and what its method says of reports."""

    def __init__(self, folder):
        self.folder = folder
        method = os.path.join(folder, "method.yaml")
        self.method, self.report = read_yaml(method), texts_of(method, "report")
        self.result = read_yaml(os.path.join(folder, "result.yaml"))


def run_beside(file):
    """The run that a curve is from; None where it is from none."""
    folder = os.path.dirname(file) or "."
    if os.path.basename(file) not in ("curve.csv", "curve_full.csv", "test.bag", "saved.bag"):
        return None
    try:
        return Simulated(folder)
    except CannotReport:
        return None


def overlay(comparison, look):
    """Both curves, again where loads are small beside the peak, and B less A over the extensions that both have."""
    closer = small_loads(lambda key: max(filter(None, readings(comparison, key)), default=None),
                         np.concatenate([comparison.a.load, comparison.b.load]), comparison.units.force.scale)
    heights = [2.9] + ([1.8] if closer else []) + [1.6]
    figure, all_axes, tall = stacked(look, heights)
    for axes in all_axes[:-1]:
        draw_both(axes, comparison, 34 if look.is_narrow else 60)
    all_axes[0].legend(loc="upper left")
    all_axes[0].set_ylabel(f"load F [{comparison.units.force.name}]")
    if closer:
        all_axes[1].set_ylim(*closer)
        all_axes[1].set_ylabel(f"small loads [{comparison.units.force.name}]")
    draw_difference(all_axes[-1], comparison)
    length = comparison.units.length
    low, high = (length.scale * s for s in comparison.facts["common_extension"])
    for axes in all_axes:
        for s in (low, high):
            axes.axvline(s, color=GREY, lw=0.6, ls=":")
    every = np.concatenate([comparison.a.extension, comparison.b.extension]) * length.scale
    all_axes[-1].set_xlim(min(0.0, every.min()), every.max() + 0.015 * (np.ptp(every) or 1.0))
    all_axes[-1].set_xlabel(f"extension s [{length.name}]")
    figure.align_ylabels(all_axes)
    figure.subplots_adjust(**look.room(tall, 0.5, 0.15))
    return as_svg(figure)


def readings(comparison, key):
    both = comparison.facts.get(key) or {}
    return [both.get("a"), both.get("b")]


def draw_both(axes, comparison, letters):
    units = comparison.units
    for pull, colour, name in ((comparison.a, ORANGE, "A"), (comparison.b, BLUE, "B")):
        rows = few_points(pull.load)
        axes.plot(units.length.scale * pull.extension[rows], units.force.scale * pull.load[rows], color=colour, lw=1.4,
                  label=f"{name}: {short(comparison.facts[name.lower()], letters)}")
    for colour, lock in zip((ORANGE, BLUE), readings(comparison, "lock_extension_by_load")):
        if lock is not None:
            axes.axvline(units.length.scale * lock, color=colour, lw=0.9, ls=(0, (4, 3)), label="_lock")


def draw_difference(axes, comparison):
    length, force = comparison.units.length, comparison.units.force
    s, difference = comparison.difference()
    rows = few_points(difference)
    s, difference = length.scale * s[rows], force.scale * difference[rows]
    axes.axhline(0.0, color=INK, lw=0.8)
    axes.fill_between(s, difference, color=GREEN, alpha=0.25, lw=0)
    axes.plot(s, difference, color=GREEN, lw=1.2)
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
    units = comparison.units
    rising = [name.upper() for name in ("a", "b") if comparison.ends_at_its_largest_load(name)]
    rows = [comparison_row(comparison, key, units) for key in READINGS if has_either(comparison.facts.get(key))]
    length, force = units.length.scale, units.force.scale
    return render("comparison.html.j2", {
        "title": "Comparison of two curves", "facts": comparison.facts,
        "curves": [overlay(comparison, look) for look in LOOKS], "rows": rows,
        "rising": rising, "sides": [(name.upper(), printable(file), *side_facts(comparison.runs[name], units))
                                    for name, file in comparison.files.items()],
        "unmeasured": [key for key in READINGS if key in comparison.facts and not has_either(comparison.facts[key])],
        "common": [shown(s, length) for s in comparison.facts["common_extension"]],
        "force": units.force.name, "length": units.length.name, "si": units.are_default,
        "rms": shown(comparison.number("rms_difference"), force),
        "largest": shown(comparison.number("largest_difference"), force),
        "share": percent(comparison.number("rms_difference_over_load")),
        "largest_at": shown(comparison.number("largest_difference_at"), length), "files": files_of(folder),
        "command": printable(command), "version": version, "folder": printable(folder)})


def has_either(both):
    return isinstance(both, dict) and any(is_number(both.get(name)) for name in ("a", "b"))


def comparison_row(comparison, key, units):
    both, quantity = comparison.facts[key], quantity_of(key)
    unit = units.of(quantity.kind)
    rises = key == "peak_force" and any(map(comparison.ends_at_its_largest_load, ("a", "b")))
    return (key, "Largest load" if rises else re.split("[,;]", quantity.label)[0], unit.name,
            *(shown(both[part], unit.scale) if is_number(both.get(part)) else "none" if part != "difference" else ""
              for part in ("a", "b", "difference")), percent(both.get("relative")))


def side_facts(run, units):
    """What a curve is from, and what its run warns of."""
    if run is None:
        return "This curve is a file of its own: no run of knot_utm stands beside it.", []
    words = (f"This curve was simulated: {knot_and_materials(run.method, run.folder)}, "
             f"knot_utm {run.result.get('version')}, ended by {run.result.get('ended_by')}.")
    return words, all_in_units(run.result.get("warnings") or [], units)
