#!/usr/bin/python3
"""scripts/movie: how many pictures of which size a movie has, and what is on them. Movies of a few pictures only."""
import json
import os
import subprocess
import unittest

from runs import ROOT, STRAIGHT, Folders

import numpy as np

from knot_utm.report.movie import OneTest, Stage

MOVIE = os.path.join(ROOT, "scripts/movie")
HIGH, WIDE = 1080, 1920


def setUpModule():
    global folders, nylon, other
    folders = Folders()
    draft = ["config/tighten.yaml", "--set", "material.bending_law=elastic", "--set", "material.friction_couple=0", "--set",
             "physics.accuracy=draft"]
    nylon = folders.run("nylon", draft, "--shapes")
    other = folders.run("other", [*draft, "--set", "material=polypropylene"], "--shapes")


def movie(*arguments):
    return subprocess.run([MOVIE, *arguments], cwd=folders.path, capture_output=True, text=True, check=False,
                          env={**os.environ, "KNOT_UTM_SKIP_BUILD": "1"})


def pictures_of(file):
    done = subprocess.run(["ffmpeg", "-loglevel", "error", "-i", file, "-f", "rawvideo", "-pix_fmt", "rgb24", "-"],
                          capture_output=True, check=True)
    return np.frombuffer(done.stdout, np.uint8).reshape(-1, HIGH, WIDE, 3).astype(int)


def orange_rows(picture):
    """How many pixels of the rod's colours under tension each half has."""
    red, green, blue = picture[:HIGH // 2, :, 0], picture[:HIGH // 2, :, 1], picture[:HIGH // 2, :, 2]
    of_rod = (red > blue + 40) & (red > green)
    return int(of_rod[:, :WIDE // 2].sum()), int(of_rod[:, WIDE // 2:].sum())


class Movie(unittest.TestCase):
    def test_of_two_runs_has_both_in_every_picture(self):
        done = movie(nylon, other, "--out", "both.mp4", "--seconds", "1", "--rate", "3")
        self.assertEqual(done.returncode, 0, done.stderr)
        file = os.path.join(folders.path, "both.mp4")
        facts = json.loads(subprocess.run(
            ["ffprobe", "-v", "error", "-show_streams", "-of", "json", file], capture_output=True, check=True).stdout)["streams"][0]
        self.assertEqual((facts["codec_name"], facts["width"], facts["height"], facts["nb_frames"], facts["r_frame_rate"]),
                         ("h264", WIDE, HIGH, "3", "3/1"))
        with open(file, "rb") as content:
            before = content.read()
        self.assertIn("both.mp4 exists already", movie(nylon, "--out", "both.mp4").stderr)
        os.symlink(os.path.join(nylon, "shapes.csv"), os.path.join(folders.path, "link.mp4"))
        self.assertIn("is an input", movie(nylon, "--out", "link.mp4", "--overwrite").stderr)
        with open(file, "rb") as content:
            self.assertEqual(content.read(), before)
        pictures = pictures_of(file)
        self.assertGreater(min(orange_rows(pictures[1])), 2000)
        for before, after in zip(pictures[:-1], pictures[1:]):
            self.assertGreater(int((np.abs(before - after).max(axis=2) > 60).sum()), 5000)
        self.assertEqual([name for name in os.listdir(folders.path) if name.endswith(".part")], [])

    def test_that_cannot_be_made_leaves_nothing(self):
        without = folders.run("without", STRAIGHT)
        for arguments, code, words in (((without,), 1, "--shapes keeps them"), ((nylon, "--color", "twist"), 1, "--color twist"),
                                       ((), 2, "RUN"), ((nylon, "--out", "x.avi"), 2, ".mp4"), ((nylon, nylon, nylon), 2, "two"),
                                       ((nylon, "--rate", "0"), 2, "--rate 0"), ((nylon, "--seconds", "0"), 2, "--seconds"),
                                       (("nowhere",), 2, "no such folder"), ((folders.path,), 2, "no test is there")):
            if words == "--shapes keeps them" and os.path.exists(os.path.join(without, "test.bag")):
                continue  # built with ROS: it has shapes
            done = movie(*arguments)
            self.assertEqual((done.returncode, done.stderr.count("\n")), (code, 1), done.stderr)
            self.assertIn(words, done.stderr)
        self.assertFalse(os.path.exists(os.path.join(folders.path, "movie.mp4")))


class Pictures(unittest.TestCase):
    def test_of_two_runs_begin_to_pull_together(self):
        stage = Stage([nylon, other], "tension", (WIDE, HIGH))
        times = stage.times(5)
        self.assertEqual((times[0], times[-1]), (min(test.first() for test in stage.tests), max(test.last() for test in stage.tests)))
        for test in stage.tests:
            self.assertNotEqual(test.run.curve.phase[np.searchsorted(test.run.curve["time"], test.at(-0.1).time)], "pull")
            self.assertRegex(test.run.words_at(test.at(0.1).time), "^pull, .* s = ")

    def test_lie_between_the_shapes_that_are_known(self):
        test = OneTest(nylon)
        before, after = test.shapes[20], test.shapes[21]
        middle = test.at(0.5 * (before.time + after.time) - test.begin)
        np.testing.assert_allclose(middle.points, 0.5 * (before.points + after.points), rtol=1e-9)
        np.testing.assert_allclose(middle.tension, 0.5 * (before.tension + after.tension), rtol=1e-9, atol=1e-12)
        for i in (0, 7, len(test.shapes) - 1):
            np.testing.assert_allclose(test.at(test.shapes[i].time - test.begin).points, test.shapes[i].points, atol=1e-12)

    def test_end_their_curve_where_the_words_say(self):
        test = OneTest(nylon)
        shape = test.at(20.03)
        extension, load = test.until(shape.time)
        self.assertIn(f"s = {extension[-1]:.4g} mm", test.run.words_at(shape.time))
        self.assertAlmostEqual(load[-1], np.interp(extension[-1], test.extension, test.load), delta=0.01 * load[-1])
        self.assertTrue((np.diff(extension) > 0.0).all())

    def test_show_the_rod_whole_until_it_has_parted(self):
        test = OneTest(nylon)
        whole, parted = test.shapes[-2:]
        self.assertIsNone(parted.tension)
        just_before = test.at(0.9 * parted.time + 0.1 * whole.time - test.begin)
        np.testing.assert_array_equal(just_before.points, whole.points)


if __name__ == "__main__":
    unittest.main()
