#!/usr/bin/python3
"""README.md and doc/ against the code: keys and their ranges, launch arguments, names, tests, files."""
import os
import re
import unittest

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../..")


def text(path):
    with open(os.path.join(ROOT, path), encoding="utf-8") as file:
        return file.read()


def rows(readme):
    """Rows of its tables, by the words in backticks in the first cell."""
    found = {}
    for line in readme.splitlines():
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


class Readme(unittest.TestCase):
    readme = text("README.md")
    rows = rows(readme)

    def test_has_every_key_of_a_method(self):
        for key in re.findall(r'(?:number|integer|text|flag|choice|vector)\("(\w+)"', text("src/io/method_fields.hpp")):
            self.assertTrue(re.search(rf"`(\w+\.)*{key}`", self.readme), key)

    def test_ranges_are_those_of_the_code(self):
        allowed = {}  # a name may stand in two sections, with a range in each
        for key, low, high in re.findall(r'number\("(\w+)", [\w.]+, Range\{([^,]+), ([^,]+),',
                                         text("src/io/method_fields.hpp")):
            allowed.setdefault(key, []).append([float(low), float(high.replace("kInfinity", "inf"))])
        checked = 0
        for word, found in self.rows.items():
            ranges = allowed.get(word.split(".")[-1])
            for cells in found:
                if ranges and len(cells) == 5 and cells[1] == "number":
                    self.assertTrue(numbers(cells[3])[:2] in ranges or len(found) > 1, f"{word}: {cells[3]}")
                    checked += 1
        self.assertGreater(checked, 20)

    def test_has_every_key_of_a_result(self):
        for key in re.findall(r'lines\.\w+\("(\w+)"', text("src/io/run_writer.cpp")):
            self.assertTrue(key in self.rows, key)

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
            self.assertTrue(f"`{name}`" in self.readme, name)

    def test_has_every_message(self):
        for file in [*files("msg", ".msg"), *files("action", ".action")]:
            name = os.path.splitext(os.path.basename(file))[0]
            self.assertTrue(f"knot_utm/{name}`" in self.readme, name)

    def test_has_every_dynamic_parameter(self):
        for file in files("cfg", ".cfg"):
            for name in re.findall(r"\.add\('(\w+)'", text(file)):
                self.assertTrue(f"`~{name}` (dynamic)" in self.readme, name)


class Documents(unittest.TestCase):
    def test_links_and_files_are_there(self):
        for document in ("README.md", "doc/model.md", "doc/performance.md", "doc/references.md", "doc/reliability.md",
                         "doc/terminology.md", "doc/tutorial.md"):
            folder = os.path.dirname(document)
            for target in re.findall(r"\]\(([^)#]+)\)", text(document)):
                self.assertTrue(os.path.exists(os.path.join(ROOT, folder, target)), f"{document}: {target}")
            for header in re.findall(r"`([\w/]+\.(?:hpp|cpp))`", text(document)):
                places = [header, "include/knot_utm/" + header]
                beside = any(file.endswith("/" + header) for file in files("include", ".hpp"))
                self.assertTrue(beside or any(os.path.exists(os.path.join(ROOT, place)) for place in places),
                                f"{document}: {header}")

    def test_named_tests_are_there(self):
        suites = set()
        for file in files("test", "_test.cpp"):
            suites.update(re.findall(r"^(?:TYPED_)?TEST(?:_F|_P)?\((\w+),", text(file), re.MULTILINE))
        for name in re.findall(r"`((?:R\d+|K\d+)\w+|StencilAt|StretchingOf|IsotropicBendingBy|SmoothContactJacobian)",
                               text("doc/references.md")):
            self.assertTrue(name in suites, name)

    def test_promises_have_their_tests(self):
        tests = {f"{suite}.{name}" for file in files("test", "_test.cpp")
                 for suite, name in re.findall(r"^(?:(?:TYPED_)?TEST(?:_F|_P)?|RC_GTEST_PROP|RC_GTEST_FIXTURE_PROP)\((\w+),\s*(\w+)", text(file), re.MULTILINE)}
        launched = {name for file in files("test/ros", "_test.py") for name in re.findall(r"def (test_\w+)", text(file))}
        named = re.findall(r"`(\w+)(\.\w+)?`", text("doc/reliability.md"))
        for suite, name in named:
            if re.match(r"[A-Z]", suite) and name:
                self.assertTrue(suite + name in tests, suite + name)
            elif suite.startswith("test_"):
                self.assertTrue(suite in launched, suite)
        self.assertGreater(len(named), 20)

    def test_tests_of_promises_are_there(self):
        tests = [os.path.basename(file) for file in [*files("test", ""), *files("src/tools", "")]]
        for name in re.findall(r"`(\w+_test|\w+\.test)`", text("doc/reliability.md")):
            self.assertTrue(any(file in (name, name + ".py", name + ".cpp") for file in tests), name)


if __name__ == "__main__":
    unittest.main()
