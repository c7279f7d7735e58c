#!/usr/bin/python3
"""scripts/export: what other programs read in the files that it writes. scripts/movie and scripts/picture: what is on their pictures."""
import json
import os
import subprocess
import unittest
import xml.etree.ElementTree as xml

from runs import FISHERMAN, Folders, read, script, write

import numpy as np
from PIL import Image
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersCore import vtkPolyDataConnectivityFilter
from vtkmodules.vtkIOGeometry import vtkGLTFReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

from knot_utm.report.colours import node_values
from knot_utm.report.movie import OneTest
from knot_utm.report.picture import facts_of_run
from knot_utm.report.quantities import number
from knot_utm.report.run import Run
from knot_utm.report.shapes import nearest, shapes_of

HIGH, WIDE = 1080, 1920


def setUpModule():
    global folders, broken, shapes, radius
    folders = Folders()
    broken = folders.run("broken", ["config/tighten.yaml", "--set", "material.bending_law=elastic", "--set", "material.friction_couple=0",
                                    "--set", "physics.accuracy=draft"], "--shapes")
    run = Run(broken)
    (shapes, note), radius = shapes_of(run), run.method["material"]["radius"]
    assert not note


def exported(*arguments):
    done = script("export", *arguments)
    assert done.returncode == 0, done.stderr
    return done


def out(name):
    return os.path.join(folders.path, name)


def mesh_of(file):
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(file)
    reader.Update()
    return reader.GetOutput()


def arrays_of(mesh):
    data = mesh.GetPointData()
    return {data.GetArrayName(i): vtk_to_numpy(data.GetArray(i)) for i in range(data.GetNumberOfArrays())}


def places_of(mesh):
    return vtk_to_numpy(mesh.GetPoints().GetData())


def pieces_of(mesh):
    regions = vtkPolyDataConnectivityFilter()
    regions.SetInputData(mesh)
    regions.SetExtractionModeToAllRegions()
    regions.Update()
    return regions.GetNumberOfExtractedRegions()


class ForParaView(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = out("paraview")
        exported(broken, "--vtk", cls.folder)
        sets = xml.parse(os.path.join(cls.folder, "rod.pvd")).getroot().iter("DataSet")
        cls.files = [(float(one.get("timestep")), os.path.join(cls.folder, one.get("file"))) for one in sets]

    def test_every_shape_has_its_time_and_its_file(self):
        np.testing.assert_array_equal([time for time, _ in self.files], [shape.time for shape in shapes])
        self.assertEqual(sorted(os.listdir(self.folder)), sorted(["rod.pvd", *(os.path.basename(f) for _, f in self.files)]))

    def test_tubes_lie_around_the_nodes_and_carry_their_values(self):
        middle = len(shapes) // 2
        shape, mesh = shapes[middle], mesh_of(self.files[middle][1])
        away = np.linalg.norm(places_of(mesh)[:, None] - shape.points[None], axis=2)
        np.testing.assert_allclose(away.min(axis=1), radius, rtol=0.1)
        nearest, arrays, known = away.argmin(axis=1), arrays_of(mesh), node_values(shape)
        self.assertLessEqual({"tension", "curvature", "contact_force"}, set(known))
        for name, values in known.items():
            self.assertGreater(np.ptp(values), 0.0, name)
            same = np.isclose(arrays[name], values[nearest], rtol=1e-5, atol=1e-6 * np.abs(values).max())
            self.assertGreater(same.mean(), 0.95, name)  # in a bend a point may be nearer to a neighbour
        self.assertLessEqual(set(known) | {"arclength"}, set(arrays))

    def test_a_rod_is_one_tube_to_its_end(self):
        first, last = (mesh_of(self.files[i][1]) for i in (0, -1))
        tube = 3  # a tube and its two caps share no points
        self.assertEqual((pieces_of(first), pieces_of(last)), (tube, tube))
        self.assertEqual(set(arrays_of(first)), set(arrays_of(last)))
        self.assertFalse(np.isnan(arrays_of(last)["curvature"]).any())


class ForSlides(unittest.TestCase):
    def read(self, file):
        """As VTK's own reader sees it."""
        reader = vtkGLTFReader()
        reader.SetFileName(file)
        reader.Update()
        leaves, mesh = reader.GetOutput(), None
        iterator = leaves.NewIterator()
        while not iterator.IsDoneWithTraversal():
            mesh = iterator.GetCurrentDataObject()
            iterator.GoToNextItem()
        return mesh

    def test_a_glb_is_the_rod_in_colours_with_y_up(self):
        exported(broken, "--gltf", out("rod.glb"), "--time", "40")
        mesh, shape = self.read(out("rod.glb")), nearest(shapes, 40.0)
        turned = shape.points[:, [0, 2, 1]] * [1.0, 1.0, -1.0]
        places, arrays = places_of(mesh), arrays_of(mesh)
        away = np.linalg.norm(places[:, None] - turned[None], axis=2).min(axis=1)
        np.testing.assert_allclose(away, radius, rtol=0.1)
        np.testing.assert_allclose(np.linalg.norm(arrays["NORMAL"], axis=1), 1.0, atol=1e-5)
        self.assertGreater(mesh.GetNumberOfPolys(), 10 * len(shape.points))
        self.assertGreater(len(np.unique(arrays["COLOR_0"], axis=0)), 10)
        corners = places[vtk_to_numpy(mesh.GetPolys().GetData()).reshape(-1, 4)[:, 1:]]
        faces = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        length = np.linalg.norm(np.diff(shape.points, axis=0), axis=1).sum()
        volume = (corners[:, 0] * faces).sum() / 6.0  # of triangles that face outwards
        self.assertAlmostEqual(volume / (np.pi * radius ** 2 * length), 1.0, delta=0.1)


class Refused(unittest.TestCase):
    def test_in_one_line_with_nothing_written(self):
        os.makedirs(out("full"))
        os.symlink(os.path.join(broken, "result.yaml"), out("link.glb"))
        write(out("full/a.glb"), "")
        damaged = folders.copy(broken)
        write(os.path.join(damaged, "shapes.csv"), read(damaged, "shapes.csv").replace("contact_force", "force", 1))
        for code, name, arguments, words in (
                (2, "export", [broken], "--vtk"), (2, "export", [out("none"), "--vtk", out("x")], "none: no such folder"),
                (2, "export", [out("full"), "--vtk", out("x")], "full: no test is there"),
                (2, "export", [broken, "--gltf", out("x.obj")], "must end with .glb"),
                (2, "export", [broken, "--gltf", out("full/a.glb")], "exists already"),
                (2, "export", [broken, "--gltf", out("link.glb"), "--overwrite"], "is an input"),
                (2, "export", [broken, "--vtk", out("full")], "is there already"),
                (2, "export", [broken, "--vtk", out("x"), "--color", "tension"], "--color"),
                (2, "export", [broken, "--gltf", out("x.glb"), "--time", "noon"], "noon"),
                (2, "export", [damaged, "--vtk", out("x")], "no column contact_force"),
                (2, "movie", [broken, "--out", out("x.avi")], ".mp4"), (2, "movie", [broken] * 3, "two runs"),
                (2, "movie", [broken, "--rate", "0"], "--rate 0"), (2, "movie", [out("full")], "no test is there"),
                (2, "picture", [broken, "--out", out("full/a.glb")], "exists already")):
            done = script(name, *arguments)
            self.assertEqual((done.returncode, done.stderr.count("\n")), (code, 1), done.stderr)
            self.assertIn(words, done.stderr)
        self.assertFalse({"x", "x.glb", "x.avi"} & set(os.listdir(folders.path)))


class Pictures(unittest.TestCase):
    def test_of_a_movie_of_two_runs_show_both_as_they_go_on(self):
        other, file = folders.run("other", [*FISHERMAN, "--set", "physics.accuracy=draft"], "--shapes"), out("both.mp4")
        done = script("movie", broken, other, "--out", file, "--seconds", "1", "--rate", "3")
        self.assertEqual(done.returncode, 0, done.stderr)
        facts = json.loads(subprocess.run(
            ["ffprobe", "-v", "error", "-show_streams", "-of", "json", file], capture_output=True, check=True).stdout)["streams"][0]
        self.assertEqual((facts["codec_name"], facts["width"], facts["height"], facts["nb_frames"], facts["r_frame_rate"]),
                         ("h264", WIDE, HIGH, "3", "3/1"))
        self.assertEqual({facts[f"color_{of}"] for of in ("space", "primaries", "transfer")}, {"bt709"})
        done = subprocess.run(["ffmpeg", "-loglevel", "error", "-i", file, "-vf", "scale=in_color_matrix=bt709", "-f", "rawvideo", "-pix_fmt",
                               "rgb24", "-"], capture_output=True, check=True)
        shown = np.frombuffer(done.stdout, np.uint8).reshape(-1, HIGH, WIDE, 3).astype(int)
        red, green, blue = np.moveaxis(shown[1, :HIGH // 2], 2, 0)
        of_rod = (red > blue + 40) & (red > green)  # its colours under tension
        self.assertGreater(min(of_rod[:, :WIDE // 2].sum(), of_rod[:, WIDE // 2:].sum()), 2000)
        for before, after in zip(shown[:-1], shown[1:]):
            self.assertGreater(int((np.abs(before - after).max(axis=2) > 60).sum()), 5000)

    def test_of_a_movie_show_what_was_computed_to_the_break(self):
        test = OneTest(broken)
        for shape in (test.shapes[20], test.shapes[-1]):
            np.testing.assert_array_equal(test.at(shape.time - test.begin).points, shape.points)
            self.assertIsNotNone(shape.tension)
        extension, _ = test.until(20.03)
        self.assertIn(f"s = {number(float(extension[-1]))} mm", test.run.words_at(20.03))

    def test_of_a_run_carry_what_they_show(self):
        done = script("picture", broken, "--out", out("picture.png"))
        self.assertEqual(done.returncode, 0, done.stderr)
        with Image.open(out("picture.png")) as picture:
            facts = facts_of_run(broken, picture.text["command"])
            self.assertEqual(({**picture.text}, facts["command"]), (facts, f"scripts/picture {broken} --out {out('picture.png')}"))
            self.assertGreater(len(set(picture.convert("RGB").getdata())), 1000)


if __name__ == "__main__":
    unittest.main()
