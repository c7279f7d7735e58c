#!/usr/bin/python3
"""A process of the system is killed in the middle of a test: the launch names it and ends, what was measured is on disk."""
import os
import signal
import unittest

from launched import METHOD, ROOT, Launch


class NodesDieTest(unittest.TestCase):

    def die(self, victim, ended_by, reason, process=None):
        with Launch('method:=' + METHOD, 'rviz:=false', command=[os.path.join(ROOT, 'scripts/tighten')]) as launch:
            launch.wait_for_rows(3)
            os.kill(launch.pid(victim), signal.SIGKILL)
            self.assertEqual(launch.end(30.0), 1)
            console = launch.console()
            self.assertIn('REQUIRED process [%s' % (process or victim), console)
            self.assertIn('exit code -9', console)
            self.assertEqual((launch.result('ended_by'), launch.result('reason')), (ended_by, reason), console)
            lines = launch.text('curve.csv').split('\n')
            self.assertEqual(lines[-1], '')
            self.assertGreaterEqual(len(lines), 2 + 3 + 1)
            self.assertEqual({len(line.split(',')) for line in lines[:-1]}, {7})

    def test_machine(self):
        self.die('utm_node', 'operator', 'utm_node died before the test had ended')

    def test_physics(self):
        self.die('knot_node', 'solver', 'knot_node died during the test')

    def test_master(self):
        self.die('master', 'operator', 'the ROS master died before the test had ended')

    def test_interrupted(self):
        with Launch('method:=' + METHOD) as launch:
            launch.wait_for_rows(3)
            os.kill(launch.process.pid, signal.SIGINT)
            launch.end(30.0)
            self.assertEqual(launch.result('reason'), 'ROS was shut down before the test had ended')


if __name__ == '__main__':
    unittest.main()
