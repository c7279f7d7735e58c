#!/usr/bin/python3
"""A node that stands still for 12 s, as on a machine that swaps or sleeps, is waited for: the files are those of the
headless tool."""
import os
import signal
import sys
import time
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), '../../../bench'))

from launched import METHOD, Headless, Launch

NODES = ['utm_node', 'knot_node', 'recorder_node']
STANDSTILL = 12.0  # [s] longer than the recorder waits for the last records of a test
HOLD = 'program.hold.duration=10'


class StoppedTest(unittest.TestCase):

    def test_same_files_as_headless(self):
        launches = {}
        try:
            for node in NODES:
                launches[node] = Launch('method:=' + METHOD, "overrides:='" + HOLD + "'")
            # Each as soon as its test is under way: that of the first is over before the last has begun.
            running = set(NODES)
            while running:
                for node in [node for node in running if launches[node].rows() >= 3]:
                    os.kill(launches[node].pid(node), signal.SIGSTOP)
                    running.remove(node)
                for node in running:
                    self.assertIsNone(launches[node].process.poll(), launches[node].console())
                time.sleep(0.05)
            time.sleep(STANDSTILL)
            for node, launch in launches.items():
                os.kill(launch.pid(node), signal.SIGCONT)
            with Headless(METHOD, HOLD) as headless:
                for node, launch in launches.items():
                    launch.end()
                    self.assertEqual(launch.result('ended_by'), 'program', node)
                    self.assertEqual(headless.different(launch.out), ([], []), node)
        finally:
            for launch in launches.values():
                launch.__exit__()


if __name__ == '__main__':
    unittest.main()
