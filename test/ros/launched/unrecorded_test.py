#!/usr/bin/python3
"""Without a recorder nothing is written, and the exit code of scripts/tighten tells how the test ended."""
import os
import signal
import sys
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), '../../../bench'))

from launched import METHOD, ROOT, Launch

IMPOSSIBLE = os.path.join(ROOT, 'test/ros/impossible.yaml')
SCRIPT = [os.path.join(ROOT, 'scripts/tighten')]
SHORT = "overrides:='program.hold.duration=0.1'"


class UnrecordedTest(unittest.TestCase):

    def ends(self, code, method, *arguments, do=None):
        """What the console had of a test that ended with this exit code."""
        with Launch('method:=' + method, 'rviz:=false', 'record:=false', *arguments, command=SCRIPT) as launch:
            if do:
                do(launch)
            self.assertEqual(launch.end(), code, launch.console())
            self.assertFalse(os.path.exists(launch.out))
            return launch.console()

    def test_ended_as_programmed(self):
        console = self.ends(0, METHOD, SHORT)
        self.assertEqual(console.count('the test ended by program'), 1)
        self.assertIn('scripts/tighten: nothing was written, because of record:=false', console)
        self.assertIn('[utm_node-3] process has finished cleanly', console)
        for word in ('died', 'REQUIRED', 'ERROR', 'Shutdown errors'):
            self.assertNotIn(word, console)

    def test_the_physics_gave_up(self):
        self.assertEqual(self.ends(1, IMPOSSIBLE).count('the test ended by solver'), 1)

    def test_wrong_input(self):
        console = self.ends(2, 'nosuch.yaml')
        self.assertIn('scripts/tighten: nothing was written', console)
        self.assertIn('nosuch.yaml', console)
        self.assertNotIn('REQUIRED', console)

    def test_the_physics_died(self):
        self.ends(1, METHOD, do=lambda launch: os.kill(launch.pid('knot_node'), signal.SIGKILL))

    def test_interrupted(self):
        def interrupt(launch):
            launch.pid('utm_node')
            os.kill(launch.roslaunch(), signal.SIGINT)

        self.ends(1, METHOD, do=interrupt)


if __name__ == '__main__':
    unittest.main()
