#!/usr/bin/python3
"""scripts/tighten and the launch files as a user meets them: arguments, exit codes, what is said and what is written."""
import os
import re
import shlex
import shutil
import signal
import subprocess
import tempfile
import unittest

import yaml

from launched import LAST_RESORT, METHOD, ROOT, TOOL, Launch, free_port, wait_for

SCRIPT = [os.path.join(ROOT, 'scripts/tighten')]
CHECK = [os.path.join(ROOT, 'launch/check')]
IMPOSSIBLE = os.path.join(ROOT, 'test/ros/impossible.yaml')
SHORT = "overrides:='program.hold.duration=0.1'"
SLIPPERY = ("overrides:='material=polypropylene', 'material.bending_law=elastic', 'material.friction_couple=0', 'specimen.preload=20', "
            "'specimen.edge_length=0.005', "
            "'material.friction_coefficient=0.05', 'physics.accuracy=draft'")
# In the place of rviz a node that needs no display.
WITH_WINDOW = """<launch>
  <arg name="working_directory"/>
  <arg name="out"/>
  <include file="$(find knot_utm)/launch/tighten.launch" pass_all_args="true">
    <arg name="method" value="%s"/>
    <arg name="overrides" value="'program.hold.duration=15'"/>
  </include>
  <node name="rviz" pkg="knot_utm" type="panel_node"/>
</launch>
"""
LINE = re.compile(r'\r(\w+) +[\d.]+ %  s +[-\d.]+ mm  load +\S+ N +\S+ x real time +\S+ s left')


def on_terminal(*command, **environment):
    """What a command says on one."""
    run = subprocess.run(['script', '-qfc', shlex.join(command), '/dev/null'], env=dict(os.environ, **environment), check=False,
                         stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, timeout=LAST_RESORT)
    return run.stdout.decode('utf-8', 'replace')


class TightenTest(unittest.TestCase):

    def ends(self, code, *arguments, prepare=None):
        """What the console has of a launch that ends with this exit code, and its folder."""
        with Launch('rviz:=false', *arguments, command=SCRIPT, prepare=prepare) as launch:
            self.assertEqual(launch.end(), code, launch.console())
            return launch.console(), sorted(os.listdir(launch.folder))

    def test_a_folder_with_every_kind_of_character_that_holds_a_run(self):
        name = "o ut; touch hacked; `touch hacked` & 'x' | \"y\" $HOME * #"

        def run_before(folder):
            subprocess.run([TOOL, METHOD, '--set', 'program.hold.duration=0.1', '--quiet', '--out', os.path.join(folder, name)],
                           check=True)

        console, folders = self.ends(0, 'method:=' + METHOD, SHORT, 'out:=' + name, prepare=run_before)
        self.assertEqual(folders, sorted([name, name + '-2', 'console', 'log']))
        self.assertIn(name + ' holds a run already', console)
        self.assertLess(len(console.partition('\nthe test ended by ')[2].splitlines()), 11)
        self.assertIn(name + '-2', console.splitlines()[-1])
        for word in ('died', 'REQUIRED', 'ERROR', 'Shutdown errors'):
            self.assertNotIn(word, console)

    def test_wrong_input_is_told_in_one_line(self):
        def copy(folder):
            shutil.copy(METHOD, os.path.join(folder, '...yaml'))

        console, folders = self.ends(2, 'method:=...yaml', 'out:=', prepare=copy)
        self.assertRegex(console, '^utm_node: .* its name without its ending is that of the folder to write to\n$')
        self.assertEqual([name for name in folders if name != 'log'], ['...yaml', 'console'])

    def test_a_knot_that_comes_undone(self):
        console, _ = self.ends(1, 'real_time_factor:=0', SLIPPERY)
        self.assertIn('the test ended by untangled', console)
        self.assertIn('a higher specimen.preload (now 20 N) or a higher', console)

    def test_a_physics_that_gives_up(self):
        console, _ = self.ends(1, 'method:=' + IMPOSSIBLE)
        self.assertIn('the test ended by solver', console)
        self.assertRegex(console.splitlines()[-1], 'files are in .*/out')

    def test_the_progress_line_is_that_of_tensile_test(self):
        with tempfile.TemporaryDirectory() as folder:
            words = ['method:=' + METHOD, "overrides:='program.hold.duration=2'", 'rviz:=false', 'record:=false', 'out:=' + folder + '/live']
            said = on_terminal(*SCRIPT, *words, '-p', str(free_port()), KNOT_UTM_SKIP_BUILD='1', ROS_HOME=folder)
            headless = on_terminal(TOOL, METHOD, '--set', 'program.hold.duration=20', '--out', folder + '/headless')
            self.assertIn('hold', LINE.findall(said), said)
            self.assertRegex(headless, LINE)  # of any phase: a fast machine may be through before the second line
            self.assertEqual(said.count('the test ended by program'), 1)
            self.assertIn('scripts/tighten: nothing was written, because of record:=false', said)
            self.assertFalse(os.path.exists(folder + '/live'))

    def test_the_launch_goes_on_until_the_window_of_rviz_is_closed(self):
        def prepare(folder):
            with open(os.path.join(folder, 'mine.launch'), 'w', encoding='utf-8') as file:
                file.write(WITH_WINDOW % METHOD)

        with Launch(prepare=prepare, command=['roslaunch', './mine.launch']) as launch:
            wait_for('the end of the test', lambda: 'the launch ends when the window of rviz is closed' in launch.console())
            # Its picture can still be changed, but no other test begins.
            self.assertIn('knot_node', launch.processes())
            said = subprocess.run(['rosservice', 'call', '/utm/start_test', '{}'], env=launch.environment, check=True,
                                  stdout=subprocess.PIPE, universal_newlines=True, timeout=LAST_RESORT).stdout
            self.assertIn('the launch is about to end', said)
            self.assertIsNone(launch.process.poll())
            os.kill(launch.pid('rviz'), signal.SIGINT)
            self.assertEqual(launch.end(), 0)
            for word in ('has died', 'REQUIRED', 'ERROR'):
                self.assertNotIn(word, launch.console())
            self.assertEqual(launch.result('ended_by'), 'program')


class ArgumentsTest(unittest.TestCase):

    def said(self, code, *command):
        run = subprocess.run(command, check=False, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=LAST_RESORT,
                             universal_newlines=True, env=dict(os.environ, ROS_MASTER_URI='http://localhost:%d' % free_port()))
        self.assertEqual(run.returncode, code, run.stdout)
        return run.stdout

    def test_unknown_argument_is_refused_with_the_nearest_known_one(self):
        said = 'matrial is no argument of tighten.launch; did you mean material?\n'
        self.assertEqual(self.said(2, *SCRIPT, 'matrial:=nylon'), said)
        for file, needed in ('tighten.launch', []), ('experiment.launch', ['data:=x']):
            console = self.said(1, 'roslaunch', '-p', str(free_port()), 'knot_utm', file, *needed, 'matrial:=nylon')
            self.assertIn('matrial is no argument of %s; did you mean material?' % file, console)
            self.assertNotIn('started with pid', console)

    def test_what_is_no_argument_is_refused(self):
        for word, why in (('nylon', 'nylon is no argument of tighten.launch'), ('--fast', '--fast is no option'),
                          ('material=nylon', 'did you mean material:=nylon?'), ('namespace:=1st', 'namespace is "/1st"'),
                          ('nothing_like_it:=1', 'which has method, material')):
            console = self.said(2, *CHECK, 'tighten.launch', '--', word, '-p', '1', '--screen')
            self.assertEqual(console.count('\n'), 1, console)
            self.assertIn(why, console)

    def test_values_are_checked_before_anything_starts(self):
        for file, word, said in (
                ('tighten', 'method:=nowhere.yaml', 'utm_node: .*nowhere.yaml'),
                ('tighten', 'material:=nilon', 'utm_node: .*nilon'),
                ('tighten', 'preload:=1e9', 'utm_node: .*specimen.preload, 1e.09 N'),
                ('tighten', 'data:=nowhere.csv', 'utm_node: .*nowhere.csv'),
                ('tighten', "overrides:='program.pull.speed=-1'", 'utm_node: .*speed is -1'),
                ('tighten', 'real_time_factor:=-1', 'utm_node: real_time_factor is -1'),
                ('tighten', 'real_time_factor:=fast', 'utm_node: real_time_factor is fast'),
                ('tighten', "overrides:='specimens.count=3'", 'utm_node: .*specimens.count is 3, but under ROS it must be 1'),
                ('tighten', 'overrides:=[', 'utm_node: overrides is '),
                ('tighten', 'overrides:=x', 'utm_node: overrides: '),
                ('tighten', "overrides:='specimen.length=[1'", 'utm_node: overrides: '),
                ('tighten', 'record:=perhaps', 'record is "perhaps", but must be true or false'),
                ('tighten', 'network:=perhaps', 'network is "perhaps", but must be true or false'),
                ('experiment', 'bag:=nowhere.bag', 'utm_node: .*nowhere.bag'),
                ('experiment', 'data:=nowhere.csv', 'utm_node: .*nowhere.csv')):
            console = self.said(2, *CHECK, '--values', file + '.launch', '--', word)
            self.assertRegex(console, '^%s.*\n$' % said)
        console = self.said(1, 'roslaunch', '-p', str(free_port()), 'knot_utm', 'tighten.launch', 'material:=nilon')
        self.assertEqual(len(re.findall('^utm_node: .*nilon', console, re.MULTILINE)), 1, console)
        self.assertNotIn('started with pid', console)

    def test_arguments_of_a_launch_file_that_includes_ours_are_its_own(self):
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, 'mine.launch')
            with open(file, 'w', encoding='utf-8') as text:
                text.write('<launch><arg name="mine"/><include file="$(find knot_utm)/launch/tighten.launch"/></launch>')
            self.said(0, 'roslaunch', '--dump-params', file, 'mine:=1')

    def test_every_parameter_of_a_test_is_set_anew(self):
        # A master outlives a launch: what the one before has left there must not be taken for this one's.
        with open(os.path.join(ROOT, 'src/ros/method_setup.cpp'), encoding='utf-8') as code:
            read = set(re.findall(r'\bword\("(\w+)"\)', code.read()))
        self.assertIn('data', read)
        for file in ('tighten.launch', 'experiment.launch'):
            found = yaml.safe_load(self.said(0, 'roslaunch', '--dump-params', 'knot_utm', file, 'data:=x.csv'))
            self.assertLessEqual({'/test/' + name for name in read}, set(found))
            self.assertEqual(found['/test/data'], 'x.csv', file)


if __name__ == '__main__':
    unittest.main()
