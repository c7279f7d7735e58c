#!/usr/bin/python3
"""What is handed to scripts/tighten stays text: it names files, and commands nothing."""
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import yaml

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), '../../../bench'))

from launched import METHOD, ROOT, Launch

SCRIPT = [os.path.join(ROOT, 'scripts/tighten')]
SHORT = "overrides:='program.hold.duration=0.1'"


class ArgumentsTest(unittest.TestCase):

    def test_folder_with_every_kind_of_character(self):
        name = "o ut; touch hacked; `touch hacked` & 'x' | \"y\" $HOME * #"
        with Launch('method:=' + METHOD, 'rviz:=false', SHORT, 'out:=' + name, command=SCRIPT) as launch:
            self.assertEqual(launch.end(), 0, launch.console())
            self.assertTrue(os.path.exists(os.path.join(launch.folder, name, 'result.yaml')))
            self.assertEqual(sorted(os.listdir(launch.folder)), sorted([name, 'console', 'log']))

    def test_method_that_is_called_like_a_folder(self):
        def copy(folder):
            shutil.copy(METHOD, os.path.join(folder, '...yaml'))

        with Launch('method:=...yaml', 'rviz:=false', 'out:=', command=SCRIPT, prepare=copy) as launch:
            self.assertEqual(launch.end(), 2)
            self.assertIn('its name without its ending is that of the folder to write to', launch.console())
            self.assertEqual(sorted(os.listdir(launch.folder)), ['...yaml', 'console', 'log'])

    def refused(self, *command):
        """What was said of words that are wrong; nothing was started."""
        with Launch(command=list(command)) as launch:
            code = launch.end()
            self.assertEqual(os.path.exists(launch.out), False)
            return code, launch.console()

    def test_unknown_argument_is_refused_with_the_nearest_known_one(self):
        said = 'matrial is no argument of tighten.launch; did you mean material?'
        self.assertEqual(self.refused(*SCRIPT, 'matrial:=nylon'), (2, said + '\n'))
        for file in ('tighten.launch', 'experiment.launch', 'replay.launch'):
            needed = {'experiment.launch': ['data:=x'], 'replay.launch': ['bag:=x']}.get(file, [])
            word, meant = ('color_buy', 'color_by') if file == 'replay.launch' else ('matrial', 'material')
            code, console = self.refused('roslaunch', 'knot_utm', file, *needed, word + ':=nylon')
            self.assertEqual(code, 1)
            self.assertIn('%s is no argument of %s; did you mean %s?' % (word, file, meant), console)
            self.assertNotIn('started with pid', console)

    def test_what_is_no_argument_is_refused(self):
        for word, said in (('nylon', 'nylon is no argument of tighten.launch'),
                           ('material=nylon', 'did you mean material:=nylon?'),
                           ('--fast', '--fast is no option'), ('nothing_like_it:=1', 'which has method, material')):
            code, console = self.refused(*SCRIPT, word)
            self.assertEqual((code, console.count('\n')), (2, 1), console)
            self.assertIn(said, console)

    def test_arguments_of_a_launch_file_that_includes_ours_are_its_own(self):
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, 'mine.launch')
            with open(file, 'w', encoding='utf-8') as text:
                text.write('<launch><arg name="mine"/><include file="$(find knot_utm)/launch/tighten.launch"/></launch>')
            subprocess.run(['roslaunch', '--dump-params', file, 'mine:=1'], stdout=subprocess.DEVNULL, check=True)

    def test_both_launch_files_say_how_a_record_is_read(self):
        for file in ('tighten.launch', 'experiment.launch'):
            given = ['data:=x.csv', 'columns:=load=3', 'units:=load=lbf', 'specimen:=2', 'invert:=load']
            check = subprocess.run([os.path.join(ROOT, 'launch/check_arguments'), file] + given, stderr=subprocess.PIPE,
                                   stdout=subprocess.DEVNULL, universal_newlines=True, check=False)
            self.assertEqual((check.returncode, check.stderr), (0, ''))
            said = subprocess.run(['roslaunch', '--dump-params', 'knot_utm', file] + given, stdout=subprocess.PIPE,
                                  universal_newlines=True, check=True).stdout
            found = yaml.safe_load(said)
            for name, _, value in (word.partition(':=') for word in given):
                self.assertEqual(found['/test/' + name], value, file)

    def test_every_parameter_of_a_test_is_set_anew(self):
        # A master outlives a launch: what the one before has left there must not be taken for this one's.
        said = subprocess.run(['roslaunch', '--dump-params', 'knot_utm', 'tighten.launch'], stdout=subprocess.PIPE,
                              universal_newlines=True, check=True).stdout
        with open(os.path.join(ROOT, 'src/ros/method_setup.cpp'), encoding='utf-8') as code:
            read = set(re.findall(r'"(test/\w+)"', code.read()))
        self.assertIn('test/data', read)
        for name in read:
            self.assertIn('/%s: ' % name, said)


if __name__ == '__main__':
    unittest.main()
