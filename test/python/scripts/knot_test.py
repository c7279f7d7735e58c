#!/usr/bin/python3
"""scripts/knot import: curves of other programs as the file of a knot, which stays the knot that it was."""
import json
import os
import re
import subprocess
import tempfile
import unittest

import numpy as np

from knot_utm.knot_diagram import diagram_in
from knot_utm.knot_drawing import closest_ways, drawn_through, through, tightest
from knot_utm.knot_shapes import curves_of

# Minimal stick knots 3_1 and 8_19, of github.com/thomaseddy/stick-knot-gen (stick_number/mseq_knots), rounded.
STICKS = {"determinant 3, ": """0.0 0.0 0.0
1.0 0.0 0.0
0.33458 0.74647 0.0
0.78021 0.25232 -0.74647
0.57673 -0.12149 0.15844
0.58142 0.71075 -0.39596
""", "polynomial 1 - t + t^3 - t^5 + t^6, ": """0.0\t0.0\t0.0
1.0\t0.0\t0.0
0.32715\t0.73978\t0.0
0.48650\t-0.24499\t0.06962
0.24831\t0.59954\t-0.41000
0.62218\t0.60062\t0.51749
0.36654\t-0.14559\t-0.09718
0.58833\t0.78497\t0.19413
"""}
# An overhand of straight pieces.
OPEN = "x,y,z\n0,0,-5\n0.6,0.3,2\n1.2,-0.8,-1.5\n-1.5,0.1,-0.2\n1.3,0.9,1.2\n0.1,-0.4,-1\n0,0,6\n"
# Two rings that hang in each other, as Geomview saves them (manual of Geomview, "VECT" and "INST").
RINGS = "VECT\n2 24 1\n-12 -12\n1 0\n{0}\n1 0 0 1\n"
SAVED = "# two rings, linked\n{{ # saved\n INST\n transform {{\n 2 0 0 0\n 0 2 0 0\n 0 0 2 0\n 9 9 9 1\n }}\n geom {{\n" \
    " appearance {{ material {{ ka 0.5 }} }}\n" + RINGS + " }}\n}}\n"
KNOT_INFO, KATLAS = "[[1,5,2,4],[3,1,4,6],[5,3,6,2]]", "PD[X[1, 4, 2, 5], X[3, 6, 4, 1], X[5, 2, 6, 3]]"
# The same trefoil in the forms of KnotTheory, Sage, pyknotid, and of tables of virtual knots.
GAUSS = ["GaussCode[-1, 2, -3, 1, -2, 3]", "[[[-1, 2, -3, 1, -2, 3]], [1, 1, 1]]", "1+c,2-c,3+c,1-c,2+c,3-c", "O1+U2+O3+U1+O2+U3+"]

SCRIPT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../../scripts/knot")


def trefoil(count=100):
    t = np.linspace(0.0, 2.0 * np.pi, count, endpoint=False)
    return np.column_stack([np.sin(t) + 2.0 * np.sin(2.0 * t), np.cos(t) - 2.0 * np.cos(2.0 * t), -np.sin(3.0 * t)])


def figure_eight(count=160):
    t = np.linspace(0.0, 2.0 * np.pi, count, endpoint=False)
    ring = 2.0 + np.cos(2.0 * t)
    return np.column_stack([ring * np.cos(3.0 * t), ring * np.sin(3.0 * t), np.sin(4.0 * t)])


def rows(points, between=" "):
    return "".join(between.join(f"{x:.6f}" for x in point) + "\n" for point in points)


def rings():
    t = np.linspace(0.0, 2.0 * np.pi, 12, endpoint=False)
    return rows(np.column_stack([np.cos(t), np.sin(t), 0 * t])) + rows(np.column_stack([1 + np.cos(t), 0 * t, np.sin(t)]))


def hooks():
    """Two elbows that hang in each other."""
    bend = np.linspace(-0.5, 0.5, 41) * np.pi
    far = np.linspace(4.0, 1.0, 20, endpoint=False)
    one = np.vstack([np.column_stack([0 * far - 1.5, 0 * far, -far]), 1.5 * np.column_stack([np.sin(bend), 0 * bend, np.cos(bend) - 0.6]),
                     np.column_stack([0 * far + 1.5, 0 * far, -far[::-1]])])
    other = one[:, [1, 0, 2]] * [1.0, 1.0, -1.0]
    return one, other


def writhe(curve):
    """Sum of the signs of the crossings of a closed polygon, as seen along z."""
    curve = curve + 1e-6 * np.random.default_rng(1).random(curve.shape)  # a corner lies at each crossing
    found, ways = 0, np.diff(curve, axis=0, append=curve[:1])
    for i in range(len(curve)):
        for j in range(i + 2, len(curve) - (i == 0)):
            plane = np.column_stack([ways[i, :2], -ways[j, :2]])
            s, t = np.linalg.solve(plane, (curve[j] - curve[i])[:2]) if abs(np.linalg.det(plane)) > 1e-9 else (-1, -1)
            if 0.0 <= s < 1.0 and 0.0 <= t < 1.0:
                found += np.sign(np.linalg.det(plane) * (curve[j] + t * ways[j] - curve[i] - s * ways[i])[2])
    return found


class Import(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def ask(self, shape, text, *words):
        with open(os.path.join(self.folder.name, shape), "w", encoding="utf-8") as file:
            file.write(text)
        return subprocess.run([SCRIPT, "import", shape, "--out", "knot.yaml", *words], check=False, text=True, cwd=self.folder.name,
                              env={**os.environ, "KNOT_UTM_SKIP_BUILD": "1"}, stdin=subprocess.DEVNULL, capture_output=True)

    def imported(self, *asked):
        done = self.ask(*asked)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def refused(self, why, *asked):
        before = set(os.listdir(self.folder.name)) | {asked[0]}
        done = self.ask(*asked)
        self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertIn(why, done.stderr)
        self.assertEqual(set(os.listdir(self.folder.name)), before)

    def test_a_closed_curve_of_knotplot_is_opened_and_stays_its_knot(self):
        said = self.imported("trefoil.txt", rows(trefoil()), "--title", "My trefoil")
        self.assertIn("title: My trefoil\nstrands: 1\nheld: a2 by the lower grip, a1 by the upper grip\n", said)
        self.assertIn("determinant 3, ", said)
        distance = float(said.split("least distance of strands: ")[1].split()[0])
        self.assertTrue(2.0 <= distance < 2.6, said)

    def test_a_polyline_of_geomview(self):
        text = "VECT # one, closed\n1 160 0\n-160\n0\n" + rows(7.0 * figure_eight() + 100.0)
        self.assertIn("determinant 5, ", self.imported("eight.vect", text))

    def test_several_ropes_by_their_numbers(self):
        text = "x,y,z,rope\nm,m,m,-\n" + "".join(rows(np.column_stack([line, np.full(len(line), rope)]), ",")
                                               for rope, line in enumerate(hooks(), 1))
        said = self.imported("hooks.csv", text, "--lower", "a1", "a2", "--upper", "b1", "b2")
        self.assertIn("strands: 2\nheld: a1 and a2 by the lower grip, b1 and b2 by the upper grip\npulled: none\n", said)
        self.assertEqual(self.ask("hooks.csv", text).returncode, 2)  # it is there already
        self.assertIn("pulled: ", self.imported("hooks.csv", text, "--overwrite"))

    def test_corners_are_rounded_and_the_knot_stays(self):
        for kind, text in STICKS.items():
            said = self.imported("sticks.txt", text, "--overwrite")
            self.assertIn(kind, said)
            self.assertIn("drawn loosely", said)
            self.assertGreaterEqual(float(said.split("least distance of strands: ")[1].split()[0]), 2.0)
            with open(os.path.join(self.folder.name, "knot.yaml"), encoding="utf-8") as file:
                self.assertLess(np.abs([float(one) for row in re.findall(r"- \[(.*?)\]\n", file.read()) for one in row.split(",")
                                        if "." in one]).max(), 40.0)
        self.assertIn("held: a1 by the lower grip, a2 by the upper grip\n", self.imported("open.csv", OPEN, "--overwrite"))
        self.assertIn("determinant 3, ", self.imported("open.csv", OPEN, "--overwrite"))

    def test_linked_curves_are_opened_side_by_side(self):
        for kind, text in (("a.vect", SAVED.format(rings())), ("a.txt", "[(4,1,3,2),(2,3,1,4)]")):
            said = self.imported(kind, text, "--overwrite")
            self.assertIn("strands: 2\n", said)
            self.assertRegex(said, "linking number of ropes 1 and 2: -?1, ")

    def test_codes_of_diagrams(self):
        self.assertIn("determinant 3, ", self.imported("knot_3_1.txt", "3_1: " + KNOT_INFO))
        self.assertIn("determinant 5, ", self.imported("knot_4_1.txt", "{-1, 2, -3, 1, -4, 3, -2, 4}", "--overwrite"))

    def test_is_refused_in_one_line(self):
        self.refused("row 2 is \"1 2\", but must be three numbers", "a.txt", "0 0 0\n1 2\n")
        self.refused("row 1: x is no number", "a.txt", "x 0 0\n")
        self.refused("it names more points than it has", "a.vect", "VECT 1 4 0 4 0 0 0 0 1 1 1\n")
        self.refused("has 2 different points", "a.csv", "x,y,z\n0,0,0\n1,1,1\n")
        self.refused("it holds no curve", "a.csv", "x,y,z\n")
        self.refused("some of its curves are closed and others are not", "a.vect", "VECT 2 10 0 -5 5 0 0 " + rows(trefoil(10)))
        self.refused("the code of no diagram in a plane", "a.txt", "O1+O2+U1+U2+")
        self.refused("it is neither JSON nor the code of a diagram", "a.json", "[[0, 0, 1.5], ")
        self.refused("its brackets stand too deep", "a.json", "[" * 100000)
        self.refused("no end is called c1; the ends are a1, a2", "a.txt", rows(trefoil()), "--lower", "c1")
        self.refused("a1 cannot be held below and above", "a.txt", rows(trefoil()), "--lower", "a1", "--upper", "a1")
        self.refused("1e200 is no number, but must be one of at most 1e+100", "a.txt", "1e200 0 0\n")
        nine = "".join(f"{x},{y},0,{rope}\n" for rope in range(9) for x, y in ((0, 0), (1, 0), (1, 1), (2, 1)))
        self.refused("it holds 9 curves, but a knot may have at most 8 ropes", "a.csv", "x,y,z,rope\n" + nine)
        self.refused("no strand comes near another one", "a.csv", rows(np.arange(30.0)[:, None] * [0.0, 0.0, 1.0], ","))

    def test_a_curve_that_crosses_itself_is_refused_by_its_rows(self):
        self.refused("a.txt: row 5 and row 63: there it crosses itself or turns back", "a.txt", rows(trefoil() * [1.0, 1.0, 0.0]))
        self.refused("a.csv: row 2 and row 3: there it crosses itself", "a.csv", "x,y,z\n0,0,0\n0,0,1\n0,0,0.2\n0.5,0.5,0.5\n")
        flat = "VECT 1 200 0 -200 0\n" + rows(trefoil(200) * [1.0, 1.0, 0.0])
        self.refused("a.vect: point 9 and point 125: there", "a.vect", flat)
        many = np.random.default_rng(1).random((20000, 3))
        self.refused("there its strands come so near to each other", "a.txt", rows(many))

    def test_what_is_no_file_of_that_size_is_refused(self):
        self.refused("a.txt: it has 17,000,000 bytes, but may have at most 16,000,000", "a.txt", "1 2 3 4\n" * 2125000)
        for shape in ("/dev/zero", "."):
            done = subprocess.run([SCRIPT, "import", shape, "--out", "knot.yaml"], check=False, text=True, cwd=self.folder.name,
                                  env={**os.environ, "KNOT_UTM_SKIP_BUILD": "1"}, stdin=subprocess.DEVNULL, capture_output=True)
            self.assertEqual((done.returncode, done.stderr),
                             (2, f"knot: {shape}: it is a folder, a device or a pipe, but must be a file of text\n"))

    def test_a_folder_that_cannot_be_written_to_is_refused(self):
        for out in ("/proc/knot.yaml", "/dev/null/knot.yaml", "not_there/knot.yaml"):
            self.refused(f"--out: cannot write {out}: no", "a.txt", rows(trefoil()), "--out", out)


class Shape(unittest.TestCase):
    def read(self, text):
        with tempfile.NamedTemporaryFile("w", suffix=".txt") as file:
            file.write(text)
            file.flush()
            return curves_of(file.name)

    def test_a_diagram_keeps_its_hand(self):
        self.assertEqual([writhe(diagram_in("", code)[0][0]) for code in (KNOT_INFO, KATLAS, *GAUSS[1:])], [3, -3, 3, 3, 3])
        self.assertEqual(abs(writhe(diagram_in("", GAUSS[0])[0][0])), 3)  # it does not tell
        self.assertEqual(abs(writhe(diagram_in("", "X[1,2,2,3], X[3,4,4,1]")[0][0])), 2)  # two kinks
        self.assertIsNone(diagram_in("", "1 2 3\n4 5 6\n"))

    def test_where_geomview_moved_it(self):
        plain, saved = self.read("# one\n" + RINGS.format(rings())), self.read(SAVED.format(rings()))
        behind = self.read("INST geom { " + RINGS.format(rings()) + " } transform 2 0 0 0 0 2 0 0 0 0 2 0 9 9 9 1")
        for one, moved, also in zip(plain, saved, behind):
            np.testing.assert_allclose(2.0 * one.points + 9.0, moved.points)
            np.testing.assert_allclose(moved.points, also.points)

    def test_what_is_closed(self):
        points = trefoil(40).round(4)
        cut = np.vstack([points[:-1], points[0] + [0.02, -0.05, 0.0]])
        self.assertTrue(self.read(rows(cut, ","))[0].closed)
        self.assertTrue(self.read(rows(trefoil(30), ","))[0].closed)
        self.assertFalse(self.read(rows(points[:-3], ","))[0].closed)
        named = json.dumps({"closed": False, "points": [dict(zip("xyz", point)) for point in points.tolist()]})
        for text, closed in ((json.dumps(points.tolist()), True), (json.dumps({"x": [0, 1, 2, 3.5], "y": [0] * 4, "z": [0] * 4}), False),
                             (named, False), (json.dumps({"components": [points.tolist(), points.tolist()]}), True)):
            self.assertEqual({one.closed for one in self.read(text)}, {closed})

    def test_the_distance_of_two_segments_is_the_least_of_their_points(self):
        p, u, q, v = np.random.default_rng(2).normal(size=(4, 50, 3))
        at = np.linspace(0.0, 1.0, 201)
        points = [start[:, None] + at[:, None] * way[:, None] for start, way in ((p, u), (q, v))]
        sampled = np.array([np.linalg.norm(one[:, None] - other, axis=2).min() for one, other in zip(*points)])
        found = np.linalg.norm(closest_ways(p, u, q, v)[0], axis=1)
        spacing = (np.linalg.norm(u, axis=1) + np.linalg.norm(v, axis=1)) / 400.0  # half of the samples'
        self.assertTrue((found <= sampled + 1e-12).all() and (sampled <= found + spacing).all())

    def test_the_radius_is_that_of_strands_that_nearly_touch(self):
        far = np.linspace(-50.0, 50.0, 400)
        crossed = [np.column_stack([far, 0 * far, 0 * far]), np.column_stack([0 * far, far, 0 * far + 4.4])]
        self.assertAlmostEqual(tightest(crossed, False)[0], 2.0, delta=0.1)

    def test_few_points_draw_the_same_curve(self):
        t = np.linspace(0.0, 4.0 * np.pi, 400)
        helix = np.column_stack([4.0 * np.cos(t), 4.0 * np.sin(t), t])
        points = drawn_through(helix)
        self.assertLess(len(points), 60)
        away = np.linalg.norm(helix[:, None] - through(points), axis=2).min(axis=1)
        self.assertLess(away.max(), 0.1)


if __name__ == "__main__":
    unittest.main()
