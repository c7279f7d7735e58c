#!/usr/bin/python3
"""The machine is operated as a user does it: by services and with the tools of ROS."""
import os
import shutil
import subprocess
import sys
import threading
import unittest

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))

import rospy
import rostest
from geometry_msgs.msg import WrenchStamped
from knot_utm.msg import Crosshead, KnotRecord, KnotState, RecorderStatus, SpecimenInfo, TestStatus
from knot_utm.srv import StartTest
from node_test import LAST_RESORT, Latest, call, start_test
from own_launch import wait_until
from rosgraph_msgs.msg import Log
from std_msgs.msg import String
from std_srvs.srv import Trigger
from visualization_msgs.msg import Marker, MarkerArray

OUT = '/tmp/knot_utm_operator_test'


def tool(*command, timeout=LAST_RESORT):
    """Output of a tool that ends by itself."""
    return subprocess.run(command, timeout=timeout, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          universal_newlines=True, check=False).stdout


def printed(what, *command, timeout=LAST_RESORT):
    """Whether a tool that goes on for ever prints a text; it is ended when it has, or when the time is over."""
    tool = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True,
                            env=dict(os.environ, PYTHONUNBUFFERED='1'))
    end = threading.Timer(timeout, tool.kill)
    end.start()
    try:
        return any(what in line for line in tool.stdout)
    finally:
        end.cancel()
        tool.kill()
        tool.wait()
        tool.stdout.close()


class OperatorTest(unittest.TestCase):
    """One story, told in order."""

    @classmethod
    def setUpClass(cls):
        shutil.rmtree(OUT, ignore_errors=True)
        rospy.init_node('operator_test')
        cls.status = Latest('utm/status', TestStatus)
        cls.state = Latest('knot/state', KnotState)
        cls.recorder = Latest('recorder/status', RecorderStatus)
        cls.load = Latest('utm/load_cell', WrenchStamped)

    def test_1_waits_for_start(self):
        self.status.wait('idle', lambda s: s.state == TestStatus.IDLE)
        self.assertFalse(call('utm/stop_test', Trigger).success)
        self.assertFalse(call('utm/balance', Trigger).success)

    def test_2_start(self):
        start_test()
        self.status.wait('running', lambda s: s.state == TestStatus.RUNNING)
        self.state.wait('holds', lambda s: s.phase == 'hold')
        self.assertGreater(self.state.last.load, 1.0)
        self.load.wait('a reading', lambda w: w.wrench.force.z > 1.0)
        self.assertFalse(call('utm/start_test', StartTest).accepted)

    def test_3_balance(self):
        self.assertTrue(call('utm/balance', Trigger).success)
        self.state.wait('no load', lambda s: s.phase == 'hold' and abs(s.load) < 1e-6 * abs(s.force_upper))
        self.assertGreater(self.state.last.force_upper, 1.0)

    def test_4_pause_and_step(self):
        self.assertFalse(call('utm/step', Trigger).success)
        self.assertTrue(call('utm/pause', Trigger).success)
        before = self.status.wait('paused', lambda s: s.state == TestStatus.PAUSED).sequence
        self.state.wait('the answer that was under way', lambda s: s.sequence == before)
        self.assertEqual(self.status.wait_for_more(3).sequence, before)
        self.assertEqual(self.state.last.sequence, before)
        self.assertTrue(call('utm/step', Trigger).success)
        self.state.wait('one step', lambda s: s.sequence == before + 1)
        self.assertEqual(self.status.wait_for_more(3).sequence, before + 1)
        self.assertEqual(self.state.last.sequence, before + 1)
        self.assertTrue(call('utm/resume', Trigger).success)
        self.state.wait('goes on', lambda s: s.sequence > before + 3)
        self.assertFalse(call('utm/resume', Trigger).success)
        self.assertTrue(call('utm/pause', Trigger).success)
        self.assertTrue(call('utm/pause', Trigger).success, 'pressed again it goes on')
        before = self.state.last.sequence
        self.state.wait('goes on again', lambda s: s.sequence > before)

    def test_4_strangers_are_ignored(self):
        console = Latest('/rosout', Log)
        forged = {'utm/crosshead': Crosshead(run=9), 'knot/state': KnotState(status=KnotState.FAILED, sequence=self.state.last.sequence),
                  'utm/status': TestStatus(state=TestStatus.ENDED, run=1), 'recorder/status': RecorderStatus(run=1, error='forged'),
                  'knot/record': KnotRecord(), 'knot/specimen': SpecimenInfo()}
        for topic, message in forged.items():
            publisher = rospy.Publisher(topic, type(message), queue_size=10)
            begin = 'messages on %s from %s are ignored' % (topic, rospy.get_name())

            def ignored(publisher=publisher, message=message, begin=begin):
                publisher.publish(message)
                return any(log.msg.startswith(begin) for log in list(console.messages))
            wait_until(topic + ' is ignored', ignored)
            publisher.unregister()
        sequence = self.state.last.sequence
        self.state.wait('the test goes on', lambda s: s.run == 1 and s.sequence > sequence + 3 and s.status != KnotState.FAILED)

    def test_5_tools(self):
        topics = tool('rostopic', 'list').split()
        for topic in ['/utm/crosshead', '/utm/joint_states', '/utm/load_cell', '/utm/status', '/knot/state',
                      '/knot/markers', '/knot/shape', '/recorder/status', '/clock', '/tf', '/diagnostics']:
            self.assertIn(topic, topics)
        for topic in ['/utm/crosshead', '/utm/joint_states', '/utm/load_cell', '/utm/status', '/knot/state',
                      '/knot/shape', '/knot/record', '/knot/specimen', '/recorder/status', '/tf', '/diagnostics']:
            text = tool('rostopic', 'echo', '-n', '1', '--noarr', topic)
            self.assertIn('---', text, topic)
        self.assertTrue(printed('average rate', 'rostopic', 'hz', '--wall-time', '/knot/state'))
        self.assertIn('success: True', tool('rosservice', 'call', '/recorder/save'))

    def test_5_what_never_changes_is_there_for_those_who_come_late(self):
        method = Latest('utm/method', String).wait('the method', lambda m: True).data
        with open(OUT + '/method.yaml', encoding='utf-8') as file:
            self.assertEqual(method, file.read())
        specimen = Latest('knot/specimen', SpecimenInfo).wait('the specimen', lambda s: True)
        self.assertAlmostEqual(specimen.length, 0.25 + 2 * 0.005)  # of which an edge in each clamp

    def test_6_markers(self):
        markers = Latest('knot/markers', MarkerArray).wait('a picture', lambda m: True).markers
        self.assertEqual([m.type for m in markers if m.ns == 'rod'], [Marker.TRIANGLE_LIST])
        self.assertEqual(len([m for m in markers if m.ns == 'grips']), 2)
        self.assertEqual([m.text for m in markers if m.text], [])  # the panel has the readings

    def test_7_saved_while_it_runs(self):
        self.assertIn('messages:', tool('rosbag', 'info', OUT + '/saved.bag'))
        self.assertTrue(os.path.exists(OUT + '/result.yaml'))

    def test_8_stop(self):
        self.assertTrue(call('utm/stop_test', Trigger).success)
        status = self.status.wait('ended', lambda s: s.state == TestStatus.ENDED)
        self.assertEqual(status.ended_by, 'operator')
        recorder = self.recorder.wait('complete', lambda r: r.complete)
        self.assertEqual(recorder.dropped, 0)
        self.assertEqual(recorder.recorded, status.sequence + 1)
        self.assertIn('ended_by: operator', open(OUT + '/result.yaml').read())
        self.assertIn('/knot/state', tool('rosbag', 'info', OUT + '/test.bag'))
        self.assertEqual(subprocess.run(['rosbag', 'check', OUT + '/test.bag'], check=False).returncode, 0)
        text = tool('rostopic', 'echo', '-b', OUT + '/test.bag', '-p', '/knot/state')
        self.assertEqual(len(text.strip().splitlines()), status.sequence + 2)

    def test_9_reset(self):
        before = self.state.last
        self.assertGreater(before.force_upper, 1.0)
        self.assertTrue(call('knot/reset', Trigger).success)
        self.assertTrue(call('utm/start_test', StartTest).accepted)
        self.state.wait('second test', lambda s: s.run == 2 and s.phase == 'pull')
        # The specimen is as it was before the first test, the clock is not.
        first, second = ([s for s in self.state.messages if s.run == run][0] for run in (1, 2))
        self.assertEqual(second.sequence, 0)
        for field in ('time', 'displacement', 'extension', 'end_to_end', 'load', 'force_upper', 'steps'):
            self.assertEqual(getattr(second, field), getattr(first, field), field)
        self.assertGreater(second.header.stamp, before.header.stamp)
        # A specimen that is taken out during the test ends it, and says so.
        self.assertTrue(call('knot/reset', Trigger).success)
        status = self.status.wait('ended', lambda s: s.run == 2 and s.state == TestStatus.ENDED)
        self.assertEqual(status.ended_by, 'solver')
        self.assertIn('reset', status.reason)
        self.recorder.wait('complete', lambda r: r.run == 2 and r.complete)


if __name__ == '__main__':
    rostest.rosrun('knot_utm', 'operator', OperatorTest)
