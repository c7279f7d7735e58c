"""The page of a batch: the curves of every specimen that counts and their mean with its band, a row for each specimen, and the
statistics of all readings, as the software of a testing machine prints them."""
import itertools
import os
import re
from collections import Counter

import numpy as np
from markupsafe import Markup

from knot_utm.errors import refuse_if
from knot_utm.report.certificate import certificate, Check, specification_checks
from knot_utm.report.curves import load_axes, mean_curve, reach, small_loads
from knot_utm.report.marks import largest_load
from knot_utm.report.method_facts import knot_and_materials, label_of, method_facts, particulars, place_of, program, sentence, unit_of
from knot_utm.report.page import Box, certificate_section, facts, figure, files_of, head_of, Headline, no_value, render, Row, Table, verdict_box
from knot_utm.report.quantities import (all_in_units, error_shown, GROUPS, in_units, is_number, is_rounding, percent, quantity_of, shown,
                                        units_of)
from knot_utm.report.run import read_table, read_yaml, Run, texts_of
from knot_utm.report.run_page import given_box, NOTHING, short_label
from knot_utm.report.style import BLUE, GREY, INK, ORANGE

WIDEST = 6  # readings beside each other
# What is looked for first, in this order, where the specimens have it.
MAIN = ("knotability", "plateau_force", "jump_force", "force_ratio", "lock_extension", "locked_stiffness", "peak_force",
        "break_extension", "knot_efficiency", "elongation_total", "elongation_at_break", "energy_to_break")
HEADLINES = 5
FINEST = 1e-5  # of a mean: no spread is so small that more digits are shown

# What stands in a row of specimens.csv before the readings, and behind what was drawn.
OUTCOME = ("rejected", "ended_by", "motion_pattern")


class Batch:
    """`numbers` of the specimens, which are `rejected`, and their `table`: columns of specimens.csv, of which some are `sampled`."""

    def __init__(self, folder):
        self.folder = folder
        method, specimens = (os.path.join(folder, name) for name in ("method.yaml", "specimens.csv"))
        self.method, self.report = read_yaml(method), texts_of(method, "report")
        self.units = units_of(self.report)
        self.table = read_table(specimens, ("specimen",), OUTCOME)
        self.numbers, self.rejected = self.table["specimen"].astype(int).tolist(), self.table["rejected"] == "true"
        refuse_if(not self.numbers, f"{specimens}: no specimens")
        self.sampled = list(self.table)[1:list(self.table).index(OUTCOME[0])]
        self.facts = read_yaml(os.path.join(folder, "statistics.yaml"), "specimens", "rejected", "motion_pattern")
        self.reasons = {one["specimen"]: in_units(one["reason"], self.units) for one in self.facts["rejected"]}
        self.runs = {number: Run(os.path.join(folder, f"specimen_{number:03d}"))
                     for number, rejected in zip(self.numbers, self.rejected) if not rejected}
        self.pulls = [(pull["extension"], pull["load"]) for pull in (run.curve.pull() for run in self.runs.values())]
        # Of a specimen whose load rose to the end, where there is one: then the largest loads are no peaks.
        self.largest = min(filter(None, map(largest_load, self.runs.values())), key=lambda largest: largest.is_peak, default=None)
        self.means = {key: (self.statistics(key) or {}).get("mean") for key in self.facts}  # as a single test could have them

    def checks(self, of):
        """[(number, [Check])] of the specimens that have some. `of`: the checks of a run."""
        return [(number, checks) for number, run in self.runs.items() if (checks := of(run))]

    def statistics(self, key):
        """mean, sd, cv, low, high, minimum, maximum and n, of which some are None; None: no specimen has the reading."""
        found = self.facts.get(key)
        return found if isinstance(found, dict) and found.get("n") else None

    def main_keys(self):
        return [key for key in MAIN if self.statistics(key)][:HEADLINES]


def report_on_batch(folder, command, version):
    batch = Batch(folder)
    length, units, rejected = batch.units.length, batch.units, batch.reasons
    mean = mean_curve(batch.pulls)
    checks = batch.checks(lambda run: certificate(run.result, run.has_knot(), run.is_soft()))
    asked = batch.checks(lambda run: specification_checks(run.method, run.result, run.units))
    asked_box = asked and verdict_box(*verdict_of_all(asked, "%s meet the specification."))
    curve = []
    if any(len(s) for s, _ in batch.pulls):
        common = mean and [shown(s, length.scale) for s in (mean.extension[0], mean.extension[-1])]
        curve = [figure(curves(batch, mean), "Load over extension of all specimens, with their mean and its band",
                        "Each thin line is the pull of a specimen, up to its break: the balanced load, without noise and resolution of the "
                        "load cell. " + (
                            "The mean is that of the loads at the same extension. It is drawn over the extensions that all specimens have, "
                            f"{common[0]} to {common[1]} {length.name}, which the dotted lines bound. The band is as wide as single "
                            "specimens scatter, the dashed lines bound the mean of all such specimens with 95 % confidence, neither beyond "
                            "what a specimen shows." if common else "Of one specimen there is no band." if len(batch.runs) == 1 else
                            "No extension is common to all specimens, so that no mean is drawn."))]
    elif batch.runs:
        curve = ["The tests ended before the specimens were pulled, so that there are no curves."]
    tables, unmeasured = all_readings(batch)
    certificates = certificate_section(
        "Kept by", asked_box, checks_of_all(asked), verdict_box(*verdict_of_all(checks, "%s keep all limits.")), checks_of_all(checks),
        "The limits are those of the certificate of a single test. Each row says how many of the specimens that have its value keep it.")
    specimens, files = batch.method.get("specimens") or {}, files_of(folder)
    folders = " to ".join(f"specimen_{number:03d}/" for number in dict.fromkeys([batch.numbers[0], batch.numbers[-1]]))
    return render(
        folder, command, version, "Batch of specimens, simulated", knot_and_materials(batch.method, batch.folder), [
            ("Rejected specimens", rejected and [
                facts([(f"Specimen {number}", reason) for number, reason in rejected.items()]),
                "A specimen is rejected where the physics gave up, where its knot came undone before it was pulled, or where an operator "
                "stopped its test. Its readings are left out of all statistics, and its curve is not drawn."]),
            ("Force and extension", curve),
            ("Specimens", [*specimens_tables(batch), "Forces are the balanced load." + (
                " The load of a specimen was still rising when its test was stopped, so that its largest load is no peak."
                if batch.largest and not batch.largest.is_peak else "") + ("" if units.are_default else " All files are in SI units."),
                "" if batch.sampled else "Nothing was drawn: the specimens differ in the noise of the load cell only."]),
            ("All readings", tables and [
                *tables, "± 95 % is half of the interval that holds the mean of all such specimens with 95 % confidence, and n the number of "
                "specimens that have the reading. SD is the standard deviation of single specimens, over n – 1, and CV its share of the mean; "
                "what is the same for all of them, but for rounding, is constant. Scatter says nothing about the numerical error that all "
                "specimens share: it stands in the report of each one.", no_value("No specimen has a", unmeasured)]),
            *([certificates] if batch.runs else []),
            ("What was tested, and how", [[*method_facts(batch.method, units, batch.folder), ("Specimens", [
                ("Count", str(len(batch.numbers))), ("Seed of the drawing", str(specimens.get("seed", ""))), *scatter(batch)], "")],
                facts(program(batch.method, units))])],
        under_title(batch), [*head_of(batch.report), *particulars(
            batch.report, batch.method, batch.means.get("gauge_length"), units,
            f"{len(batch.numbers)} tested, {len(batch.runs)} count, {len(rejected)} discarded")],
        batch.report.get("notes", ""), headlines(batch), [
            next(filter(None, map(given_box, batch.runs.values())), None), asked_box,
            Box("fail", ["No specimen counts: " + (f"all {len(rejected)} are" if len(rejected) > 1 else "the only one is") +
                         " rejected, so that there are no readings."]) if not batch.runs else
            Box("warnings", [Markup("<b>Warnings</b>"), *lines]) if (lines := warnings(batch)) else
            Box("quiet", ["No specimen that counts gave a warning."])],
        [*files[:-2], (folders, "of each specimen all that a single test writes"), *files[-2:]])


def under_title(batch):
    def counts(name):
        found = Counter(batch.table[name][~batch.rejected].tolist())
        return ", ".join(f"{word} {number}" for word, number in sorted(found.items(), key=lambda item: (-item[1], item[0])))

    count, rejected = len(batch.numbers), len(batch.reasons)
    said = [f"knot_utm {next(iter(batch.runs.values())).result.get('version')}"] if batch.runs else []
    said.append(f"{count} specimen{'s' if count > 1 else ''}" + (
        f", of which {count - rejected} count and {rejected} {'are' if rejected > 1 else 'is'} rejected" if rejected else ""))
    if batch.runs:
        said += [f"motion pattern {counts('motion_pattern')}", f"ended by {counts('ended_by')}"]
    return " · ".join(said)


def named(numbers):
    """As in a sentence: "specimens 1 to 4 and 7"."""
    runs = [[one for _, one in run] for _, run in itertools.groupby(enumerate(sorted(numbers)), lambda pair: pair[1] - pair[0])]
    words = [f"{run[0]} to {run[-1]}" if len(run) > 1 else str(run[0]) for run in runs]
    return ("specimens " if len(numbers) > 1 else "specimen ") + " and ".join(filter(None, [", ".join(words[:-1]), words[-1]]))


# ---- tables ----


def digits_of(mean, spread, unit):
    """The text of a value, with as many digits as leave two of the spread."""
    error = max(spread, FINEST * abs(mean)) if spread else None
    return lambda value: shown(value, unit.scale, error) if is_number(value) else "none"


def specimens_tables(batch):
    """What was drawn for each specimen, and its main readings and those that the specification asks for, in as many tables as are
    needed."""
    columns = []  # (label, unit, texts)
    for key in batch.sampled:
        values, unit = batch.table[key].tolist(), unit_of(key, batch.units)
        text = digits_of(max(values), float(np.std(values, ddof=1)) if len(values) > 1 else 0.0, unit)
        columns.append((sentence(name_of(key)), unit, [*map(text, values)]))
    asked = [key for key in batch.method.get("specification") or {} if batch.statistics(key)]
    for key in dict.fromkeys(batch.main_keys() + asked):
        found, unit = batch.statistics(key), batch.units.of(quantity_of(key).kind)
        text = digits_of(found["mean"], found["sd"], unit)
        columns.append((short_label(batch.means, key, batch.largest), unit,
                        [text(None if rejected else value) for value, rejected in zip(batch.table[key], batch.rejected)]))
    names = [f"{number}{', rejected' if rejected else ''}" for number, rejected in zip(batch.numbers, batch.rejected)]
    tables = max(1, -(-len(columns) // WIDEST))
    each = max(1, -(-len(columns) // tables))
    return [Table(("Specimen", *(f"{label} {f'[{unit.name}]' if unit.name else ''}" for label, unit, _ in some)),
                  [Row(name, (), texts) for name, *texts in zip(names, *(texts for _, _, texts in some))])
            for some in (columns[i:i + each] for i in range(0, len(columns), each))]


def name_of(key):
    """What a dotted key of the method is called: a speed is that of a step."""
    *where, _ = place_of(key).split(".")
    return f"{label_of(key)}, {where[-1]}" if where[0] == "program" else label_of(key)


def scatter(batch):
    """[(what, law and spread)]"""
    laws = (batch.method.get("specimens") or {}).get("scatter")
    return [(sentence(name_of(key)), f"{name.replace('_', '-')}, {percent(spread)}")
            for key, law in (laws.items() if isinstance(laws, dict) else ()) for name, spread in law.items()]


def all_readings(batch):
    """Tables of the statistics of every reading that a specimen has, and the keys that none has."""
    labels = {key: short_label(batch.means, key, batch.largest) for key in ("locked_stiffness", "peak_force")}
    titles = {"beside": "Numerical errors and true forces", "certificate": "Checks", "head": "Further"}
    tables, shown_keys = [], {"specimens", "rejected", "motion_pattern"}
    groups = {title: [key for key in group if key in batch.facts] for title, group in GROUPS.items()}
    groups["head"] = [key for key in batch.facts if key not in ("specimens", "rejected") and not any(key in group for group in groups.values())]
    for title, keys in groups.items():
        rows = [statistics_row(batch, key, labels.get(key) or quantity_of(key).label) for key in keys
                if batch.statistics(key) and NOTHING.get(key) != batch.means[key]]
        shown_keys.update(row.keys[0] for row in rows)
        if rows:
            tables.append(Table((titles.get(title, title), "Mean", "± 95 %", "SD", "CV", "Least", "Largest", "n", "Unit"), rows))
    return tables, [key for key in batch.facts if key not in shown_keys]


def statistics_row(batch, key, label):
    found, unit, mean_of = batch.statistics(key), batch.units.of(quantity_of(key).kind), batch.means.get
    text, n, sd = digits_of(found["mean"], found["sd"], unit), found["n"], found["sd"]
    ends = [text(found[end]) if is_number(found.get(end)) else "" for end in ("minimum", "maximum")]
    # Neither the mean nor the spread is more than rounding.
    if is_rounding(key, mean_of) and (sd is None or is_rounding(key, lambda one: sd if one == key else mean_of(one))):
        return Row(label, [key], ["0", "", "constant" if n > 1 else "", "", *ends, str(n), unit.name])
    spread = error_shown(sd, unit.scale) if sd is not None or n < 2 else "constant"
    return Row(label, [key], [text(found["mean"]), error_shown(half_of(found), unit.scale), spread, percent(found["cv"]), *ends, str(n), unit.name])


def half_of(statistics):
    """Half the width of the 95 % interval of the mean."""
    return statistics["high"] - statistics["mean"] if is_number(statistics["high"]) else None


def checks_of_all(checks):
    """Each check over all specimens that have its value. `checks`: [(number, [Check])]."""
    found = {}
    for number_of_specimen, some in checks:
        for check in some:
            found.setdefault((check.words, check.key), []).append((number_of_specimen, check))
    rows = []
    for (words, key), some in found.items():
        missed = [number_of_specimen for number_of_specimen, check in some if not check.kept]
        words += f"; not so {named(missed)}" if 0 < len(missed) < len(some) else ""
        rows.append(Check(words, key, f"{len(some) - len(missed)} of {len(some)} specimens", some[0][1].limit, not missed))
    return rows


def verdict_of_all(checks, sentence_of):
    """(words, whether all do). `sentence_of`: "%s keep all limits." """
    good = sum(all(check.kept for check in some) for _, some in checks)
    return sentence_of % f"{good} of {len(checks)} specimens", good == len(checks)


def headlines(batch):
    found = []
    for key in batch.main_keys():
        statistics, unit = batch.statistics(key), batch.units.of(quantity_of(key).kind)
        half, variation, n = half_of(statistics), percent(statistics["cv"]), f"n = {statistics['n']}"
        remark = f"CV {variation}, {n}" if variation else f"constant, {n}" if statistics["n"] > 1 and not half else n
        found.append(Headline("Mean of " + short_label(batch.means, key, batch.largest).lower(), shown(statistics["mean"], unit.scale, half),
                              error_shown(half, unit.scale), unit.name, remark))
    return found


def warnings(batch):
    """Each warning once, with the specimens that gave it. Those that differ in their numbers only are one."""
    found = {}
    for number, run in batch.runs.items():
        for line in all_in_units(run.result.get("warnings") or [], run.units):
            found.setdefault(re.sub(r"[-–]?\d[\d.]*(?:e[-+]?\d+)?", "#", line), []).append((number, line))
    lines = []
    for said in found.values():
        first, line = said[0]
        differ = f" (the numbers are those of specimen {first})" if any(other != line for _, other in said) else ""
        lines.append(f"{named({number for number, _ in said})}: {line}{differ}")
    return lines


def curves(batch, mean):
    """`mean`: a MeanCurve, or None. The loads once more where they are small beside the peak."""
    pulls = [pull for pull in batch.pulls if len(pull[0])]
    force, length, loads = batch.units.force.scale, batch.units.length.scale, np.concatenate([load for _, load in pulls])
    # Where not every specimen that counts has a reading it says nothing of all of them.
    means = {key: mean for key, mean in batch.means.items() if mean is not None and batch.statistics(key)["n"] == len(batch.runs)}
    drawn, axes = load_axes(batch.units, small_loads(means.get, loads))
    for one in axes:
        label = "the specimen" if len(pulls) == 1 else f"{len(pulls)} specimens"
        for s, load in pulls:  # so faint that many do not hide the band
            one.plot(length * s, force * load, color=BLUE, lw=0.8, alpha=min(0.6, max(0.1, 6.0 / len(pulls))), label=label)
            label = None
        if mean is not None:
            s = length * mean.extension
            one.fill_between(s, *(force * end for end in mean.scatter), color=ORANGE, alpha=0.28, lw=0, zorder=3, label="mean ± standard deviation")
            one.plot(s, force * mean.mean, color=ORANGE, lw=1.5, zorder=5, label="mean")
            for end, name in zip(mean.interval, ("95 % interval of the mean", None)):
                one.plot(s, force * end, color=INK, lw=0.7, ls=(0, (3, 2)), zorder=4, label=name)
            for end in (s[0], s[-1]):
                one.axvline(end, color=GREY, lw=0.6, ls=":")
    if loads.min() >= 0.0:
        axes[0].set_ylim(bottom=0.0)
    # Above the axes, as curves and bands may be anywhere in them.
    for line in axes[0].legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncol=4, borderpad=0.2).get_lines():
        line.set_alpha(1.0)
    reach(axes[-1], length * np.concatenate([s for s, _ in pulls]))
    return drawn
