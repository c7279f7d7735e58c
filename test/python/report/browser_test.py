#!/usr/bin/python3
"""The report in a browser, and on paper: is everything drawn, does it fit, does it ask for anything, does the rod turn."""
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from html import escape

from runs import FISHERMAN, Folders, read, tool, write

WIDTHS = (360, 1280)  # a telephone, a desk [px]
# What the page cannot hide from itself, said where --dump-dom shows it. It stands in a frame, as no window is as narrow as a telephone.
FRAME = """<html><body><pre id=seen></pre><script>function tell(seen) {
  document.getElementById("seen").textContent = btoa(unescape(encodeURIComponent(JSON.stringify(seen)))); }
</script><iframe style="width: %dpx; height: 1500px; border: 0" srcdoc="%s"></iframe></body></html>"""
PROBE = """<script>window.addEventListener("load", () => {
  const figure = document.getElementById("turnable"), part = name => figure.querySelector("." + name), looks = [];
  const seen = {images: [...document.images].map(image => image.complete && image.naturalWidth > 100),
    requests: performance.getEntriesByType("resource").map(entry => entry.name),
    overflow: document.documentElement.scrollWidth - window.innerWidth};
  if (figure && !figure.hidden) {
    const mouse = (where, kind, x) => where.dispatchEvent(new MouseEvent(kind, {clientX: x, clientY: 100, button: 0, bubbles: true}));
    const look = event => { event(); looks.push(part("stage").toDataURL()); };  // there only until the browser takes it
    const set = (name, value, kind) => () => { part(name).value = value; part(name).dispatchEvent(new Event(kind)); };
    seen.words = [1, part("time").max].map(shape => { look(set("time", shape, "input")); return part("words").textContent; });
    seen.quantities = [...part("quantity").options].map(option => { look(set("quantity", option.value, "change")); return option.text; });
    look(() => { mouse(part("stage"), "mousedown", 200); mouse(document, "mousemove", 260); mouse(document, "mouseup", 260); });
    seen.looks = new Set(looks).size;
  }
  parent.tell(seen);
});</script>"""


def setUpModule():
    global folders, run, comparison, batch
    folders = Folders()
    run = folders.run("run", FISHERMAN, "--report")
    comparison, batch = os.path.join(folders.path, "comparison"), folders.run("batch", [*FISHERMAN, "--specimens", "2"], "--report")
    done = tool("compare", f"{run}/curve.csv", f"{batch}/specimen_002/curve.csv", "--report", comparison)
    assert done.returncode == 0, done.stderr


class InABrowser(unittest.TestCase):
    def seen(self, folder, width, graphics):
        file = os.path.join(folders.path, "probed.html")
        write(file, FRAME % (width, escape(read(folder, "report.html").replace("</body>", PROBE + "</body>"))))
        with tempfile.TemporaryDirectory(prefix="knot_utm_browser_") as profile:
            done = subprocess.run(["chromium", "--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", graphics,
                                   f"--user-data-dir={profile}", "--enable-logging=stderr", "--window-size=1350,1600", "--dump-dom",
                                   f"file://{file}"], capture_output=True, text=True, check=True, timeout=900)
        self.assertEqual([line for line in done.stderr.splitlines() if "CONSOLE" in line and "OpenGL, Performance" not in line], [])
        text = re.search(r'<pre id="seen">([^<]+)</pre>', done.stdout)[1]
        return json.loads(subprocess.run(["base64", "-d"], input=text, capture_output=True, text=True, check=True).stdout)

    def test_pages_are_whole_at_every_width_and_ask_for_nothing(self):
        for folder, images in ((run, 3), (comparison, 1), (batch, 1)):
            for width in WIDTHS:
                seen = self.seen(folder, width, "--disable-3d-apis")
                self.assertEqual(seen, {"images": images * [True], "requests": [], "overflow": seen["overflow"]})
                self.assertLessEqual(seen["overflow"], 0, (folder, width))

    def test_the_rod_follows_its_slider_turns_and_shows_all_that_is_known(self):
        seen = self.seen(run, 1280, "--enable-unsafe-swiftshader")  # by the processor, as no graphics card is there
        self.assertRegex(" ".join(seen["words"]), r"^tie, .* s = [\d.]+ mm, F = [\d.]+ N$")
        self.assertEqual(seen["quantities"],
                         ["tension of the rod [N]", "curvature times radius", "twist [rad/m]", "contact force per length [N/mm]"])
        self.assertEqual(seen["looks"], 2 + 4 - 1 + 1)  # the first colours are those that were there


class OnPaper(unittest.TestCase):
    def test_has_all_that_the_page_has(self):
        for folder, words in ((run, ("The line is the balanced load", "Results", "Quality certificate", "What was tested, and how", "--report")),
                              (batch, ("Standard deviation", "specimens keep all limits", "normal, 10 %")),
                              (comparison, ("locked_stiffness", "RMS difference", "simulated: Fisherman's knot"))):
            text = subprocess.run(["pdftotext", "-layout", os.path.join(folder, "report.pdf"), "-"], capture_output=True, text=True,
                                  check=True).stdout
            pages = text.split("\f")[:-1]
            for number, page in enumerate(pages, 1):
                self.assertRegex(page, rf"\b{number}\s*/\s*{len(pages)}\s*$")
                self.assertGreater(len(page.split()), 20, f"page {number} is all but empty")
            for one in words:
                self.assertIn(one, text)
            self.assertIn(words[0], pages[0] if folder == run else text, "the head leaves no room for the curve on its sheet")


if __name__ == "__main__":
    if not shutil.which("chromium") or not shutil.which("pdftotext"):
        sys.exit(77)
    unittest.main()
