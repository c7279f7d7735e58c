#!/usr/bin/python3
"""A node that stands still for 20 s, as on a machine that swaps or sleeps, is waited for: the files are those of the
headless tool."""
import os
import signal
import sys
import time
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), '../../../bench'))

from launched import METHOD, Headless, Launch

NODES = ['utm_node', 'knot_node', 'recorder_node']
STANDSTILL = 20.0
HOLD = 'program.hold.duration=4'


class StoppedTest(unittest.TestCase):

    def test_same_files_as_headless(self):
        launches = {}
        try:
            for node in NODES:
                launches[node] = Launch('method:=' + METHOD, "overrides:='" + HOLD + "'")
            for node, launch in launches.items():
                launch.wait_for_rows(3)
                os.kill(launch.pid(node), signal.SIGSTOP)
            time.sleep(STANDSTILL)
            for node, launch in launches.items():
                os.kill(launch.pid(node), signal.SIGCONT)
            with Headless(METHOD, HOLD) as headless:
                for node, launch in launches.items():
                    launch.end(60.0)
                    self.assertEqual(launch.result('ended_by'), 'program', node)
                    self.assertEqual(headless.different(launch.out), ([], []), node)
        finally:
            for launch in launches.values():
                launch.__exit__()


if __name__ == '__main__':
    unittest.main()
