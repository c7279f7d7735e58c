#!/usr/bin/python3
"""The figures of the report of a run: what is drawn, marked and named in them."""
import unittest
from types import SimpleNamespace

from runs import FISHERMAN, STRAIGHT, Folders, OfValues, a_pull, read, write

import matplotlib.text
import numpy as np

from knot_utm.report import colours, curves, marks, rod_pictures, run_page, shapes, style, tube, turnable
from knot_utm.report.run import Run


def setUpModule():
    global folders, straight, fisherman
    folders = Folders()
    straight, fisherman = folders.run("straight", STRAIGHT), folders.run("fisherman", FISHERMAN)


def texts_of(figure):
    return [text for text in figure.findobj(matplotlib.text.Text) if text.get_text().strip()]


class Band(unittest.TestCase):
    def test_is_a_share_of_the_true_force_where_nothing_slid(self):
        pull = a_pull(np.linspace(0.0, 0.01, 11), np.linspace(0.0, 50.0, 11))
        low, high = curves.error_band(OfValues(pull, locked_stiffness=4e3, locked_stiffness_error=400.0,
                                                   balance_offset=10.0), pull)
        np.testing.assert_allclose(low, 0.9 * (pull["load"] + 10.0) - 10.0)
        np.testing.assert_allclose(high, 1.1 * (pull["load"] + 10.0) - 10.0)

    def test_behind_the_lock_it_moves_along_the_extension(self):
        s = np.linspace(0.0, 0.1, 1001)
        load = np.where(s < 0.05, 2.0, 2.0 + 1e4 * (s - 0.05))
        run = OfValues(a_pull(s, load), plateau_force=2.0, plateau_force_error=0.2, lock_extension=0.05,
                       lock_extension_error=0.002, locked_stiffness=1e4, locked_stiffness_error=0.0)
        low, high = curves.error_band(run, run.curve)
        np.testing.assert_allclose((low[200], high[200]), (1.8, 2.2))
        # 2 mm at 1e4 N/m
        np.testing.assert_allclose((low[800], high[800]), (load[800] - 20.0, load[800] + 20.0))

class FewPoints(unittest.TestCase):
    def test_keep_the_first_the_last_and_every_extreme(self):
        load = np.sin(np.linspace(0.0, 40.0, 300001))
        load[123456], load[200001] = 7.0, -7.0
        rows = curves.few_points(load)
        self.assertLess(len(rows), 10000)
        self.assertEqual((rows[0], rows[-1], load[rows].max(), load[rows].min()), (0, 300000, 7.0, -7.0))
        self.assertEqual(len(curves.few_points(load[:500])), 500)


class ABrokenRod(unittest.TestCase):
    def test_is_drawn_in_its_pieces(self):
        nodes = np.column_stack([np.zeros(10), np.zeros(10), np.linspace(0.0, 0.9, 10)])
        whole = shapes.Shape(0.0, nodes, np.ones(9))
        recoil = np.where(np.arange(10) >= 4, 0.5, 0.0)[:, None] * [0.0, 0.0, 1.0]
        parted = shapes.Shape(1.0, nodes + recoil, np.zeros(9))
        stretched = shapes.Shape(1.0, 3.0 * nodes, np.ones(9))
        self.assertEqual(shapes.pieces(parted, whole), [slice(0, 4), slice(4, 10)])
        self.assertEqual(shapes.pieces(stretched, whole), [slice(0, 10)])

    def test_of_several_ropes_is_drawn_in_these_and_in_its_pieces(self):
        nodes = np.column_stack([np.where(np.arange(10) < 6, 0.0, 5.0), np.zeros(10), np.linspace(0.0, 0.9, 10)])
        cuts = shapes.cuts_of(np.array([1.0] * 6 + [2.0] * 4))
        self.assertEqual(cuts, (5,))
        whole = shapes.Shape(0.0, nodes, np.ones(9), cuts=cuts)
        self.assertEqual(shapes.pieces(whole, whole), [slice(0, 6), slice(6, 10)])
        recoil = np.where(np.arange(10) == 3, 0.5, 0.0)[:, None] * [0.0, 0.0, 1.0]
        self.assertEqual(shapes.pieces(whole._replace(points=nodes + recoil), whole), [slice(0, 3), slice(4, 6), slice(6, 10)])
        values = colours.node_values(whole._replace(tension=np.where(np.arange(9) == 5, 0.0, 2.0)))
        np.testing.assert_array_equal(values["tension"], np.full(10, 2.0))
        np.testing.assert_allclose(values["curvature"], 0.0, atol=1e-6)

    def test_of_two_materials_is_as_thick_as_each(self):
        nodes = np.column_stack([np.where(np.arange(10) < 6, 0.0, 5.0), np.zeros(10), np.linspace(0.0, 0.9, 10)])
        shape, run = shapes.Shape(0.0, nodes, np.ones(9), cuts=(5,)), Run.__new__(Run)
        for other, radii in ({"other_material": {"radius": 0.003}}, (2.0, 3.0)), ({}, (2.0, 2.0)):
            run.method = {"material": {"radius": 0.002}, **other}
            self.assertEqual(turnable.pieces_of(run, shape, shape), [[0, 6, radii[0]], [6, 10, radii[1]]])
            self.assertEqual(run.thickest(), 1e-3 * radii[1])

    def test_is_shown_parted_at_the_end_also_where_no_shape_was_recorded_behind_the_break(self):
        nodes = np.zeros((3, 3))
        series = shapes.Series([0.0, 0.9], lambda i: shapes.Shape([0.0, 0.9][i], nodes, np.ones(2)))
        final = shapes.Shape(1.1, nodes)
        found = shapes.shapes_at(series, [0.0, 1.0, 1.1], broke=1.0, final=final)
        self.assertEqual([one.time for one in found], [0.0, 0.9, 1.1])
        self.assertEqual([one.time for one in shapes.shapes_at(series, [0.0, 1.1], final=final)], [0.0, 0.9])

    def test_has_no_load_behind_its_break(self):
        s = np.minimum(np.linspace(0.0, 0.1, 101), 0.08)
        run = OfValues(a_pull(s, np.where(np.arange(101) <= 80, 100.0 * s, -50.0)), break_extension=0.08, peak_force=8.0)
        run.curve.columns["time"] = np.arange(101.0)
        self.assertEqual(run.time_of_break(), 80.0)
        self.assertEqual(run.tested()["load"].min(), 0.0)
        end = marks.marks_of(run)[-1]
        self.assertEqual((end.title(), np.isnan(end.load)), ("end of the test", True))


class APlateau(unittest.TestCase):
    def test_has_its_range_beside_it(self):
        s = np.linspace(0.0, 0.1, 101)
        for slope, words in ((60.0, "rises from 3.9 to 6.7 N"), (1.0, "between 3.9 and 6.7 N")):
            run = OfValues(a_pull(s, s), plateau_force=5.0, plateau_force_low=3.92, plateau_force_high=6.73,
                           plateau_force_slope=slope, lock_extension_by_load=0.084)
            self.assertEqual(run_page.range_of_plateau(run), words)
        level = OfValues(a_pull(s, s), plateau_force=5.0, plateau_force_low=4.999, plateau_force_high=5.001)
        self.assertEqual(run_page.range_of_plateau(level), "")


class TheMeanCurve(unittest.TestCase):
    def test_is_that_of_the_loads_at_each_extension_that_all_have(self):
        # Loads s, 2 s and 6 s: mean 3 s, standard deviation sqrt(7) s; with 2 degrees of freedom t is 4.3027.
        pulls = [(np.array([0.0, 0.4, 4.0]), np.array([0.0, 0.4, 4.0])), (np.array([0.5, 3.0]), np.array([1.0, 6.0])),
                 (np.array([0.0, 1.0, 5.0]), np.array([0.0, 6.0, 30.0]))]
        found = curves.mean_curve(pulls)
        self.assertEqual((found.extension[0], found.extension[-1]), (0.5, 3.0))
        np.testing.assert_allclose(found.mean, 3.0 * found.extension)
        # Neither band goes beyond what a specimen shows.
        np.testing.assert_allclose(found.scatter[1], (3.0 + np.sqrt(7.0)) * found.extension)
        np.testing.assert_allclose(found.scatter[0], found.extension)
        np.testing.assert_allclose(found.interval[1], 6.0 * found.extension)

    def test_is_not_drawn_where_nothing_is_common(self):
        one, behind = (np.array([0.0, 1.0]), np.array([0.0, 1.0])), (np.array([2.0, 3.0]), np.array([0.0, 1.0]))
        self.assertIsNone(curves.mean_curve([one]))
        self.assertIsNone(curves.mean_curve([one, behind]))
        self.assertIsNone(curves.mean_curve([one, (np.array([]), np.array([]))]))


class ATube(unittest.TestCase):
    def test_has_few_faces_where_it_is_straight_and_many_in_a_bend(self):
        angle = np.linspace(0.0, np.pi, 101)
        bend = np.column_stack([np.sin(angle), 1.0 - np.cos(angle), np.zeros(101)])
        straight = np.column_stack([np.linspace(-5.0, 0.0, 101)[:-1], np.zeros((100, 2))])
        for radius, faces in ((0.5, (10, 36)), (0.1, (50, 36))):
            kept = tube.enough_points(np.concatenate([straight, bend]), radius)
            self.assertEqual((kept[0], kept[-1]), (0, 200))
            self.assertAlmostEqual(np.count_nonzero(kept < 100), faces[0], delta=2)
            self.assertAlmostEqual(np.count_nonzero(kept >= 100), faces[1], delta=3)


class APicture(unittest.TestCase):
    def test_is_never_much_higher_than_wide(self):
        run = Run(straight)
        across = np.column_stack([np.linspace(0.0, 1.2, 50), np.zeros(50), np.linspace(0.0, 0.008, 50)])
        picture = rod_pictures.pictures(run, [marks.end_of(run.curve)], [shapes.Shape(0.0, across, None)])
        self.assertLess(picture.get_figheight(), picture.get_figwidth())

    def test_has_the_rollers_of_every_loop_and_the_post_of_a_strand_around_one(self):
        shape = shapes.Shape(0.0, np.zeros((2, 3)), None)
        for knot, grips, expected in (("fisherman", "rollers", [(0.0, 0.0, 20.0), (250.0, 0.0, 20.0)]),
                                      ("multiple_fisherman", "rollers", [(0.0, 0.0, 20.0), (250.0, 0.0, 20.0)]),
                                      ("fisherman", "clamps", []), ("capstan", "nodes", [(0.0, 0.0, 15.0)]),
                                      ("straight", "clamps", []), ("overhand", "nodes", []), ("reef", "clamps", []),
                                      ("bowline", "clamps", [(0.0, 0.0, 10.0)])):
            run = SimpleNamespace(method={"specimen": {"knot": knot, "post_diameter": 0.03},
                                          "machine": {"grips": grips, "roller_diameter": 0.04}},
                                  curve={"time": [0.0, 1.0], "end_to_end": [0.25, 0.3]}, folder="", thickest=lambda: 0.002)
            self.assertEqual(rod_pictures.rollers(run, shape), expected, (knot, grips))

    def test_a_post_of_the_upper_grip_moves_with_it_and_others_beside_it(self):
        drawing = {"upper": [], "posts": [{"through": [0, 0, 5], "along": [0, 1, 0], "radius": 3},
                                          {"through": [1, 0, 30], "along": [0, 2, 0], "radius": 4, "grip": "upper"},
                                          {"through": [2, 0, 33], "along": [0, 1, 0], "radius": 5, "grip": "upper"},
                                          {"through": [2, 0, 33], "along": [1, 0, 0], "radius": 5, "grip": "upper"}]}
        self.assertEqual(rod_pictures.posts_of(drawing, "upper", 90.0, 2.0), [(90.0, 2.0, 8.0), (96.0, 4.0, 10.0)])
        self.assertEqual(rod_pictures.posts_of(drawing, "lower", 0.0, 2.0), [(0.0, 0.0, 6.0)])

    def test_a_ring_is_two_sections_on_either_side_of_its_hole(self):
        drawing = {"upper": ["upper"], "posts": [{"through": [1, 0, 5], "along": [0, 0, 2], "radius": 1, "ring": 3},
                                                 {"through": [0, 0, 9], "along": [0, 1, 0], "radius": 1, "ring": 3}]}
        self.assertEqual(rod_pictures.posts_of(drawing, "lower", 0.0, 2.0), [(0.0, -4.0, 2.0), (0.0, 8.0, 2.0)])


class ACompliantFrame(unittest.TestCase):
    def test_readings_are_held_against_the_specimens_own_extension(self):
        folder = folders.copy(straight)
        for name in ("curve.csv", "curve_full.csv"):
            rows = [row.split(",") for row in read(folder, name).splitlines()]
            rows = [rows[0] + ["crosshead_travel"], rows[1] + ["m"], *(row + [str(2.0 * float(row[1]))] for row in rows[2:])]
            write("\n".join(map(",".join, rows)) + "\n", folder, name)
        run = Run(folder)
        np.testing.assert_array_equal(run.curve["extension"], Run(straight).curve["extension"])
        np.testing.assert_array_equal(run.curve["crosshead_extension"], 2.0 * run.curve["extension"])
        found = marks.marks_of(run)
        self.assertIn("the deflection of the frame is taken off", run_page.caption(run, found, marks.largest_load(run)))
        axes = curves.force_extension(run, found).axes[-1]
        self.assertGreater(axes.get_xlim()[1], 1e3 * run.tested()["crosshead_extension"].max())


class Marks(unittest.TestCase):
    def test_are_start_lock_peak_and_end(self):
        s = np.linspace(0.0, 0.1, 101)
        run = OfValues(a_pull(s, np.where(s < 0.09, 100.0 * s, 1.0)), lock_extension=0.05, peak_force=9.0)
        found = marks.marks_of(run)
        self.assertEqual([(mark.letter, mark.title()) for mark in found],
                         [("a", "start of the pull"), ("b", "lock"), ("c", "peak"), ("d", "end of the test")])
        self.assertAlmostEqual(found[1].extension, 0.05)

    def test_tell_what_was_before_a_break_from_what_was_behind(self):
        s = np.linspace(0.0, 0.1, 101)
        found = marks.marks_of(OfValues(a_pull(s, np.where(s < 0.0995, s, 0.0)), break_extension=0.0992,
                                          peak_force=0.099))
        self.assertEqual([mark.title() for mark in found], ["start of the pull", "peak, break", "end of the test"])
        self.assertAlmostEqual(marks.time_of_break(found), 0.99)
        seconds = np.array([0.0, 0.5, 0.98, 1.02, 1.3])
        self.assertEqual([shapes.nearest(seconds, time, 1.01) for time in (0.4, 1.005, 1.01, 1.4)], [1, 2, 2, 4])

    def test_that_fall_together_are_one(self):
        s = np.linspace(0.0, 0.1, 101)
        self.assertEqual([mark.title() for mark in marks.marks_of(OfValues(a_pull(s, s), peak_force=0.1))],
                         ["start of the pull", "largest load, end of the test"])

    def test_have_a_peak_only_where_the_pull_has_one(self):
        s = np.linspace(0.0, 0.1, 101)
        held = a_pull(s, np.where(s < 0.05, s, 0.2 - s))
        held.phase[50:] = "hold"
        self.assertEqual([mark.title() for mark in marks.marks_of(OfValues(held, peak_force=None))],
                         ["start of the pull", "end of the test"])
        found = marks.marks_of(OfValues(held, peak_force=0.049))
        self.assertEqual([(mark.title(), mark.load) for mark in found][1], ("largest load", held["load"][49]))
        held.phase[:] = "hold"
        self.assertEqual([mark.title() for mark in marks.marks_of(OfValues(held, peak_force=1.0))],
                         ["start", "end of the test"])


class TheLargestLoad(unittest.TestCase):
    S = np.linspace(0.0, 0.1, 101)

    def of(self, load, **result):
        return marks.largest_load(OfValues(a_pull(self.S, load), peak_force=1.0, **result))

    def test_is_a_peak_where_the_load_fell_behind_it(self):
        found = self.of(np.where(self.S < 0.06, self.S, 0.0), ended_by="extension")
        self.assertEqual((found.is_peak, found.name, found.where), (True, "peak", "at an extension of 59 mm"))

    def test_is_a_peak_where_the_rod_parted(self):
        found = self.of(np.where(self.S < 0.0995, self.S, 0.0), ended_by="break", break_extension=0.0992)
        self.assertEqual((found.is_peak, found.where), (True, "where the rod parted, at 99.2 mm"))

    def test_is_no_peak_where_the_test_was_stopped_while_the_load_rose(self):
        for ended_by, where in (("extension", "where the test was stopped"), ("operator", "where the operator stopped the test"),
                                ("solver", "where the physics gave up")):
            found = self.of(self.S, ended_by=ended_by)
            self.assertEqual((found.is_peak, found.name), (False, "largest load"))
            self.assertEqual(found.where, "at 100 mm, " + where)

    def test_is_where_the_load_cell_read_it(self):
        run = OfValues(a_pull(self.S, self.S), peak_force=0.099, ended_by="extension")
        run.readings = a_pull(self.S[:-1:3], self.S[:-1:3])  # the last reading is at 99 mm, the line ends at 100
        found = marks.largest_load(run)
        self.assertEqual(found.where, "at 99 mm, before the test was stopped")
        self.assertEqual((found.rows["extension"][found.row], found.rows["load"][found.row]), (0.099, 0.099))
        self.assertEqual(run_page.between_readings(run), "0.1 N")

    def test_is_no_peak_where_a_hold_follows_the_pull(self):
        held = a_pull(self.S, np.minimum(self.S, 0.05))
        held.phase[51:] = "hold"
        found = marks.largest_load(OfValues(held, peak_force=0.05, ended_by="time"))
        self.assertEqual((found.is_peak, found.where), (False, "at 50 mm, where the pull ended"))


class Figures(unittest.TestCase):
    def test_have_no_letters_smaller_than_the_smallest(self):
        run = Run(fisherman)
        found = marks.marks_of(run)
        for figure in (curves.force_extension(run, found), curves.course(run),
                       rod_pictures.pictures(run, found[-1:], [shapes.final_shape(run)])):
            self.assertGreaterEqual(min(text.get_fontsize() for text in texts_of(figure)), style.SMALL)

    def test_show_where_a_knot_jumped_open_and_the_small_loads(self):
        run = Run(folders.changed(fisherman, "result.yaml", jump_force=1.626, jump_extension=0.0121, lock_extension=None,
                                  plateau_force=None, lock_extension_by_load=None, locked_stiffness=None))
        found = marks.marks_of(run)
        self.assertIn("a knot jumped open", [mark.title() for mark in found])
        texts = [text.get_text() for text in texts_of(curves.force_extension(run, found))]
        self.assertLessEqual({"a knot jumped open at 1.626 N", "small loads [N]"}, set(texts))

    def test_draw_the_floor_of_the_load_cell_and_the_line_of_rigid_sliding(self):
        for grips, slope in (("rollers", 2), ("nodes", 1)):
            run = Run(fisherman)
            cell = {"floor": 0.002, "capacity": 100.0}
            run.method = {**run.method, "machine": {**run.method["machine"], "grips": grips, "load_cell": cell}}
            figure = curves.force_extension(run, [])
            self.assertIn("cell's floor, 0.2 N", [text.get_text() for text in texts_of(figure)])
            line, = [line for line in figure.axes[-1].lines if line.get_label() == f"de/ds = –{slope}: rigid sliding"]
            (s_from, s_to), (e_from, e_to) = line.get_data()
            self.assertAlmostEqual((e_to - e_from) / (s_to - s_from), -slope)


if __name__ == "__main__":
    unittest.main()
