#!/usr/bin/python3
"""A physics that gives up ends the test, and leaves the files of the headless tool."""
import os
import signal
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), '../../../bench'))
sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), '..'))

from launched import FILES, ROOT, TOOL, Launch, wait_for

METHOD = os.path.join(ROOT, 'test/ros/impossible.yaml')
SCRIPT = [os.path.join(ROOT, 'scripts/tighten')]


def content(*path):
    with open(os.path.join(*path), 'rb') as file:
        return file.read()


class GivesUpTest(unittest.TestCase):

    def assert_same_as_headless(self, launch):
        self.assertEqual(launch.result('ended_by'), 'solver')
        with tempfile.TemporaryDirectory() as headless:
            code = subprocess.run([TOOL, METHOD, '--quiet', '--out', headless], check=False,
                                  stderr=subprocess.DEVNULL).returncode
            self.assertEqual(code, 1)
            for name in FILES:
                self.assertEqual(content(launch.out, name), content(headless, name), name)

    def test_same_files_as_headless(self):
        with Launch('method:=' + METHOD, 'rviz:=false', command=SCRIPT) as launch:
            self.assertEqual(launch.end(), 1, launch.console())
            self.assert_same_as_headless(launch)

    def test_recorder_that_is_killed_once_it_has_the_failure(self):
        # So slow that it is paused before it does anything.
        with Launch('method:=' + METHOD, 'respawn:=true', 'autostart:=false', 'real_time_factor:=0.0001') as launch:
            recorder = launch.pid('recorder_node')
            wait_for('the master', lambda: launch.answers('utm_node'))
            os.environ['ROS_MASTER_URI'] = launch.uri
            # Not before: they take the master's address when they are loaded.
            import rospy
            from knot_utm.msg import KnotState, RecorderStatus, TestStatus
            from node_test import Latest, call, start_test
            from std_srvs.srv import Trigger
            rospy.init_node('gives_up_test', disable_signals=True)
            states, status = Latest('knot/state', KnotState), Latest('utm/status', TestStatus)
            recorded = Latest('recorder/status', RecorderStatus)
            # What is answered before somebody listens is not said again.
            wait_for('who answers', states.connected)
            start_test()
            self.assertTrue(call('utm/pause', Trigger).success)
            sequence = status.wait('paused', lambda s: s.state == TestStatus.PAUSED).sequence
            # The machine ends the test when it is asked for a command more than this one.
            while states.wait('an answer', lambda s, due=sequence: s.sequence >= due).status != KnotState.FAILED:
                self.assertTrue(call('utm/step', Trigger).success)
                sequence += 1
            recorded.wait('the failure on disk', lambda s: s.next_sequence > sequence)
            os.kill(recorder, signal.SIGKILL)
            self.assertFalse(os.path.exists(os.path.join(launch.out, 'result.yaml')))
            wait_for('another recorder', lambda: launch.processes().get('recorder_node') not in (None, recorder))
            self.assertTrue(call('utm/resume', Trigger).success)
            launch.end()
            self.assertIn('goes on with', launch.console())
            self.assert_same_as_headless(launch)


if __name__ == '__main__':
    unittest.main()
