#!/usr/bin/python3
"""scripts/knot import: curves of other programs as the file of a knot, which stays the knot that it was."""
import os
import subprocess
import tempfile
import unittest

import numpy as np

from knot_utm.knot_drawing import drawn_through, segments_apart, through, tightest

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


def hooks():
    """Two elbows that hang in each other."""
    bend = np.linspace(-0.5, 0.5, 41) * np.pi
    far = np.linspace(4.0, 1.0, 20, endpoint=False)
    one = np.vstack([np.column_stack([0 * far - 1.5, 0 * far, -far]), 1.5 * np.column_stack([np.sin(bend), 0 * bend, np.cos(bend) - 0.6]),
                     np.column_stack([0 * far + 1.5, 0 * far, -far[::-1]])])
    other = one[:, [1, 0, 2]] * [1.0, 1.0, -1.0]
    return one, other


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

    def test_is_refused_in_one_line(self):
        self.refused("row 2 is \"1 2\", but must be three numbers", "a.txt", "0 0 0\n1 2\n")
        self.refused("row 1: x is no number", "a.txt", "x 0 0\n")
        self.refused("it names more points than it has", "a.vect", "VECT 1 4 0 4 0 0 0 0 1 1 1\n")
        self.refused("has 2 different points", "a.csv", "x,y,z\n0,0,0\n1,1,1\n")
        self.refused("it holds no curve", "a.csv", "x,y,z\n")
        self.refused("a closed curve must be the only one", "a.txt", rows(trefoil()) + "\n" + rows(trefoil() + 9.0))
        self.refused("no end is called c1; the ends are a1, a2", "a.txt", rows(trefoil()), "--lower", "c1")
        self.refused("a1 cannot be held below and above", "a.txt", rows(trefoil()), "--lower", "a1", "--upper", "a1")
        self.refused("1e200 is no number, but must be one of at most 1e+100", "a.txt", "1e200 0 0\n")
        nine = "".join(f"{x},{y},0,{rope}\n" for rope in range(9) for x, y in ((0, 0), (1, 0), (1, 1), (2, 1)))
        self.refused("it holds 9 curves, but a knot may have at most 8 ropes", "a.csv", "x,y,z,rope\n" + nine)
        self.refused("no strand comes near another one", "a.csv", rows(np.arange(30.0)[:, None] * [0.0, 0.0, 1.0], ","))

    def test_a_curve_that_crosses_itself_is_refused_by_its_rows(self):
        self.refused("a.txt: row 5 and row 63: there it comes nearer to itself than 1/313 of its size", "a.txt", rows(trefoil() * [1.0, 1.0, 0.0]))
        self.refused("a.csv: row 2 and row 4: there it comes nearer to itself", "a.csv", "x,y,z\n0,0,0\n0,0,1\n0.001,0,0\n0.5,0.5,0.5\n")
        flat = "VECT 1 200 0 -200 0\n" + rows(trefoil(200) * [1.0, 1.0, 0.0])
        self.refused("a.vect: point 10 and point 126: there", "a.vect", flat)
        many = np.random.default_rng(1).random((20000, 3))
        self.refused("there it comes nearer to itself", "a.txt", rows(many))

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
    def test_the_distance_of_two_segments_is_the_least_of_their_points(self):
        p, u, q, v = np.random.default_rng(2).normal(size=(4, 50, 3))
        at = np.linspace(0.0, 1.0, 201)
        points = [start[:, None] + at[:, None] * way[:, None] for start, way in ((p, u), (q, v))]
        sampled = np.array([np.linalg.norm(one[:, None] - other, axis=2).min() for one, other in zip(*points)])
        found = segments_apart(p, u, q, v)
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
