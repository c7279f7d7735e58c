"""Two curves overlaid, and their difference."""
import numpy as np

from knot_utm.report.curve_figures import MANY
from knot_utm.report.few_points import few_points
from knot_utm.report.quantities import number
from knot_utm.report.style import BLUE, GREEN, GREY, INK, ORANGE, SMALL, as_svg, stacked


def overlay(comparison, look):
    """Both curves, again where loads are small beside the peak, and B less A over the extensions that both have."""
    closer = near_the_plateau(comparison)
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


def near_the_plateau(comparison):
    plateaus = [value for value in readings(comparison, "plateau_force") if value]
    peaks = [value for value in readings(comparison, "peak_force") if value]
    if not plateaus or not peaks or max(peaks) < MANY * max(plateaus):
        return None
    top = 3.0 * max(plateaus)
    lowest = min(0.0, float(comparison.a.load.min()), float(comparison.b.load.min()))
    scale = comparison.units.force.scale
    return scale * (max(lowest, -top) - 0.05 * top), scale * top


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


def short(file, letters):
    """The last two parts of a path, the last letters of a long name."""
    text = "/".join(file.split("/")[-2:])
    text = text if len(text) <= letters else "…" + text[1 - letters:]
    return text.replace("$", r"\$")  # which begins a formula


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
