#!/usr/bin/python3
"""Two launches on one master: the second is refused, or has a namespace of its own; the first does not notice it. The launch
leaves the master as it found it."""
import os
import signal
import subprocess
import tempfile
import unittest

import rosgraph

from launched import FILES, LAST_RESORT, METHOD, ROOT, Launch, children, free_port, wait_for, words

SCRIPT = [os.path.join(ROOT, 'scripts/tighten')]


def master_at(uri):
    return rosgraph.Master('/test', master_uri=uri)


def parameter(uri, name):
    """None: it is not set."""
    return master_at(uri).getParam(name) if master_at(uri).hasParam(name) else None


def publishers(uri, topic):
    return [nodes for name, nodes in master_at(uri).getSystemState()[0] if name == topic]


class TwoLaunchesTest(unittest.TestCase):

    def master(self):
        """One that was there before."""
        port, log = free_port(), tempfile.TemporaryDirectory()
        master = subprocess.Popen(['rosmaster', '--core', '-p', str(port)], env=dict(os.environ, ROS_LOG_DIR=log.name),
                                  stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.addCleanup(log.cleanup)
        self.addCleanup(master.wait)
        self.addCleanup(master.kill)
        wait_for('the master', lambda: rosgraph.is_master_online('http://localhost:%d' % port))
        return port

    def assert_refused(self, code, lines, launch):
        self.assertEqual(launch.end(), code, launch.console())
        said = [line for line in launch.console().split('\n') if 'a test runs already' in line]
        self.assertEqual(len(said), 1, launch.console())
        if lines:
            self.assertEqual(launch.console().count('\n'), lines, launch.console())
        self.assertNotIn('started with pid', launch.console())
        self.assertFalse(os.path.exists(launch.out))
        return said[0]

    def assert_stops(self, namespace, launch):
        """By its own operator and for no other reason, with all files."""
        subprocess.run(['rosservice', 'call', namespace + '/utm/stop_test'], env=launch.environment, stdout=subprocess.DEVNULL,
                       check=True)
        launch.end()
        self.assertEqual((launch.result('ended_by'), launch.result('reason')), ('operator', 'stopped by the operator'))
        for name in FILES:
            self.assertTrue(os.path.exists(os.path.join(launch.out, name)), name)

    def test_second_is_refused_or_has_its_own_namespace(self):
        port = self.master()
        with Launch('method:=' + METHOD, port=port) as first:
            first.wait_for_rows(3)
            self.assertEqual(parameter(first.uri, '/use_sim_time'), True)
            for code, lines, command in ((2, 1, SCRIPT), (1, None, None)):
                with Launch('method:=' + METHOD, port=port, command=command) as second:
                    said = self.assert_refused(code, lines, second)
                    for part in (METHOD, '-p %d' % (port + 1), 'namespace:='):
                        self.assertIn(part, said)
            with Launch('method:=' + METHOD, 'namespace:=second', port=port) as second:
                second.wait_for_rows(3)
                self.assertEqual(publishers(first.uri, '/clock'), [['/utm_node']])
                for topic in '/second/clock', '/second/utm/status':
                    self.assertEqual(publishers(first.uri, topic), [['/second/utm_node']], topic)
                self.assertEqual(publishers(first.uri, '/second/tf'), [['/second/knot_node']])
                with Launch('method:=' + METHOD, 'namespace:=second', port=port) as third:
                    self.assertIn(' in /second on ', self.assert_refused(1, None, third))
                self.assert_stops('/second', second)
            self.assertEqual(parameter(first.uri, '/use_sim_time'), True)
            self.assertIsNone(parameter(first.uri, '/second/use_sim_time'))
            self.assertTrue(first.answers('utm_node'))
            self.assert_stops('', first)
            self.assertIsNone(parameter(first.uri, '/use_sim_time'))
            self.assertIsNone(parameter(first.uri, '/test/use_sim_time_found'))

    def test_roslaunch_is_killed(self):
        port = self.master()
        master_at('http://localhost:%d' % port).setParam('/use_sim_time', False)
        with Launch('method:=' + METHOD, port=port) as launch:
            launch.wait_for_rows(3)
            nodes = [launch.pid(name) for name in ('utm_node', 'knot_node', 'recorder_node')]
            rosout = [pid for pid in children(launch.roslaunch()) if any(w.endswith('/rosout') for w in words(pid))]
            os.kill(launch.roslaunch(), signal.SIGKILL)
            wait_for('the end of the nodes', lambda: not any(words(pid) for pid in nodes))
            self.assertEqual(launch.result('ended_by'), 'interrupted')
            self.assertEqual(parameter(launch.uri, '/use_sim_time'), False)
            for pid in rosout:  # nobody else ends it
                os.kill(pid, signal.SIGKILL)

    def test_master_of_another_machine(self):
        for word, code in ('network:=false', 2), ('network:=true', 0):
            check = subprocess.run([os.path.join(ROOT, 'launch/check'), 'tighten.launch', '--', word], check=False,
                                   env=dict(os.environ, ROS_MASTER_URI='http://203.0.113.7:11311'), stdout=subprocess.DEVNULL,
                                   stderr=subprocess.PIPE, universal_newlines=True, timeout=LAST_RESORT)
            self.assertEqual((check.returncode, check.stderr.count('\n')), (code, code // 2), check.stderr)
            self.assertIn("which is not on this machine's loopback" if code else '', check.stderr)


if __name__ == '__main__':
    unittest.main()
