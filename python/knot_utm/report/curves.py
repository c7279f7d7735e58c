"""The one drawer of curves: what is made of them before they are drawn, loads over extensions, and those of a test with all that
happened in it."""
import math
from collections import namedtuple

import numpy as np
from matplotlib.patches import Patch

from knot_utm.panel.readings import MANY
from knot_utm.report.quantities import with_unit
from knot_utm.report.run import FORMING
from knot_utm.report.style import BLUE, GOLD, GREEN, GREY, INK, ORANGE, PHASES, RED, SMALL, stacked, VIOLET

FEW = 250    # readings of the cell that are drawn as points
STEPS = 1000
DASHED, DOTTED = (0, (4, 3)), (0, (1, 2))


def small_loads(value, load):
    """Loads to show once more [N]: those of sliding, or up to a knot's jump, where they are small beside the peak; else None.
    `value` gives the readings by key."""
    plateau, peak = value("plateau_force") or value("jump_force"), value("peak_force")
    if plateau is None or plateau <= 0.0 or peak is None or peak < MANY * plateau:
        return None
    top = max(2.5 * plateau, 1.3 * (value("breakaway_force") or 0.0))
    return max(min(0.0, float(load.min())), -0.5 * top) - 0.05 * top, top


def load_axes(units, small=None, more=(), above=0.3):
    """A figure of loads over extensions: axes of the loads, of the small ones where there are any, and below them of the heights
    `more` [in]."""
    figure, axes = stacked([2.8, *([1.7] if small else []), *more], above)
    axes[0].set_ylabel(f"load F [{units.force.name}]")
    if small:
        axes[1].set_ylim(*(units.force.scale * load for load in small))
        axes[1].set_ylabel(f"small loads [{units.force.name}]")
    axes[-1].set_xlabel(f"extension s [{units.length.name}]")
    return figure, axes


def reach(axes, extensions):
    """Lets the axes reach as far as the extensions, in the unit of the page."""
    axes.set_xlim(min(0.0, extensions.min()), extensions.max() + 0.015 * (np.ptp(extensions) or 1.0))


def phases_of(curve):
    """[(phase, first row, last row)] in order."""
    changes = np.flatnonzero(curve.phase[1:] != curve.phase[:-1]) + 1
    edges = [0, *changes.tolist(), len(curve)]
    return [(str(curve.phase[a]), a, min(b, len(curve) - 1)) for a, b in zip(edges[:-1], edges[1:]) if b > a]


# ---- a test ----


def course(run):
    """Load and extension over time, with every phase of the program."""
    curve, force, length, time = run.curve, run.units.force, run.units.length, run.curve["time"]
    figure, (axes,) = stacked([1.5], right=0.6)
    for name, a, b in phases_of(curve):
        axes.axvspan(time[a], time[b], color=PHASES.get(name, "#eeeeee"), lw=0, zorder=0)
    names = [name for name in dict.fromkeys(curve.phase.tolist()) if name in PHASES]
    figure.legend(handles=[Patch(color=PHASES[name], label=name) for name in names], loc="upper center", handlelength=1.0,
                  ncol=len(names), columnspacing=1.0, handletextpad=0.4, borderpad=0.2)
    tested = ~np.isin(curve.phase, FORMING)
    second = axes.twinx()
    for one, name, unit, colour in ((axes, "load", force, BLUE), (second, "extension", length, ORANGE)):
        one.plot(time, unit.scale * np.where(tested, curve[name], np.nan), color=colour, lw=1.2)
        one.set_ylabel(f"{name} {'F' if name == 'load' else 's'} [{unit.name}]", color=colour)
        one.grid(False)
    second.spines["right"].set_visible(True)
    axes.set_xlabel("time [s]")
    axes.set_xlim(time[0], max(time[-1], time[0] + 1e-9))
    return figure


def force_extension(run, marks):
    """Load over extension; again where the load is small beside its peak; knot distance where there are two knots."""
    tested, events, scale = run.curve.tested(), events_of(run), run.units.length.scale
    small, knots = small_loads(run.value, tested["load"]), np.isfinite(tested["knot_distance"]).any()
    figure, axes = load_axes(run.units, small, [1.4] if knots else [], 0.25 + 0.15 * len(events))
    loads = axes[:2 if small else 1]
    for one in loads:
        draw_loads(one, run)
    if tested["load"].min() >= 0.0:
        axes[0].set_ylim(bottom=0.0)
    axes[0].legend(loc="upper left", bbox_to_anchor=(0.0, 0.93), borderpad=0.2)
    draw_plateau(loads[-1], run)
    put_marks(axes[0], run, [(mark, run.units.force.scale * mark.load) for mark in marks])
    if knots:
        draw_knot_distance(axes[-1], run, marks)
    draw_motion(axes, run, events, scale * float(tested["extension"].max()))
    shown = tested["extension"]
    if tested.has_compliant_frame():
        pull = run.curve.pull()
        shown = np.concatenate([pull["extension"] if len(pull) else shown, tested["crosshead_extension"]])
    reach(axes[-1], scale * shown)
    figure.align_ylabels(axes)
    return figure


def draw_loads(axes, run):
    tested, force, length = run.curve.tested(), run.units.force, run.units.length
    floor, pull = run.load_cell_floor(), run.curve.pull()
    if floor:  # below it the cell's error is as large as that of the floor
        axes.axhspan(force.scale * (-floor if tested["load"].min() < 0.0 else 0.0), force.scale * floor, facecolor="none", edgecolor=GREY,
                     alpha=0.45, hatch="////", lw=0.0, label=f"cell's floor, {with_unit(floor, force)}")
    band = error_band(run, pull)
    if band:
        axes.fill_between(length.scale * pull["extension"], *(force.scale * end for end in band), color=BLUE, alpha=0.22, lw=0,
                          label="numerical error")
    named = set()
    for name, a, b in phases_of(tested):
        axes.plot(length.scale * tested["extension"][a:b + 1], force.scale * tested["load"][a:b + 1], lw=1.4,
                  color={"hold": VIOLET, "return": GREEN}.get(name, BLUE), label=None if name in named else name)
        named.add(name)
    cell = run.readings.tested()
    if len(cell) <= FEW:
        axes.plot(length.scale * cell["extension"], force.scale * cell["load"], "o", ms=2.6, mfc="white", mec=BLUE, mew=0.7,
                  label="as the cell reads it")
    if tested.has_compliant_frame():
        axes.plot(length.scale * tested["crosshead_extension"], force.scale * tested["load"], color=GREY, lw=0.9, ls=(0, (5, 2)),
                  label="over the crosshead's extension")


def draw_plateau(axes, run):
    plateau, lock = run.value("plateau_force"), run.value("lock_extension_by_load")
    if plateau is None:
        return
    end = run.units.length.scale * (lock if lock is not None else run.curve.pull()["extension"][-1])
    axes.plot([0.3 * end, 0.8 * end], 2 * [run.units.force.scale * plateau], color=ORANGE, lw=1.6, zorder=4)
    axes.text(0.55 * end, 0.85, "plateau " + with_unit(plateau, run.units.force, run.value("plateau_force_error")), ha="center",
              fontsize=SMALL, color=ORANGE, transform=axes.get_xaxis_transform())


def draw_knot_distance(axes, run, marks):
    tested, length, lock = run.curve.tested(), run.units.length, run.value("lock_extension")
    s, e = length.scale * tested["extension"], length.scale * tested["knot_distance"]
    axes.plot(s, e, color=VIOLET, lw=1.4)
    if lock is not None or (run.result.get("motion_pattern") == "sliding" and run.value("jump_force") is None):
        first, end = np.flatnonzero(np.isfinite(e))[0], length.scale * lock if lock is not None else s[-1]
        rigid = 2 if run.method["machine"]["grips"] == "rollers" else 1
        axes.plot([s[first], end], [e[first], e[first] - rigid * (end - s[first])], color=GREY, lw=0.9, ls=DASHED,
                  label=f"de/ds = –{rigid}: rigid sliding")
        axes.legend(loc="lower left", borderpad=0.2)
    axes.set_ylabel(f"knot distance e [{length.name}]")
    put_marks(axes, run, [(mark, float(np.interp(mark.time, tested["time"], e))) for mark in marks])


def put_marks(axes, run, places):
    for mark, y in places:
        if np.isfinite(y):
            at = (run.units.length.scale * mark.extension, y)
            axes.plot(*at, "o", ms=10.5, mfc="white", mec=INK, mew=0.9, clip_on=False, zorder=6)
            axes.annotate(mark.letter, at, ha="center", va="center_baseline", fontsize=SMALL, zorder=7, annotation_clip=False)


def events_of(run):
    """[(place in the unit of the page, words, colour, style)] in order of their places."""
    length, value = run.units.length, run.value
    events = (("first_contact_extension", "the knots touch", VIOLET, DOTTED),
              ("jump_extension", "a knot jumped open at " + with_unit(value("jump_force"), run.units.force), RED, DASHED),
              ("lock_extension", "lock " + with_unit(value("lock_extension"), length, value("lock_extension_error")), INK, DASHED),
              ("break_extension", "break " + with_unit(value("break_extension"), length), RED, "-"))
    return sorted((length.scale * value(key), *event) for key, *event in events if value(key) is not None)


def draw_motion(axes, run, events, end):
    """What moves where: up to the lock the knots slide, behind it the rod stretches. Each event is named on a line of its own above the
    axes."""
    lock, error, scale = run.value("lock_extension"), run.value("lock_extension_error"), run.units.length.scale
    pattern, parts = run.result.get("motion_pattern"), []
    if lock is not None:
        parts = [(0.0, scale * lock, "the knots slide", GREEN, "mount", 0.45), (scale * lock, end, "the rod stretches", GOLD, "tie", 0.5)]
    elif pattern not in (None, "none"):
        parts = [(0.0, end, f"motion pattern: {pattern}", GREEN, None, 0.0)]
    for one in axes:
        for begin, finish, _, _, phase, strength in parts:
            one.axvspan(begin, finish, color=PHASES.get(phase), alpha=strength, lw=0, zorder=0)
        if lock is not None and error:
            one.axvspan(scale * (lock - error), scale * (lock + error), color=GREY, alpha=0.2, lw=0, zorder=0)
        for place, _, colour, style in events:
            one.axvline(place, color=colour, lw=0.9, ls=style)
    above = axes[0].get_xaxis_transform()
    for line, (place, words, colour, _) in enumerate(events):
        axes[0].annotate(words, (place, 1.0), xytext=(0, 3 + 10.8 * line), xycoords=above, textcoords="offset points", color=colour,
                         ha="right" if place > 0.8 * end else "left" if place < 0.1 * end else "center", fontsize=SMALL)
    for begin, finish, words, colour, *_ in parts:
        if begin == 0.0 or finish - begin > 0.2 * end:
            axes[0].text(0.5 * (begin + finish), 0.955, words, ha="center", color=colour, transform=above)


# ---- bands ----


def error_band(run, pull):
    """Where the curve of ever finer tolerances may lie, by the errors that result.yaml gives for its readings.

    Up to the lock the force may be off by plateau_force_error / true_plateau_force, behind it by locked_stiffness_error /
    locked_stiffness, each as a share of the true force; the extension may be off by lock_extension_error at the lock and behind it,
    and in proportion before. A curve between these errors lies between the lowest and the highest load that are returned: over the
    extensions of the pull, NaN where no error is known; None where none is known anywhere."""
    lock = run.value("lock_extension")
    sliding, locked = share(run, "plateau_force"), share(run, "locked_stiffness")
    shift = run.value("lock_extension_error") if lock is not None else 0.0
    if len(pull) < 2 or (sliding is None and locked is None):
        return None
    s, force = pull["extension"], pull["load"] + run.offset()
    # Nothing slid: the stiffness is that of the whole pull.
    behind = s >= lock if lock is not None else np.full(len(s), sliding is None)
    relative = np.where(behind, np.nan if locked is None else locked, np.nan if sliding is None else sliding)
    lowest = highest = force
    if shift:
        along = shift * np.minimum(1.0, np.maximum(s, 0.0) / lock)
        moved = [np.interp(s + t * along, s, force) for t in np.linspace(-1.0, 1.0, 21)]
        lowest, highest = np.min(moved, axis=0), np.max(moved, axis=0)
    return lowest - relative * np.abs(lowest) - run.offset(), highest + relative * np.abs(highest) - run.offset()


def share(run, key):
    """Errors of forces belong to the true one."""
    value, error = run.value("true_" + key) or run.value(key), run.value(key + "_error")
    return None if value is None or error is None or value == 0.0 else abs(error / value)


# Over `extension` [m] the mean of the loads [N], and bands about it: one standard deviation, and the 95 % interval of the mean.
MeanCurve = namedtuple("MeanCurve", "extension mean scatter interval")


def mean_curve(pulls):
    """`pulls`: of each curve extension and load, straight from point to point. None: they are not two, or no extension is common to
    all. The bands reach no further than a specimen shows: where locks lie apart loads are not normally distributed."""
    if len(pulls) < 2 or any(len(s) < 2 for s, _ in pulls):
        return None
    low, high = max(s[0] for s, _ in pulls), min(s[-1] for s, _ in pulls)
    if not low < high:
        return None
    from scipy.special import stdtrit  # quantile of Student's distribution

    extension = np.linspace(low, high, STEPS + 1)
    loads = np.array([np.interp(extension, s, load) for s, load in pulls])
    mean, sd, n = loads.mean(axis=0), loads.std(axis=0, ddof=1), len(loads)
    bands = [(np.maximum(mean - width, loads.min(axis=0)), np.minimum(mean + width, loads.max(axis=0)))
             for width in (sd, stdtrit(n - 1, 0.975) * sd / math.sqrt(n))]
    return MeanCurve(extension, mean, *bands)
