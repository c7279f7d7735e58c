#!/usr/bin/python3
"""The ROS master is killed in the middle of a test."""
import os
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), '../../../bench'))

from dying import Dying
from launched import METHOD, Headless, Launch, free_port

HOLD = 'program.hold.duration=10'


class MasterDiesTest(Dying):

    def test_master_of_the_launch(self):
        self.dies('master', 'interrupted', 'the ROS master died before the test had ended')

    def test_master_that_was_there_before(self):
        # Nobody watches it, and the nodes do not need it any more: the test goes on to its end.
        port = free_port()
        with tempfile.TemporaryDirectory() as log:
            master = subprocess.Popen(['rosmaster', '--core', '-p', str(port)], env=dict(os.environ, ROS_LOG_DIR=log),
                                      stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            try:
                with Launch('method:=' + METHOD, "overrides:='" + HOLD + "'", port=port) as launch:
                    launch.wait_for_rows(3)
                    master.kill()
                    launch.end()
                    self.assertEqual(launch.result('ended_by'), 'program')
                    with Headless(METHOD, HOLD) as headless:
                        self.assertEqual(headless.different(launch.out), ([], []))
            finally:
                master.kill()
                master.wait()


if __name__ == '__main__':
    unittest.main()
