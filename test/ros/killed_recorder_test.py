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

    def rows(self, name='curve.csv'):
        """Rows of samples that a reader finds now."""
        file = os.path.join(self.out, name)
        return max(0, content(file).count(b'\n') - 2) if os.path.exists(file) else 0

    def has(self, name):
        return os.path.exists(os.path.join(self.out, name))

    def assert_beginning_of_headless(self):
        for name in CURVES:
            self.assertTrue(content(self.headless, name).startswith(content(self.out, name)), name)

    def assert_same_as_headless(self):
        for name in FILES:
            same = filecmp.cmp(os.path.join(self.out, name), os.path.join(self.headless, name), shallow=False)
            self.assertTrue(same, name)
        self.assertFalse(self.has('journal'))

    def assert_bag_has_every_row(self):
        # Once: method and colours. With each reading: command, joint, state, shape, load cell, status, frames, markers.
        self.assertEqual(messages(self.out + '/test.bag'), 2 + 8 * self.rows())

    def test_the_launch_ends_and_the_folder_is_recovered(self):
        launch = self.launch('ends')
        wait_until('the test runs', lambda: self.rows() >= 20)
        launch.kill('recorder_node')
        rows = self.rows()
        said = launch.end()
        self.assertEqual(said.count('process has died'), 1, said)
        self.assertRegex(said, r'\[recorder_node-\d+\] has died!\nprocess has died')
        wait_until('the folder is recovered', lambda: self.has('result.yaml'))
        self.assertIn(b'ended_by: not yet\nreason: "the recorder died"', content(self.out, 'result.yaml'))
        self.assertGreaterEqual(self.rows(), rows)
        self.assert_beginning_of_headless()
        self.assert_bag_has_every_row()

    def test_another_one_goes_on(self):
        launch = self.launch('goes_on', respawn='true')
        # Between any two of them the machine has to wait for the new one.
        for rows in 100, 300, 500:
            wait_until('the test runs', lambda least=rows: self.rows() >= least)
            before = launch.kill('recorder_node')
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
        wait_until('the second specimen is tested', lambda: self.rows('specimen_002/curve.csv') >= 5)
        before = launch.kill('recorder_node')
        wait_until('another recorder', lambda: launch.pid('recorder_node') not in (None, before))
        self.assertEqual(launch.end().count('goes on with'), 1)
        for name in CURVES:
            for specimen in 'specimen_001', 'specimen_002', 'specimen_003':
                file = os.path.join(specimen, name)
                self.assertEqual(content(self.out, file), content(headless, file), file)
        self.assertEqual(content(self.out, 'statistics.yaml'), content(headless, 'statistics.yaml'))
        self.assertFalse(self.has('journal'))

    def test_started_anew_after_the_end_it_leaves_the_files_alone(self):
        launch = self.launch('after', respawn='true', real_time_factor='0', exit_at_end='false')
        wait_until('all is written', lambda: self.has('result.yaml') and not self.has('journal'))
        result = content(self.out, 'result.yaml')
        before = launch.kill('recorder_node')
        wait_until('another recorder', lambda: launch.pid('recorder_node') not in (None, before))
        self.assertIn('there is nothing to save yet', launch.tool('rosservice', 'call', '/recorder/save'))
        self.assertEqual(content(self.out, 'result.yaml'), result)
        self.assert_same_as_headless()

    def test_stopped_in_the_midst_of_a_test_its_result_stays(self):
        launch = self.launch('stopped', respawn='true')
        wait_until('the test runs', lambda: self.rows() >= 100)
        launch.kill('recorder_node', signal.SIGINT)
        self.assertIn('holds a result, which the rest of the test would write over', launch.end())
        self.assertIn(b'ended_by: interrupted\n', content(self.out, 'result.yaml'))
        self.assertGreaterEqual(self.rows(), 100)
        self.assert_beginning_of_headless()

    def test_that_lost_the_beginning_it_writes_the_rest_and_ends(self):
        launch = self.launch('lost', respawn='true')
        wait_until('the test runs', lambda: self.rows() >= 100)
        # Nobody finds the folder any more, the keeper neither: what the machine has been told is recorded is gone.
        os.rename(self.out, self.out + '_away')
        launch.kill('recorder_node')
        said = launch.end()
        self.assertIn('commands of the test never arrived', said)
        result = content(self.out, 'result.yaml')
        self.assertIn(b'ended_by: program\n', result)
        self.assertRegex(result, rb'warnings: \["\d+ commands of the test were not recorded"')
        self.assertGreater(self.rows(), 100)
        self.assertTrue(content(self.headless, 'curve.csv').endswith(content(self.out, 'curve.csv').split(b'\n', 3)[3]))
        self.assert_bag_has_every_row()

    def test_without_room_it_says_so_and_the_journal_has_what_was_measured(self):
        launch = self.launch('full', real_time_factor='0', recorder_prefix='prlimit --fsize=60000')
        said = launch.end()
        self.assertRegex(said, r'file too large; what was recorded until then is in the journal, write it out with: \S*recover ')
        self.assertFalse(self.has('result.yaml'))
        here, elsewhere = self.out, os.path.join(self.folder, 'elsewhere')
        # Once there is room, in place too: the bag that ran out of it has no index.
        for arguments in [here, '--out', elsewhere], [here]:
            self.out = arguments[-1]
            if self.out == here:
                self.assertNotEqual(subprocess.run(['rosbag', 'info', here + '/test.bag'], check=False,
                                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode, 0)
            subprocess.run([executable('recover')] + arguments, check=True)
            self.assertGreater(self.rows(), 3)
            self.assert_beginning_of_headless()
            self.assert_bag_has_every_row()

    def test_a_keeper_leaves_with_its_recorder(self):
        launch = self.launch('left', real_time_factor='0')
        wait_until('the recorder runs', lambda: launch.pid('recorder_node'))
        recorder = launch.pid('recorder_node')
        children = '/proc/%d/task/%d/children' % (recorder, recorder)
        with open(children) as file:
            keepers = [int(word) for word in file.read().split()]
        self.assertEqual(len(keepers), 1)
        launch.end()
        wait_until('the keeper is gone', lambda: not os.path.exists('/proc/%d' % keepers[0]))
        self.assert_same_as_headless()


if __name__ == '__main__':
    rostest.rosrun('knot_utm', 'killed_recorder', KilledRecorderTest)
