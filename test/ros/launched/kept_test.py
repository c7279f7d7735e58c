#!/usr/bin/python3
"""A second test into the same folder leaves the first one as it is; a knot that comes undone is no success."""
import os
import shutil
import sys
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), '../../../bench'))

from launched import METHOD, ROOT, Launch

SCRIPT = [os.path.join(ROOT, 'scripts/tighten')]
SHORT = "overrides:='program.hold.duration=0.1'"
SLIPPERY = ("'material=polypropylene', 'specimen.preload=20', 'specimen.edge_length=0.005', "
            "'material.friction_coefficient=0.05', 'physics.accuracy=draft'")


def content(*path):
    with open(os.path.join(*path), 'rb') as file:
        return file.read()


class KeptTest(unittest.TestCase):

    def test_the_second_one_goes_elsewhere_and_its_result_is_told(self):
        def first(folder):
            out = os.path.join(folder, 'out')
            with Launch('method:=' + METHOD, 'rviz:=false', SHORT, command=SCRIPT) as launch:
                self.assertEqual(launch.end(), 0, launch.console())
                shutil.copytree(launch.out, out)

        with Launch('method:=' + METHOD, 'rviz:=false', SHORT, command=SCRIPT, prepare=first) as launch:
            before = content(launch.out, 'result.yaml')
            self.assertEqual(launch.end(), 0, launch.console())
            self.assertEqual(content(launch.out, 'result.yaml'), before)
            self.assertEqual(content(launch.out, 'curve.csv'), content(launch.out + '-2', 'curve.csv'))
            self.assertIn(launch.out + ' holds a run already', launch.console())
            self.assertIn('\nthe test ended by ', launch.console())
            self.assertLess(len(launch.console().partition('\nthe test ended by ')[2].splitlines()), 11)

    def test_a_knot_that_comes_undone(self):
        for program, code in ('', 1), (", 'program=[{tie: {}}, {release: {}}]'", 0):
            with Launch('rviz:=false', 'real_time_factor:=0', 'overrides:=' + SLIPPERY + program,
                        command=SCRIPT) as launch:
                self.assertEqual(launch.end(), code, launch.console())
                self.assertEqual(launch.result('ended_by'), 'untangled')
                self.assertIn('a higher specimen.preload (now 20 N; auto is 50 N)', launch.console())


if __name__ == '__main__':
    unittest.main()
