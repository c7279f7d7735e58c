#!/usr/bin/python3
"""Nodes that join late and a subscriber that is slow change nothing: the files are those of the headless tool."""
import filecmp
import os
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))

import rospkg
import rospy
import rostest
from catkin.find_in_workspaces import find_in_workspaces
from knot_utm.msg import KnotRecord, RecorderStatus
from node_test import Latest

OUT = '/tmp/knot_utm_late_test'


def slow(_message):
    time.sleep(0.5)


class LateAndSlowTest(unittest.TestCase):

    def test_same_files_as_headless(self):
        rospy.init_node('late_and_slow_test')
        rospy.Subscriber('knot/record', KnotRecord, slow, queue_size=1)
        rospy.Subscriber('knot/state', rospy.AnyMsg, slow, queue_size=1)
        recorder = Latest('recorder/status', RecorderStatus)
        status = recorder.wait('complete', lambda r: r.complete)
        self.assertEqual(status.dropped, 0)
        self.addCleanup(shutil.rmtree, status.directory)
        self.assertTrue(status.directory.startswith(OUT))

        headless = tempfile.mkdtemp()
        try:
            tool = find_in_workspaces(['libexec'], 'knot_utm', 'tensile_test', first_match_only=True)[0]
            method = os.path.join(rospkg.RosPack().get_path('knot_utm'), 'config', 'straight.yaml')
            subprocess.run([tool, method, '--out', headless, '--quiet', '--set', 'machine.stiffness=1e6',
                            '--set', 'machine.load_cell.accuracy=0.005'], check=True)
            with open(os.path.join(headless, 'curve.csv'), encoding='utf-8') as curve:
                self.assertTrue(curve.readline().endswith(',phase,balance_offset,crosshead_travel\n'))
            for name in ['curve.csv', 'curve_full.csv', 'final_shape.csv', 'method.yaml', 'test.bag']:
                self.assertTrue(filecmp.cmp(os.path.join(status.directory, name), os.path.join(headless, name), shallow=False), name)
        finally:
            shutil.rmtree(headless)


if __name__ == '__main__':
    rostest.rosrun('knot_utm', 'late_and_slow', LateAndSlowTest)
