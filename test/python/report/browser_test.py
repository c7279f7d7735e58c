#!/usr/bin/python3
"""The report in a browser, and on paper: is everything drawn, does it fit, does it ask for anything."""
import json
import os
import re
import subprocess
import tempfile
import unittest
from html import escape

from runs import FISHERMAN, Folders, read, tool, write

import matplotlib.image
import numpy as np
import yaml

from knot_utm.report import style

NO_WEBGL, WEBGL = ["--disable-3d-apis"], ["--enable-unsafe-swiftshader"]  # by the processor, as no graphics card is there
WIDTH = 1200                    # of the window [px]
WIDTHS = (360, 720, 1280)  # a telephone, a tablet, a desk [px]
SMALLEST, DRAWN = 12.0, 10.0    # letters of the page, and those in its figures [px]

# What the page cannot hide from itself, said where --dump-dom shows it. It stands in a frame, as no window is as narrow as
# a telephone.
FRAME = """<html><body><pre id=seen></pre><script>function tell(text) { document.getElementById("seen").textContent = text; }
</script><iframe style="width: %dpx; height: 1500px; border: 0" srcdoc="%s"></iframe></body></html>"""
PROBE = """<script>window.addEventListener("load", () => {
  const seen = {
    images: [...document.images].map(image => [image.complete, image.naturalWidth, image.clientWidth]),
    requests: performance.getEntriesByType("resource").map(entry => entry.name),
    overflow: document.documentElement.scrollWidth - window.innerWidth,
    height: document.documentElement.scrollHeight,
    letters: Math.min(...[...document.querySelectorAll("body *")]
      .filter(element => [...element.childNodes].some(node => node.nodeType == 3 && node.data.trim())
        && element.tagName != "SCRIPT" && element.offsetWidth > 0)
      .map(element => parseFloat(getComputedStyle(element).fontSize))),
    outside: [...document.querySelectorAll("body *")].filter(element =>
      element.getBoundingClientRect().right > window.innerWidth + 0.5).map(element => element.outerHTML.slice(0, 200)),
    narrow: [...document.images].map(image => image.currentSrc != image.src),
    keys: [...document.querySelectorAll("[data-key]")].map(element => element.dataset.key),
    text: document.body.innerText };
  parent.tell(btoa(unescape(encodeURIComponent(JSON.stringify(seen)))));
});</script>"""

# What the rod that can be turned does when it is used. The bytes of a picture are there only until the browser takes it.
USE = """<script>window.addEventListener("load", () => {
  const figure = document.getElementById("turnable"), part = name => figure.querySelector("." + name);
  const looks = () => {
    const marker = part("marker");
    return {words: part("words").textContent, cx: Number(marker.getAttribute("cx")), cy: Number(marker.getAttribute("cy")),
            marked: marker.style.display != "none"};
  };
  const drawn = event => { event(); return part("stage").toDataURL(); };
  const set = (name, value, kind) => () => { part(name).value = value; part(name).dispatchEvent(new Event(kind)); };
  const mouse = (where, kind, x) => where.dispatchEvent(new MouseEvent(kind,
    {clientX: x, clientY: 100, button: 0, bubbles: true, cancelable: true}));
  const used = {hidden: figure.hidden, shapes: Number(part("time").max) + 1, states: [], quantities: []};
  const pictures = [];
  for (const shape of SHAPES) {
    pictures.push(drawn(set("time", shape < 0 ? used.shapes + shape : shape, "input")));
    used.states.push(looks());
  }
  used.shapes_drawn = new Set(pictures).size;
  const colours = [...part("quantity").options].map(option => {
    const picture = drawn(set("quantity", option.value, "change"));
    used.quantities.push([option.text, part("ticks").children.length]);
    return picture;
  });
  used.colours_drawn = new Set(colours).size;
  const turned = drawn(() => {
    mouse(part("stage"), "mousedown", 200); mouse(document, "mousemove", 260); mouse(document, "mouseup", 260);
  });
  used.turned = turned != colours[colours.length - 1];
  set("time", 0, "input")();
  const box = part("course").getBoundingClientRect();
  part("course").dispatchEvent(new MouseEvent("click", {clientX: box.left + used.states[1].cx, bubbles: true}));
  used.clicked = looks();
  parent.tell(btoa(unescape(encodeURIComponent(JSON.stringify(used)))));
});</script>"""


def setUpModule():
    global folders, run, comparison, batch
    folders = Folders()
    run = folders.run("run", FISHERMAN, "--report", "--set", "report={specimen_id: 山田太郎, conditioning: C, terminations: T}")
    other = folders.run("other", [*FISHERMAN, "--set", "material.friction_coefficient=0.5"])
    comparison = os.path.join(folders.path, "comparison")
    done = tool("compare", f"{run}/curve.csv", f"{other}/curve.csv", "--report", comparison)
    assert done.returncode == 0, done.stderr
    batch = folders.run("batch", [*FISHERMAN, "--specimens", "2"], "--report")


def chromium(*arguments, graphics=NO_WEBGL):
    with tempfile.TemporaryDirectory(prefix="knot_utm_browser_") as profile:
        done = subprocess.run(["chromium", "--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars",
                               "--disable-dev-shm-usage", *graphics, f"--user-data-dir={profile}", "--enable-logging=stderr",
                               *arguments], capture_output=True, text=True, check=False, timeout=900)
    assert done.returncode == 0, done.stderr
    return done


def in_browser(html, width=WIDTH, probe=PROBE, graphics=NO_WEBGL):
    """What the page is like once loaded, and what the console says, but for what it says of slow graphics."""
    file = os.path.join(folders.path, "probed.html")
    write(FRAME % (width, escape(html.replace("</body>", probe + "</body>"))), file)
    done = chromium(f"--window-size={max(width, WIDTH) + 50},1600", "--dump-dom", f"file://{file}",
                    graphics=graphics)
    seen = re.search(r'<pre id="seen">([^<]+)</pre>', done.stdout)
    assert seen, done.stdout[-2000:] + done.stderr
    decoded = subprocess.run(["base64", "-d"], input=seen.group(1), capture_output=True, text=True, check=True).stdout
    return json.loads(decoded), [line for line in done.stderr.splitlines() if "CONSOLE" in line and "OpenGL, Performance" not in line]


def in_mm(length):
    """As the page writes a length, with as many digits as its error leaves."""
    either = "|".join(re.escape(f"{1e3 * length:.{digits}f}") for digits in (1, 2))
    return rf"(?<![\d.])({either})(?!\d)"


class InABrowser(unittest.TestCase):
    def is_whole_and_legible(self, folder, images, facts):
        """At every width; what was seen at the last one."""
        for width in WIDTHS:
            seen, console = in_browser(read(folder, "report.html"), width)
            look = style.NARROW if width <= 760 else style.WIDE
            self.assertEqual((console, seen["requests"], seen["outside"]), ([], [], []), width)
            self.assertLessEqual(seen["overflow"], 0, width)
            self.assertGreaterEqual(seen["letters"], SMALLEST, width)
            self.assertEqual(set(seen["narrow"]), {look.is_narrow}, width)
            self.assertEqual(len(seen["images"]), images)
            for complete, natural, drawn in seen["images"]:
                self.assertTrue(complete and natural > 100, seen["images"])
                self.assertGreaterEqual(drawn / look.width * style.SMALL / 72.0, DRAWN, width)
            self.assertEqual(set(yaml.safe_load(read(folder, facts))) - set(seen["keys"]), set())
        return seen

    def test_the_page_of_a_run_is_whole_and_legible_at_every_width(self):
        seen = self.is_whole_and_legible(run, 3, "result.yaml")
        self.assertRegex(seen["text"], in_mm(yaml.safe_load(read(run, "result.yaml"))["lock_extension"]))

    def test_the_page_of_a_comparison_is_whole_and_legible_at_every_width(self):
        self.is_whole_and_legible(comparison, 1, "comparison.yaml")

    def test_the_page_of_a_batch_is_whole_and_legible_at_every_width(self):
        self.is_whole_and_legible(batch, 1, "statistics.yaml")

    def test_what_is_not_whole_would_be_seen(self):
        seen, console = in_browser('<html><body><img src="data:image/png;base64,AAAA">'
                                   '<img src="http://127.0.0.1:9/x.png"><div style="width: 3000px">.</div>'
                                   '<script>console.error("seen");</script>'
                                   '</body></html>')
        self.assertEqual([natural for _, natural, _ in seen["images"]], [0, 0])
        self.assertIn("http://127.0.0.1:9/x.png", seen["requests"])
        self.assertGreater(seen["overflow"], 0)
        self.assertEqual(len(seen["outside"]), 1)
        self.assertTrue(any("seen" in line for line in console), console)

    def test_the_pictures_are_not_blank(self):
        seen, _ = in_browser(read(run, "report.html"))
        shot = os.path.join(folders.path, "shot.png")
        chromium(f"--window-size={WIDTH},{seen['height']}", f"--screenshot={shot}", f"file://{run}/report.html")
        pixels = matplotlib.image.imread(shot)[:, :, :3]
        self.assertEqual(pixels.shape[:2], (seen["height"], WIDTH))
        # The load in blue, the tension of the locked rod in dark red.
        red, green, blue = (pixels[:, :, i] for i in range(3))
        self.assertGreater(int(((blue > 0.5) & (red < 0.25) & (green < 0.5)).sum()), 500)
        self.assertGreater(int(((red > 1.6 * green) & (red > 1.2 * blue) & (red > 0.25)).sum()), 2000)


class ARodToTurn(unittest.TestCase):
    def used(self, folder, *shapes):
        seen, console = in_browser(read(folder, "report.html"), probe=USE.replace("SHAPES", json.dumps(shapes)), graphics=WEBGL)
        self.assertEqual(console, [])
        self.assertFalse(seen["hidden"])
        return seen

    def test_follows_the_slider_and_so_does_the_mark_on_the_curve(self):
        seen = self.used(run, 1, -1, -10, -20)
        states = seen["states"]
        self.assertEqual(seen["shapes_drawn"], 4)
        self.assertEqual([state["marked"] for state in states], [False, True, True, True])
        self.assertRegex(states[0]["words"], "^tie, ")
        places = [(float(s), float(force), state["cx"], state["cy"]) for state in states[1:]
                  for s, force in re.findall(r"s = ([\d.]+) mm, F = ([\d.]+) N", state["words"])]
        self.assertEqual(len(places), 3)
        for column in (0, 1):  # both axes are straight: extension to the right, load upwards
            value, at = ([place[column + 2 * k] for place in places] for k in (0, 1))
            slope = (at[2] - at[0]) / (value[2] - value[0])
            self.assertGreater(slope if column == 0 else -slope, 0.0)
            self.assertAlmostEqual(at[1], at[0] + slope * (value[1] - value[0]), delta=1.0)
        self.assertEqual(seen["clicked"]["words"], states[1]["words"])

    def test_turns_and_shows_all_that_is_known(self):
        seen = self.used(run, 0, -1)
        self.assertEqual([text for text, _ in seen["quantities"]],
                         ["tension of the rod [N]", "curvature times radius", "twist [rad/m]", "contact force per length [N/mm]"])
        self.assertGreaterEqual(min(ticks for _, ticks in seen["quantities"]), 2)
        self.assertEqual(seen["colours_drawn"], 4)
        self.assertTrue(seen["turned"])

    def test_shows_twist_where_the_test_solves_for_it(self):
        twisted = folders.run("twisted", ["config/overhand.yaml", "--set", "physics.accuracy=draft", "--set",
                                          "program=[{balance: {}}, {hold: {duration: 1}}]"], "--report")
        self.assertIn("twist [rad/m]", [text for text, _ in self.used(twisted, 0, -1)["quantities"]])

    def test_is_drawn_in_colour_and_on_a_page_that_fits(self):
        for width in (360, WIDTH):
            seen, console = in_browser(read(run, "report.html"), width, graphics=WEBGL)
            self.assertEqual((seen["overflow"], seen["outside"], seen["requests"], console), (0, [], [], []))
            self.assertGreaterEqual(seen["letters"], SMALLEST)
        shot, alone = (os.path.join(folders.path, name) for name in ("rod.png", "rod.html"))
        write(read(run, "report.html").replace("</body>", """<script>for (const one of document.body.children)
          one.hidden = one.id != "turnable"; document.querySelector(".course").remove();
          document.querySelector(".above").remove();</script></body>"""), alone)
        chromium(f"--window-size={WIDTH},600", f"--screenshot={shot}", f"file://{alone}", graphics=WEBGL)
        red, green, blue = np.moveaxis(matplotlib.image.imread(shot)[:, :, :3], 2, 0)
        self.assertGreater(int(((red > blue + 0.2) & (green > blue)).sum()), 2000, "the rod under tension, in orange")

    def test_without_webgl_leaves_the_page_as_it_is(self):
        seen, console = in_browser(read(run, "report.html"), probe="""<script>window.addEventListener("load", () =>
          parent.tell(btoa(JSON.stringify({hidden: document.getElementById("turnable").hidden,
            high: document.getElementById("turnable").offsetHeight})))); </script>""")
        self.assertEqual((seen, console), ({"hidden": True, "high": 0}, []))


class OnPaper(unittest.TestCase):
    def pages(self, folder):
        file = os.path.join(folder, "report.pdf")
        facts = subprocess.run(["pdfinfo", file], capture_output=True, text=True, check=True).stdout
        self.assertIn("(A4)", facts)
        self.assertNotIn("CreationDate", facts)
        text = subprocess.run(["pdftotext", "-layout", file, "-"], capture_output=True, text=True, check=True).stdout
        pages = text.split("\f")[:-1]
        self.assertEqual(len(pages), int(re.search(r"Pages:\s+(\d+)", facts).group(1)))
        for number, page in enumerate(pages, 1):
            self.assertRegex(page, rf"\b{number}\s*/\s*{len(pages)}\s*$")
            self.assertGreater(len(page.split()), 20, f"page {number} is all but empty")
        return text

    def test_a_run(self):
        text = self.pages(run)
        for words in ("Fisherman's knot, polypropylene", "Force and extension", "The rod at the marked points",
                      "Results", "Quality certificate", "What was tested, and how", "Where this page comes from", "--report"):
            self.assertIn(words, text)
        self.assertIn("The line is the balanced load", text.split("\f")[0], "the head leaves no room for the curve on its sheet")
        lock = yaml.safe_load(read(run, "result.yaml"))["lock_extension_by_load"]
        self.assertRegex(text, rf"lock_extension_by_load\s+{in_mm(lock)}")

    def test_a_batch(self):
        text = self.pages(batch)
        for words in ("Means of the 2 specimens that count", "Kept by", "Standard deviation", "95 % interval of the mean, high end",
                      "specimens keep all limits", "What was drawn for each specimen", "normal, 10 %"):
            self.assertIn(words, text)

    def test_a_comparison(self):
        text = self.pages(comparison)
        for words in ("Comparison of two curves", "locked_stiffness", "RMS difference", "simulated: Fisherman's knot"):
            self.assertIn(words, text)


if __name__ == "__main__":
    unittest.main()
