#!/usr/bin/python3
"""The machine is operated as a user does it, on nodes that stay: by the service, the action, dynamic_reconfigure and the tools of
ROS, one test after the other. Who listens slowly, looks at a picture, changes the pace or stands still changes nothing."""
import math
import os
import signal
import subprocess
import time
import unittest
import xml.etree.ElementTree

from launched import FILES, METHOD, ROOT, Headless, Launch, wait_for

PROGRAM = os.path.join(ROOT, 'test/ros/whole_program.yaml')
KNOT = ['physics.accuracy=draft', 'program.pull.until={extension: 0.002}']
STANDSTILL = 5.0  # [s] longer than the recorder waits for the last records of a test


class OperatorTest(unittest.TestCase):
    """One story, told in order."""

    @classmethod
    def setUpClass(cls):
        cls.launch = Launch('method:=' + METHOD, 'autostart:=false', 'exit_at_end:=false')
        cls.addClassCleanup(cls.launch.__exit__)
        wait_for('the master', lambda: cls.launch.answers('utm_node'))
        os.environ.update(cls.launch.environment)
        global rospy, client, msg, Reset, StartTest, Trigger, Client, GoalStatus, SimpleActionClient, TFMessage, MarkerArray
        # Not before: they take the master's address when they are loaded.
        import client
        import knot_utm.msg as msg
        import rospy
        from actionlib import GoalStatus, SimpleActionClient
        from diagnostic_msgs.msg import DiagnosticArray
        from dynamic_reconfigure.client import Client
        from knot_utm.srv import Reset, StartTest
        from rosgraph_msgs.msg import Clock, Log
        from std_srvs.srv import Trigger
        from tf2_msgs.msg import TFMessage
        from visualization_msgs.msg import MarkerArray
        rospy.init_node('operator_test', disable_signals=True)
        rospy.Subscriber('knot/record', msg.KnotRecord, lambda _: time.sleep(0.5), queue_size=1)
        cls.status = client.Latest('utm/status', msg.TestStatus)
        cls.state = client.Latest('knot/state', msg.KnotState)
        cls.recorder = client.Latest('recorder/status', msg.RecorderStatus)
        cls.frames = client.Latest('/tf', TFMessage)
        cls.fixed = client.Latest('/tf_static', TFMessage)
        cls.clock = client.Latest('/clock', Clock)
        cls.console = client.Latest('/rosout', Log)
        cls.diagnostics = client.Latest('/diagnostics', DiagnosticArray)
        wait_for('the nodes', lambda: all(one.connected() for one in (cls.status, cls.state, cls.recorder, cls.frames)))

    def tool(self, *command):
        """Output of one that ends by itself."""
        return subprocess.run(command, timeout=client.LAST_RESORT, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              universal_newlines=True, check=False).stdout

    def start(self, **fields):
        answer = client.call('utm/start_test', StartTest, **fields)
        self.assertTrue(answer.accepted, answer.message)
        return answer.folder

    def ended(self, run):
        recorded = self.recorder.wait('complete', lambda r: r.run == run and r.complete)
        self.assertEqual(recorded.error, '')
        return self.status.wait('ended', lambda s: s.run == run and s.state == s.ENDED)

    def goal(self, **fields):
        """A goal of the action, its feedback so far, and a function for its end: state, result and text."""
        feedback, goal = [], SimpleActionClient('utm/run_test', msg.RunTestAction)
        goal.wait_for_server()
        goal.send_goal(msg.RunTestGoal(**fields), feedback_cb=feedback.append)

        def end():
            wait_for('the end of the goal', lambda: goal.get_state() not in (GoalStatus.PENDING, GoalStatus.ACTIVE))
            return goal.get_state(), goal.get_result(), goal.get_goal_status_text()
        return goal, feedback, end

    def diagnosis(self, name, holds):
        def found(message):
            return [status for status in message.status if status.name == name and holds(status)]
        return found(self.diagnostics.wait(name, found))[0]

    def assert_description_is_where_the_frames_are(self, diameters, lowered):
        """Each joint, where it has gone, as the transform. `diameters`: of the cylinders that both grips are; `lowered`: how far the
        upper grip may be below its place on the crosshead [m]."""
        robot = xml.etree.ElementTree.fromstring(rospy.get_param('robot_description').encode())
        joints = {(j.find('parent').get('link'), j.find('child').get('link')): j for j in robot.findall('joint')}
        for name in 'lower_grip', 'upper_grip':
            grip = next(link for link in robot.findall('link') if link.get('name') == name)
            self.assertEqual([2.0 * float(c.get('radius')) for c in grip.iter('cylinder')], diameters)
        way = self.state.last.displacement
        self.assertGreater(way, 0.0005)
        above = float(joints['utm_base', 'crosshead'].find('origin').get('xyz').split()[2])
        moving = self.frames.wait('the last frames', lambda m: abs(m.transforms[0].transform.translation.z - above - way) < 1e-9)
        transforms = {(t.header.frame_id, t.child_frame_id): t.transform
                      for message in (self.fixed.last, moving) for t in message.transforms}
        self.assertEqual(set(joints) | {('utm_base', 'knot')}, set(transforms))
        for frames, joint in joints.items():
            place = [float(x) for x in joint.find('origin').get('xyz').split()]
            if joint.get('type') == 'prismatic':
                place[2] += way
            there = transforms[frames].translation
            off = [there.x - place[0], there.y - place[1], there.z - place[2]]
            if frames == ('crosshead', 'upper_grip'):
                self.assertLessEqual(-lowered - 1e-9, off.pop())
            for x in off:
                self.assertAlmostEqual(x, 0.0, delta=1e-9, msg=frames)

    def test_1_what_is_wrong_is_refused_and_changes_nothing(self):
        self.status.wait('idle', lambda s: s.state == s.IDLE)
        for service in 'stop_test', 'balance', 'step', 'resume':
            self.assertFalse(client.call('utm/' + service, Trigger).success, service)
        late = [self.tool('rostopic', 'echo', '-n', '1', '/tf') for _ in range(2)]
        self.assertIn('child_frame_id: "upper_grip"', late[0])
        self.assertNotEqual(*late)  # no stamp is repeated
        for fields, why in ((dict(material='nylom'), 'material is "nylom"'), (dict(method='tihgten'), 'method'),
                            (dict(overrides=['specimen.length=-1']), 'specimen.length is -1'), (dict(material='a\nb'), 'material'),
                            (dict(preload=70.0), 'preload'),  # a straight rod has none
                            (dict(method='tighten', preload=math.nan), 'specimen.preload is .nan'),
                            (dict(overrides=['specimens.count=3']), 'specimens.count is 3, but under ROS it must be 1')):
            answer = client.call('utm/start_test', StartTest, **fields)
            self.assertEqual((answer.accepted, answer.folder), (False, ''), fields)
            self.assertIn(why, answer.message)
            self.assertEqual(self.goal(**fields)[2]()[::2], (GoalStatus.REJECTED, answer.message))
        self.assertFalse(os.path.exists(self.launch.out))

    def test_2_another_method_by_the_service(self):
        view = Client('knot_node', timeout=client.LAST_RESORT)
        pictures = client.Latest('knot/markers', MarkerArray)
        colors = client.Latest('knot/colors', msg.ColorBar)
        # As the page says it.
        said = self.tool('rosservice', 'call', '/utm/start_test', '{method: tighten, material: nylon, preload: 60, overrides: %s}' % KNOT)
        self.assertIn('test 1 is running', said)
        self.assertFalse(client.call('utm/start_test', StartTest).accepted)
        Client('utm_node', timeout=client.LAST_RESORT).update_configuration({'real_time_factor': 0.0})
        self.assertEqual(view.update_configuration({'color_by': 'curvature'})['color_by'], 'curvature')
        colors.wait('curvature', lambda bar: bar.quantity == 'curvature')
        self.assertEqual(view.update_configuration({'color_by': 'beauty', 'marker_rate': 50.0})['color_by'], 'curvature')
        self.assertEqual([view.update_configuration({'sides': sides})['sides'] for sides in (8, 25)], [8, 8])
        wait_for('the refusal', lambda: any('color_by is "beauty", but must be tension or curvature' in m.msg for m in self.console.messages))
        self.assertEqual(self.ended(1).ended_by, 'extension')
        pictures.wait('a picture', lambda m: 'rod' in {k.ns for k in m.markers})
        self.assertIn('ns: "grips"', self.tool('rostopic', 'echo', '-n', '1', '/knot/bodies'))  # also for who comes late
        with Headless('tighten', 'material=nylon', 'specimen.preload=60', *KNOT) as headless:
            self.assertEqual(headless.different(self.launch.out), ([], []))
        self.assert_description_is_where_the_frames_are([0.0381], 2 * 0.003175)

    def test_3_operated(self):
        Client('utm_node', timeout=client.LAST_RESORT).update_configuration({'real_time_factor': 1.0})
        out = self.start()
        self.assertEqual(out, self.launch.out + '-2')
        self.state.wait('holds', lambda s: s.run == 2 and s.phase == 'hold' and s.load > 1.0)
        self.status.wait_for_more(15)
        paces = [s.real_time_factor for s in self.status.messages if s.run == 2 and s.real_time_factor > 0.0]
        changes = sorted(abs(b / a - 1.0) for a, b in zip(paces, paces[1:]))
        self.assertLess(changes[len(changes) // 2], 0.1, paces)  # statuses and commands come at unlike periods
        self.assertTrue(client.call('utm/balance', Trigger).success)
        self.state.wait('no load', lambda s: s.phase == 'hold' and abs(s.load) < 1e-6 * abs(s.force_upper))
        for _ in range(2):
            self.assertEqual(client.call('utm/pause', Trigger).message, 'the test is paused')
        before = self.status.wait('paused', lambda s: s.state == s.PAUSED).sequence
        self.state.wait('the answer that was under way', lambda s: s.sequence == before)
        self.assertEqual(self.status.wait_for_more(3).sequence, before)
        said = client.call('utm/step', Trigger).message
        self.assertIn(', to %.17g s' % self.state.wait('one step', lambda s: s.sequence == before + 1).time, said)
        self.assertEqual(self.status.wait_for_more(3).sequence, before + 1)
        self.assertFalse(client.call('knot/reset', Reset).success)
        self.assertTrue(client.call('utm/resume', Trigger).success)
        self.state.wait('goes on', lambda s: s.sequence > before + 3)
        self.assertIn('success: True', self.tool('rosservice', 'call', '/recorder/save'))
        self.assertIn('messages:', self.tool('rosbag', 'info', out + '/saved.bag'))
        for topic in 'utm/crosshead', 'utm/joint_states', 'utm/load_cell', 'utm/method', 'knot/shape', 'knot/specimen', 'diagnostics':
            self.assertIn('---', self.tool('rostopic', 'echo', '-n', '1', '--noarr', topic), topic)
        self.assert_description_is_where_the_frames_are([], 0.0)
        self.assert_strangers_are_ignored()
        self.assertTrue(client.call('utm/stop_test', Trigger).success)
        status = self.ended(2)
        self.assertEqual(status.ended_by, 'operator')
        now = rospy.get_rostime()
        rospy.sleep(0.3)  # the clock goes on between two tests
        self.assertGreaterEqual((rospy.get_rostime() - now).to_sec(), 0.3)
        self.assertEqual(self.recorder.last.recorded, status.sequence + 1)
        self.assertEqual(subprocess.run(['rosbag', 'check', out + '/test.bag'], check=False).returncode, 0)
        text = self.tool('rostopic', 'echo', '-b', out + '/test.bag', '-p', '/knot/state')
        self.assertEqual(len(text.strip().splitlines()), status.sequence + 2)

    def assert_strangers_are_ignored(self):
        forged = {'utm/crosshead': msg.Crosshead(run=9), 'knot/state': msg.KnotState(status=4, sequence=self.state.last.sequence),
                  'utm/status': msg.TestStatus(state=3, run=2), 'recorder/status': msg.RecorderStatus(run=2, error='forged'),
                  'knot/record': msg.KnotRecord(), 'knot/specimen': msg.SpecimenInfo()}
        for topic, message in forged.items():
            publisher = rospy.Publisher(topic, type(message), queue_size=10)
            begin = 'messages on %s from %s are ignored' % (topic, rospy.get_name())

            def ignored(publisher=publisher, message=message, begin=begin):
                publisher.publish(message)
                return any(log.msg.startswith(begin) for log in list(self.console.messages))
            wait_for(topic + ' is ignored', ignored)
            publisher.unregister()
        sequence = self.state.last.sequence
        self.state.wait('the test goes on', lambda s: s.run == 2 and s.sequence > sequence + 3 and s.status != s.FAILED)

    def test_4_an_action_while_each_node_stands_still_once(self):
        goal, feedback, end = self.goal(method=PROGRAM)
        wait_for('a load', lambda: feedback and feedback[-1].force > 1.0)
        self.assertEqual(self.goal()[2]()[::2], (GoalStatus.REJECTED, 'a test is running'))
        # The recorder last: the test goes on while it stands still, and may end.
        for node in 'utm_node', 'knot_node', 'recorder_node':
            pid = self.launch.pid(node)
            os.kill(pid, signal.SIGSTOP)
            time.sleep(STANDSTILL)
            if node == 'knot_node':
                self.assertIn('slower than asked for', self.diagnosis('utm_node: machine', lambda s: s.level == 1).message)
            os.kill(pid, signal.SIGCONT)
        machine = Client('utm_node', timeout=client.LAST_RESORT)
        self.assertEqual(machine.update_configuration({'real_time_factor': -1.0})['real_time_factor'], 1.0)
        self.assertEqual(machine.update_configuration({'real_time_factor': 0.0})['real_time_factor'], 0.0)
        state, result, text = end()
        self.assertEqual((state, result.ended_by), (GoalStatus.SUCCEEDED, 'break'), text)
        self.assertIn('the rod parted', result.reason)
        self.assertGreater(result.peak_force, 1.0)
        with Headless(PROGRAM) as headless:
            self.assertEqual(headless.different(result.directory), ([], []))
        self.assertEqual(goal.get_state(), GoalStatus.SUCCEEDED)

    def test_5_cancelled(self):
        Client('utm_node', timeout=client.LAST_RESORT).update_configuration({'real_time_factor': 1.0})
        goal, feedback, end = self.goal()
        wait_for('feedback', lambda: feedback)
        goal.cancel_goal()
        state, result, _ = end()
        self.assertEqual((state, result.ended_by), (GoalStatus.PREEMPTED, 'operator'))
        self.assertTrue(all(os.path.exists(os.path.join(result.directory, name)) for name in FILES))

    def test_6_a_specimen_that_is_taken_out_ends_the_test(self):
        goal, feedback, end = self.goal()
        wait_for('feedback', lambda: feedback)
        self.assertTrue(client.call('knot/reset', Reset, force=True).success)
        state, result, text = end()
        self.assertEqual((state, result.ended_by), (GoalStatus.ABORTED, 'solver'))
        self.assertIn('reset', text)
        self.diagnosis('utm_node: machine', lambda s: s.level == 2 and 'reset' in s.message)
        first, last = ([s for s in self.state.messages if s.run == run][0] for run in (2, 5))
        for field in 'time', 'displacement', 'extension', 'load', 'force_upper', 'steps':
            self.assertEqual(getattr(last, field), getattr(first, field), field)
        self.assertEqual(goal.get_state(), GoalStatus.ABORTED)
        stamps = [m.clock for m in self.clock.messages]
        self.assertEqual(stamps, sorted(stamps))


if __name__ == '__main__':
    unittest.main()
