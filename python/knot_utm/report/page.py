"""What goes into a page, and the page as HTML and PDF."""
import logging
import os
import re
from collections import namedtuple
from html import escape

from jinja2 import Environment, FileSystemLoader, StrictUndefined

from knot_utm.report.certificate import certificate, specification_checks, specification_verdict, stiffness_name, verdict
from knot_utm.report.commands import CannotReport
from knot_utm.report.curve_figures import course, force_extension
from knot_utm.report.curves import error_band
from knot_utm.report.marks import end_of, largest_load, marks_of, time_of_break
from knot_utm.report.method_facts import knot_and_materials, method_facts, particulars, program
from knot_utm.report.quantities import all_in_units, error_shown, in_units, number, quantity_of, shown, with_unit
from knot_utm.report.results_table import results_table, short_label
from knot_utm.report.rod_pictures import pictures
from knot_utm.report.run import printable, Run
from knot_utm.report.shapes import final_shape, series_of, shapes_at
from knot_utm.report.style import LOOKS
from knot_utm.report.turnable import turnable
from knot_utm.report.typefaces import told, without_typeface

FILES = [
    ("curve.csv", "load, extension and knot distance at every reading of the load cell"),
    ("curve_full.csv", "the same at every time step"),
    ("result.yaml", "every result in full precision"),
    ("statistics.yaml", "the statistics of the batch in full precision"),
    ("specimens.csv", "a row for each specimen: what was drawn, how its test ended, and all of its readings"),
    ("method.yaml", "the method with every value, which gives the same curve when it is run again"),
    ("final_shape.csv", "the rod at the end"),
    ("shapes.csv", "the rod over the time of the test"),
    ("test.bag", "the topics of the test"),
    ("samples.csv", "every sample with all of its fields; the files above are made from it"),
    ("shapes.bin", "the rod at every reading of the load cell, for the files above"),
    ("saved.bag", "the bag as it was when recorder/save was called"),
    ("specimen.csv", "the shape that was tested"),
    ("knot.yaml", "the knot that was tested"),
    ("comparison.yaml", "the comparison in full precision"),
    ("a.csv", "curve A as compared"),
    ("b.csv", "curve B as compared"),
    ("fit.yaml", "the fit in full precision"),
    ("method_2.yaml", "the method of the second record; of further ones method_3.yaml and so on"),
    ("curves.csv", "the means of the measured and the fitted curves, and their errors"),
    ("profiles.csv", "the profiles of the keys"),
    ("report.html", "this page"),
    ("report.pdf", "this page for paper"),
]
HEADLINES = ("knotability", "force_ratio", "plateau_force", "lock_extension", "locked_stiffness", "peak_force", "break_extension",
             "elongation_total")


def report_on_run(folder, command, version):
    run = Run(folder)
    marks = marks_of(run)
    largest = largest_load(run)
    checks = certificate(run.result, run.has_knot(), run.is_soft())
    asked = specification_checks(run.method, run.result, run.units)
    words, good = verdict(checks)
    results, unmeasured, untold = results_table(run, words_of_largest(largest))
    told = {key: in_units(run.result[key], run.units) for key in ("reason",) if run.result.get(key)}
    return render("run.html.j2", {
        **figures_of(run, marks), "marks": marks, "largest": largest, "run": run,
        "result": {**run.result, **told, "warnings": all_in_units(run.result.get("warnings") or [], run.units)},
        "title": knot_and_materials(run.method, run.folder),
        "head": [*head_of(run.report), *particulars(run.report, run.method, run.value("gauge_length"), run.units)],
        "report": run.report, "headlines": headlines(run, largest),
        "facts": method_facts(run.method, run.units, run.folder), "program": program(run.method, run.units),
        "gave_up": run.result.get("ended_by") == "solver", "results": results, "unmeasured": unmeasured, "untold": untold,
        "checks": checks, "verdict": words, "good": good,
        "asked": asked, "asked_verdict": specification_verdict(run.result, asked),
        "band": words_of_band(run), "floor": run.load_cell_floor(),
        "compliant": run.curve.has_compliant_frame(), "si": run.units.are_default,
        "largest_load": with_unit(run.value("peak_force"), run.units.force), "between": between_readings(run),
        "given": run.given_strength(), "not_predicted": run.not_predicted(),
        "files": files_of(folder), "command": printable(command), "version": version, "folder": printable(folder)})


def figures_of(run, marks):
    """Each for a wide page and for a narrow one; None where there is nothing to draw."""
    found = {"curve": None, "course": None, "pictures": None, "note": "", "turnable": None}
    if marks:
        found["curve"] = [force_extension(run, marks, look) for look in LOOKS]
    if len(run.curve) >= 2:
        found["course"] = [course(run, look) for look in LOOKS]
        shown_at = marks or [end_of(run.curve)]
        series, found["note"] = series_of(run)
        shapes = shapes_at(series, [mark.time for mark in shown_at], time_of_break(shown_at), final_shape(run))
        found["pictures"] = pictures(run, shown_at[-len(shapes):], shapes, LOOKS)
        found["turnable"] = turnable(run, series, marks)
    return found


def words_of_band(run):
    """The readings whose errors it is made of; None: there is no band."""
    if error_band(run, run.pull()) is None:
        return None
    names = {"plateau_force": "plateau force", "lock_extension": "lock extension", "locked_stiffness": stiffness_name(run.result)}
    *first, last = [name for key, name in names.items() if run.value(key + "_error") is not None]
    return " and ".join([", ".join(first), last] if first else [last])


def words_of_largest(largest):
    """What the row of the largest load is called."""
    if largest is None:
        return "Largest load"
    return f"{'Peak force' if largest.is_peak else 'Largest load'}, {largest.where}"


def between_readings(run):
    """The largest load of the line that is drawn, where it is seen to be larger than the largest reading; else None."""
    line, peak = run.tested()["load"].max(initial=0.0), run.value("peak_force")
    texts = [with_unit(value, run.units.force) for value in (float(line), peak)]
    return texts[0] if peak is not None and line > peak and texts[0] != texts[1] else None


HEAD = (("specimen_id", "Specimen"), ("standard", "Standard"), ("conditioning", "Conditioning"), ("terminations", "Terminations"))


def head_of(report):
    """[(key, label, text)] of what the user gave."""
    return [(key, label, report[key]) for key, label in HEAD if report.get(key)]


# What a reader looks for first.
Headline = namedtuple("Headline", "label value error unit remark")


def headlines(run, largest):
    found = []
    for key in HEADLINES:
        value, error = run.value(key), run.value(key + "_error")
        if value is not None:
            unit = run.units.of(quantity_of(key).kind)
            remark = largest.where if key == "peak_force" and largest else \
                range_of_plateau(run) if key == "plateau_force" else ""
            found.append(Headline(short_label(run.result, key, largest), shown(value, unit.scale, error),
                                  error_shown(error, unit.scale), unit.name, remark))
    return found


RISES = 0.5  # of a plateau's range, that its slope over the way accounts for


def range_of_plateau(run):
    """Where its force is not the same all along."""
    low, high, slope = (run.value("plateau_force_" + name) for name in ("low", "high", "slope"))
    if low is None or high is None:
        return ""
    unit = run.units.force
    ends = [number(end * unit.scale, end * unit.scale) for end in (low, high)]  # with two digits
    if ends[0] == ends[1]:
        return ""
    end = run.value("lock_extension_by_load")
    way = 0.5 * (end if end is not None else float(run.pull()["extension"][-1]))  # from 0.3 to 0.8
    rises = slope is not None and slope * way > RISES * (high - low)
    return f"{'rises from' if rises else 'between'} {ends[0]} {'to' if rises else 'and'} {ends[1]} {unit.name}"


def files_of(folder):
    """The page itself is among them, also where it is yet to be written."""
    return [(name, words) for name, words in FILES
            if name.startswith("report.") or os.path.exists(os.path.join(folder, name))]


PLACE_OF_LINE = "<!-- characters that cannot be shown -->"  # in base.html.j2


def render(template, content):
    environment = Environment(loader=FileSystemLoader(os.path.dirname(os.path.abspath(__file__))), autoescape=True,
                              undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True)
    page = environment.get_template(template).render(content)
    line = told(without_typeface(page))
    return page.replace(PLACE_OF_LINE, f'<p class="box warnings">{escape(line)}</p>' if line else "", 1)


def write(folder, html):
    """Both files, whole: neither is touched before both could be written."""
    contents = {os.path.join(folder, "report.html"): html.encode("utf-8"),
                os.path.join(folder, "report.pdf"): as_pdf(html)}
    try:
        for file, content in contents.items():
            with open(file + ".part", "wb") as out:
                out.write(content)
        for file in contents:
            os.replace(file + ".part", file)
    except OSError as why:
        raise CannotReport(f"{file}: cannot be written: {why.strerror}") from why
    finally:
        for part in (file + ".part" for file in contents):
            if os.path.isfile(part):
                os.remove(part)


NOT_ON_PAPER = re.compile(r"<script.*?</script>|<source[^>]*>", re.DOTALL)  # which takes long to read past


def as_pdf(html):
    # Fonts are cut to what is used; the time of the cut would stand in them.
    os.environ["SOURCE_DATE_EPOCH"] = "0"
    import weasyprint

    for name in ("weasyprint", "fontTools"):
        logging.getLogger(name).setLevel(logging.ERROR)
    on_paper = NOT_ON_PAPER.sub("", html)
    return weasyprint.HTML(string=on_paper, url_fetcher=own_images_only).write_pdf()


def own_images_only(url, *_, **__):
    """The page holds all that it shows."""
    if not url.startswith("data:"):
        raise ValueError(f"the page asks for {url}")
    from weasyprint import default_url_fetcher

    return default_url_fetcher(url)
