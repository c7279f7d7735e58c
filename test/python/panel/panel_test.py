#!/usr/bin/python3
"""The panel beside the picture in rviz: what it says, and that all of it can be read."""
import itertools
import math
import os
import signal
import subprocess
import tempfile
import types
import unittest

ROOT = os.path.realpath(os.path.join(os.path.dirname(__file__), '../../..'))

from knot_utm import tool
from knot_utm.panel.drawing import EXTENSION, HEIGHT, TIME, WIDTH, Drawing
from knot_utm.panel.readings import BROKEN, CROSSED, ENDED, FAILED, MOST_WAITING, PAUSED, PREPARATION, Readings


def state(**fields):
    return types.SimpleNamespace(**{**dict(run=1, time=12.5, phase='pull', motion_pattern='sliding', locked=False,
                                           extension=0.0301, load=4.2, knot_distance=0.1021, end_to_end=0.2801,
                                           status=0, knot_type=0, balance_offset=0.3, highest_load=4.3),
                                    **fields})


def color_bar(full=5000.0):
    color = types.SimpleNamespace(r=1.0, g=0.5, b=0.1)
    return types.SimpleNamespace(quantity='tension', unit='N', ticks=[-1e-3 * full, 0.0, 1e-3 * full, 1e-2 * full, 0.1 * full, full],
                                 places=[0.0, 0.206, 0.412, 0.604, 0.802, 1.0], colors=[color] * 16)


def status(**fields):
    return types.SimpleNamespace(**{**dict(run=1, state=1, ended_by=''), **fields})


def pull(readings, loads, step=1e-3, begin=0.0, **fields):
    for i, load in enumerate(loads):
        stamp = begin + i / 3.0
        readings.take_state(stamp, state(**{'time': i / 3.0, 'extension': step * i, 'load': load, **fields}))
        readings.take_load(stamp, load)
    return readings


def texts_of(drawing):
    """All texts of the picture that are to be read, without labels beyond the limits of their axis, which matplotlib keeps."""
    def is_within(axis, text):
        low, high = sorted(axis.get_view_interval())
        return low - 1e-9 <= text.get_position()[0 if axis.axis_name == 'x' else 1] <= high + 1e-9
    found = list(drawing.figure.texts)
    for axes in filter(lambda one: one.get_visible(), drawing.figure.axes):
        for axis in (axes.xaxis, axes.yaxis):
            found += [axis.label, axis.get_offset_text(), *(text for text in axis.get_ticklabels() if is_within(axis, text))]
        found += [axes.title, *(axes.get_legend().get_texts() if axes.get_legend() and axes.get_legend().get_visible() else ())]
    return [text for text in found if text.get_visible() and text.get_text()]


class ReadingsTest(unittest.TestCase):

    def test_each_reading_has_its_name_and_unit(self):
        readings = Readings()
        readings.take_method({'material': {'name': 'nylon'}, 'specimen': {'knot': 'fisherman'}})
        readings.take_state(1.0, state(locked=True, load=-0.0, extension=-1e-5))
        self.assertLessEqual({('load', '0', 'N'), ('extension', '0.0', 'mm'), ('motion pattern', 'locked', '')}, set(readings.table()))
        readings.take_state(1.5, state())
        rows = {name: (value, unit) for name, value, unit in readings.table()}
        self.assertEqual(rows, {'time': ('12.5', 's'), 'material': ('nylon', ''), 'knot': ('fisherman', ''),
                                'state': ('running', ''), 'phase': ('pull', ''), 'motion pattern': ('sliding', ''), 'extension': ('30.1', 'mm'),
                                'load': ('4.2', 'N'), 'knot distance': ('102.1', 'mm'),
                                'end-to-end distance': ('280.1', 'mm')})

    def test_all_values_are_of_the_last_reading_of_the_load_cell(self):
        readings = pull(Readings(), [100.0, 131.8])
        readings.take_state(0.5, state(extension=0.0935, load=236.7))  # no reading is due
        self.assertLessEqual({('extension', '1.0', 'mm'), ('load', '131.8', 'N')}, set(readings.table()))
        readings.take_load(0.6, 240.1)
        readings.take_state(0.6, state(extension=0.0938, load=240.1))
        self.assertLessEqual({('extension', '93.8', 'mm'), ('load', '240.1', 'N')}, set(readings.table()))

    def test_the_curve_pairs_readings_by_their_stamps_in_any_order(self):
        readings = Readings()
        readings.take_load(1.0, 10.0)
        readings.take_state(0.5, state(extension=0.001))  # no reading was due there
        readings.take_state(1.0, state(extension=0.002))
        readings.take_state(2.0, state(extension=0.003))
        readings.take_load(2.0, 20.0)
        self.assertEqual(readings.curve, [(0.002, 10.0), (0.003, 20.0)])
        for i in range(3, 3 * MOST_WAITING):  # what finds no partner is forgotten
            readings.take_load(i, 1.0)
        readings.take_state(3.0, state())
        self.assertEqual(len(readings.curve), 2)

    def test_another_test_has_a_curve_of_its_own(self):
        readings = pull(Readings(), [1.0, 2.0])
        readings.take_load(10.0, 3.0)  # of the second test, before its state
        readings.take_state(10.0, state(run=2, extension=0.0))
        self.assertEqual(readings.curve, [(0.0, 3.0)])
        readings.take_state(0.0, state(run=2))  # an earlier stamp: a bag is played again
        self.assertEqual(readings.curve, [])

    def test_the_recorded_curve_is_that_of_its_topics(self):
        readings = Readings()
        readings.take_state(1.0, state(extension=0.002))
        for stamp, extension, load in ((1.0, 0.0021, 3.0), (2.0, 0.0041, 5.0)):
            readings.measured_pairs.add(1, stamp, load)
            readings.measured_pairs.add(0, stamp, extension)
        self.assertEqual(readings.measured, [(0.0021, 3.0), (0.0041, 5.0)])

    def test_the_curve_begins_at_the_zero_of_the_pull(self):
        readings = Readings()
        program = [('tie', 0.0), ('release', 0.0), ('mount', 0.0), ('hold', 0.0), ('balance', 0.7), ('pull', 0.7), ('pull', 0.7),
                   ('hold', 0.7)]
        for i, (phase, zero) in enumerate(program):
            readings.take_load(i, 10.0 * i)
            readings.take_state(i, state(phase=phase, extension=1e-3 * i, balance_offset=zero))
        self.assertEqual([load for _, load in readings.curve], [40.0, 50.0, 60.0, 70.0])
        readings.take_load(8, 0.1)  # another zero, by the operator
        readings.take_state(8, state(phase='pull', extension=0.0, balance_offset=80.0))
        self.assertEqual(readings.curve, [(0.0, 0.1)])

    def test_phases_that_prepare_are_those_of_the_program(self):
        prepare = {row['name'] for row in tool.listing('phases') if row['prepares'] == '1'}
        self.assertEqual(PREPARATION - {''}, prepare - {'balance'})

    def test_the_curve_ends_with_the_load_at_the_break(self):
        readings = pull(Readings(), [1.0, 2.0])
        # Its ends recoil by now.
        readings.take_load(1.0, -3.0)
        readings.take_state(1.0, state(status=BROKEN, extension=0.0021, load=-3.0, highest_load=2.1))
        readings.take_state(1.1, state(status=BROKEN, extension=0.0021, load=-3.0, highest_load=-3.0))
        readings.take_load(1.1, -3.0)
        self.assertEqual(readings.curve, [(0.0, 1.0), (0.001, 2.0), (0.0021, 2.1)])
        rows = {name: (value, unit) for name, value, unit in readings.table()}
        self.assertEqual(rows['load at the break'], ('2.1', 'N'))
        self.assertNotIn('load', rows)
        readings.bar = color_bar()
        self.assertFalse(readings.colours_are_known())
        readings.bar.quantity = 'curvature'
        self.assertTrue(readings.colours_are_known())
        readings.take_state(2.0, state(run=2))
        self.assertIn('load', [name for name, _, _ in readings.table()])

    def test_says_how_the_test_stands(self):
        for fields, of_test, words in (
                ({}, None, 'running'),
                ({}, status(), 'running'),
                ({}, status(state=PAUSED), 'paused'),
                ({}, status(run=7, state=ENDED, ended_by='load'), 'running'),  # of another test
                ({}, status(state=ENDED, ended_by='extension'), 'ended by extension'),
                ({}, status(state=ENDED, ended_by='operator'), 'ended by the operator'),
                ({}, status(state=ENDED), 'ended'),  # of a record that does not say how
                (dict(status=BROKEN), None, 'broke'),
                (dict(status=BROKEN), status(state=ENDED, ended_by='break'), 'broke, ended'),
                ({}, status(state=ENDED, ended_by='break'), 'broke'),  # the load fell, the rod is whole
                (dict(motion_pattern='untangling'), None, 'a knot opened'),
                (dict(motion_pattern='untangling', knot_type=1), None, 'came undone'),
                (dict(motion_pattern='untangling', knot_type=1), status(state=ENDED, ended_by='travel'), 'came undone, ended by travel'),
                ({}, status(state=ENDED, ended_by='untangled'), 'came undone'),
                (dict(knot_type=CROSSED), None, 'ran through itself'),
                (dict(status=FAILED), status(state=ENDED, ended_by='solver'), 'the physics gave up, ended')):
            with self.subTest(words=words):
                readings = Readings()
                readings.take_state(1.0, state(**fields))
                if of_test:
                    readings.take_status(of_test)
                self.assertIn(('state', words, ''), readings.table())

    def test_small_loads_are_shown_again_where_large_ones_hide_them(self):
        readings = pull(Readings(), [0.0, 4.0, 6.0, 6.0])
        self.assertIsNone(readings.small_load())
        pull(readings, [100.0, 7000.0], begin=10.0, locked=True)
        self.assertEqual(readings.small_load(), 2.5 * 5.0)
        self.assertIsNone(pull(Readings(), [0.0, 4.0, 7000.0], motion_pattern='stretching').small_load())


class DrawingTest(unittest.TestCase):

    def setUp(self):
        self.drawing = Drawing()

    def texts(self, readings):
        """The texts of a picture of these, each of which lies within it and apart from the others."""
        self.drawing.draw(readings)
        renderer = self.drawing.canvas.get_renderer()
        boxes = [(text.get_text(), text.get_window_extent(renderer)) for text in texts_of(self.drawing)]
        self.assertGreater(len(boxes), 10)
        for text, box in boxes:
            self.assertTrue(box.x0 >= 0 and box.y0 >= 0 and box.x1 <= WIDTH and box.y1 <= HEIGHT, (text, box))
        for (one, a), (other, b) in itertools.combinations(boxes, 2):
            apart = a.x1 <= b.x0 or b.x1 <= a.x0 or a.y1 <= b.y0 or b.y1 <= a.y0
            self.assertTrue(apart, '"%s" lies over "%s"' % (one, other))
        return [text for text, _ in boxes]

    def test_before_anything_is_known(self):
        self.assertEqual(self.drawing.draw(Readings()).shape, (HEIGHT, WIDTH, 3))

    def test_texts_lie_within_the_picture_and_apart(self):
        for loads, fields, full in (([0.0], {}, 5000.0),
                                    ([0.0, 3.0, 5.0, 4.2], {}, 5000.0),
                                    ([0.0, 4.0, 6352.8], dict(locked=True), 5000.0),
                                    ([0.0, 123456.0], dict(motion_pattern='stretching', time=98765.4), 2e6),
                                    ([-0.05, 0.0, -0.0213], dict(motion_pattern='untangling'), 0.02),
                                    ([0.0, 2e-4, 5e-4], dict(knot_distance=math.nan), 1e-3)):
            with self.subTest(loads=loads):
                readings = Readings()
                readings.take_method({'material': {'name': 'polypropylene'}, 'specimen': {'knot': 'fisherman'}})
                readings.bar = color_bar(full)
                self.texts(pull(readings, loads, step=0.04, **fields))

    def test_axes_before_the_pull_do_not_end_at_a_metre(self):
        readings = Readings()
        readings.bar = color_bar()
        self.assertIn('10', self.texts(pull(readings, [0.0, 0.3], step=0.0, phase='tie')))

    def test_small_loads_have_axes_of_their_own(self):
        readings = pull(pull(Readings(), [0.0, 4.0, 6.0, 6.5]), [500.0, 6352.8], begin=10.0, locked=True)
        readings.bar = color_bar()
        readings.take_status(status(state=ENDED, ended_by='extension'))
        texts = self.texts(readings)
        self.assertTrue({'load [N]', 'small loads [N]', 'extension [mm]', 'ended by extension'} <= set(texts), texts)
        self.assertEqual(texts.count('extension [mm]'), 1)
        before = self.drawing.draw(readings).copy()
        readings.take_state(20.0, state(time=20.0, status=BROKEN, highest_load=7000.0))
        self.assertIn('grey: of a rod that has parted no tension is known', self.texts(readings))
        self.assertTrue((self.drawing.draw(readings) != before).any())

    def test_with_a_measured_curve(self):
        readings = pull(Readings(), [0.0, 10.0])
        readings.bar = color_bar()
        for stamp in (20.0, 21.0):
            readings.measured_pairs.add(0, stamp, 0.001 * stamp)
            readings.measured_pairs.add(1, stamp, 30.0)
        self.assertLessEqual({'simulated', 'measured', '30'}, set(self.texts(readings)))

    def test_beside_a_record_without_travel_loads_are_over_time(self):
        readings = pull(Readings(), [2.0, 10.0], begin=5.0)
        readings.bar = color_bar()
        for stamp in (20.0, 30.0):
            readings.take_measured_load(stamp, 40.0)
        self.assertEqual(readings.over_time(), [[(0.0, 2.0), (1.0 / 3.0, 10.0)], [(0.0, 40.0), (10.0, 40.0)]])
        self.assertLessEqual({'simulated', 'measured', '40', '15.0', TIME}, set(self.texts(readings)))
        readings.measured_pairs.add(0, 30.0, 0.02)
        self.assertIsNone(readings.over_time())
        self.assertIn(EXTENSION, self.texts(readings))

    def test_what_changes_is_drawn_anew_without_the_rest(self):
        readings = pull(Readings(), [0.0, 3.0, 5.0])
        before = self.drawing.draw(readings).copy()
        pull(readings, [5.0], begin=1.2, step=0.0, time=1.2, phase='hold', extension=readings.curve[-1][0])
        after = self.drawing.draw(readings)
        rows = (before != after).any(axis=(1, 2)).nonzero()[0]
        self.assertGreater(len(rows), 0)
        self.assertLess(rows.max(), HEIGHT // 2)  # in the table only
        self.assertTrue((self.drawing.draw(readings) == after).all())


class PanelNodeTest(unittest.TestCase):

    def test_an_interrupt_while_it_loads_is_no_traceback(self):
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(folder, 'rospy.py'), 'w', encoding='utf-8') as file:
                file.write('import os, signal\nos.kill(os.getpid(), signal.SIGINT)\n')
            ended = subprocess.run([os.path.join(ROOT, 'python/knot_utm/panel/panel_node')],
                                   env=dict(os.environ, PYTHONPATH=folder + os.pathsep + os.path.join(ROOT, 'python')), check=False,
                                   capture_output=True)
            self.assertEqual((ended.returncode, ended.stdout, ended.stderr), (-signal.SIGINT, b'', b''))


if __name__ == '__main__':
    unittest.main()
