#!/usr/bin/python3
"""A physics that gives up ends the test, and leaves the files of the headless tool: the step that could not be made
too."""
import os
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), '../../../bench'))

from launched import FILES, ROOT, TOOL, Launch

METHOD = os.path.join(ROOT, 'test/ros/impossible.yaml')
SCRIPT = [os.path.join(ROOT, 'scripts/tighten')]


def content(*path):
    with open(os.path.join(*path), 'rb') as file:
        return file.read()


class GivesUpTest(unittest.TestCase):

    def test_same_files_as_headless(self):
        with Launch('method:=' + METHOD, 'rviz:=false', command=SCRIPT) as launch, \
                tempfile.TemporaryDirectory() as headless:
            self.assertEqual(subprocess.run([TOOL, METHOD, '--quiet', '--out', headless], check=False,
                                            stderr=subprocess.DEVNULL).returncode, 1)
            self.assertEqual(launch.end(60.0), 1, launch.console())
            self.assertEqual(launch.result('ended_by'), 'solver')
            for name in FILES + ['failed_step.bin']:
                self.assertEqual(content(launch.out, name), content(headless, name), name)
            self.assertIn('scripts/replay-step ' + launch.out + '/failed_step.bin', launch.console())
            replay = os.path.join(os.path.dirname(TOOL), 'replay_step')
            said = subprocess.run([replay, launch.out + '/failed_step.bin'], check=False, stdout=subprocess.PIPE)
            self.assertEqual(said.returncode, 1)


if __name__ == '__main__':
    unittest.main()
