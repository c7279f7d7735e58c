#!/usr/bin/python3
"""utm/start_test: one test after the other on nodes that stay, each by another method, and the machine's description. Nodes that
join late and subscribers that are slow change nothing: the files are those of the headless tool."""
import filecmp
import math
import os
import shutil
import subprocess
import sys
import tempfile
import time
import unittest
import xml.etree.ElementTree

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))

import rospy
import rostest
import yaml
from catkin.find_in_workspaces import find_in_workspaces
from knot_utm.msg import KnotRecord, RecorderStatus, TestStatus
from knot_utm.srv import StartTest
from node_test import LAST_RESORT, Latest, call, start_test
from own_launch import wait_until
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage

OUT = '/tmp/knot_utm_start_test'
FILES = ['curve.csv', 'curve_full.csv', 'final_shape.csv', 'method.yaml', 'test.bag']
KNOT = ['material.bending_law=elastic', 'material.friction_couple=0', 'physics.accuracy=draft',
        'program.pull.until={extension: 0.002}']
LAUNCHED = ['program.pull.until={extension: 0.001}', 'machine.load_cell={capacity: 50e3, sampling_rate: 50, accuracy: 0.005}',
            'machine.stiffness=1e6']


def slow(_message):
    time.sleep(0.5)


class StartTestTest(unittest.TestCase):
    """One story, told in order."""

    @classmethod
    def setUpClass(cls):
        for folder in [OUT] + [OUT + '-%d' % number for number in range(2, 9)]:
            shutil.rmtree(folder, ignore_errors=True)
        rospy.init_node('start_test_test')
        rospy.Subscriber('knot/record', KnotRecord, slow, queue_size=1)
        rospy.Subscriber('knot/state', rospy.AnyMsg, slow, queue_size=1)
        cls.status = Latest('utm/status', TestStatus)
        cls.recorder = Latest('recorder/status', RecorderStatus)
        cls.method = Latest('utm/method', String)
        cls.joints = Latest('utm/joint_states', JointState, queue_size=None)
        cls.frames = Latest('/tf', TFMessage, queue_size=None)
        cls.fixed = Latest('/tf_static', TFMessage)
        wait_until('who listens', lambda: all(one.connected() for one in (cls.joints, cls.frames, cls.recorder)))
        cls.headless = tempfile.mkdtemp()

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.headless)

    def wait_for_end(self, answer, run, directory=''):
        """Until the test that the service answered with has ended and is recorded where it said."""
        self.assertEqual((answer.accepted, answer.message), (True, 'test %d is running' % run))
        recorded = self.recorder.wait('complete', lambda r: r.run == run and r.complete)
        self.assertEqual((recorded.error, recorded.dropped), ('', 0))
        self.assertEqual(recorded.directory, answer.folder + directory)
        return self.status.wait('ended', lambda s: s.run == run and s.state == TestStatus.ENDED)

    def assert_same_as_headless(self, folder, method, overrides=(), words=(), below=''):
        """The same bytes as those of tensile_test."""
        tool = find_in_workspaces(['libexec'], 'knot_utm', 'tensile_test', first_match_only=True)[0]
        out = tempfile.mkdtemp(dir=self.headless)
        command = [tool, method, '--quiet', '--overwrite', '--out', out, *words]
        for override in overrides:
            command += ['--set', override]
        subprocess.run(command, check=True)
        # Of a batch tensile_test writes no bags.
        files = [name for name in FILES if not below or name != 'test.bag']
        _, different, missing = filecmp.cmpfiles(folder + below, out + below, files, shallow=False)
        self.assertEqual(different + missing, [])

    def material(self):
        """Of the method on its topic."""
        return yaml.safe_load(self.method.last.data)['material']['name']

    @staticmethod
    def described():
        """The machine's description, as what reads URDF sees it."""
        robot = xml.etree.ElementTree.fromstring(rospy.get_param('robot_description').encode())
        joints = {(j.find('parent').get('link'), j.find('child').get('link')): j for j in robot.findall('joint')}
        return robot, joints

    def assert_description_is_where_the_frames_are(self, lowered=0.0):
        """Each joint, at its value in utm/joint_states, as the transform of the same stamp. `lowered`: how far the upper
        grip may be below its place on the crosshead [m]."""
        positions = {m.header.stamp: dict(zip(m.name, m.position)) for m in self.joints.messages}

        def moved(message):
            stamp = message.transforms[0].header.stamp
            return stamp in positions and stamp == self.joints.last.header.stamp
        moving = self.frames.wait('the last frames', moved).transforms
        transforms = {(t.header.frame_id, t.child_frame_id): t for t in self.fixed.last.transforms + moving}
        robot, joints = self.described()
        self.assertEqual({link.get('name') for link in robot.findall('link')},
                         {'world', 'utm_base', 'lower_grip', 'crosshead', 'upper_grip', 'load_cell'})
        self.assertEqual(len(joints), 5)
        for frames, joint in joints.items():
            place = [float(x) for x in joint.find('origin').get('xyz').split()]
            if joint.get('type') == 'prismatic':
                way = positions[moving[0].header.stamp][joint.get('name')]
                self.assertGreater(way, 0.0005)
                self.assertLess(way, float(joint.find('limit').get('upper')))
                place = [x + way * float(a) for x, a in zip(place, joint.find('axis').get('xyz').split())]
            there = transforms[frames].transform
            off = [b - a for a, b in zip(place, (there.translation.x, there.translation.y, there.translation.z))]
            if frames == ('crosshead', 'upper_grip') and lowered > 0.0:
                self.assertTrue(-lowered < off.pop() < 0.0)
            for x in off:
                self.assertAlmostEqual(x, 0.0, delta=1e-12, msg=frames)
            self.assertEqual(there.rotation.w, 1.0)

    def rollers(self):
        """Diameters of the cylinders in both grips."""
        robot, _ = self.described()
        return {link.get('name'): [2.0 * float(c.get('radius')) for c in link.iter('cylinder')]
                for link in robot.findall('link') if link.get('name').endswith('_grip')}

    def test_0_who_comes_late_sees_where_the_machine_stands(self):
        self.frames.wait('the first frames', lambda m: True)  # no others come before a test
        said = subprocess.run(['rostopic', 'echo', '-n', '1', '/tf'], check=True, timeout=LAST_RESORT,
                              stdout=subprocess.PIPE, universal_newlines=True).stdout
        self.assertIn('child_frame_id: "upper_grip"', said)

    def test_1_another_method_than_the_launched_one(self):
        self.assertEqual(self.rollers(), {'lower_grip': [], 'upper_grip': []})  # clamps
        answer = start_test(method='tighten', material='nylon', preload=60.0, overrides=KNOT)
        self.assertEqual(answer.folder, OUT)
        self.assertFalse(call('utm/start_test', StartTest).accepted)
        self.assertEqual(self.wait_for_end(answer, 1).ended_by, 'extension')
        self.assert_same_as_headless(OUT, 'tighten', ['material=nylon', 'specimen.preload=60', *KNOT])
        self.assertEqual(self.material(), 'nylon')

    def test_2_its_machine_is_described(self):
        self.assertEqual(self.rollers(), {'lower_grip': [0.0381], 'upper_grip': [0.0381]})
        self.assert_description_is_where_the_frames_are(lowered=2 * 0.003175)

    def test_3_what_is_wrong_is_refused_and_changes_nothing(self):
        before = [rospy.get_param(name) for name in ('test', 'robot_description')]
        known = len(self.method.messages)
        wrong = [(dict(material='nylom'), 'material is "nylom", but must be a name'),
                 (dict(method='tihgten'), 'method'),
                 (dict(method='/tmp'), '/tmp'),
                 (dict(overrides=['specimen.legnth=1']), 'legnth'),
                 (dict(overrides=['specimen.length=-1']), 'specimen.length is -1'),
                 (dict(overrides=['program']), 'program'),
                 (dict(material='a\nb'), 'material'),
                 (dict(preload=70.0), 'preload'),  # a straight rod has none
                 (dict(method='tighten', preload=-1.0, overrides=['']), 'specimen.preload is -1'),
                 (dict(method='tighten', preload=math.nan, overrides=['']), 'specimen.preload is .nan'),
                 (dict(specimens=2000), '2000 specimens are asked for')]
        for fields, why in wrong:
            answer = call('utm/start_test', StartTest, **fields)
            self.assertEqual((answer.accepted, answer.folder), (False, ''), fields)
            self.assertIn(why, answer.message)
            self.assertEqual(len(answer.message.splitlines()), 1, answer.message)
        self.assertEqual([rospy.get_param(name) for name in ('test', 'robot_description')], before)
        self.assertEqual(len(self.method.messages), known)
        self.assertFalse(os.path.exists(OUT + '-2'))

    def test_4_the_command_of_the_page(self):
        said = subprocess.run(['rosservice', 'call', '/utm/start_test', '{material: polypropylene}'], check=True,
                              timeout=LAST_RESORT, stdout=subprocess.PIPE, universal_newlines=True).stdout
        self.assertEqual(yaml.safe_load(said),
                         {'accepted': True, 'message': 'test 2 is running', 'folder': OUT + '-2'})
        self.recorder.wait('complete', lambda r: r.run == 2 and r.complete)
        # Of what it does not say the launch does.
        self.assert_same_as_headless(OUT + '-2', 'straight', ['material=polypropylene', *LAUNCHED])
        self.assertEqual(self.material(), 'polypropylene')
        self.assertEqual(self.rollers(), {'lower_grip': [], 'upper_grip': []})
        self.assert_description_is_where_the_frames_are(lowered=0.001)  # by the compliance of the frame

    def test_5_two_specimens(self):
        answer = start_test(specimens=2, overrides=['program.pull.until={extension: 0.0008}'])
        self.assertEqual(answer.folder, OUT + '-3')
        self.assertEqual(answer.message, 'test 3 is running')
        recorded = self.recorder.wait('complete', lambda r: r.run == 4 and r.complete)
        self.assertEqual((recorded.batch, recorded.directory), (OUT + '-3', OUT + '-3/specimen_002'))
        for below in '/specimen_001', '/specimen_002':
            self.assert_same_as_headless(OUT + '-3', 'straight', ['program.pull.until={extension: 0.0008}'],
                                         ['--specimens', '2'], below)
        with open(OUT + '-3/statistics.yaml', encoding='utf-8') as file:
            self.assertEqual(yaml.safe_load(file)['specimens'], 2)

    def test_6_nothing_asked_for_is_the_launched_test(self):
        self.wait_for_end(start_test(), 5)
        self.assert_same_as_headless(OUT + '-4', 'straight', LAUNCHED)
        with open(OUT + '-4/curve.csv', encoding='utf-8') as curve:
            self.assertTrue(curve.readline().endswith(',phase,balance_offset,crosshead_travel\n'))
        self.assertEqual(self.material(), 'nylon')


if __name__ == '__main__':
    rostest.rosrun('knot_utm', 'start_test', StartTestTest)
