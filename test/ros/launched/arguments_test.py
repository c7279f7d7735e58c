#!/usr/bin/python3
"""What is handed to scripts/tighten stays text: it names files, and commands nothing."""
import os
import shutil
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
            self.assertIn('is not allowed: a file whose name without ending is a name for a folder', launch.console())
            self.assertEqual(sorted(os.listdir(launch.folder)), ['...yaml', 'console', 'log'])


if __name__ == '__main__':
    unittest.main()
