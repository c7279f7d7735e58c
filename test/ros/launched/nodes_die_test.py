#!/usr/bin/python3
"""A process is killed in the middle of a test: the launch names it and ends, what was measured is on disk."""
import ctypes
import os
import re
import signal
import socket
import subprocess
import sys
import unittest
import xmlrpc.client

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), '../../../bench'))

from launched import METHOD, ROOT, Launch, reading_times, wait_for
from dying import Dying


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


class NodesDieTest(Dying):

    def test_machine(self):
        self.dies('utm_node', 'interrupted', 'utm_node died before the test had ended')

    def test_physics(self):
        self.dies('knot_node', 'solver', 'knot_node died during the test')

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
