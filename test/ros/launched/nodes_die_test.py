#!/usr/bin/python3
"""A process is killed in the middle of a test: the launch names it and ends, what was measured is on disk."""
import os
import signal
import sys
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), '../../../bench'))

from launched import METHOD, ROOT, Launch
from dying import Dying


class NodesDieTest(Dying):

    def test_machine(self):
        self.dies('utm_node', 'interrupted', 'utm_node died before the test had ended')

    def test_physics(self):
        self.dies('knot_node', 'solver', 'knot_node died during the test')

    def test_interrupted(self):
        with Launch('method:=' + METHOD, 'rviz:=false', command=[os.path.join(ROOT, 'scripts/tighten')]) as launch:
            launch.wait_for_rows(3)
            os.killpg(launch.process.pid, signal.SIGINT)  # as Ctrl-C does
            self.assertEqual(launch.end(), 1)
            self.assertTrue(launch.console().endswith(
                'scripts/tighten: the test was cut off; the files are in %s\n' % launch.out), launch.console())
            self.assertEqual((launch.result('ended_by'), launch.result('reason')),
                             ('interrupted', 'ROS was shut down before the test had ended'))


if __name__ == '__main__':
    unittest.main()
