#!/usr/bin/python3
"""A batch by the action utm/run_test: its specimens are those of tensile_test, and nothing of it is lost where it is stopped."""
import filecmp
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))

import rospkg
import rospy
import rostest
import yaml
from actionlib_msgs.msg import GoalStatus
from catkin.find_in_workspaces import find_in_workspaces
from dynamic_reconfigure.client import Client
from goal import Goal, start
from node_test import LAST_RESORT

OUT = '/tmp/knot_utm_batch_test'
METHOD = os.path.join(rospkg.RosPack().get_path('knot_utm'), 'test', 'ros', 'batch.yaml')
SPECIMENS = ['specimen_001', 'specimen_002', 'specimen_003']
FILES = ['curve.csv', 'curve_full.csv', 'final_shape.csv', 'method.yaml']


def tensile_test(*words):
    tool = find_in_workspaces(['libexec'], 'knot_utm', 'tensile_test', first_match_only=True)[0]
    subprocess.run([tool, *words, '--quiet'], check=True)


def load(*path):
    with open(os.path.join(*path), encoding='utf-8') as file:
        return yaml.safe_load(file)


class BatchTest(unittest.TestCase):
    """One story, told in order."""

    @classmethod
    def setUpClass(cls):
        for folder in OUT, OUT + '-2', OUT + '-3', OUT + '-4':
            shutil.rmtree(folder, ignore_errors=True)
        rospy.init_node('several_specimens_test')
        cls.headless = tempfile.mkdtemp()
        tensile_test(METHOD, '--out', cls.headless + '/batch')
        tensile_test(METHOD, '--specimens', '1', '--out', cls.headless + '/alone')

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.headless)

    def assert_same_as_headless(self, folder, other, names):
        _, different, missing = filecmp.cmpfiles(folder, os.path.join(self.headless, other), names, shallow=False)
        self.assertEqual(different + missing, [], folder)

    def test_1_as_many_as_the_method_says(self):
        goal = start()
        state, result, text = goal.wait()
        self.assertEqual(state, GoalStatus.SUCCEEDED, text)
        self.assertEqual(result.directory, OUT)
        self.assertEqual([t.specimen for t in result.tests], [1, 2, 3])
        self.assertEqual([t.run for t in result.tests], [1, 2, 3])
        self.assertEqual([t.directory for t in result.tests], [os.path.join(OUT, name) for name in SPECIMENS])
        self.assertEqual((result.run, result.peak_force), (3, result.tests[-1].peak_force))
        for name in SPECIMENS:
            self.assert_same_as_headless(os.path.join(OUT, name), os.path.join('batch', name), FILES)
            self.assertTrue(os.path.exists(os.path.join(OUT, name, 'test.bag')))
        self.assert_same_as_headless(OUT, 'batch', ['method.yaml', 'specimens.csv', 'statistics.yaml'])
        # They differ, so that a specimen tested thrice would be seen.
        forces = load(OUT, 'statistics.yaml')['peak_force']
        self.assertEqual(forces['n'], 3)
        self.assertGreater(forces['sd'], 0.001 * forces['mean'])
        for test, reading in zip(result.tests, sorted(SPECIMENS)):
            self.assertAlmostEqual(test.peak_force, load(OUT, reading, 'result.yaml')['peak_force'], places=6)

    def test_2_one_alone_does_not_scatter(self):
        goal = start(1)
        state, result, text = goal.wait()
        self.assertEqual(state, GoalStatus.SUCCEEDED, text)
        self.assertEqual((result.directory, len(result.tests)), (OUT + '-2', 1))
        self.assert_same_as_headless(OUT + '-2', 'alone', FILES)

    def test_3_more_than_a_batch_may_have(self):
        state, _, text = Goal(20000).wait()
        self.assertEqual((state, text), (GoalStatus.REJECTED, '20000 specimens are asked for, but under ROS a batch may have at most 1000'))

    def test_4_cancelled_in_the_midst(self):
        Client('utm_node', timeout=LAST_RESORT).update_configuration({'real_time_factor': 0.2})
        goal = start(3)
        while goal.wait_for_feedback().specimen != 2:
            self.assertEqual(goal.feedback[-1].specimens, 3)
        goal.client.cancel_goal()
        state, result, text = goal.wait()
        self.assertEqual(state, GoalStatus.PREEMPTED)
        self.assertEqual(text, 'tested 2 of 3 specimens; the last test ended by operator: stopped by the operator')
        self.assertEqual([t.ended_by for t in result.tests], ['extension', 'operator'])
        self.assertEqual(result.directory, OUT + '-3')
        statistics = load(OUT + '-3', 'statistics.yaml')
        self.assertEqual(statistics['specimens'], 2)
        self.assertEqual(statistics['rejected'], [{'specimen': 2, 'reason': 'the operator stopped the test'}])

    def test_5_the_others_are_tested_later(self):
        Client('utm_node', timeout=LAST_RESORT).update_configuration({'real_time_factor': 0.0})
        start(1).wait()  # so that the recorder leaves the batch
        tensile_test('--resume', OUT + '-3')
        self.assertEqual(load(OUT + '-3', 'statistics.yaml')['specimens'], 3)
        # What the operator stopped stays stopped.
        self.assertEqual(load(OUT + '-3', 'statistics.yaml')['rejected'],
                         [{'specimen': 2, 'reason': 'the operator stopped the test'}])
        for name in SPECIMENS[0], SPECIMENS[2]:
            self.assert_same_as_headless(os.path.join(OUT + '-3', name), os.path.join('batch', name), FILES)


if __name__ == '__main__':
    rostest.rosrun('knot_utm', 'several_specimens', BatchTest)
