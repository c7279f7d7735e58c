"""What goes into the page of a batch, and its figure: the curves of every specimen that counts, and their mean with its band."""
import re
from collections import Counter

import numpy as np

from knot_utm.report.batch import Batch
from knot_utm.report.batch_tables import (all_readings, checks_of_all, drawn_tables, half_of, main_keys, named,
                                          readings_tables, scatter, verdict_of_all)
from knot_utm.report.curve_figures import small_loads
from knot_utm.report.curves import few_points, mean_curve
from knot_utm.report.method_facts import counted, knot_of, method_facts, particulars, program
from knot_utm.report.page import files_of, head_of, Headline, logo_of, render
from knot_utm.report.quantities import error_shown, percent, quantity_of, shown
from knot_utm.report.results_table import short_label
from knot_utm.report.run import printable
from knot_utm.report.style import as_svg, BLUE, GREY, INK, LOOKS, ORANGE, stacked

IN_ALL = 60000  # points of all curves together: more of them make a page that is slow to open
FEWEST = 60     # points of one curve


def report_on_batch(folder, command, version):
    batch = Batch(folder)
    mean = mean_curve([one.pull for one in batch.tested])
    checks = [(one.number, one.checks) for one in batch.tested]
    asked = [(one.number, one.asked) for one in batch.tested if one.asked]
    readings, missing = all_readings(batch)
    length = batch.units.length
    return render("batch.html.j2", {
        "title": f"{knot_of(batch.method)}, {batch.method['material'].get('name', 'own material')}",
        "head": [*head_of(batch.report), *tested_as(batch)], "report": batch.report, "logo": logo_of(batch),
        "headlines": headlines(batch),
        "count": len(batch.specimens), "counted": len(batch.counted), "rejected": list(batch.reasons.items()),
        "patterns": counts(batch, "motion_pattern"), "endings": counts(batch, "ended_by"),
        "given": next((one.given for one in batch.tested if one.given), None),
        "not_predicted": [key for one in batch.tested for key in one.not_predicted],
        "tested_by": batch.tested[0].version if batch.tested else None, "warnings": warnings(batch),
        "curve": [curves(batch, mean, look) for look in LOOKS] if any(len(one.pull[0]) for one in batch.tested) else None,
        "common": mean and [shown(s, length.scale) for s in (mean.extension[0], mean.extension[-1])], "length": length.name,
        "largest": batch.largest(), "tables": readings_tables(batch), "readings": readings, "unmeasured": missing,
        "verdict": verdict_of_all(checks, "%s keep all limits."), "checks": checks_of_all(checks),
        "asked_verdict": verdict_of_all(asked, "%s meet the specification.") if asked else None,
        "asked": checks_of_all(asked), "drawn": drawn_tables(batch) if batch.specimens else [],
        "facts": [*method_facts(batch.method, batch.units), ("Specimens", drawing_facts(batch), "")],
        "program": program(batch.method, batch.units), "si": batch.units.are_default,
        "files": with_specimens(files_of(folder), batch), "command": printable(command), "version": version,
        "folder": printable(folder)})


def tested_as(batch):
    return particulars(batch.report, batch.method, batch.mean("gauge_length"), batch.units,
                       counted(len(batch.specimens), len(batch.reasons)))


def headlines(batch):
    means, largest, found = batch.means(), batch.largest(), []
    for key in main_keys(batch):
        statistics, unit = batch.statistics(key), batch.units.of(quantity_of(key).kind)
        half, variation = half_of(statistics), percent(statistics["cv"])
        n = f"n = {statistics['n']}"
        remark = f"CV {variation}, {n}" if variation else f"constant, {n}" if statistics["n"] > 1 and not half else n
        found.append(Headline(short_label(means, key, largest), shown(statistics["mean"], unit.scale, half),
                              error_shown(half, unit.scale), unit.name, remark))
    return found


def counts(batch, name):
    """[(word, how many specimens that count)], the most frequent first."""
    found = Counter(getattr(one, name) for one in batch.counted)
    return sorted(found.items(), key=lambda item: (-item[1], item[0]))


def warnings(batch):
    """Each warning once, with the specimens that gave it. Those that differ in their numbers only are one."""
    found = {}
    for one in batch.tested:
        for line in one.warnings:
            found.setdefault(re.sub(r"[-–]?\d[\d.]*(?:e[-+]?\d+)?", "#", line), []).append((one.number, line))
    lines = []
    for said in found.values():
        first, line = said[0]
        differ = f" (the numbers are those of specimen {first})" if any(other != line for _, other in said) else ""
        lines.append((named({number for number, _ in said}), line + differ))
    return lines


def drawing_facts(batch):
    specimens = batch.method.get("specimens") or {}
    return [("Count", str(len(batch.specimens))), ("Seed of the drawing", str(specimens.get("seed", ""))), *scatter(batch)]


def with_specimens(files, batch):
    """Before the page itself."""
    first, last = batch.specimens[0].number, batch.specimens[-1].number
    folders = f"specimen_{first:03d}/ to specimen_{last:03d}/" if last > first else f"specimen_{first:03d}/"
    return [*files[:-2], (folders, "of each specimen all that a single test writes"), *files[-2:]]


# ---- the figure ----

def curves(batch, mean, look):
    """`mean`: a MeanCurve, or None. The loads once more where they are small beside the peak."""
    pulls = [one.pull for one in batch.tested if len(one.pull[0])]
    force, length = batch.units.force, batch.units.length
    closer = small_loads(batch.common_mean, np.concatenate([load for _, load in pulls]), force.scale)
    figure, all_axes, tall = stacked(look, [2.7] + ([1.8] if closer else []))
    for axes in all_axes:
        draw(axes, pulls, mean, force.scale, length.scale)
    all_axes[0].set_ylim(*load_limits(pulls, force.scale))
    all_axes[0].set_ylabel(f"load F [{force.name}]")
    place_legend(all_axes[0], look)
    if closer:
        all_axes[1].set_ylim(*closer)
        all_axes[1].set_ylabel(f"small loads [{force.name}]")
    every = length.scale * np.concatenate([s for s, _ in pulls])
    all_axes[-1].set_xlim(min(0.0, every.min()), every.max() + 0.015 * (np.ptp(every) or length.scale))
    all_axes[-1].set_xlabel(f"extension s [{length.name}]")
    figure.align_ylabels(all_axes)
    figure.subplots_adjust(**look.room(tall, 0.5, 0.5 if look.is_narrow else 0.3))
    return as_svg(figure)


def place_legend(axes, look):
    """Above the axes, as curves and bands may be anywhere in them."""
    if look.is_narrow:
        legend = axes.legend(loc="lower left", bbox_to_anchor=(-0.22, 1.0), ncol=2, columnspacing=0.8, handlelength=1.2,
                             borderpad=0.2)
    else:
        legend = axes.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncol=4, borderpad=0.2)
    for line in legend.get_lines():
        line.set_alpha(1.0)


def draw(axes, pulls, mean, force, length):
    most = max(FEWEST, IN_ALL // len(pulls))
    faint = min(0.6, max(0.1, 6.0 / len(pulls)))  # so that many do not hide the band
    label = "the specimen" if len(pulls) == 1 else f"{len(pulls)} specimens"
    for s, load in pulls:
        rows = few_points(load, most=most)
        axes.plot(length * s[rows], force * load[rows], color=BLUE, lw=0.8, alpha=faint, label=label)
        label = None
    if mean is None:
        return
    s, middle = length * mean.extension, force * mean.mean
    low, high = mean.about(mean.sd)
    axes.fill_between(s, force * low, force * high, color=ORANGE, alpha=0.28, lw=0, zorder=3,
                      label="mean ± standard deviation")
    axes.plot(s, middle, color=ORANGE, lw=1.5, zorder=5, label="mean")
    for end, name in zip(mean.about(mean.half), ("95 % interval of the mean", None)):
        axes.plot(s, force * end, color=INK, lw=0.7, ls=(0, (3, 2)), zorder=4, label=name)
    for end in (s[0], s[-1]):
        axes.axvline(end, color=GREY, lw=0.6, ls=":")


def load_limits(pulls, force):
    low = force * min(0.0, *(load.min() for _, load in pulls))
    high = force * max(load.max() for _, load in pulls)
    room = 0.05 * ((high - low) or 1.0)
    return low - room if low < 0.0 else 0.0, high + room
