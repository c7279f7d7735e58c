#!/usr/bin/python3
"""A batch that is cut off, by Ctrl-C or by the death of a node, says how to go on, and then has the statistics that it would
have had."""
import os
import re
import shlex
import signal
import subprocess
import sys
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), '../../../bench'))

from launched import ROOT, TOOL, Headless, Launch, wait_for

BATCH = os.path.join(ROOT, 'test/ros/batch.yaml')


def content(*path):
    with open(os.path.join(*path), 'rb') as file:
        return file.read()


class CutOffBatchTest(unittest.TestCase):

    def assert_goes_on_after(self, cut_off):
        with Launch('method:=' + BATCH, 'real_time_factor:=0.5') as launch, Headless(BATCH) as headless:
            second = os.path.join(launch.out, 'specimen_002')
            curve = os.path.join(second, 'curve.csv')
            wait_for('the second test', lambda: os.path.exists(curve) and content(curve).count(b'\n') > 7)
            cut_off(launch)
            launch.end()
            wait_for('what was measured', lambda: os.path.exists(os.path.join(second, 'result.yaml')))
            self.assertIn('specimens: 1\nrejected: []\n', launch.text('statistics.yaml'))
            command = re.search(r'test the others by: (.*)', launch.console())
            self.assertTrue(command, launch.console())
            words = shlex.split(command[1])
            self.assertTrue(os.path.samefile(words[0], TOOL))
            # Whoever writes the files of a recorder that was killed may not have let go of the folder.
            wait_for('the others', lambda: subprocess.run(words + ['--quiet'], check=False).returncode == 0)
            for name in 'statistics.yaml', 'specimens.csv', 'specimen_002/curve_full.csv', 'specimen_003/curve_full.csv':
                self.assertEqual(content(launch.out, name), content(headless.folder, name), name)
            self.assertFalse(os.path.exists(os.path.join(launch.out, 'journal')))

    def test_by_ctrl_c(self):
        self.assert_goes_on_after(lambda launch: os.kill(launch.roslaunch(), signal.SIGINT))

    def test_by_the_death_of_the_physics(self):
        self.assert_goes_on_after(lambda launch: os.kill(launch.pid('knot_node'), signal.SIGKILL))

    def test_by_the_death_of_the_machine(self):
        self.assert_goes_on_after(lambda launch: os.kill(launch.pid('utm_node'), signal.SIGKILL))

    def test_by_the_death_of_the_recorder(self):
        self.assert_goes_on_after(lambda launch: os.kill(launch.pid('recorder_node'), signal.SIGKILL))


if __name__ == '__main__':
    unittest.main()
