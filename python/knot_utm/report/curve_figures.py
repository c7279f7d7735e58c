"""Curves of one test: its course over time, and load and knot distance over extension."""
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.patches import Patch
from matplotlib.ticker import MaxNLocator

from knot_utm.panel.readings import MANY
from knot_utm.report.curves import error_band, few_points
from knot_utm.report.quantities import shown, with_unit
from knot_utm.report.run import FORMING
from knot_utm.report.style import as_svg, BLUE, GOLD, GREEN, GREY, INK, ORANGE, PHASES, RED, SMALL, stacked, USUAL, VIOLET

FEW = 250   # readings of the cell that are drawn as points


def phases_of(curve):
    """[(phase, first row, last row)] in order."""
    changes = np.flatnonzero(curve.phase[1:] != curve.phase[:-1]) + 1
    edges = [0, *changes.tolist(), len(curve)]
    return [(str(curve.phase[a]), a, min(b, len(curve) - 1)) for a, b in zip(edges[:-1], edges[1:])]


def course(run, look):
    """Load and extension over time, with every phase of the program."""
    curve, force, length = run.curve, run.units.force, run.units.length
    tall = 2.4 if look.is_narrow else 2.2
    figure, axes = plt.subplots(figsize=(look.width, tall))
    time = curve["time"]
    for name, a, b in phases_of(curve):
        axes.axvspan(time[a], time[b], color=PHASES.get(name, "#eeeeee"), lw=0, zorder=0)
    names = [name for name in dict.fromkeys(curve.phase.tolist()) if name in PHASES]
    figure.legend(handles=[Patch(color=PHASES[name], label=name) for name in names], loc="upper center", handlelength=1.0,
                  ncol=5 if look.is_narrow else len(names), columnspacing=1.0, handletextpad=0.4, borderpad=0.2)
    tested, broke = ~np.isin(curve.phase, FORMING), run.time_of_break()
    if broke is not None:
        tested &= time <= broke
    rows = few_points(curve["load"], curve["extension"])
    axes.plot(time[rows], force.scale * np.where(tested, curve["load"], np.nan)[rows], color=BLUE, lw=1.3)
    axes.set_xlabel("time [s]")
    axes.set_ylabel(f"load F [{force.name}]", color=BLUE)
    axes.grid(False)
    if time[-1] > time[0]:
        axes.set_xlim(time[0], time[-1])
    second = axes.twinx()
    second.plot(time[rows], length.scale * np.where(tested, curve["extension"], np.nan)[rows], color=ORANGE, lw=1.1)
    second.set_ylabel(f"extension s [{length.name}]", color=ORANGE)
    second.spines["right"].set_visible(True)
    second.grid(False)
    figure.subplots_adjust(**look.room(tall, 0.5, 0.5 if look.is_narrow else 0.3, right=0.6))
    return as_svg(figure)


def force_extension(run, marks, look):
    """Load over extension; again where the load is small beside its peak; knot distance where there are two knots."""
    tested = run.tested()
    closer = near_the_plateau(run)
    knots = tested.has_knot_distance()
    heights = [2.8] + ([1.7] if closer else []) + ([1.4] if knots else [])
    figure, all_axes, tall = stacked(look, heights)
    draw_load(all_axes[0], run, marks)
    all_axes[0].legend(loc="upper left", bbox_to_anchor=(0.0, 0.93), borderpad=0.2)
    if closer:
        draw_load(all_axes[1], run, [])
        all_axes[1].set_ylim(*closer)
        all_axes[1].set_ylabel(f"small loads [{run.units.force.name}]")
    draw_plateau(all_axes[1 if closer else 0], run)
    if knots:
        draw_knot_distance(all_axes[-1], run, marks)
    for axes in all_axes:
        shade_motion(axes, run)
    name_motion(all_axes[0], run, look)
    all_axes[-1].set_xlim(*extension_limits(run))
    all_axes[-1].set_xlabel(f"extension s [{run.units.length.name}]")
    figure.align_ylabels(all_axes)
    figure.subplots_adjust(**look.room(tall, 0.5, 0.42 if look.is_narrow else 0.28))
    return as_svg(figure)


def extension_limits(run):
    """All that is drawn, in the unit of the page. On a compliant frame that is the crosshead's extension too."""
    tested = run.tested()
    drawn = [tested["extension"]]
    if tested.has_compliant_frame():
        pull = run.pull()
        drawn = [pull["extension"] if len(pull) else tested["extension"], tested["crosshead_extension"]]
    scale = run.units.length.scale
    s = scale * np.concatenate(drawn)
    return min(0.0, scale * tested["extension"].min()), s.max() + 0.015 * (np.ptp(s) or scale)


def near_the_plateau(run):
    """Loads to show once more: those of sliding, or up to a knot's jump, where they are small beside the peak; else
    None."""
    return small_loads(run.value, run.tested()["load"], run.units.force.scale)


def small_loads(value, load, scale):
    """As above, of loads [N] and the readings that `value` gives by key, in a unit of `scale`."""
    plateau, peak = value("plateau_force") or value("jump_force"), value("peak_force")
    if plateau is None or plateau <= 0.0 or peak is None or peak < MANY * plateau:
        return None
    top = max(2.5 * plateau, 1.3 * (value("breakaway_force") or 0.0))
    lowest = min(0.0, float(load.min()))
    return scale * (max(lowest, -0.5 * top) - 0.05 * top), scale * top


def draw_load(axes, run, marks):
    tested, force, length = run.tested(), run.units.force, run.units.length
    draw_floor(axes, run, tested)
    draw_band(axes, run)
    for number, (name, a, b) in enumerate(phases_of(tested) if len(tested) else []):
        colour = {"hold": VIOLET, "return": GREEN}.get(name, BLUE)
        first = name not in [other for other, _, _ in phases_of(tested)[:number]]
        rows = a + few_points(tested["extension"][a:b + 1], tested["load"][a:b + 1])
        axes.plot(length.scale * tested["extension"][rows], force.scale * tested["load"][rows], color=colour, lw=1.4,
                  label=name if first else None)
    cell = run.tested(run.readings)
    if len(cell) <= FEW:
        axes.plot(length.scale * cell["extension"], force.scale * cell["load"], "o", ms=2.6, mfc="white", mec=BLUE,
                  mew=0.7, label="as the cell reads it")
    if tested.has_compliant_frame():
        rows = few_points(tested["crosshead_extension"], tested["load"])
        axes.plot(length.scale * tested["crosshead_extension"][rows], force.scale * tested["load"][rows], color=GREY,
                  lw=0.9, ls=(0, (5, 2)), label="over the crosshead's extension")
    axes.set_ylabel(f"load F [{force.name}]")
    axes.yaxis.set_major_locator(MaxNLocator(6))
    if tested["load"].min() >= 0.0:
        axes.set_ylim(bottom=0.0)
    put_marks(axes, run, [(mark, force.scale * mark.load) for mark in marks])


def draw_band(axes, run):
    pull = run.pull()
    band = error_band(run, pull)
    if not band:
        return
    rows, force = few_points(*band), run.units.force.scale
    axes.fill_between(run.units.length.scale * pull["extension"][rows], force * band[0][rows], force * band[1][rows],
                      color=BLUE, alpha=0.22, lw=0, label="numerical error")


def draw_floor(axes, run, tested):
    """Below its floor the cell's error is as large as that of the floor."""
    floor, unit = run.load_cell_floor(), run.units.force
    if floor:
        low = -floor if tested["load"].min() < 0.0 else 0.0
        axes.axhspan(unit.scale * low, unit.scale * floor, facecolor="none", edgecolor=GREY, alpha=0.45, hatch="////",
                     lw=0.0, label=f"cell's floor, {with_unit(floor, unit)}")
        axes.axhline(unit.scale * floor, color=GREY, lw=0.8)


def draw_plateau(axes, run):
    plateau, lock = run.value("plateau_force"), run.value("lock_extension_by_load")
    if plateau is None:
        return
    force, length = run.units.force, run.units.length
    end = length.scale * (lock if lock is not None else run.pull()["extension"][-1])
    level = force.scale * plateau
    axes.plot([0.3 * end, 0.8 * end], [level, level], color=ORANGE, lw=1.6, zorder=4)
    axes.text(0.55 * end, 0.85, "plateau " + with_unit(plateau, force, run.value("plateau_force_error")), ha="center",
              fontsize=SMALL, color=ORANGE, transform=axes.get_xaxis_transform())


def draw_knot_distance(axes, run, marks):
    tested, length = run.tested(), run.units.length
    s, e = length.scale * tested["extension"], length.scale * tested["knot_distance"]
    rows = few_points(s, e)
    axes.plot(s[rows], e[rows], color=VIOLET, lw=1.4, label="e")
    known = np.flatnonzero(np.isfinite(e))
    lock = run.value("lock_extension")
    slid = run.result.get("motion_pattern") == "sliding" and run.value("jump_force") is None
    if lock is not None or slid:
        end = length.scale * lock if lock is not None else s[-1]
        rigid = 2 if run.method["machine"]["grips"] == "rollers" else 1
        axes.plot([s[known[0]], end], [e[known[0]], e[known[0]] - rigid * (end - s[known[0]])], color=GREY, lw=0.9,
                  ls=(0, (4, 3)), label=f"de/ds = –{rigid}: rigid sliding")
        axes.legend(loc="lower left", borderpad=0.2)
    axes.set_ylabel(f"knot distance e [{length.name}]")
    put_marks(axes, run, [(mark, float(np.interp(mark.time, tested["time"], e))) for mark in marks
                          if np.isfinite(mark.load)])


def put_marks(axes, run, places):
    for mark, y in places:
        if np.isfinite(y):
            at = (run.units.length.scale * mark.extension, y)
            axes.plot(*at, "o", ms=10.5, mfc="white", mec=INK, mew=0.9, clip_on=False, zorder=6)
            axes.annotate(mark.letter, at, ha="center", va="center_baseline", fontsize=SMALL, zorder=7,
                          annotation_clip=False)


def end_of_test(run):
    return run.units.length.scale * float(run.tested()["extension"].max())


def shade_motion(axes, run):
    """Up to the lock the knots slide, behind it the rod stretches; the break ends it. Dotted: the knots touch."""
    lock, broke, scale = run.value("lock_extension"), run.value("break_extension"), run.units.length.scale
    if lock is not None:
        axes.axvspan(0.0, scale * lock, color=PHASES["mount"], alpha=0.45, lw=0, zorder=0)
        axes.axvspan(scale * lock, end_of_test(run), color=PHASES["tie"], alpha=0.5, lw=0, zorder=0)
        axes.axvline(scale * lock, color=INK, lw=0.9, ls=(0, (4, 3)))
        error = run.value("lock_extension_error")
        if error:
            axes.axvspan(scale * (lock - error), scale * (lock + error), color=GREY, alpha=0.2, lw=0, zorder=0)
    touch = run.value("first_contact_extension")
    if touch is not None:
        axes.axvline(scale * touch, color=VIOLET, lw=0.9, ls=(0, (1, 2)))
    jumped = run.value("jump_extension")
    if jumped is not None:
        axes.axvline(scale * jumped, color=RED, lw=0.9, ls=(0, (4, 3)))
    if broke is not None:
        axes.axvline(scale * broke, color=RED, lw=1.1)


def name_motion(axes, run, look):
    """What happened where; what a narrow figure has no room for the caption says."""
    lock, broke, length = run.value("lock_extension"), run.value("break_extension"), run.units.length
    end, pattern = end_of_test(run), run.result.get("motion_pattern")
    above = axes.get_xaxis_transform()
    if run.value("first_contact_extension") is not None:
        axes.annotate("knots touch", (length.scale * run.value("first_contact_extension"), 0.5), xycoords=above,
                      xytext=(-3, 0), textcoords="offset points", color=VIOLET, ha="right", va="center", rotation=90,
                      fontsize=SMALL)
    if run.value("jump_force") is not None:
        place = length.scale * run.value("jump_extension")
        axes.text(place, 1.015, "a knot jumped open at " + with_unit(run.value("jump_force"), run.units.force), color=RED,
                  ha="left" if place < 0.5 * end else "right", fontsize=SMALL, transform=above)
    if lock is not None:
        at, words = length.scale * lock, "lock " + with_unit(lock, length, run.value("lock_extension_error"))
        axes.text(0.5 * at, 0.955, "the knots slide", ha="center", color=GREEN, fontsize=USUAL, transform=above)
        axes.text(at, 1.015, words, ha="center", color=INK, fontsize=SMALL, transform=above)
        if end - at > (0.45 if look.is_narrow else 0.2) * end:
            axes.text(0.5 * (at + end), 0.955, "the rod stretches", ha="center", color=GOLD, fontsize=USUAL,
                      transform=above)
    elif pattern not in (None, "none"):
        axes.text(0.5 * end, 0.955, f"motion pattern: {pattern}", ha="center", color=GREEN, fontsize=USUAL,
                  transform=above)
    if broke is not None:
        # One line higher where it would stand on the name of the lock.
        near = lock is not None and broke - lock < (0.6 if look.is_narrow else 0.3) * broke
        raised = (near and look.is_narrow) or run.value("jump_force") is not None
        axes.text(length.scale * broke, 1.07 if raised else 1.015,
                  f"break {shown(broke, length.scale)} {length.name}", ha="right", color=RED, fontsize=SMALL,
                  transform=above)
