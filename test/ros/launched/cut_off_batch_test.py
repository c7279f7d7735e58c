#!/usr/bin/python3
"""A batch that is cut off, by Ctrl-C or by the death of a node, says how to go on, and then has the statistics that it would
have had."""
import os
import re
import shlex
import signal
import subprocess
import sys
import time
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), '../../../bench'))

from launched import ROOT, TOOL, Headless, Launch

BATCH = os.path.join(ROOT, 'test/ros/batch.yaml')


def content(*path):
    with open(os.path.join(*path), 'rb') as file:
        return file.read()


def kill(node):
    return lambda launch: os.kill(launch.pid(node), signal.SIGKILL)


CUTS = {'Ctrl-C': lambda launch: os.kill(launch.roslaunch(), signal.SIGINT), 'the physics dies': kill('knot_node'),
        'the machine dies': kill('utm_node'), 'the recorder dies': kill('recorder_node')}


class CutOffBatchTest(unittest.TestCase):

    def assert_goes_on(self, how, launch, headless):
        launch.end()
        self.assertIn('specimens: 1\nrejected: []\n', launch.text('statistics.yaml'))
        command = re.search(r'test the others by: (.*)', launch.console())
        # Who says it is utm_node, unless it is what was killed.
        self.assertTrue(command or how == 'the machine dies', launch.console())
        words = shlex.split(command[1]) if command else [TOOL, '--resume', launch.out]
        self.assertTrue(os.path.samefile(words[0], TOOL))
        subprocess.run(words + ['--quiet'], check=True)
        for name in 'statistics.yaml', 'specimens.csv', 'specimen_002/curve_full.csv', 'specimen_003/curve_full.csv':
            self.assertEqual(content(launch.out, name), content(headless.folder, name), name)

    def test_goes_on(self):
        launches = {}
        try:
            for how in CUTS:  # side by side
                launches[how] = Launch('method:=' + BATCH, 'real_time_factor:=0.2')  # time enough on a busy machine
            to_cut = set(CUTS)
            while to_cut:
                for how in [how for how in to_cut if launches[how].rows('specimen_002') > 5]:
                    CUTS[how](launches[how])
                    to_cut.remove(how)
                for how in to_cut:
                    self.assertIsNone(launches[how].process.poll(), launches[how].console())
                time.sleep(0.02)
            with Headless(BATCH) as headless:
                for how, launch in launches.items():
                    with self.subTest(how):
                        self.assert_goes_on(how, launch, headless)
        finally:
            for launch in launches.values():
                launch.__exit__()


if __name__ == '__main__':
    unittest.main()
