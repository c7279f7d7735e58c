#!/usr/bin/python3
"""scripts/doc: Doxygen has nothing to complain of, the site has every page and every public header, and is read offline. Skipped,
with exit code 77, where Doxygen is not installed."""
import glob
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = os.path.realpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "../.."))


def text(path):
    with open(path, encoding="utf-8", errors="replace") as file:
        return file.read()


class Site(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.done = subprocess.run([os.path.join(ROOT, "scripts/doc"), folder.name], check=False, text=True,
                                  env={**os.environ, "KNOT_UTM_SKIP_BUILD": "1"}, stdin=subprocess.DEVNULL,
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        cls.html = os.path.join(folder.name, "html")
        cls.pages = {os.path.basename(page): text(page) for page in glob.glob(os.path.join(cls.html, "*.html"))}

    def setUp(self):
        self.assertEqual(self.done.returncode, 0, self.done.stdout)

    def test_has_every_page(self):
        self.assertIn("index.html", self.pages)
        for page in glob.glob(os.path.join(ROOT, "doc/**/*.md"), recursive=True):
            name = os.path.splitext(os.path.basename(page))[0]
            self.assertIn(f"page-{name}.html", self.pages)

    def test_has_every_public_header(self):
        files = self.pages["files.html"]
        for line in text(os.path.join(ROOT, "cmake/public_headers.txt")).splitlines():
            if line and not line.startswith("#"):
                self.assertTrue(f">{os.path.basename(line)}</a>" in files, line)
        self.assertTrue("<li>load_method()" in self.pages["namespacemembers_func.html"])

    def test_links_lead_to_what_is_there(self):
        places = {name: set(re.findall(r'(?:id|name)="([^"]+)"', page)) for name, page in self.pages.items()}
        checked = 0
        for name, page in self.pages.items():
            for link in re.findall(r'<(?:a|img|script|link)\b[^>]*?(?:href|src)="([^"]+)"', page):
                # Doxygen 1.9.4 links to the list of private classes, which it leaves out.
                if re.match(r"\w+:", link) or link == "#nested-classes":
                    continue
                file, _, place = link.partition("#")
                self.assertTrue(os.path.exists(os.path.join(self.html, file)), f"{name}: {link}")
                if place and (file or name) in places:
                    self.assertIn(place, places[file or name], f"{name}: {link}")
                checked += 1
        self.assertGreater(checked, 1000)

    def test_loads_nothing_from_the_web(self):
        for name, page in self.pages.items():
            loaded = re.findall(r'<(?:img|script|link)\b[^>]*?(?:href|src)="(\w+:[^"]*)"', page)
            self.assertEqual(loaded, [], name)


if __name__ == "__main__":
    if not shutil.which("doxygen"):
        print("skipped: Doxygen is not installed (scripts/doc installs it)")
        sys.exit(77)
    unittest.main()
