"""The one layout of all pages, into which each kind of report puts its readings, figures, tables and notes; the page as HTML and PDF."""
import ctypes.util
import logging
import os
from collections import namedtuple

from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup

from knot_utm.arguments import write_whole
from knot_utm.report.style import embedded
from knot_utm.yaml_text import printable

FILES = {
    "curve.csv": "load, extension and knot distance at every reading of the load cell",
    "curve_full.csv": "the same at every time step",
    "result.yaml": "every result in full precision",
    "statistics.yaml": "the statistics of the batch in full precision",
    "specimens.csv": "a row for each specimen: what was drawn, how its test ended, and all of its readings",
    "method.yaml": "the method with every value, which gives the same curve when it is run again",
    "final_shape.csv": "the rod at the end",
    "shapes.csv": "the rod over the time of the test",
    "test.bag": "the topics of the test",
    "samples.csv": "every sample with all of its fields; the files above are made from it",
    "shapes.bin": "the rod at every reading of the load cell, for the files above",
    "saved.bag": "the bag as it was when recorder/save was called",
    "specimen.csv": "the shape that was tested",
    "knot.yaml": "the knot that was tested",
    "comparison.yaml": "the comparison in full precision",
    "a.csv": "curve A as compared",
    "b.csv": "curve B as compared",
    "fit.yaml": "the fit in full precision",
    "method_2.yaml": "the method of the second record; of further ones method_3.yaml and so on",
    "curves.csv": "the means of the measured and the fitted curves, and their errors",
    "profiles.csv": "the profiles of the keys",
    "report.html": "this page",
    "report.pdf": "this page for paper",
}

# What a reader looks for first, at the head of a page.
Headline = namedtuple("Headline", "label value error unit remark")
# A box of lines. `kind`: pass, fail, warnings, or quiet, which has no frame.
Box = namedtuple("Box", "kind lines")
# What a section holds, one below the other; a text is a remark.
Figure = namedtuple("Figure", "image words caption")
Table = namedtuple("Table", "heads rows kind", defaults=[""])  # kind: facts, of labels and texts
Row = namedtuple("Row", "label keys cells")  # `keys`: those whose values it shows; the first is named beside the label
Turnable = namedtuple("Turnable", "data scripts")


def figure(drawn, words, caption, kind="PNG"):
    return Figure(embedded(drawn, kind), words, caption)


def facts(rows):
    """A table of [(label, text)]."""
    return Table((), [Row(label, (), (text,)) for label, text in rows], "facts")


def checks_table(name, kept_by, checks):
    return Table((name, kept_by, "Limit", "Verdict"),
                 [Row(check.words, [check.key], (check.value, check.limit, "pass" if check.kept else "fail")) for check in checks])


def no_value(who_has_none, keys):
    return Markup("{} value of {}.").format(who_has_none, Markup(", ").join(Markup("<code>{}</code>").format(key) for key in keys)) if keys else ""


def verdict_box(words, good):
    return Box("pass" if good else "fail", [words])


def certificate_section(kept_by, asked_box, asked, checks_box, checks, remark):
    """What the user asked for, where it is something, and how far the result may be trusted. `kept_by`: the head of what is checked."""
    of_user = [asked_box, checks_table("Specification", kept_by, asked)] if asked else []
    return "Quality certificate", [*of_user, checks_box, checks_table("Trust in the computation", kept_by, checks), remark]


HEAD = {"specimen_id": "Specimen", "standard": "Standard", "conditioning": "Conditioning", "terminations": "Terminations"}


def head_of(report):
    """[(label, text)] of what the user gave."""
    return [(label, report[key]) for key, label in HEAD.items() if report.get(key)]


def files_of(folder):
    """The page itself is among them, also where it is yet to be written."""
    return [(name, words) for name, words in FILES.items()
            if name.startswith("report.") or os.path.exists(os.path.join(folder, name))]


def render(folder, command, version, kind, title, sections, under="", head=(), notes="", headlines=(), boxes=(), files=None):
    """The page of a `kind`. `sections`: [(title, parts)], of which empty parts are left out."""
    environment = Environment(loader=FileSystemLoader(os.path.dirname(os.path.abspath(__file__))), autoescape=True,
                              undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True)
    return environment.get_template("page.html.j2").render(
        kind=kind, title=title, under=under, head=head, notes=notes, headlines=headlines, boxes=boxes, version=version,
        sections=[(name, [part for part in parts if part]) for name, parts in sections], command=printable(command).split(" "),
        folder=printable(folder), files=[(Markup("<code>{}</code>").format(name), words) for name, words in files or files_of(folder)],
        facts=facts)


def write(folder, html):
    """Both files, each whole, once both could be made."""
    for name, content in (("report.pdf", as_pdf(html)), ("report.html", html.encode("utf-8"))):
        write_whole(os.path.join(folder, name), content)


def as_pdf(html):
    # Fonts are cut to what is used; the time of the cut would stand in them.
    os.environ["SOURCE_DATE_EPOCH"] = "0"
    # Of each library cffi would ask ldconfig, gcc and ld for the names that it has elsewhere, before it takes Debian's.
    find, ctypes.util.find_library = ctypes.util.find_library, lambda name: None
    import weasyprint

    ctypes.util.find_library = find
    for name in ("weasyprint", "fontTools"):
        logging.getLogger(name).setLevel(logging.ERROR)
    head, _, rest = html.partition("<!-- to turn -->")
    return weasyprint.HTML(string=head + rest.partition("<!-- turned -->")[2] if rest else html, url_fetcher=own_images_only).write_pdf()


def own_images_only(url, *_, **__):
    """The page holds all that it shows."""
    if not url.startswith("data:"):
        raise ValueError(f"the page asks for {url}")
    from weasyprint import default_url_fetcher

    return default_url_fetcher(url)
