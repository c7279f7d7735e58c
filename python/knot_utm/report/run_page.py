"""The page of one test: every key of result.yaml that has a value has its place, also those that this package has never heard of."""
from markupsafe import Markup

from knot_utm.report.certificate import certificate, specification_checks, specification_verdict, stiffness_name, verdict
from knot_utm.report.curves import course, error_band, force_extension
from knot_utm.report.marks import end_of, largest_load, marks_of
from knot_utm.report.method_facts import knot_and_materials, method_facts, particulars, program
from knot_utm.report.page import Box, certificate_section, facts, figure, head_of, Headline, no_value, render, Row, Table, verdict_box
from knot_utm.report.quantities import (all_in_units, CERTIFICATE, error_shown, GROUPS, HEAD, in_units, is_number, is_rounding, quantity_of,
                                        shown, TABLES, with_unit)
from knot_utm.report.rod_pictures import pictures
from knot_utm.report.run import Run
from knot_utm.report.shapes import nearest, shapes_of
from knot_utm.report.turnable import turnable

HEADLINES = ("knotability", "force_ratio", "plateau_force", "lock_extension", "locked_stiffness", "peak_force", "break_extension",
             "elongation_total")
# What stands for no value where it is not null.
NOTHING = {"break_place": "none", "cycles": 0, "motion_pattern_confidence": 0}


def report_on_run(folder, command, version):
    run = Run(folder)
    result, marks, largest = run.result, marks_of(run), largest_load(run)
    gave_up = result.get("ended_by") == "solver"
    reason = in_units(result.get("reason") or "", run.units)
    asked = specification_checks(run.method, result, run.units)
    asked_verdict = specification_verdict(result, asked)
    asked_box = asked_verdict and verdict_box(*asked_verdict)
    checks, warnings = certificate(result, run.has_knot(), run.is_soft()), all_in_units(result.get("warnings") or [], run.units)
    boxes = [given_box(run), asked_box,
             gave_up and Box("fail", [Markup("<b>The physics gave up before the test ended, so that the results are those of its "
                                             "beginning.</b> {}").format(reason)]),
             Box("warnings", [Markup("<b>Warnings</b>"), *warnings]) if warnings else None if gave_up else
             Box("quiet", ["The test gave no warning."])]
    shown_keys = {*GROUPS[HEAD], *(check.key for check in checks)}
    tables = results_tables(run, largest, shown_keys)
    unmeasured = [key for key in result if key not in shown_keys and key != "no_plateau_because"]
    curve, rod, over_time = figures_of(run, marks, largest)
    return render(
        folder, command, version, "Tensile test, simulated", knot_and_materials(run.method, run.folder), [
            ("Force and extension", curve),
            ("The rod at the marked points", rod),
            ("Results", [*tables, "Forces are the balanced load. They are relative to the last zeroing of the load cell (the step balance of "
                         "the program), if there is one. True forces are absolute. The numerical error is estimated; it is given only "
                         "where a convergence study covers the case. It does not tell how well the model of the rod describes a real one."
                         + ("" if run.units.are_default else " All files are in SI units."), no_value("This test has no", unmeasured)]),
            certificate_section("Value", asked_box, asked, verdict_box(*verdict(checks)), checks,
                                "The limits are those at which the program itself warns."),
            ("What was tested, and how", [method_facts(run.method, run.units, run.folder), over_time,
                                          facts(program(run.method, run.units))])],
        Markup("knot_utm {} · ended by <b>{}</b>{} · motion pattern <b>{}</b>").format(
            result.get("version"), result.get("ended_by"), f": {reason}" if reason and not gave_up else "", result.get("motion_pattern")),
        [*head_of(run.report), *particulars(run.report, run.method, run.value("gauge_length"), run.units)],
        run.report.get("notes", ""), headlines(run, largest), boxes)


def given_box(run):
    """Where the rod parted at the breaking force of its material: what is read at such a break follows from it."""
    forces = [run.method[of].get("breaking_force") for of in ("material", "other_material") if of in run.method]
    if run.value("break_extension") is None or "at a tension of" not in (run.result.get("reason") or "") or not any(map(is_number, forces)):
        return None
    given = with_unit(min(filter(is_number, forces)), run.units.force)
    return Box("quiet", [f"The rod parted at the breaking force that was given, {given}" + (
        ": the strength of the knot is not predicted." if "knot_efficiency" in run.not_predicted() else
        ", which the peak force repeats.")])


# ---- figures ----


def figures_of(run, marks, largest):
    """Parts of the curve, of the rod, and of the course of the test."""
    curve, rod, over_time = ["The test ended before the specimen was pulled, so that there is no curve."], [], None
    if marks:
        curve = [figure(force_extension(run, marks), "Load over extension, with the lock, a jump, the break and the marked points",
                        caption(run, marks, largest))]
    if len(run.curve) >= 2:
        over_time = figure(course(run), "Load and extension over time, with the phases of the program",
                           "Load and extension over the whole test; the colours show the phases of the program. Until the balance the load "
                           "is not yet zeroed. While the knots are tied the load cell reads nothing.")
        shown_at = marks or [end_of(run.curve)]
        shapes, note = shapes_of(run)
        at_marks = shapes if len(shapes) == 1 else [nearest(shapes, mark.time) for mark in shown_at]
        rod = [note and Box("warnings", [note]),
               figure(pictures(run, shown_at[-len(at_marks):], at_marks), "The rod at the marked points, coloured by its tension",
                      "The load axis runs from left to right. Parts of the rod that are farther away are paler. Each picture shows the rod at "
                      "the recorded instant nearest to its mark.", "JPEG")]
        curve.append(turnable(run, shapes, marks))
    return curve, rod, over_time


def caption(run, marks, largest):
    band, peak = words_of_band(run), with_unit(run.value("peak_force"), run.units.force)
    sentences = [
        largest and not largest.is_peak and f"The curve has no peak: its largest load, {peak}, was read {largest.where}.",
        run.value("break_extension") is not None and "It ends where the rod parted.",
        f"The band shows the estimated numerical error, from the {'errors' if ' and ' in band else 'error'} of the {band} in the table below."
        if band else "No band of numerical error is drawn: it is made of the errors of the plateau, the lock and the stiffness, which are "
        "not known here.",
        run.curve.has_compliant_frame() and "The extension is that of the specimen itself: the deflection of the frame is taken off.",
        run.load_cell_floor() and "Below the hatched floor of the load cell its error is no longer a share of the reading."]
    return Markup("The line is the balanced load on the specimen, without noise and resolution of the load cell. The points, where there are "
                  "not too many, are the readings of the load cell. {}. {}").format(
        Markup("; ").join(Markup("<b>{}</b>&nbsp;{}").format(mark.letter, mark.title()) for mark in marks), " ".join(filter(None, sentences)))


def words_of_band(run):
    """The readings whose errors it is made of; None: there is no band."""
    if error_band(run, run.curve.pull()) is None:
        return None
    names = {"plateau_force": "plateau force", "lock_extension": "lock extension", "locked_stiffness": stiffness_name(run.result)}
    *first, last = [name for key, name in names.items() if run.value(key + "_error") is not None]
    return " and ".join([", ".join(first), last] if first else [last])


# ---- readings ----


def short_label(result, key, largest):
    """For a place that has no room for the label. `largest`: the LargestLoad of the test, or None."""
    if key == "peak_force" and largest and not largest.is_peak:
        return "Largest load"
    name = stiffness_name(result) if key == "locked_stiffness" else key.replace("_", " ")
    return name[:1].upper() + name[1:]


def headlines(run, largest):
    found = []
    for key in HEADLINES:
        value, error = run.value(key), run.value(key + "_error")
        if value is not None:
            unit = run.units.of(quantity_of(key).kind)
            remark = largest.where if key == "peak_force" and largest else ""
            found.append(Headline(short_label(run.result, key, largest), shown(value, unit.scale, error),
                                  error_shown(error, unit.scale), unit.name, remark))
    return found


def has_value(result, key):
    """A rod without two knots never has a plateau, which needs no reason."""
    if key == "no_plateau_because" and result.get("motion_pattern") == "none" and result.get("jump_force") is None:
        return False
    return result.get(key) not in (None, []) and NOTHING.get(key) != result[key]


def results_tables(run, largest, shown_keys):
    """Tables in the order of --list-results, and of keys that it does not have. Adds the keys that they show to `shown_keys`."""
    result = run.result
    labels = {"locked_stiffness": short_label(result, "locked_stiffness", None),
              "peak_force": f"{'Peak force' if largest.is_peak else 'Largest load'}, {largest.where}" if largest else "Largest load"}
    words, tables = {key: "not predicted" for key in run.not_predicted()}, []
    # An error and a true force stand beside their reading.
    beside = {name for key in result for name in (key + "_error", "true_" + key) if has_value(result, key)}
    known = {key for title in (*TABLES, CERTIFICATE) for key in GROUPS[title]}
    for title in (*TABLES, "Further"):
        keys = GROUPS.get(title) or [key for key in result if key not in known | beside | shown_keys]
        rows = [row_of(run, key, labels.get(key) or quantity_of(key).label, words.get(key)) for key in keys
                if has_value(result, key) or key in words]
        # Columns that are empty throughout are left out.
        columns = [i for i in range(4) if i in (0, 3) or any(len(row.cells) > 1 and row.cells[i] for row in rows)]
        heads = ("Value", "± error", "True force", "Unit")
        if rows:
            tables.append(Table((title, *(heads[i] for i in columns)),
                                [row if len(row.cells) == 1 else row._replace(cells=[row.cells[i] for i in columns]) for row in rows]))
        shown_keys.update(key for row in rows for key in row.keys)
    return tables


def row_of(run, key, label, words):
    result, unit = run.result, run.units.of(quantity_of(key).kind)
    keys, value = [name for name in (key, key + "_error", "true_" + key) if name in result], result[key]
    if words or isinstance(value, str):
        return Row(label, keys, [words or in_units(value, run.units)])
    error, true = result.get(key + "_error"), result.get("true_" + key)
    error_words = error_shown(error, unit.scale)
    return Row(label, keys, [shown(0.0 if is_rounding(key, result.get) else value, unit.scale, error), error_words and f"± {error_words}",
                             "" if true is None else shown(true, unit.scale, error), "" if isinstance(value, (bool, dict)) else unit.name])
