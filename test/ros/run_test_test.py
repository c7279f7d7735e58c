#!/usr/bin/python3
"""The action utm/run_test, what dynamic_reconfigure changes while a test runs, and /diagnostics."""
import filecmp
import math
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest
import xmlrpc.client

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))

import rospkg
import rospy
import rostest
from actionlib_msgs.msg import GoalStatus
from catkin.find_in_workspaces import find_in_workspaces
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from dynamic_reconfigure.client import Client
from goal import Goal, start
from knot_utm.msg import ColorBar, KnotState, TestStatus
from node_test import LAST_RESORT, Latest, call
from own_launch import wait_until
from rosgraph_msgs.msg import Clock, Log
from std_srvs.srv import Trigger
from visualization_msgs.msg import Marker, MarkerArray

OUT = '/tmp/knot_utm_run_test'


def process(node):
    """Its number."""
    uri = xmlrpc.client.ServerProxy(os.environ['ROS_MASTER_URI']).lookupNode('/test', '/' + node)[2]
    return xmlrpc.client.ServerProxy(uri).getPid('/test')[2]


def difference(folder):
    """Files of a test that are not those of the headless tool, byte for byte."""
    headless = tempfile.mkdtemp()
    try:
        tool = find_in_workspaces(['libexec'], 'knot_utm', 'tensile_test', first_match_only=True)[0]
        method = os.path.join(rospkg.RosPack().get_path('knot_utm'), 'test', 'ros', 'pull_for_seconds.yaml')
        subprocess.run([tool, method, '--out', headless, '--quiet'], check=True)
        names = ['curve.csv', 'curve_full.csv', 'final_shape.csv', 'method.yaml', 'test.bag']
        _, different, missing = filecmp.cmpfiles(folder, headless, names, shallow=False)
        return different + missing
    finally:
        shutil.rmtree(headless)


class RunTestTest(unittest.TestCase):
    """One story, told in order."""

    @classmethod
    def setUpClass(cls):
        shutil.rmtree(OUT, ignore_errors=True)
        rospy.init_node('run_test_test')
        cls.goals = []
        cls.clock = Latest('/clock', Clock)
        cls.state = Latest('knot/state', KnotState)
        cls.status = Latest('utm/status', TestStatus)
        cls.markers = Latest('knot/markers', MarkerArray)
        cls.colors = Latest('knot/colors', ColorBar)
        cls.console = Latest('/rosout', Log)
        cls.diagnostics = Latest('/diagnostics', DiagnosticArray)

    def diagnosis(self, name, what, condition):
        """The status of this name, once condition(status) holds."""
        def latest(message):
            return next((s for s in message.status if s.name == name), None)

        def holds(message):
            status = latest(message)
            return status is not None and condition(status)
        return latest(self.diagnostics.wait(name + ': ' + what, holds))

    def said(self, line):
        """By some node on its console, and so on /rosout."""
        wait_until(line, lambda: any(line == m.msg for m in self.console.messages))

    def test_1_a_test_whose_pace_and_picture_are_changed_is_the_same_test(self):
        goal = start()
        while goal.wait_for_feedback().phase != 'pull' or goal.feedback[-1].extension <= 0.0:
            pass
        told = goal.feedback[-1]
        self.assertGreater(told.force, 1.0)
        self.assertEqual(told.load, told.force)
        self.assertTrue(math.isnan(told.knot_distance))
        self.assertGreater(told.progress, 0.0)

        other = Goal()
        state, _, text = other.wait()
        self.assertEqual((state, text), (GoalStatus.REJECTED, 'a test is running'))

        healthy = self.diagnosis('utm_node: machine', 'runs', lambda s: s.message == 'running')
        self.assertEqual(healthy.level, DiagnosticStatus.OK)
        physics = self.diagnosis('knot_node: physics', 'pulls', lambda s: s.message == 'pull')
        values = {v.key: float(v.value) for v in physics.values}
        self.assertGreater(values['time steps'], 0.0)
        self.assertLessEqual(values['Newton iterations per time step of late'], values['Newton iterations'])
        self.diagnosis('recorder_node: files', 'records', lambda s: s.message == 'recording')

        self.markers.wait('a picture', lambda m: any(k.ns == 'rod' for k in m.markers))
        self.colors.wait('tension', lambda bar: bar.quantity == 'tension')
        view = Client('knot_node', timeout=LAST_RESORT)
        changed = view.update_configuration({'color_by': 'curvature', 'marker_rate': 50.0})
        self.assertEqual(changed['color_by'], 'curvature')
        self.colors.wait('curvature', lambda bar: bar.quantity == 'curvature')
        self.assertEqual(view.update_configuration({'color_by': 'beauty'})['color_by'], 'curvature')
        self.said('knot_node: refused: color_by is "beauty", but must be tension or curvature')
        self.assertEqual(view.update_configuration({'marker_rate': 1000.0})['marker_rate'], 50.0)
        self.said('knot_node: refused: marker_rate is 1000, but must be 0.1 to 60')

        machine = Client('utm_node', timeout=LAST_RESORT)
        self.assertEqual(machine.update_configuration({'real_time_factor': -1.0})['real_time_factor'], 0.2)
        self.said('utm_node: real_time_factor: -1 is refused: 0 or more is allowed; it stays 0.2')
        self.assertEqual(machine.update_configuration({'real_time_factor': 0.0})['real_time_factor'], 0.0)
        state, result, text = goal.wait()
        self.assertEqual(state, GoalStatus.SUCCEEDED, text)
        self.assertEqual((result.run, result.ended_by, result.directory), (1, 'program', OUT))
        self.assertAlmostEqual(result.time, 8.0, delta=0.1)
        self.assertGreater(result.peak_force, told.force)
        self.assertEqual(difference(OUT), [])

    def test_2_slower_than_asked_for_is_said(self):
        Client('utm_node', timeout=LAST_RESORT).update_configuration({'real_time_factor': 0.2})
        goal = start()
        goal.wait_for_feedback()
        physics = process('knot_node')
        os.kill(physics, signal.SIGSTOP)
        try:
            late = self.diagnosis('utm_node: machine', 'late', lambda s: s.level == DiagnosticStatus.WARN)
        finally:
            os.kill(physics, signal.SIGCONT)
        self.assertIn('slower than asked for', late.message)
        self.diagnosis('utm_node: machine', 'in time again', lambda s: s.level == DiagnosticStatus.OK)
        self.goals.append(goal)

    def test_3_cancelled(self):
        goal = self.goals.pop()
        goal.wait_for_feedback()
        goal.client.cancel_goal()
        state, result, _ = goal.wait()
        self.assertEqual(state, GoalStatus.PREEMPTED)
        self.assertEqual(result.ended_by, 'operator')
        with open(os.path.join(result.directory, 'result.yaml'), encoding='utf-8') as file:
            self.assertIn('ended_by: operator', file.read())

    def test_4_stopped_by_another_operator(self):
        goal = start()
        goal.wait_for_feedback()
        self.assertTrue(call('utm/stop_test', Trigger).success)
        self.assertEqual(goal.wait()[0], GoalStatus.PREEMPTED)

    def test_5_the_physics_gives_up(self):
        goal = start()
        goal.wait_for_feedback()
        self.assertTrue(call('knot/reset', Trigger).success)
        state, result, text = goal.wait()
        self.assertEqual(state, GoalStatus.ABORTED)
        self.assertEqual(result.ended_by, 'solver')
        self.assertIn('reset', text)
        sick = self.diagnosis('utm_node: machine', 'gave up', lambda s: s.level == DiagnosticStatus.ERROR)
        self.assertIn('reset', sick.message)

    def test_6_clock_never_went_back(self):
        stamps = [m.clock for m in self.clock.messages]
        self.assertGreater(stamps[-1], stamps[0])
        self.assertEqual(stamps, sorted(stamps))


if __name__ == '__main__':
    rostest.rosrun('knot_utm', 'run_test', RunTestTest)
