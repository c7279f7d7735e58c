#!/usr/bin/python3
"""What is handed to scripts/tighten stays text: it names files, and commands nothing."""
import os
import re
import shutil
import subprocess
import sys
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), '../../../bench'))

from launched import METHOD, ROOT, Launch

SCRIPT = [os.path.join(ROOT, 'scripts/tighten')]
SHORT = "overrides:='program.hold.duration=0.1'"


class ArgumentsTest(unittest.TestCase):

    def test_folder_with_every_kind_of_character(self):
        name = "o ut; touch hacked; `touch hacked` & 'x' | \"y\" $HOME * #"
        with Launch('method:=' + METHOD, 'rviz:=false', SHORT, 'out:=' + name, command=SCRIPT) as launch:
            self.assertEqual(launch.end(60.0), 0, launch.console())
            self.assertTrue(os.path.exists(os.path.join(launch.folder, name, 'result.yaml')))
            self.assertEqual(sorted(os.listdir(launch.folder)), sorted([name, 'console', 'log']))

    def test_method_that_is_called_like_a_folder(self):
        def copy(folder):
            shutil.copy(METHOD, os.path.join(folder, '...yaml'))

        with Launch('method:=...yaml', 'rviz:=false', 'out:=', command=SCRIPT, prepare=copy) as launch:
            self.assertEqual(launch.end(60.0), 1)
            self.assertIn('its name without its ending is that of the folder to write to', launch.console())
            self.assertEqual(sorted(os.listdir(launch.folder)), ['...yaml', 'console', 'log'])

    def test_every_parameter_of_a_test_is_set_anew(self):
        # A master outlives a launch: what the one before has left there must not be taken for this one's.
        said = subprocess.run(['roslaunch', '--dump-params', 'knot_utm', 'tighten.launch'], stdout=subprocess.PIPE,
                              universal_newlines=True, check=True).stdout
        with open(os.path.join(ROOT, 'src/ros/test_setup.cpp'), encoding='utf-8') as code:
            read = set(re.findall(r'"(test/\w+)"', code.read()))
        self.assertIn('test/data', read)
        for name in read:
            self.assertIn('/%s: ' % name, said)


if __name__ == '__main__':
    unittest.main()
