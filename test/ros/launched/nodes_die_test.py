#!/usr/bin/python3
"""A process is killed in the middle of a test: the launch names it and ends, what was measured is on disk."""
import os
import signal
import subprocess
import unittest

from launched import METHOD, ROOT, TOOL, Headless, Launch

SCRIPT = [os.path.join(ROOT, 'scripts/tighten')]


class NodesDieTest(unittest.TestCase):

    def dies(self, victim, ended_by, reason):
        """A process is killed in the middle of a test that a script runs."""
        with Launch('method:=' + METHOD, 'rviz:=false', command=SCRIPT) as launch:
            launch.wait_for_rows(3)
            os.kill(launch.pid(victim), signal.SIGKILL)
            self.assertEqual(launch.end(), 1)
            console = launch.console()
            self.assertIn('files are in %s\n' % launch.out, console)
            # Once, and not what ended for that reason.
            self.assertEqual(console.count('process has died'), 1, console)
            self.assertRegex(console, r'\[%s(-\d+)?\] (has died!\n)?process has died \[.*exit code -9' % victim)
            self.assertRegex(launch.result('ended_by'), ended_by, console)
            self.assertRegex(launch.result('reason'), reason)
            lines = launch.text('curve.csv').split('\n')
            self.assertEqual(lines[-1], '')
            self.assertGreaterEqual(len(lines), 2 + 3 + 1)
            self.assertEqual({len(line.split(',')) for line in lines[:-1]}, {len(lines[0].split(','))})

    def test_machine(self):
        # roslaunch may end the recorder before it has noticed.
        self.dies('utm_node', 'interrupted', '(utm_node died|ROS was shut down) before the test had ended')

    def test_physics(self):
        # roslaunch may end the recorder before the machine has said so.
        self.dies('knot_node', '(solver|interrupted)', '(knot_node died during the test|ROS was shut down)')

    def test_master_of_the_launch(self):
        self.dies('master', 'interrupted', 'the ROS master died before the test had ended')

    def test_recorder(self):
        with Launch('method:=' + METHOD) as launch, Headless(METHOD, 'program.hold.duration=40') as headless:
            launch.wait_for_rows(5)
            os.kill(launch.pid('recorder_node'), signal.SIGKILL)
            launch.end()
            self.assertEqual(launch.console().count('process has died'), 1, launch.console())
            self.assertFalse(os.path.exists(os.path.join(launch.out, 'result.yaml')))
            self.make_from_samples(launch)
            self.assertIn('ended_by: not yet\nreason: "the test was cut off"', launch.text('result.yaml'))
            for name in 'curve.csv', 'curve_full.csv':
                with open(os.path.join(headless.folder, name), encoding='utf-8') as whole:
                    self.assertTrue(whole.read().startswith(launch.text(name)), name)

    def make_from_samples(self, launch):
        subprocess.run([TOOL, '--from-samples', launch.out, '--quiet'], check=True)
        self.assertGreaterEqual(launch.text('curve.csv').count('\n'), 2 + 3)

    def test_recorder_without_room(self):
        with Launch('method:=' + METHOD, 'real_time_factor:=0', 'recorder_prefix:=prlimit --fsize=60000') as launch:
            launch.end()
            self.assertRegex(launch.console(), r'file too large; what was measured until then stands in \S*samples.csv, make the '
                                               r'results of it by: \S*tensile_test --from-samples ')
            self.make_from_samples(launch)  # once there is room

    def test_interrupted(self):
        with Launch('method:=' + METHOD, 'rviz:=false', command=SCRIPT) as launch:
            launch.wait_for_rows(3)
            os.killpg(launch.process.pid, signal.SIGINT)  # as Ctrl-C does
            self.assertEqual(launch.end(), 1)
            self.assertTrue(launch.console().endswith(
                'scripts/tighten: the test was cut off; the files are in %s\n' % launch.out), launch.console())
            self.assertEqual((launch.result('ended_by'), launch.result('reason')),
                             ('interrupted', 'ROS was shut down before the test had ended'))
            self.assertIn('readings were written to ' + launch.out, launch.console())


if __name__ == '__main__':
    unittest.main()
