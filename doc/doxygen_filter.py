#!/usr/bin/python3
"""A page of doc/ or README.md as Doxygen takes it, on stdout: doxygen_filter.py PAGE. Doxygen 1.9.4 knows none of the anchors
that GitHub and GitLab make of headings. So each heading gets a label, and links lead to these. Links to files that are no
pages, which the site does not hold, become plain text."""
import os
import re
import sys

HEADING = re.compile(r"(#+) (.+)")
LINK = re.compile(r"(?<!!)\[((?:[^][]|\[[^]]*\])*)\]\(([^)\s]+)\)")
ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..")


def label(page, heading=""):
    """Of a heading of a page, or of the page itself."""
    name = os.path.splitext(os.path.basename(page))[0].lower()
    return f"{name}-{heading}" if heading else f"page-{name}"


def led(match, page):
    """A link of a page as Doxygen follows it."""
    said, target = match.groups()
    if re.match(r"\w+:", target):
        return match.group()
    file, _, place = target.partition("#")
    file = os.path.normpath(os.path.join(os.path.dirname(page), file)) if file else page
    is_page = file.endswith(".md") and os.path.dirname(file) in ("", "doc", "doc/developers")
    return f"[{said}](#{label(file, place)})" if is_page else said


def filtered(page, lines):
    first, prose = True, []  # a link may begin on one line and end on the next

    def linked():
        text = LINK.sub(lambda match: led(match, page), "\n".join(prose))
        prose.clear()
        return text

    for line in lines:
        heading = HEADING.fullmatch(line)
        if not heading and not line.startswith("    "):
            prose.append(line)
            continue
        if prose:
            yield linked()
        if heading:
            words = heading.group(2)
            anchor = re.sub(r"[^\w\- ]", "", words.lower()).replace(" ", "-")
            yield f"{heading.group(1)} {words} {{#{label(page) if first else label(page, anchor)}}}"
            first = False
        else:
            yield line  # code
    if prose:
        yield linked()


if __name__ == "__main__":
    PAGE = os.path.relpath(sys.argv[1], ROOT)
    with open(sys.argv[1], encoding="utf-8") as FILE:
        print("\n".join(filtered(PAGE, FILE.read().split("\n"))))
