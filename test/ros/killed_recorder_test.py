#!/usr/bin/python3
"""A recorder that is killed in the midst of a test loses nothing, whether or not another one takes its place."""
import filecmp
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))

import rospkg
import rostest
from catkin.find_in_workspaces import find_in_workspaces
from own_launch import OwnLaunch, wait_until

METHOD = os.path.join(rospkg.RosPack().get_path('knot_utm'), 'test/ros/pull_for_seconds.yaml')
CURVES = ['curve.csv', 'curve_full.csv']
FILES = CURVES + ['final_shape.csv', 'method.yaml', 'test.bag']


def executable(name):
    return find_in_workspaces(['libexec'], 'knot_utm', name, first_match_only=True)[0]


def content(*path):
    with open(os.path.join(*path), 'rb') as file:
        return file.read()


def messages(bag):
    info = subprocess.run(['rosbag', 'info', '-y', '-k', 'messages', bag], check=True, stdout=subprocess.PIPE)
    return int(info.stdout)


class KilledRecorderTest(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp()
        cls.headless = os.path.join(cls.folder, 'headless')
        subprocess.run([executable('tensile_test'), METHOD, '--out', cls.headless, '--quiet'], check=True)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def launch(self, name, **arguments):
        self.out = os.path.join(self.folder, name)
        launch = OwnLaunch(**dict({'method': METHOD, 'out': self.out}, **arguments))
        self.addCleanup(launch.stop)
        return launch

    def commands(self, specimen=''):
        """Those that are in samples.csv now."""
        file = os.path.join(self.out, specimen, 'samples.csv')
        return content(file).count(b'\nanswer,') if os.path.exists(file) else 0

    def has(self, name):
        return os.path.exists(os.path.join(self.out, name))

    def make_anew(self):
        subprocess.run([executable('tensile_test'), '--from-samples', self.out, '--quiet'], check=True)

    def assert_same_as_headless(self):
        for name in FILES:
            same = filecmp.cmp(os.path.join(self.out, name), os.path.join(self.headless, name), shallow=False)
            self.assertTrue(same, name)

    def assert_all_that_was_recorded(self):
        """As far as the test went, the files are those of a whole one, with every command."""
        for name in CURVES:
            self.assertTrue(content(self.headless, name).startswith(content(self.out, name)), name)
        self.assert_bag_has_every_row()

    def assert_bag_has_every_row(self):
        # Once: method and colours. With each reading: command, joint, state, shape, load cell, status, frames, markers.
        self.assertEqual(messages(self.out + '/test.bag'), 2 + 8 * (content(self.out, 'curve.csv').count(b'\n') - 2))

    def test_the_launch_ends_and_the_files_are_made_from_the_samples(self):
        launch = self.launch('ends')
        wait_until('the test runs', lambda: self.commands() >= 20)
        launch.kill('recorder_node')
        said = launch.end()
        self.assertEqual(said.count('process has died'), 1, said)
        self.assertRegex(said, r'\[recorder_node-\d+\] has died!\nprocess has died')
        self.assertFalse(self.has('result.yaml'))
        self.make_anew()
        self.assertIn(b'ended_by: not yet\nreason: "the test was cut off"', content(self.out, 'result.yaml'))
        self.assert_all_that_was_recorded()

    def test_another_one_goes_on(self):
        launch = self.launch('goes_on', respawn='true')
        # Between any two of them the machine has to wait for the new one. One that is stopped writes what it has first.
        for commands, by in (100, signal.SIGKILL), (300, signal.SIGINT), (500, signal.SIGKILL):
            wait_until('the test runs', lambda least=commands: self.commands() >= least)
            before = launch.kill('recorder_node', by)
            wait_until('another recorder', lambda one=before: launch.pid('recorder_node') not in (None, one))
        said = launch.end()
        self.assertEqual(said.count('goes on with'), 3)
        self.assert_same_as_headless()
        self.assertIn(b'ended_by: program\n', content(self.out, 'result.yaml'))

    def test_another_one_goes_on_with_a_batch(self):
        method = os.path.join(os.path.dirname(METHOD), 'batch.yaml')
        headless = os.path.join(self.folder, 'headless_batch')
        subprocess.run([executable('tensile_test'), method, '--out', headless, '--quiet'], check=True)
        launch = self.launch('batch', respawn='true', method=method, real_time_factor='0.5')
        wait_until('the second specimen is tested', lambda: self.commands('specimen_002') >= 5)
        before = launch.kill('recorder_node')
        wait_until('another recorder', lambda: launch.pid('recorder_node') not in (None, before))
        self.assertEqual(launch.end().count('goes on with'), 1)
        for name in CURVES:
            for specimen in 'specimen_001', 'specimen_002', 'specimen_003':
                file = os.path.join(specimen, name)
                self.assertEqual(content(self.out, file), content(headless, file), file)
        self.assertEqual(content(self.out, 'statistics.yaml'), content(headless, 'statistics.yaml'))

    def test_started_anew_after_the_end_it_leaves_the_files_alone(self):
        launch = self.launch('after', respawn='true', real_time_factor='0', exit_at_end='false')
        wait_until('all is written', lambda: self.has('result.yaml') and launch.is_told('test/recorded'))
        result = content(self.out, 'result.yaml')
        before = launch.kill('recorder_node')
        wait_until('another recorder', lambda: launch.pid('recorder_node') not in (None, before))
        self.assertIn('there is nothing to save yet', launch.tool('rosservice', 'call', '/recorder/save'))
        self.assertEqual(content(self.out, 'result.yaml'), result)
        self.assert_same_as_headless()

    def test_that_lost_the_beginning_it_writes_the_rest_and_ends(self):
        launch = self.launch('lost', respawn='true')
        wait_until('the test runs', lambda: self.commands() >= 100)
        # Nobody finds the folder any more: what the machine has been told is recorded is gone.
        os.rename(self.out, self.out + '_away')
        launch.kill('recorder_node')
        said = launch.end()
        self.assertIn('commands of the test never arrived', said)
        result = content(self.out, 'result.yaml')
        self.assertIn(b'ended_by: program\n', result)
        self.assertRegex(result, rb'warnings: \["\d+ commands of the test were not recorded"')
        self.assertGreater(self.commands(), 100)
        self.assertTrue(content(self.headless, 'curve.csv').endswith(content(self.out, 'curve.csv').split(b'\n', 3)[3]))
        self.assert_bag_has_every_row()

    def test_without_room_it_says_what_stands(self):
        launch = self.launch('full', real_time_factor='0', recorder_prefix='prlimit --fsize=60000')
        self.assertRegex(launch.end(), r'file too large; what was measured until then stands in \S*samples.csv, make the results '
                                       r'of it by: \S*tensile_test --from-samples ')
        self.assertFalse(self.has('result.yaml'))
        self.make_anew()  # once there is room
        self.assertGreater(self.commands(), 3)
        self.assert_all_that_was_recorded()


if __name__ == '__main__':
    rostest.rosrun('knot_utm', 'killed_recorder', KilledRecorderTest)
