#!/usr/bin/python3
"""examples/hand_on_the_machine, in Python and in C++, as their heads say they are run, at no pace: the machine stops at the loads that
its operator asks for, between two commands. Then what else the operator's hand does."""
import os
import re
import subprocess
import tempfile
import unittest

from launched import ROOT, Launch, wait_for


class HandTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.launch = Launch('material:=nylon', "overrides:='physics.accuracy=draft'", 'real_time_factor:=0', 'autostart:=false',
                            'exit_at_end:=false')
        cls.addClassCleanup(cls.launch.__exit__)
        wait_for('the master', lambda: cls.launch.answers('utm_node'))
        os.environ.update(cls.launch.environment)
        global rospy, client, msg, GoalStatus, SimpleActionClient, Trigger, StartTest
        import client
        import knot_utm.msg as msg
        import rospy
        from actionlib import GoalStatus, SimpleActionClient
        from knot_utm.srv import StartTest
        from std_srvs.srv import Trigger
        rospy.init_node('hand_test', disable_signals=True)
        cls.status = client.Latest('utm/status', msg.TestStatus)
        cls.recorder = client.Latest('recorder/status', msg.RecorderStatus)

    def run_example(self, name, program):
        """As its head says; returns the loads at which the crosshead stood."""
        with open(os.path.join(ROOT, 'examples', name), encoding='utf-8') as file:
            line = re.search('Run: +(.*)', file.read()).group(1)
        with tempfile.TemporaryDirectory() as folder:
            for entry in 'examples', 'build':
                os.symlink(os.path.join(ROOT, entry), os.path.join(folder, entry))
            done = subprocess.run(['/bin/bash', '-c', line + program], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                  universal_newlines=True, timeout=client.LAST_RESORT, check=False)
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertEqual(done.stdout.count('the crosshead stands at its load'), 2, done.stdout)
        run = self.status.last.run
        self.status.wait('ended', lambda s: s.run == run and s.state == s.ENDED and s.ended_by == 'operator')
        self.assertEqual(self.recorder.wait('complete', lambda r: r.run == run and (r.complete or r.error)).error, '')
        return [float(load) for load in re.findall(r'(-?[0-9.]+) N', done.stdout)]

    def test_examples(self):
        for name, program in ('hand_on_the_machine.py', ''), ('hand_on_the_machine.cpp', ' && ./hand'):
            out, back = self.run_example(name, program)
            self.assertAlmostEqual(out, 100.0, delta=1.0)
            self.assertAlmostEqual(back, 5.0, delta=1.0)

    def test_refused_taken_back_and_replaced(self):
        machine, other = (SimpleActionClient('utm/move', msg.MoveAction) for _ in range(2))
        for one in machine, other:
            one.wait_for_server()
        machine.send_goal_and_wait(msg.MoveGoal(load=1.0))
        self.assertEqual((machine.get_state(), machine.get_goal_status_text()[:18]), (GoalStatus.REJECTED, 'no test is running'))
        wait_for('the start', lambda: client.call('utm/start_test', StartTest).accepted)
        machine.send_goal_and_wait(msg.MoveGoal(load=1.0, speed=-1.0))
        self.assertEqual(machine.get_goal_status_text(), 'speed: -1 is refused: 0 to 0.5 m/s is allowed')
        machine.send_goal(msg.MoveGoal(extension=1.0, speed=1e-6))
        wait_for('the goal', lambda: machine.get_state() == GoalStatus.ACTIVE)
        other.send_goal_and_wait(msg.MoveGoal(extension=0.001))
        self.assertEqual((machine.get_state(), other.get_state()), (GoalStatus.PREEMPTED, GoalStatus.SUCCEEDED))
        self.assertAlmostEqual(other.get_result().extension, 0.001, delta=0.0007)  # the way in one command
        now = rospy.get_rostime()
        rospy.sleep(0.3)  # the clock goes on while the crosshead stands
        self.assertGreaterEqual((rospy.get_rostime() - now).to_sec(), 0.3)
        feedback = []
        machine.send_goal(msg.MoveGoal(extension=1.0, speed=1e-5), feedback_cb=feedback.append)
        wait_for('feedback', lambda: feedback and feedback[-1].time > other.get_result().time)
        machine.cancel_goal()
        self.assertTrue(machine.wait_for_result())
        self.assertEqual((machine.get_state(), machine.get_result().ended_by), (GoalStatus.PREEMPTED, 'operator'))
        machine.send_goal(msg.MoveGoal(extension=1.0, speed=1e-5))
        wait_for('the goal', lambda: machine.get_state() == GoalStatus.ACTIVE)
        self.assertTrue(client.call('utm/stop_test', Trigger).success)
        self.assertTrue(machine.wait_for_result())
        self.assertEqual((machine.get_state(), machine.get_goal_status_text()), (GoalStatus.ABORTED, 'the test ended by operator'))


if __name__ == '__main__':
    unittest.main()
