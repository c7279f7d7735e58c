"""What goes into the page of a batch."""
import re
from collections import Counter

from knot_utm.report.batch import Batch
from knot_utm.report.batch_figures import curves
from knot_utm.report.batch_tables import (all_readings, checks_of_all, drawn_tables, half_of, main_keys, named, readings_tables, scatter,
                          verdict_of_all)
from knot_utm.report.laboratory import counted, particulars
from knot_utm.report.mean_curve import mean_curve
from knot_utm.report.method_facts import knot_of, method_facts, program
from knot_utm.report.page import Headline, files_of, head_of, logo_of, render
from knot_utm.report.quantities import error_shown, percent, quantity_of, shown
from knot_utm.report.results_table import short_label
from knot_utm.report.run import printable
from knot_utm.report.style import LOOKS


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
