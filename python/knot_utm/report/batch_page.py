"""The page of a batch: the curves of every specimen that counts and their mean with its band, and tables with a row for each specimen
and rows of statistics, as the software of a testing machine prints them."""
import re
from collections import Counter, namedtuple

import numpy as np

from knot_utm.report.batch import Batch
from knot_utm.report.certificate import Check
from knot_utm.report.curve_figures import small_loads
from knot_utm.report.curves import few_points, mean_curve
from knot_utm.report.method_facts import counted, knot_and_materials, label_of, method_facts, particulars, place_of, program, sentence, unit_of
from knot_utm.report.page import files_of, head_of, Headline, render
from knot_utm.report.quantities import (BESIDE, CERTIFICATE, error_shown, GROUPS, is_number, is_rounding, percent, quantity_of, shown,
                                        TABLES)
from knot_utm.report.results_table import labels_of, NOTHING, short_label
from knot_utm.report.run import printable
from knot_utm.report.style import as_svg, BLUE, GREY, INK, LOOKS, ORANGE, stacked

WIDEST = 5  # readings beside each other: as many as a telephone has room for
# What is looked for first, in this order, where the specimens have it.
MAIN = ("knotability", "plateau_force", "jump_force", "force_ratio", "lock_extension", "locked_stiffness", "peak_force",
        "break_extension", "knot_efficiency", "elongation_total", "elongation_at_break", "energy_to_break")
STATISTICS = (("Mean", "mean"), ("Standard deviation", "sd"), ("Coefficient of variation", "cv"), ("Minimum", "minimum"),
              ("Maximum", "maximum"), ("95 % interval of the mean, low end", "low"),
              ("95 % interval of the mean, high end", "high"), ("Readings", "n"))
FINEST = 1e-5  # of a mean: no spread is so small that more digits are shown
IN_ALL = 60000  # points of all curves together: more of them make a page that is slow to open
FEWEST = 60     # points of one curve


def main_keys(batch):
    return [key for key in MAIN if batch.statistics(key)][:WIDEST]


def named(numbers):
    """As in a sentence: "specimens 1 to 4 and 7"."""
    runs = []
    for one in sorted(numbers):
        if runs and one == runs[-1][1] + 1:
            runs[-1][1] = one
        else:
            runs.append([one, one])
    words = [str(part) for first, last in runs
             for part in ([first] if first == last else [first, last] if last == first + 1 else [f"{first} to {last}"])]
    return ("specimens " if len(numbers) > 1 else "specimen ") + " and ".join(filter(None, [", ".join(words[:-1]), words[-1]]))


class Column:
    """One reading of every specimen. Its values have as many digits as leave two of their spread."""

    def __init__(self, key, label, unit, mean, spread):
        self.key, self.label, self.unit = key, label, unit
        self.error = max(spread, FINEST * abs(mean)) if spread else None

    def text(self, value):
        return shown(value, self.unit.scale, self.error) if is_number(value) else "none"


# `rows`: of each specimen the number, and its values as texts; `statistics`: the same of rows of statistics.
Table = namedtuple("Table", "columns rows statistics")


def beside_each_other(columns):
    """In as many tables as they need, of about the same width."""
    tables = -(-len(columns) // WIDEST)
    each = -(-len(columns) // max(tables, 1))
    return [columns[i:i + each] for i in range(0, len(columns), each)] if columns else []


def readings_tables(batch):
    """Of the main readings, and of those that the specification asks for."""
    keys = main_keys(batch)
    keys += [key for key in batch.method.get("specification") or {} if key not in keys and batch.statistics(key)]
    means, largest = batch.means(), batch.largest()
    columns = [Column(key, short_label(means, key, largest), batch.units.of(quantity_of(key).kind), batch.mean(key),
                      batch.statistics(key)["sd"]) for key in keys]
    return [Table(some, [(one.number, [column.text(one.readings[column.key]) for column in some]) for one in batch.counted],
                  [(name, [statistic(batch, column, part) for column in some]) for name, part in STATISTICS])
            for some in beside_each_other(columns)]


def statistic(batch, column, part):
    found = batch.statistics(column.key)
    if part == "n":
        return str(found["n"])
    if part == "sd" and found["sd"] is None and found["n"] > 1:
        return "constant"
    if part == "cv":
        return percent(found["cv"])
    return column.text(found[part]) if is_number(found[part]) else ""


def drawn_tables(batch):
    """What was drawn for each specimen, also for those that are rejected."""
    columns = [Column(key, sentence(name_of(key)), unit_of(key, batch.units), max(one.drawn[key] for one in batch.specimens),
                      batch.spread(key)) for key in batch.specimens[0].drawn]
    return [Table(some, [(one.number, [column.text(one.drawn[column.key]) for column in some]) for one in batch.specimens], [])
            for some in beside_each_other(columns)]


def name_of(key):
    """Of a dotted key of the method: a speed is that of a step."""
    *where, _ = place_of(key).split(".")
    return f"{label_of(key)}, {where[-1]}" if where[0] == "program" else label_of(key)


def scatter(batch):
    """[(what, law and spread)]"""
    laws = (batch.method.get("specimens") or {}).get("scatter")
    return [(sentence(name_of(key)), f"{name.replace('_', '-')}, {percent(spread)}")
            for key, law in (laws.items() if isinstance(laws, dict) else ()) for name, spread in law.items()]


class Row:
    """Statistics of one reading, as texts."""

    def __init__(self, batch, key, label):
        found, quantity = batch.statistics(key), quantity_of(key)
        unit = batch.units.of(quantity.kind)
        column = Column(key, label or quantity.label, unit, found["mean"], found["sd"])
        half = half_of(found)
        self.key, self.label, self.unit, self.n = key, column.label, unit.name, found["n"]
        if is_nothing(batch, key):
            self.mean, self.cv, self.half, self.sd = "0", "", "", "constant" if self.n > 1 else ""
            return
        self.mean, self.cv = column.text(found["mean"]), percent(found["cv"])
        self.sd = error_shown(found["sd"], unit.scale) if found["sd"] is not None or self.n < 2 else "constant"
        self.half = error_shown(half, unit.scale)


def is_nothing(batch, key):
    """Whether neither the mean nor the spread of the readings is more than rounding."""
    def mean_of(one):
        return (batch.statistics(one) or {}).get("mean")

    spread = batch.statistics(key)["sd"]
    return is_rounding(key, mean_of) and (
        spread is None or is_rounding(key, lambda one: spread if one == key else mean_of(one)))


def half_of(statistics):
    """Half the width of the 95 % interval of the mean."""
    return statistics["high"] - statistics["mean"] if is_number(statistics["high"]) else None


def all_readings(batch):
    """[(title, rows)] of every reading that a specimen has, and the keys that none has."""
    largest = batch.largest()
    labels = labels_of(batch.means(), short_label({}, "peak_force", largest))
    titles = [*((title, title) for title in TABLES), (BESIDE, "Numerical errors and true forces"),
              (CERTIFICATE, "Checks")]
    keys = {title: [key for key in GROUPS[group] if key in batch.facts] for group, title in titles}
    known = {"specimens", "rejected", "motion_pattern", *(key for some in keys.values() for key in some)}
    keys["Further"] = [key for key in batch.facts if key not in known]
    groups = [(title, [Row(batch, key, labels.get(key)) for key in some if has_values(batch, key)])
              for title, some in keys.items()]
    missing = [key for some in keys.values() for key in some if key != "motion_pattern" and not has_values(batch, key)]
    return [group for group in groups if group[1]], missing


def has_values(batch, key):
    mean = batch.mean(key)
    return mean is not None and NOTHING.get(key) != mean


def checks_of_all(checks):
    """Each check that has a limit, over all specimens that have its value. `checks`: [(number, [Check])]."""
    found = {}
    for number_of_specimen, some in checks:
        for check in some:
            if check.verdict:
                found.setdefault(check.words, []).append((number_of_specimen, check))
    return [over_all(words, some) for words, some in found.items()]


def over_all(words, found):
    first, missed = found[0][1], [one for one, check in found if check.verdict == "fail"]
    if 0 < len(missed) < len(found):
        words += f"; not so {named(missed)}"
    return Check(words, first.keys, f"{len(found) - len(missed)} of {len(found)} specimens", first.limit, not missed)


def verdict_of_all(checks, sentence_of):
    """(words, whether all do). `sentence_of`: "%s keep all limits." """
    good = [one for one, some in checks if not any(check.verdict == "fail" for check in some)]
    return sentence_of % f"{len(good)} of {len(checks)} specimens", len(good) == len(checks)


# ---- the page ----


def report_on_batch(folder, command, version):
    batch = Batch(folder)
    mean = mean_curve([one.pull for one in batch.tested])
    checks = [(one.number, one.checks) for one in batch.tested]
    asked = [(one.number, one.asked) for one in batch.tested if one.asked]
    readings, missing = all_readings(batch)
    length = batch.units.length
    return render("batch.html.j2", {
        "title": knot_and_materials(batch.method, batch.folder),
        "head": [*head_of(batch.report), *tested_as(batch)], "report": batch.report,
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
        "facts": [*method_facts(batch.method, batch.units, batch.folder), ("Specimens", drawing_facts(batch), "")],
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
