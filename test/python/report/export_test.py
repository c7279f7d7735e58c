#!/usr/bin/python3
"""scripts/export: what other programs read in the files that it writes."""
import os
import subprocess
import unittest
import xml.etree.ElementTree as xml

from runs import ROOT, Folders, put_into

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersCore import vtkPolyDataConnectivityFilter
from vtkmodules.vtkIOGeometry import vtkGLTFReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

from knot_utm.report.colours import curvature, node_values
from knot_utm.report.run import Run
from knot_utm.report.shapes import final_shape, series_of

EXPORT = os.path.join(ROOT, "scripts/export")


def setUpModule():
    global folders, broken, twisted, series
    folders = Folders()
    broken = folders.run("broken", ["config/tighten.yaml", "--set", "material.bending_law=elastic", "--set", "material.friction_couple=0",
                                    "--set", "physics.accuracy=draft"], "--shapes")
    # A knot that is drawn and held in clamps solves for twist from the beginning.
    twisted = folders.run("twisted", ["config/overhand.yaml", "--set", "physics.accuracy=draft", "--set",
                                      "program=[{balance: {}}, {hold: {duration: 1}}]"], "--shapes")
    series, note = series_of(Run(broken))
    assert not note


def export(*arguments):
    return subprocess.run([EXPORT, *arguments], cwd=ROOT, capture_output=True, text=True, check=False,
                          env={**os.environ, "KNOT_UTM_SKIP_BUILD": "1"})


def exported(*arguments):
    done = export(*arguments)
    assert done.returncode == 0, done.stderr
    return done


def out(name):
    return os.path.join(folders.path, name)


def radius_of(folder):
    return Run(folder).method["material"]["radius"]


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
        np.testing.assert_array_equal([time for time, _ in self.files], series.times)
        self.assertEqual(sorted(os.listdir(self.folder)), sorted(["rod.pvd", *(os.path.basename(f) for _, f in self.files)]))

    def test_tubes_lie_around_the_nodes_and_carry_their_values(self):
        middle = len(series) // 2
        shape, mesh = series.shape(middle), mesh_of(self.files[middle][1])
        away = np.linalg.norm(places_of(mesh)[:, None] - shape.points[None], axis=2)
        np.testing.assert_allclose(away.min(axis=1), radius_of(broken), rtol=0.1)
        nearest, arrays, known = away.argmin(axis=1), arrays_of(mesh), node_values(shape)
        self.assertEqual(set(known), {"tension", "curvature", "contact_force"})
        for name, values in known.items():
            self.assertGreater(np.ptp(values), 0.0, name)
            same = np.isclose(arrays[name], values[nearest], rtol=1e-5, atol=1e-6 * np.abs(values).max())
            self.assertGreater(same.mean(), 0.95, name)  # in a bend a point may be nearer to a neighbour
        self.assertLessEqual(set(known) | {"arclength"}, set(arrays))

    def test_a_rod_that_has_parted_is_two_tubes_without_forces(self):
        first, last = (mesh_of(self.files[i][1]) for i in (0, -1))
        tube = 3  # a tube and its two caps share no points
        self.assertEqual((pieces_of(first), pieces_of(last)), (tube, 2 * tube))
        self.assertEqual(set(arrays_of(first)), set(arrays_of(last)))
        self.assertTrue(np.isnan(arrays_of(last)["tension"]).all())
        self.assertFalse(np.isnan(arrays_of(last)["curvature"]).any())

    def test_twist_is_there_where_the_test_solves_for_it(self):
        folder = out("twisted_paraview")
        exported(twisted, "--vtk", folder)
        twist = arrays_of(mesh_of(os.path.join(folder, "rod_001.vtp")))["twist"]
        self.assertTrue(np.isfinite(twist).all())
        self.assertGreater(np.ptp(twist), 0.0)

    def test_without_shapes_it_is_the_final_one_and_says_so(self):
        folder = folders.copy(broken)
        for name in ("shapes.csv", "test.bag"):
            if os.path.exists(os.path.join(folder, name)):
                os.remove(os.path.join(folder, name))
        self.assertIn("only the final shape is written", exported(folder, "--vtk", out("final")).stderr)
        self.assertEqual(sorted(os.listdir(out("final"))), ["rod.pvd", "rod_000.vtp"])


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
        mesh, shape, radius = self.read(out("rod.glb")), series.at(40.0), radius_of(broken)
        turned = shape.points[:, [0, 2, 1]] * [1.0, 1.0, -1.0]
        places, arrays = places_of(mesh), arrays_of(mesh)
        away = np.linalg.norm(places[:, None] - turned[None], axis=2).min(axis=1)
        np.testing.assert_allclose(away, radius, rtol=0.1)
        np.testing.assert_allclose(np.linalg.norm(arrays["NORMAL"], axis=1), 1.0, atol=1e-5)
        self.assertGreater(mesh.GetNumberOfPolys(), 10 * len(shape.points))
        self.assertGreater(len(np.unique(arrays["COLOR_0"], axis=0)), 10)

    def test_its_triangles_face_outwards(self):
        exported(broken, "--gltf", out("outwards.glb"), "--time", "40")
        mesh = self.read(out("outwards.glb"))
        corners = places_of(mesh)[vtk_to_numpy(mesh.GetPolys().GetData()).reshape(-1, 4)[:, 1:]]
        faces = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        volume = (corners[:, 0] * faces).sum() / 6.0
        points = series.at(40.0).points
        length = np.linalg.norm(np.diff(points, axis=0), axis=1).sum()
        self.assertAlmostEqual(volume / (np.pi * radius_of(broken) ** 2 * length), 1.0, delta=0.1)

    def test_colours_are_of_what_was_asked_or_it_is_refused(self):
        contents = []
        for name in ("tension", "curvature", "contact_force"):
            exported(broken, "--gltf", out(f"{name}.glb"), "--time", "40", "--color", name)
            with open(out(f"{name}.glb"), "rb") as content:
                contents.append(content.read())
        self.assertEqual(len(set(contents)), 3)
        done = export(broken, "--gltf", out("twist.glb"), "--color", "twist")
        self.assertEqual((done.returncode, done.stderr.count("\n")), (1, 1), done.stderr)
        self.assertIn("--color twist: it is not known", done.stderr)
        self.assertFalse(os.path.exists(out("twist.glb")))


class Refused(unittest.TestCase):
    def test_in_one_line_with_nothing_written(self):
        os.makedirs(out("full"))
        os.symlink(os.path.join(broken, "result.yaml"), out("link.glb"))
        open(out("full/a.glb"), "w", encoding="utf-8").close()
        with open(out("full/a"), "w", encoding="utf-8"):
            pass
        for arguments, words in (([broken], "--vtk"), ([out("none"), "--vtk", out("x")], "none: no such folder"),
                                 ([out("full"), "--vtk", out("x")], "full: no test is there"),
                                 ([broken, "--gltf", out("x.obj")], "must end with .glb"),
                                 ([broken, "--gltf", out("full/a.glb")], "exists already"),
                                 ([broken, "--gltf", out("link.glb"), "--overwrite"], "is an input"),
                                 ([broken, "--vtk", out("full")], "is there already"),
                                 ([broken, "--vtk", out("x"), "--color", "tension"], "--color"),
                                 ([broken, "--gltf", out("x.glb"), "--color", "blue"], "blue"),
                                 ([broken, "--gltf", out("x.glb"), "--time", "noon"], "noon")):
            done = export(*arguments)
            self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)
            self.assertIn(words, done.stderr)
        self.assertFalse(os.path.exists(out("x")) or os.path.exists(out("x.glb")))

    def test_shapes_that_are_not_what_they_should_be(self):
        for old, new, words in (("contact_force", "force", "no column contact_force"), ("\n0,0,", "\n0,a,", "node")):
            folder = folders.copy(broken)
            put_into(folder, "shapes.csv", old, new)
            done = export(folder, "--vtk", out("damaged"))
            self.assertEqual((done.returncode, done.stderr.count("\n")), (1, 1), done.stderr)
            self.assertIn(words, done.stderr)


class Values(unittest.TestCase):
    def test_curvature_is_that_of_a_circle(self):
        angle = np.linspace(0.0, 5.0, 60)
        circle = 0.04 * np.column_stack([np.cos(angle), np.sin(angle), np.zeros(60)])
        np.testing.assert_allclose(curvature(circle)[1:-1], 25.0, rtol=1e-3)

    def test_the_last_shape_is_the_final_one(self):
        self.assertTrue((np.diff(series.times) > 0.0).all())
        np.testing.assert_allclose(series.shape(len(series) - 1).points, final_shape(Run(broken)).points, atol=1e-6)


if __name__ == "__main__":
    unittest.main()
