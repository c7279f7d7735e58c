#!/usr/bin/python3
"""A whole test program, up to the break of the rod: live, the files are those of the headless tool."""
import os
import sys
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), '../../../bench'))

from launched import ROOT, Headless, Launch

PROGRAM = os.path.join(ROOT, 'test/ros/whole_program.yaml')


class ProgramTest(unittest.TestCase):

    def test_same_files_as_headless(self):
        with Launch('method:=' + PROGRAM) as launch, Headless(PROGRAM) as headless:
            launch.end()
            self.assertEqual(launch.result('ended_by'), 'break', launch.console())
            self.assertIn('the rod parted', launch.result('reason'))
            self.assertEqual(headless.different(launch.out), ([], []))


if __name__ == '__main__':
    unittest.main()
