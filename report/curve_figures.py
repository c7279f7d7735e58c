"""Curves of one test: its course over time, and load and knot distance over extension."""
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import MaxNLocator

from error_band import error_band
from few_points import few_points
from style import BLUE, GREEN, GREY, INK, ORANGE, PHASES, VIOLET, WIDTH, as_svg

SMALL = 8.0       # a peak above this many plateaus hides the plateau: it gets axes of its own
FEW = 250         # readings of the cell that are drawn as points


def phases_of(curve):
    """[(phase, first row, last row)] in order."""
    changes = np.flatnonzero(curve.phase[1:] != curve.phase[:-1]) + 1
    edges = [0, *changes.tolist(), len(curve)]
    return [(str(curve.phase[a]), a, min(b, len(curve) - 1)) for a, b in zip(edges[:-1], edges[1:])]


def named_spans(curve):
    """[(names, begin, end)] [s]: phases in a row that are too short for a name each share one place."""
    time, spans = curve["time"], []
    enough = 0.07 * (time[-1] - time[0])
    for name, a, b in phases_of(curve):
        short = time[b] - time[a] < enough
        if name in ("idle", "done"):
            continue
        if short and spans and spans[-1][3]:
            names, begin = spans[-1][0], spans[-1][1]
            names = names if names.endswith(name) or names.endswith("…") else names + ", " + name
            spans[-1] = (names if len(names) < 40 else names + " …", begin, time[b], True)
        else:
            spans.append((name, time[a], time[b], short))
    return [span[:3] for span in spans]


def course(run):
    """Load and extension over time, with every phase of the program."""
    curve = run.curve
    figure, axes = plt.subplots(figsize=(WIDTH, 2.1))
    time = curve["time"]
    for name, a, b in phases_of(curve):
        axes.axvspan(time[a], time[b], color=PHASES.get(name, "#eeeeee"), lw=0, zorder=0)
    for names, begin, end in named_spans(curve):
        axes.text(0.5 * (begin + end), 1.04, names, ha="center", fontsize=8.5, color=GREY,
                  transform=axes.get_xaxis_transform())
    tested = ~np.isin(curve.phase, ("tie", "release"))
    rows = few_points(curve["load"], curve["extension"])
    axes.plot(time[rows], np.where(tested, curve["load"], np.nan)[rows], color=BLUE, lw=1.3)
    axes.set_xlabel("time [s]")
    axes.set_ylabel("load F [N]", color=BLUE)
    axes.grid(False)
    if time[-1] > time[0]:
        axes.set_xlim(time[0], time[-1])
    second = axes.twinx()
    second.plot(time[rows], 1e3 * np.where(tested, curve["extension"], np.nan)[rows], color=ORANGE, lw=1.1)
    second.set_ylabel("extension s [mm]", color=ORANGE)
    second.spines["right"].set_visible(True)
    second.grid(False)
    figure.subplots_adjust(left=0.085, right=0.925, bottom=0.22, top=0.87)
    return as_svg(figure)


def force_extension(run, marks):
    """Load over extension; again where the load is small beside its peak; knot distance where there are two knots."""
    tested = run.curve.tested()
    closer = near_the_plateau(run)
    knots = tested.has_knot_distance()
    heights = [3.6] + ([2.3] if closer else []) + ([1.8] if knots else [])
    figure, all_axes = plt.subplots(len(heights), 1, figsize=(WIDTH, sum(heights) + 0.9), sharex=True, squeeze=False,
                                    gridspec_kw={"height_ratios": heights, "hspace": 0.12})
    all_axes = list(all_axes[:, 0])
    draw_load(all_axes[0], run, marks)
    all_axes[0].legend(loc="upper left", bbox_to_anchor=(0.01, 0.93))
    if closer:
        draw_load(all_axes[1], run, [])
        all_axes[1].set_ylim(*closer)
        all_axes[1].set_ylabel("load F [N], small loads")
        draw_plateau(all_axes[1], run)
    else:
        draw_plateau(all_axes[0], run)
    if knots:
        draw_knot_distance(all_axes[-1], run, marks)
    for axes in all_axes:
        shade_motion(axes, run, names=axes is all_axes[0])
    all_axes[-1].set_xlim(*extension_limits(run))
    all_axes[-1].set_xlabel("extension s [mm]")
    figure.align_ylabels(all_axes)
    tall = sum(heights) + 0.9
    figure.subplots_adjust(left=0.085, right=0.985, bottom=0.55 / tall, top=1.0 - 0.25 / tall)
    return as_svg(figure)


def extension_limits(run):
    """[mm] All that is drawn. On a compliant frame that is the crosshead's extension too, and behind a break, where the
    specimen has no extension of its own, that alone."""
    tested = run.curve.tested()
    drawn = [tested["extension"]]
    if tested.has_compliant_frame():
        pull = run.pull()
        drawn = [pull["extension"] if len(pull) else tested["extension"], tested["crosshead_extension"]]
    s = 1e3 * np.concatenate(drawn)
    return min(0.0, 1e3 * tested["extension"].min()), s.max() + 0.015 * (np.ptp(s) or 1.0)


def near_the_plateau(run):
    """Loads to show once more: those of sliding, where they are small beside the peak; else None."""
    plateau, peak = run.value("plateau_force"), run.value("peak_force")
    if plateau is None or peak is None or peak < SMALL * plateau:
        return None
    top = max(2.5 * plateau, 1.3 * (run.value("breakaway_force") or 0.0)) - run.offset()
    lowest = min(0.0, float(run.curve.tested()["load"].min()))
    return max(lowest, -0.5 * top) - 0.05 * top, top


def draw_load(axes, run, marks):
    tested, pull = run.curve.tested(), run.pull()
    draw_floor(axes, run, tested)
    band = error_band(run, pull)
    if band:
        rows = few_points(*band)
        axes.fill_between(1e3 * pull["extension"][rows], band[0][rows], band[1][rows], color=BLUE, alpha=0.22, lw=0,
                          label="error of the pull")
    for number, (name, a, b) in enumerate(phases_of(tested) if len(tested) else []):
        colour = {"hold": VIOLET, "return": GREEN}.get(name, BLUE)
        first = name not in [other for other, _, _ in phases_of(tested)[:number]]
        rows = a + few_points(tested["extension"][a:b + 1], tested["load"][a:b + 1])
        axes.plot(1e3 * tested["extension"][rows], tested["load"][rows], color=colour, lw=1.4,
                  label=name if first else None)
    cell = run.readings.tested()
    if len(cell) <= FEW:
        axes.plot(1e3 * cell["extension"], cell["load"], "o", ms=2.6, mfc="white", mec=BLUE, mew=0.7,
                  label="as the cell reads it")
    if tested.has_compliant_frame():
        rows = few_points(tested["crosshead_extension"], tested["load"])
        axes.plot(1e3 * tested["crosshead_extension"][rows], tested["load"][rows], color=GREY, lw=0.9, ls=(0, (5, 2)),
                  label="over the crosshead's extension")
    axes.set_ylabel("load F [N]")
    axes.yaxis.set_major_locator(MaxNLocator(6))
    if tested["load"].min() >= 0.0:
        axes.set_ylim(bottom=0.0)
    put_marks(axes, [(mark, mark.load) for mark in marks])


def draw_floor(axes, run, tested):
    """Below its floor the cell's error is as large as that of the floor."""
    floor = run.load_cell_floor()
    if floor:
        low = -floor if tested["load"].min() < 0.0 else 0.0
        axes.axhspan(low, floor, facecolor="none", edgecolor=GREY, alpha=0.45, hatch="////", lw=0.0,
                     label=f"below the load cell's floor, {floor:.4g} N")
        axes.axhline(floor, color=GREY, lw=0.8)


def draw_plateau(axes, run):
    plateau, lock = run.value("plateau_force"), run.value("lock_extension")
    if plateau is None:
        return
    pull = run.pull()
    end = lock if lock is not None else pull["extension"][-1]
    level = plateau - run.offset()
    axes.plot([0.3e3 * end, 0.8e3 * end], [level, level], color=ORANGE, lw=1.6, zorder=4)
    sd = run.value("plateau_force_sd")
    words = f"plateau {plateau:.4g} N" + (f", sd {sd:.2g} N" if sd is not None else "")
    if run.offset():
        words += f" (true force: load + {run.offset():.3g} N)"
    axes.text(0.55e3 * end, 0.85, words, ha="center", fontsize=8.5, color=ORANGE,
              transform=axes.get_xaxis_transform())


def draw_knot_distance(axes, run, marks):
    tested = run.curve.tested()
    s, e = 1e3 * tested["extension"], 1e3 * tested["knot_distance"]
    rows = few_points(s, e)
    axes.plot(s[rows], e[rows], color=VIOLET, lw=1.4, label="e")
    known = np.flatnonzero(np.isfinite(e))
    lock = run.value("lock_extension")
    if lock is not None or run.result.get("motion_pattern") == "sliding":
        end = 1e3 * lock if lock is not None else s[-1]
        axes.plot([s[known[0]], end], [e[known[0]], e[known[0]] - 2.0 * (end - s[known[0]])], color=GREY, lw=0.9,
                  ls=(0, (4, 3)), label="de/ds = –2: rigid sliding")
        axes.legend(loc="upper right")
    axes.set_ylabel("knot distance e [mm]")
    put_marks(axes, [(mark, float(np.interp(mark.time, tested["time"], e))) for mark in marks])


def put_marks(axes, places):
    for mark, y in places:
        if np.isfinite(y):
            at = (1e3 * mark.extension, y)
            axes.plot(*at, "o", ms=10.5, mfc="white", mec=INK, mew=0.9, clip_on=False, zorder=6)
            axes.annotate(mark.letter, at, ha="center", va="center_baseline", fontsize=8.5, zorder=7,
                          annotation_clip=False)


def shade_motion(axes, run, names):
    """Up to the lock the knots slide, behind it the rod stretches; the break ends it."""
    lock, broke = run.value("lock_extension"), run.value("break_extension")
    end = 1e3 * float(run.curve.tested()["extension"].max())
    if lock is not None:
        axes.axvspan(0.0, 1e3 * lock, color=PHASES["mount"], alpha=0.45, lw=0, zorder=0)
        axes.axvspan(1e3 * lock, end, color=PHASES["tie"], alpha=0.5, lw=0, zorder=0)
        axes.axvline(1e3 * lock, color=INK, lw=0.9, ls=(0, (4, 3)))
        error = run.value("lock_extension_error")
        if error:
            axes.axvspan(1e3 * (lock - error), 1e3 * (lock + error), color=GREY, alpha=0.2, lw=0, zorder=0)
    if broke is not None:
        axes.axvline(1e3 * broke, color="#a02020", lw=1.1)
    if not names:
        return
    above = axes.get_xaxis_transform()
    pattern = run.result.get("motion_pattern")
    if lock is not None:
        axes.text(0.5e3 * lock, 0.955, "the knots slide", ha="center", color=GREEN, transform=above)
        axes.text(1e3 * lock, 1.015, f"lock {1e3 * lock:.4g} mm", ha="center", color=INK, fontsize=8.5, transform=above)
        if end - 1e3 * lock > 0.15 * end:
            axes.text(0.5 * (1e3 * lock + end), 0.955, "the rod stretches", ha="center", color="#8a6d1d",
                      transform=above)
    elif pattern not in (None, "none"):
        axes.text(0.5 * end, 0.955, f"motion pattern: {pattern}", ha="center", color=GREEN, transform=above)
    if broke is not None:
        axes.text(1e3 * broke, 1.015, f"break {1e3 * broke:.4g} mm", ha="right", color="#a02020", fontsize=8.5,
                  transform=above)
