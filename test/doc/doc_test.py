#!/usr/bin/python3
"""README.md and doc/ against the code: generated tables, launch arguments, names, tests, files, links."""
import glob
import os
import re
import subprocess
import unittest
import xml.etree.ElementTree

import yaml

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../..")
SCREEN = 50  # lines


def text(path):
    with open(os.path.join(ROOT, path), encoding="utf-8") as file:
        return file.read()


def rows(page):
    """Rows of its tables, by the words in backticks in the first cell."""
    found = {}
    for line in page.splitlines():
        if line.startswith("|"):
            cells = [cell.strip() for cell in line.strip("|").split("|")]
            for word in re.findall(r"`([^`]+)`", cells[0]):
                found.setdefault(word, []).append(cells)
    return found


def files(folder, ending):
    for where, _, names in os.walk(os.path.join(ROOT, folder)):
        yield from (os.path.join(where, name) for name in names if name.endswith(ending))


def documents():
    """README.md, every page of doc/, and those for who changes the code."""
    return ["README.md"] + sorted(os.path.relpath(page, ROOT) for page in glob.glob(os.path.join(ROOT, "doc/**/*.md"), recursive=True))


def prose(page):
    """Its lines without blocks of code, in which a # begins a comment and brackets are no links."""
    return [line for line in page.splitlines() if not line.startswith("    ")]


def headings(page):
    return [match.group(1) for match in (re.match(r"#+ (.+)", line) for line in prose(page)) if match]


def anchor(heading):
    """Where a link to a heading leads, as GitHub and GitLab name it."""
    return re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")


class Generated(unittest.TestCase):
    def test_tables_are_as_they_are_generated(self):
        done = subprocess.run([os.path.join(ROOT, "scripts/tables"), "--check"], check=False, capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""))


class Measured(unittest.TestCase):
    """doc/developers/measured.md against the code."""

    def test_every_constant_has_the_value_of_the_code(self):
        listed = [[cell.strip() for cell in line.strip("|").split("|")] for line in text("doc/developers/measured.md").splitlines()
                  if line.startswith("| `")]
        self.assertGreater(len(listed), 20)
        for constants, file, *_ in listed:
            for name, value in re.findall(r"`(k\w+)`(?: = ([-\d.e]+))?", constants):
                found = re.search(rf"\b{name}(?: = ([^;,]+)|{{)", text(file.strip("`")))
                self.assertTrue(found, f"{file} has no {name}")
                if value:
                    self.assertEqual(float(found.group(1)), float(value), name)
        names = set(re.findall(r"\b(k[A-Z]\w+)(?= = |{)", text("src/settings/measured.hpp")))
        self.assertEqual(names - {name for row in listed for name in re.findall(r"`(k\w+)`", row[0])}, set())


class Ros(unittest.TestCase):
    def test_pages_have_every_launch_argument_name_and_message(self):
        page = text("doc/ros.md") + text("doc/developers/ros_parameters.md")
        arguments = rows(page)
        for file in files("launch", ".launch"):
            for name in re.findall(r'<arg name="(\w+)"(?! value)', text(file)):
                self.assertTrue(name in arguments, f"{file}: {name}")
        for name in re.findall(r'= "([^"]+)";', text("include/knot_utm/ros/names.hpp")):
            self.assertTrue(f"`{name}`" in page, name)
        for file in [*files("msg", ".msg"), *files("srv", ".srv"), *files("action", ".action")]:
            self.assertTrue(f"knot_utm/{os.path.splitext(os.path.basename(file))[0]}`" in page, file)

    def test_every_field_of_a_message_has_its_unit_above_it(self):
        for file in [*files("msg", ".msg"), *files("srv", ".srv"), *files("action", ".action")]:
            comment = ""
            for line in text(file).splitlines():
                if line.startswith("#"):
                    comment = line
                elif re.match(r"[\w/]+(\[\])? \w+$", line):
                    self.assertRegex(comment, r"\[[^]]+\]|, in that unit$", f"{file}: {line}")
                    comment = ""


class Contributing(unittest.TestCase):
    def test_diffs_fit_the_files_that_they_change(self):
        blocks = re.findall(r"\n\n(.*?)\n\n *```diff\n(.*?)```", text("CONTRIBUTING.md"), re.DOTALL)
        self.assertGreater(len(blocks), 7)
        for before, diff in blocks:
            file = re.findall(r"`((?:src|include)/\S+)`", before)[-1]
            for line in diff.splitlines():
                if not line.startswith("+") and "…" not in line:
                    self.assertIn(" ".join(line[1:].split()), " ".join(text(file).split()), file)


class Readme(unittest.TestCase):
    def test_leads_to_every_page(self):
        for document in documents()[1:]:
            self.assertTrue(f"]({document})" in text("README.md"), document)


class Documents(unittest.TestCase):
    def test_commands_of_pages_and_headers_are_there(self):
        studies = set(re.findall(r'"(\w+)": \[', re.search(r"^STUDIES = \{(.*?)\}", text("scripts/bench"), re.M | re.S)[1]))
        for page in [*documents(), "CONTRIBUTING.md", *files("include", ".hpp"), *files("src", ".cpp")]:
            said = text(page)
            self.assertLessEqual(set(re.findall(r"scripts/bench ([a-z]\w*)", said)), studies, page)
            for script in re.findall(r"(?<![\w/])scripts/(\w+)", said):
                self.assertTrue(os.path.exists(os.path.join(ROOT, "scripts", script)), f"{page}: scripts/{script}")

    def test_links_lead_to_files_and_headings_that_are_there(self):
        for document in documents():
            for link in re.findall(r"\]\(([^)\s]+)\)", "\n".join(prose(text(document)))):
                if re.match(r"\w+:", link):
                    continue  # of the web
                target, _, place = link.partition("#")
                file = os.path.normpath(os.path.join(os.path.dirname(document), target)) if target else document
                self.assertTrue(os.path.exists(os.path.join(ROOT, file)), f"{document}: {link}")
                if place:
                    self.assertIn(place, [anchor(heading) for heading in headings(text(file))], f"{document}: {link}")

    def test_pages_longer_than_a_screen_have_a_table_of_contents(self):
        for document in documents():
            page = text(document)
            if len(page.splitlines()) <= SCREEN:
                continue
            sections = re.findall(r"^## (.+)$", "\n".join(prose(page)), re.MULTILINE)
            self.assertGreater(len(sections), 1, f"{document} is long and has no sections")
            contents = re.findall(r"^- \[([^\]]+)\]\(#([^)]+)\)$", page[:page.index("\n## ")], re.MULTILINE)
            self.assertEqual(contents, [(section, anchor(section)) for section in sections], document)

    def test_named_sources_are_there(self):
        for document in documents():
            for header in re.findall(r"`([\w/]+\.(?:hpp|cpp))`", text(document)):
                places = [header, "include/knot_utm/" + header]
                beside = any(file.endswith("/" + header) for file in files("include", ".hpp"))
                self.assertTrue(beside or any(os.path.exists(os.path.join(ROOT, place)) for place in places),
                                f"{document}: {header}")

    def test_named_tests_are_there(self):
        suites = set()
        for file in files("test", "_test.cpp"):
            suites.update(re.findall(r"^(?:TYPED_)?TEST(?:_F|_P)?\((\w+),", text(file), re.MULTILINE))
        for name in re.findall(r"`((?:R\d+|K\d+)\w+|StencilAt|StretchingLaw|IsotropicBendingBy|SmoothContactJacobian)",
                               text("doc/references.md")):
            self.assertTrue(name in suites, name)

    def test_promises_have_their_tests(self):
        tests = {f"{suite}.{name}" for file in files("test", "_test.cpp")
                 for suite, name in re.findall(r"^(?:(?:TYPED_)?TEST(?:_F|_P)?|RC_GTEST_PROP|RC_GTEST_FIXTURE_PROP)\((\w+),\s*(\w+)", text(file), re.MULTILINE)}
        launched = {name for file in files("test/ros", "_test.py") for name in re.findall(r"def (test_\w+)", text(file))}
        named = re.findall(r"`(\w+)(\.\w+)?`", text("doc/developers/reliability.md"))
        for suite, name in named:
            if re.match(r"[A-Z]", suite) and name:
                self.assertTrue(suite + name in tests, suite + name)
            elif suite.startswith("test_"):
                self.assertTrue(suite in launched, suite)
        self.assertGreater(len(named), 20)


class PublicHeaders(unittest.TestCase):
    def test_those_to_include_are_explained(self):
        meant, others = re.split(r"\n\n(?=# What those include)", text("cmake/public_headers.txt"))
        explained = [key for key in rows(text("doc/install.md")) if key.endswith(".hpp")]
        self.assertEqual([line for line in meant.splitlines()[2:] if line and not line.startswith("#")], explained)
        for header in re.findall(r"^[^#].*$", others, re.MULTILINE):
            self.assertTrue(any(f'"knot_utm/{header}"' in text(f"include/knot_utm/{by}")
                                for by in re.findall(r"^[^#\n].*$", meant + "\n" + others, re.MULTILINE)), header)


class Sources(unittest.TestCase):
    CITED = re.compile(r"\b([A-Z][a-z]+)(?:,? (?:[A-Z][\w'’]+|and|et al\.)(?=[ ,]))*,? (?:algorithm )?\(?((?:18|19|20)\d\d)\b")

    def test_who_is_cited_stands_in_the_bibliography(self):
        entries = text("doc/bibliography.md").split("\n")
        cited = set()
        for folder, ending in (("include", ".hpp"), ("src", "pp"), ("test", "pp"), ("bench", ".py"), ("config", ".yaml"), ("doc", ".md")):
            for file in files(folder, ending):
                if not file.endswith("bibliography.md"):
                    words = re.sub(r"\n\s*(?:///?|#)?\s*", " ", text(file))  # a comment goes on in the next line
                    cited.update((author, year, file) for author, year in self.CITED.findall(words))
        self.assertGreater(len(cited), 10)
        for author, year, file in cited:
            self.assertTrue(any(author in entry and year in entry for entry in entries), f"{file}: {author} {year}")


class Citation(unittest.TestCase):
    citation = yaml.safe_load(text("CITATION.cff"))

    def test_version_and_licence_are_the_packages(self):
        package = xml.etree.ElementTree.parse(os.path.join(ROOT, "package.xml")).getroot()
        # CMakeLists.txt reads it there; a citation cannot.
        version = package.find("version").text
        self.assertRegex(version, r"^\d+\.\d+\.\d+$")
        self.assertEqual(self.citation["version"], version)
        self.assertNotRegex(text("CMakeLists.txt"), r"project\(knot_utm VERSION \d")
        self.assertEqual(self.citation["license"], package.find("license").text)

    def test_has_the_source_paper_as_the_bibliography_has_it(self):
        paper = self.citation["references"][0]
        for part in [paper["title"], paper["doi"], paper["start"], *(author["family-names"] for author in paper["authors"])]:
            self.assertIn(part, " ".join(text("doc/bibliography.md").split()))


if __name__ == "__main__":
    unittest.main()
