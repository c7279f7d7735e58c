#!/usr/bin/python3
"""Whole tests, launched as a user does it: a program up to the break of the rod, and a batch."""
import os
import sys
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), '../../../bench'))

from launched import ROOT, Headless, Launch

PROGRAM = os.path.join(ROOT, 'test/ros/whole_program.yaml')
BATCH = os.path.join(ROOT, 'test/ros/batch.yaml')


class ProgramTest(unittest.TestCase):

    def test_same_files_as_headless(self):
        with Launch('method:=' + PROGRAM) as launch, Headless(PROGRAM) as headless:
            launch.end()
            self.assertEqual(launch.result('ended_by'), 'break', launch.console())
            self.assertIn('the rod parted', launch.result('reason'))
            self.assertEqual(headless.different(launch.out), ([], []))

    def test_a_batch_ends_with_its_statistics(self):
        with Launch('method:=' + BATCH, 'rviz:=false', 'real_time_factor:=0',
                    command=[os.path.join(ROOT, 'scripts/tighten')]) as launch:
            self.assertEqual(launch.end(), 0, launch.console())
            self.assertIn('\n3 of 3 specimens count\n', launch.console())


if __name__ == '__main__':
    unittest.main()
