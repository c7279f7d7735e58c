#!/usr/bin/python3
"""A process is killed in the middle of a test: the launch names it and ends, what was measured is on disk."""
import ctypes
import os
import re
import signal
import socket
import subprocess
import sys
import tempfile
import unittest
import xmlrpc.client

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), '../../../bench'))

from launched import METHOD, ROOT, Headless, Launch, free_port, reading_times, wait_for

HOLD = 'program.hold.duration=10'


def connection(launch):
    """What ROS says of that by which utm_node hears of the recorder; None: there is none."""
    with xmlrpc.client.ServerProxy(launch.uri) as master:
        uri = master.lookupNode('/test', '/recorder_node')[2]
    with xmlrpc.client.ServerProxy(uri) as recorder:
        found = [one[6] for one in recorder.getBusInfo('/test')[2]
                 if one[1] == '/utm_node' and one[2] == 'o' and one[4] == '/recorder/status']
    return found[0] if found else None


def cut(process, said):
    """Shuts a connection down as a network that fails does. No process notices who did it."""
    number = int(re.search(r'on socket (\d+)', said)[1])
    pidfd_getfd = 438  # the system call, for which Python has no name
    taken = ctypes.CDLL(None, use_errno=True).syscall(pidfd_getfd, os.pidfd_open(process), number, 0)
    if taken < 0:
        raise OSError(ctypes.get_errno(), 'cannot reach a socket of process %d' % process)
    with socket.socket(fileno=taken) as connected:
        connected.shutdown(socket.SHUT_RDWR)


class NodesDieTest(unittest.TestCase):

    def dies(self, victim, ended_by, reason):
        """A process is killed in the middle of a test that a script runs."""
        with Launch('method:=' + METHOD, 'rviz:=false', command=[os.path.join(ROOT, 'scripts/tighten')]) as launch:
            launch.wait_for_rows(3)
            os.kill(launch.pid(victim), signal.SIGKILL)
            self.assertEqual(launch.end(), 1)
            console = launch.console()
            self.assertIn('files are in %s\n' % launch.out, console)
            # Once, and not what ended for that reason.
            self.assertEqual(console.count('process has died'), 1, console)
            self.assertRegex(console, r'\[%s(-\d+)?\] (has died!\n)?process has died \[.*exit code -9' % victim)
            self.assertEqual(launch.result('ended_by'), ended_by, console)
            self.assertRegex(launch.result('reason'), reason)
            lines = launch.text('curve.csv').split('\n')
            self.assertEqual(lines[-1], '')
            self.assertGreaterEqual(len(lines), 2 + 3 + 1)
            self.assertEqual({len(line.split(',')) for line in lines[:-1]}, {len(lines[0].split(','))})

    def test_machine(self):
        # roslaunch may end the recorder before it has noticed.
        self.dies('utm_node', 'interrupted', '(utm_node died|ROS was shut down) before the test had ended')

    def test_physics(self):
        self.dies('knot_node', 'solver', 'knot_node died during the test')

    def test_physics_that_dies_between_two_tests(self):
        with Launch('method:=' + METHOD, "overrides:='program.hold.duration=0.1'", 'exit_at_end:=false') as launch:
            wait_for('the first test', lambda: os.path.exists(os.path.join(launch.out, 'result.yaml')))
            os.kill(launch.pid('knot_node'), signal.SIGKILL)
            launch.end()

    def test_master_of_the_launch(self):
        self.dies('master', 'interrupted', 'the ROS master died before the test had ended')

    def test_master_that_was_there_before(self):
        # Nobody watches it, and the nodes do not need it any more: the test goes on to its end.
        port = free_port()
        with tempfile.TemporaryDirectory() as log:
            master = subprocess.Popen(['rosmaster', '--core', '-p', str(port)], env=dict(os.environ, ROS_LOG_DIR=log),
                                      stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            try:
                with Launch('method:=' + METHOD, "overrides:='" + HOLD + "'", port=port) as launch:
                    launch.wait_for_rows(3)
                    master.kill()
                    launch.end()
                    self.assertEqual(launch.result('ended_by'), 'program')
                    with Headless(METHOD, HOLD) as headless:
                        self.assertEqual(headless.different(launch.out), ([], []))
            finally:
                master.kill()
                master.wait()

    def test_connection_lost(self):
        with Launch('method:=' + METHOD, 'rviz:=false') as launch:
            launch.wait_for_rows(3)
            before, time = connection(launch), reading_times(launch.out)[-1]
            cut(launch.pid('recorder_node'), before)
            wait_for('another connection', lambda: connection(launch) not in (None, before))
            # In real time, which is longer than the recorder waits for the last records of a machine that died.
            wait_for('what follows', lambda: reading_times(launch.out)[-1] > time + 3.0 or
                     os.path.exists(os.path.join(launch.out, 'result.yaml')))
            subprocess.run(['rosservice', 'call', '/utm/stop_test'], env=launch.environment, stdout=subprocess.DEVNULL,
                           check=True)
            launch.end()
            self.assertEqual((launch.result('ended_by'), launch.result('reason')), ('operator', 'stopped by the operator'),
                             launch.console())

    def test_interrupted(self):
        with Launch('method:=' + METHOD, 'rviz:=false', command=[os.path.join(ROOT, 'scripts/tighten')]) as launch:
            launch.wait_for_rows(3)
            os.killpg(launch.process.pid, signal.SIGINT)  # as Ctrl-C does
            self.assertEqual(launch.end(), 1)
            self.assertTrue(launch.console().endswith(
                'scripts/tighten: the test was cut off; the files are in %s\n' % launch.out), launch.console())
            self.assertEqual((launch.result('ended_by'), launch.result('reason')),
                             ('interrupted', 'ROS was shut down before the test had ended'))


if __name__ == '__main__':
    unittest.main()
