#!/usr/bin/python3
"""README.md and doc/ against the code: keys and their ranges, launch arguments, names, tests, files, links."""
import glob
import os
import re
import unittest
import xml.etree.ElementTree

import yaml

from knot_utm import tool

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


def numbers(cell):
    """All numbers of a cell; infinities as they stand in YAML."""
    return [float(number.replace(".inf", "inf"))
            for number in re.findall(r"(?<![\w.])[-–]?(?:\d+(?:\.\d+)?(?:e-?\d+)?|\.inf)", cell.replace("–", "-"))]


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


class Design(unittest.TestCase):
    def test_rooms_are_those_of_the_table(self):
        table = {}
        for line in text("cmake/rooms.txt").splitlines():
            if line and line[0] not in "#=":
                room, _, uses = line.partition(":")
                table[room] = uses.split()
        page = {room: cells[0][2] for room, cells in rows(text("doc/developers/design.md")).items() if room in table}
        self.assertEqual({room: re.findall(r"\w+", cell) for room, cell in page.items()}, table)


class Method(unittest.TestCase):
    page = text("doc/method.md")
    rows = rows(page)

    def test_has_every_key(self):
        keys = re.findall(r'\b(?:f|top|friction|contact|until|units)\.\w+\("(\w+)"',
                          text("src/method/method_fields.hpp") + text("src/method/method.cpp"))
        keys += re.findall(r'(?:number|integer|text|flag|choice|vector)\("(\w+)"', text("src/method/method_fields.hpp"))
        self.assertGreater(len(keys), 80)
        # As scripts/fuzz finds them.
        spans = [span for line in self.page.splitlines() for span in re.findall(r"`([^`]+)`", line)]
        words = {word for span in spans for word in re.findall(r"\w+", span)}
        for key in keys:
            self.assertIn(key, words)

    def test_names_and_keys_of_laws_and_knots_are_explained(self):
        found = [name for file in [*files("include/knot_utm/contact", "_friction.hpp"), *files("include/knot_utm/rod", ".hpp")]
                 for name in re.findall(r'kName = "(\w+)"|LawKey(?: \w+)?\{"(\w+)"', text(file))]
        names = [law or key for law, key in found]
        names += [name for file in files("src/specimen", ".cpp") for name in re.findall(r'out\.name = "(\w+)"', text(file))]
        self.assertGreater(len(names), 20)
        for name in names:
            self.assertTrue(re.search(rf"`(\w+\.)*{name}`", self.page), name)

    def test_ranges_are_those_of_the_code(self):
        allowed = {}  # a name may stand in two sections, with a range in each
        for key, low, high in re.findall(r'number\("(\w+)", [\w.]+, Range\{([^,]+), ([^,]+),',
                                         text("src/method/method_fields.hpp")):
            allowed.setdefault(key, []).append([float(low), float(high.replace("kInfinity", "inf"))])
        checked = 0
        for word, found in self.rows.items():
            ranges = allowed.get(word.split(".")[-1])
            for cells in found:
                if ranges and len(cells) == 5 and cells[1] == "number":
                    self.assertTrue(numbers(cells[3])[:2] in ranges or len(found) > 1, f"{word}: {cells[3]}")
                    checked += 1
        self.assertGreater(checked, 20)

    def test_lengths_of_texts_are_those_of_the_code(self):
        found = re.findall(r'text\("(\w+)", [\w.]+, (\d+)\)', text("src/method/method_fields.hpp"))
        self.assertGreater(len(found), 4)
        for key, most in found:
            self.assertTrue(any(f"at most {most} characters" in cells[1] for cells in self.rows[key]), key)


class Measured(unittest.TestCase):
    """doc/developers/measured.md against the code."""

    PAGE = text("doc/developers/measured.md")
    ROWS = [[cell.strip() for cell in line.strip("|").split("|")] for line in PAGE.splitlines() if line.startswith("| `")]

    def test_every_constant_has_the_value_of_the_code(self):
        self.assertGreater(len(self.ROWS), 30)
        for constants, file, *_ in self.ROWS:
            code = text(file.strip("`"))
            for name, value in re.findall(r"`(k\w+)`(?: = ([-\d.e]+))?", constants):
                with self.subTest(name):
                    found = re.search(rf"\b{name}(?: = ([^;,]+)|{{)", code)
                    self.assertTrue(found, f"{file} has no {name}")
                    if value:
                        self.assertEqual(float(found.group(1)), float(value))

    def test_every_constant_of_the_error_study_is_listed(self):
        listed = {name for row in self.ROWS for name in re.findall(r"`(k\w+)`", row[0])}
        code = text("src/machine/measured.hpp")
        names = set(re.findall(r"\b(k[A-Z]\w+)(?= = |{)", code))
        self.assertGreater(len(names), 15)
        self.assertEqual(names - listed, set())


class Results(unittest.TestCase):
    """doc/results.md against the table of the keys, which the program writes (tensile_test --list-results)."""
    page = text("doc/results.md")
    units = {row["key"]: row["unit"] for row in tool.result_keys()}

    def test_has_every_key_and_its_unit(self):
        self.assertGreater(len(self.units), 20)
        said = self.said()
        self.assertEqual(set(said), set(self.units))
        for key, unit in self.units.items():
            self.assertEqual(said[key], unit.replace("-", "–"), key)

    def said(self):
        """Units by key; one unit may stand for all keys of a row."""
        found = {}
        table = self.page[self.page.index("## Keys of `result.yaml`"):self.page.index("## When a mean is a plateau")]
        for line in table.splitlines():
            cells = [cell.strip() for cell in line.strip("|").split("|")]
            keys = re.findall(r"`(\w+)`", cells[0]) if line.startswith("| `") else []
            units = cells[1].split(", ") if keys else []
            for key, unit in zip(keys, units * len(keys) if len(units) == 1 else units):
                found[key] = unit
        return found


class Ros(unittest.TestCase):
    page = text("doc/ros.md")
    rows = rows(page)
    of_nodes = page + text("doc/developers/ros_parameters.md")

    def test_has_every_launch_argument_and_its_default(self):
        for name, default in re.findall(r'<arg name="(\w+)" default="([^"]*)"', text("launch/tighten.launch")):
            self.assertTrue(name in self.rows, name)
            if re.fullmatch(r"[\w.]+", default):
                # Two launch files may have an argument of one name.
                said = [" ".join(row).replace("`", "") for row in self.rows[name]]
                self.assertTrue(any(default in row for row in said), f"{name}: {said}")

    def test_has_every_argument_of_other_launch_files(self):
        for file in files("launch", ".launch"):
            for name in re.findall(r'<arg name="(\w+)"(?! value)', text(file)):
                self.assertTrue(name in self.rows, f"{file}: {name}")

    def test_has_every_name_of_the_nodes(self):
        for name in re.findall(r'= "([^"]+)";', text("include/knot_utm/ros/names.hpp")):
            self.assertTrue(f"`{name}`" in self.of_nodes, name)

    def test_has_every_message(self):
        for file in [*files("msg", ".msg"), *files("srv", ".srv"), *files("action", ".action")]:
            name = os.path.splitext(os.path.basename(file))[0]
            self.assertTrue(f"knot_utm/{name}`" in self.page, name)

    def test_every_field_of_a_message_has_its_unit_above_it(self):
        for file in [*files("msg", ".msg"), *files("srv", ".srv"), *files("action", ".action")]:
            comment = ""
            for line in text(file).splitlines():
                if line.startswith("#"):
                    comment = line
                elif re.match(r"[\w/]+(\[\])? \w+$", line):
                    self.assertRegex(comment, r"\[[^]]+\]|, in that unit$", f"{file}: {line}")
                    comment = ""

    def test_messages_name_every_end_of_a_test(self):
        ends = set(re.findall(r'"(\w[\w ]*)"', re.search(r"kEndNames\[\] = \{(.*?)\}", text("include/knot_utm/record/ended_by.hpp"), re.S)[1]))
        for name in ("msg/TestStatus.msg", "action/RunTest.action"):
            told = re.search(r"# how it ended: ([^;\[]*).*\nstring ended_by", text(name))[1]
            self.assertEqual(set(re.findall(r"\w+", told)) - {"or"}, ends - {"not yet", "interrupted"}, name)

    def test_has_every_dynamic_parameter(self):
        for file in files("cfg", ".cfg"):
            for name in re.findall(r"\.add\('(\w+)'", text(file)):
                self.assertTrue(f"`~{name}` (dynamic)" in self.page, name)


class LoadsOfIso2307(unittest.TestCase):
    """The reference tension is d^2/8 daN, d in mm, and the cycles go to half of the breaking force, of each rope its own."""

    def test_the_page_has_those_of_the_ropes(self):
        page = text("doc/standards.md")
        section = page[page.index("## ISO 2307 with another rope"):page.index("## Inner diameter of a knot")]
        table = {name: [float(cell) for cell in found[0][1:]] for name, found in rows(section).items()}
        for name, numbers in table.items():
            material = yaml.safe_load(text(f"config/materials/{name}.yaml"))
            d, breaking_force = 2e3 * material["radius"], material["breaking_force"]
            expected = [d, breaking_force, 10.0 * d * d / 8.0, 0.5 * breaking_force]
            for number, exact in zip(numbers, expected):  # to a tenth
                self.assertLessEqual(abs(number - exact), 0.0501, name)
        self.assertGreaterEqual(set(table), {"nylon", "polypropylene", "polyester_cord"})


class Readme(unittest.TestCase):
    def test_is_read_in_one_go(self):
        self.assertLessEqual(len(text("README.md").splitlines()), 150)

    def test_leads_to_every_page(self):
        for document in documents()[1:]:
            self.assertTrue(f"]({document})" in text("README.md"), document)


class Documents(unittest.TestCase):
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

    def test_every_script_is_explained(self):
        pages = "".join(text(document) for document in documents())
        for file in glob.glob(os.path.join(ROOT, "scripts/*")):
            if os.path.isfile(file):
                self.assertTrue(f"scripts/{os.path.basename(file)}" in pages, file)

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

    def test_tests_of_promises_are_there(self):
        tests = [os.path.basename(file) for file in [*files("test", ""), *files("src/tools", "")]]
        for name in re.findall(r"`(\w+_test|\w+\.test)`", text("doc/developers/reliability.md")):
            self.assertTrue(any(file in (name, name + ".py", name + ".cpp") for file in tests), name)


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

    def test_links_name_the_doi_that_they_lead_to(self):
        dois = re.findall(r"\[doi:(\S+)\]\(https://doi\.org/(\S+)\)", text("doc/bibliography.md"))
        self.assertGreater(len(dois), 5)
        for said, led in dois:
            self.assertEqual(said, led.replace("%28", "(").replace("%29", ")"))


class Citation(unittest.TestCase):
    citation = yaml.safe_load(text("CITATION.cff"))

    def test_has_what_the_format_requires(self):
        self.assertEqual(self.citation["cff-version"], "1.2.0")
        for key in ("message", "title", "authors"):
            self.assertTrue(self.citation[key], key)
        for work in [self.citation, *self.citation["references"]]:
            for author in work["authors"]:
                self.assertTrue(set(author) in ({"name"}, {"given-names", "family-names"}), author)
        for reference in self.citation["references"]:
            self.assertTrue({"type", "title", "authors"} <= set(reference), reference)

    def test_version_and_licence_are_the_packages(self):
        package = xml.etree.ElementTree.parse(os.path.join(ROOT, "package.xml")).getroot()
        # CMakeLists.txt reads it there; a citation cannot.
        version = package.find("version").text
        self.assertRegex(version, r"^\d+\.\d+\.\d+$")
        self.assertEqual(self.citation["version"], version)
        self.assertNotRegex(text("CMakeLists.txt"), r"project\(knot_utm VERSION \d")
        self.assertEqual(self.citation["license"], package.find("license").text)

    def test_the_newest_section_of_the_changelog_is_the_packages(self):
        package = xml.etree.ElementTree.parse(os.path.join(ROOT, "package.xml")).getroot()
        # As bloom and catkin_prepare_release read headings: a version, its date, and a line below that is as long.
        sections = re.findall(r"^((?:\d+\.\d+\.\d+) \(\d{4}-\d{2}-\d{2}\)|Forthcoming)\n(-+)$", text("CHANGELOG.rst"), re.MULTILINE)
        self.assertTrue(all(len(heading) == len(line) for heading, line in sections))
        versions = [heading.split()[0] for heading, _ in sections if heading != "Forthcoming"]
        self.assertEqual(versions[0], package.find("version").text)

    def test_has_the_source_paper_as_the_bibliography_has_it(self):
        paper = self.citation["references"][0]
        for part in [paper["title"], paper["doi"], paper["start"], *(author["family-names"] for author in paper["authors"])]:
            self.assertIn(part, " ".join(text("doc/bibliography.md").split()))


if __name__ == "__main__":
    unittest.main()
