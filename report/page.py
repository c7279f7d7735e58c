"""What goes into a page, and the page as HTML and PDF."""
import logging
import os
import re

from jinja2 import Environment, FileSystemLoader, StrictUndefined

from certificate import certificate, stiffness_name, verdict
from comparison import READINGS, Comparison, run_beside
from comparison_figures import overlay
from curve_figures import course, force_extension
from error_band import error_band
from failure import CannotReport
from marks import end_of, marks_of, time_of_break
from method_facts import knot_of, method_facts, program
from quantities import error_shown, number, quantity_of, shown
from results_table import results_table
from rod_pictures import pictures
from run import Run, printable
from shapes import shapes_at

FILES = [
    ("curve.csv", "load, extension and knot distance at every reading of the load cell"),
    ("curve_full.csv", "the same at every time step"),
    ("result.yaml", "every result in full precision"),
    ("method.yaml", "the method, everything resolved: it runs again to the same curve"),
    ("final_shape.csv", "the rod at the end"),
    ("test.bag", "the topics of the test"),
    ("saved.bag", "the bag as it was when recorder/save was called"),
    ("specimen.csv", "the shape that was tested"),
    ("failed_step.bin", "the time step that could not be made"),
    ("comparison.yaml", "the comparison in full precision"),
    ("a.csv", "curve A as compared"),
    ("b.csv", "curve B as compared"),
    ("report.html", "this page"),
    ("report.pdf", "the same on paper"),
]
HEADLINES = ("plateau_force", "lock_extension", "locked_stiffness", "peak_force", "break_extension")


def report_on_run(folder, command, version):
    run = Run(folder)
    marks = marks_of(run)
    content = {"marks": marks, "curve": None, "course": None, "pictures": None, "note": ""}
    if marks:
        content["curve"] = force_extension(run, marks)
    if len(run.curve) >= 2:
        content["course"] = course(run)
        content["pictures"], content["note"] = drawn(run, marks or [end_of(run.curve)])
    checks = certificate(run.result)
    words, good = verdict(checks)
    return render("run.html.j2", {
        **content, "run": run, "title": f"{knot_of(run.method)}, {run.method['material'].get('name', 'own material')}",
        "result": run.result, "headlines": headlines(run.result), "facts": method_facts(run.method),
        "program": program(run.method), "results": results_table(run.result), "checks": checks, "verdict": words,
        "good": good, "band": error_band(run, run.pull()) is not None, "floor": run.load_cell_floor(),
        "compliant": run.curve.has_compliant_frame(),
        "files": files_of(folder), "command": printable(command), "version": version, "folder": printable(folder)})


def drawn(run, marks):
    shapes, note = shapes_at(run, [mark.time for mark in marks], time_of_break(marks))
    return pictures(run, marks[-len(shapes):], shapes), note


def headlines(result):
    """[(label, value, error, unit)] of what a reader looks for first."""
    found = []
    for key in HEADLINES:
        if result.get(key) is not None:
            quantity, error = quantity_of(key), result.get(key + "_error")
            found.append((headline(result, key), shown(result[key], quantity.scale, error),
                          error_shown(error, quantity.scale), quantity.unit))
    return found


def headline(result, key):
    name = stiffness_name(result) if key == "locked_stiffness" else key.replace("_", " ")
    return name[:1].upper() + name[1:]


def report_on_comparison(folder, command, version):
    comparison = Comparison(folder)
    rows = [comparison_row(comparison, key) for key in READINGS if isinstance(comparison.facts.get(key), dict)]
    return render("comparison.html.j2", {
        "title": "Comparison of two curves", "facts": comparison.facts, "curves": overlay(comparison), "rows": rows,
        "sides": [(name.upper(), printable(file), *side_facts(run_beside(file))) for name, file in comparison.files.items()],
        "common": [shown(s, 1e3) for s in comparison.facts["common_extension"]],
        "rms": shown(comparison.number("rms_difference")), "largest": shown(comparison.number("largest_difference")),
        "share": percent(comparison.number("rms_difference_over_load")),
        "largest_at": shown(comparison.number("largest_difference_at"), 1e3), "files": files_of(folder),
        "command": printable(command), "version": version, "folder": printable(folder)})


def comparison_row(comparison, key):
    both, quantity = comparison.facts[key], quantity_of(key)
    return (key, re.split("[,;]", quantity.label)[0], quantity.unit,
            *(shown(both.get(part), quantity.scale) for part in ("a", "b", "difference")),
            percent(both.get("relative")))


def percent(share):
    return "–" if share is None else number(float(f"{100.0 * share:.3g}")) + " %"


def side_facts(beside):
    """What a curve is from, and what its run warns of."""
    if beside is None:
        return "a file of its own: no run of knot_utm stands beside it", []
    method, result = beside
    words = (f"simulated: {knot_of(method)}, {method['material'].get('name', 'own material')}, knot_utm "
             f"{result.get('version')}, ended by {result.get('ended_by')}")
    return words, result.get("warnings") or []


def files_of(folder):
    """The page itself is among them, also where it is yet to be written."""
    return [(name, words) for name, words in FILES
            if name.startswith("report.") or os.path.exists(os.path.join(folder, name))]


def render(template, content):
    environment = Environment(loader=FileSystemLoader(os.path.dirname(os.path.abspath(__file__))), autoescape=True,
                              undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True)
    return environment.get_template(template).render(content)


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


def as_pdf(html):
    # Fonts are cut to what is used; the time of the cut would stand in them.
    os.environ["SOURCE_DATE_EPOCH"] = "0"
    import weasyprint

    for name in ("weasyprint", "fontTools"):
        logging.getLogger(name).setLevel(logging.ERROR)
    return weasyprint.HTML(string=html, url_fetcher=own_images_only).write_pdf()


def own_images_only(url, *_, **__):
    """The page holds all that it shows."""
    if not url.startswith("data:"):
        raise ValueError(f"the page asks for {url}")
    from weasyprint import default_url_fetcher

    return default_url_fetcher(url)
