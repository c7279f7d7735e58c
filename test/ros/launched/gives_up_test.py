#!/usr/bin/python3
"""A physics that gives up ends the test, and leaves the files of the headless tool: the step that could not be made
too."""
import os
import signal
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), '../../../bench'))

from launched import FILES, ROOT, TOOL, Launch, wait_for

METHOD = os.path.join(ROOT, 'test/ros/impossible.yaml')
SCRIPT = [os.path.join(ROOT, 'scripts/tighten')]
STEP = 'failed_step.bin'


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
            for name in FILES + [STEP]:
                self.assertEqual(content(launch.out, name), content(headless, name), name)

    def test_same_files_as_headless(self):
        with Launch('method:=' + METHOD, 'rviz:=false', command=SCRIPT) as launch:
            self.assertEqual(launch.end(60.0), 1, launch.console())
            self.assert_same_as_headless(launch)
            self.assertIn('scripts/replay-step %s/%s' % (launch.out, STEP), launch.console())
            replay = [os.path.join(os.path.dirname(TOOL), 'replay_step'), os.path.join(launch.out, STEP)]
            self.assertEqual(subprocess.run(replay, check=False, stdout=subprocess.DEVNULL).returncode, 1)

    def test_recorder_that_is_killed_once_it_has_the_failure(self):
        # On a busy machine the test may end before the recorder is killed: what is meant then has not happened yet.
        for _ in range(5):
            if self.went_on_after_a_kill():
                return
        self.fail('the recorder was never killed in time')

    def went_on_after_a_kill(self):
        with Launch('method:=' + METHOD, 'respawn:=true', 'real_time_factor:=0') as launch:
            machine, recorder = launch.pid('utm_node'), launch.pid('recorder_node')
            step = os.path.join(launch.out, STEP)
            # In slices, so that the machine hardly ends the test before the recorder is killed.
            for _ in range(1000):
                if os.path.exists(step):
                    break
                os.kill(machine, signal.SIGCONT)
                time.sleep(0.01)
                os.kill(machine, signal.SIGSTOP)
                time.sleep(0.05)
            time.sleep(0.2)
            os.kill(recorder, signal.SIGKILL)
            if os.path.exists(os.path.join(launch.out, 'result.yaml')):
                return False
            wait_for('another recorder', lambda: launch.processes().get('recorder_node') not in (None, recorder))
            os.kill(machine, signal.SIGCONT)
            launch.end(60.0)
            self.assertIn('goes on with', launch.console())
            self.assert_same_as_headless(launch)
            return True


if __name__ == '__main__':
    unittest.main()
