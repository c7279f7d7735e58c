#!/usr/bin/python3
"""Two launches on one master: the second is refused, or has a namespace of its own; the first does not notice it. The launch
leaves the master as it found it."""
import os
import runpy
import signal
import subprocess
import sys
import tempfile
import types
import unittest
import unittest.mock as mock
import xmlrpc.client

for folder in 'bench', 'launch':
    sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), '../../..', folder))

from launched import FILES, LAST_RESORT, METHOD, ROOT, Launch, children, free_port, wait_for, words

SHORT = "overrides:='program.hold.duration=1'"
SCRIPT = [os.path.join(ROOT, 'scripts/tighten')]


def parameter(uri, name):
    """None: it is not set."""
    with xmlrpc.client.ServerProxy(uri) as master:
        code, _, value = master.getParam('/test', name)
        return value if code == 1 else None


def publishers(uri, topic):
    with xmlrpc.client.ServerProxy(uri) as master:
        return [nodes for name, nodes in master.getSystemState('/test')[2][0] if name == topic]


class TwoLaunchesTest(unittest.TestCase):

    def master(self):
        """One that was there before."""
        port, log = free_port(), tempfile.TemporaryDirectory()
        master = subprocess.Popen(['rosmaster', '--core', '-p', str(port)], env=dict(os.environ, ROS_LOG_DIR=log.name),
                                  stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.addCleanup(log.cleanup)
        self.addCleanup(master.wait)
        self.addCleanup(master.kill)

        def answers():
            try:
                return parameter('http://localhost:%d' % port, '/run_id') is None
            except OSError:
                return False
        wait_for('the master', answers)
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

    def test_a_port_at_which_a_master_runs_is_refused(self):
        port = self.master()
        uri = 'http://localhost:%d' % port
        for environment, said in (('http://localhost:%d' % free_port(), 'a ROS master runs already at %s' % uri), (uri, '')):
            check = subprocess.run([os.path.join(ROOT, 'launch/check_master'), 'tighten.launch', '--', '-p', str(port)],
                                   env=dict(os.environ, ROS_MASTER_URI=environment), stdout=subprocess.DEVNULL,
                                   stderr=subprocess.PIPE, universal_newlines=True, check=False)
            self.assertEqual((check.returncode, check.stderr.count('\n')), (2, 1) if said else (0, 0), check.stderr)
            self.assertIn(said, check.stderr)

    def test_second_is_refused_or_has_its_own_namespace(self):
        port = self.master()
        with Launch('method:=' + METHOD, port=port) as first:
            first.wait_for_rows(3)
            self.assertIn('joins the ROS master at %s, which it has not started' % first.uri, first.console())
            self.assertEqual(parameter(first.uri, '/use_sim_time'), True)
            for code, lines, command in ((2, 1, SCRIPT), (1, None, None)):
                with Launch('method:=' + METHOD, port=port, command=command) as second:
                    said = self.assert_refused(code, lines, second)
                    for part in (METHOD, 'files in ' + first.out, '-p %d' % (port + 1), 'namespace:='):
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

    def test_of_two_at_the_same_time_one_comes_first(self):
        port = free_port()
        with Launch('method:=' + METHOD, SHORT, port=port) as one, Launch('method:=' + METHOD, SHORT, port=port) as other:
            wait_for('one that is refused', lambda: one.process.poll() or other.process.poll())
            first, second = (other, one) if one.process.poll() else (one, other)
            self.assertIn('a test is being launched already', second.console())
            self.assertIn('-p %d' % (port + 1), second.console())
            first.end()
            self.assertEqual(first.result('ended_by'), 'program', first.console())

    def test_roslaunch_is_killed(self):
        port = self.master()
        with xmlrpc.client.ServerProxy('http://localhost:%d' % port) as master:
            master.setParam('/test', '/use_sim_time', False)
        with Launch('method:=' + METHOD, port=port) as launch:
            launch.wait_for_rows(3)
            nodes = [launch.pid(name) for name in ('utm_node', 'knot_node', 'recorder_node', 'watch_node')]
            rosout = [pid for pid in children(launch.roslaunch()) if any(w.endswith('/rosout') for w in words(pid))]
            os.kill(launch.roslaunch(), signal.SIGKILL)
            wait_for('the end of the nodes', lambda: not any(words(pid) for pid in nodes))
            self.assertIn('roslaunch died', launch.console())
            self.assertEqual(launch.result('ended_by'), 'interrupted')
            self.assertEqual(parameter(launch.uri, '/use_sim_time'), False)
            for pid in rosout:  # nobody else ends it
                os.kill(pid, signal.SIGKILL)

    def test_master_of_another_machine(self):
        for command, code in (SCRIPT, 2), (['roslaunch', 'knot_utm', 'tighten.launch'], 1):
            said = subprocess.run(command, check=False, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=LAST_RESORT,
                                  env=dict(os.environ, ROS_MASTER_URI='http://203.0.113.7:11311', KNOT_UTM_SKIP_BUILD='1'),
                                  universal_newlines=True)
            self.assertEqual(said.returncode, code, said.stdout)
            self.assertIn("ROS_MASTER_URI is http://203.0.113.7:11311, which is not on this machine's loopback", said.stdout)
            if code == 2:
                self.assertEqual(said.stdout.count('\n'), 1)


class NoteOfALaunchTest(unittest.TestCase):
    """Before a master knows of a launch, a file says so."""

    def setUp(self):
        self.check_master = types.SimpleNamespace(**runpy.run_path(os.path.join(ROOT, 'launch/check_master')))
        home = tempfile.TemporaryDirectory()
        self.addCleanup(home.cleanup)
        self.folder = os.path.join(home.name, 'knot_utm_launches_%d' % os.getuid())
        self.environment = {'XDG_RUNTIME_DIR': home.name, 'HOME': os.path.join(home.name, 'home')}

    def refusal(self, roslaunch=os.getpid(), **environment):
        """What a launch is refused with; None: it is noted."""
        with mock.patch.dict(os.environ, {**self.environment, **environment}):
            try:
                self.check_master.reserve(self.check_master.Place(['-p', '11399']), roslaunch)
            except self.check_master.Refused as why:
                return str(why)
            return None

    def test_stands_in_a_folder_of_the_user_alone(self):
        self.assertIsNone(self.refusal())
        self.assertEqual(os.stat(self.folder).st_mode & 0o777, 0o700)
        self.assertEqual(os.listdir(self.folder), ['localhost%3A11399'])
        self.assertIsNone(self.refusal(), 'the same launch')
        self.assertIn('being launched already', self.refusal(roslaunch=os.getppid()))

    def test_stands_with_the_files_of_ros_where_the_machine_has_no_folder_of_the_user(self):
        self.assertIsNone(self.refusal(XDG_RUNTIME_DIR='/dev/null'))
        ours = os.path.join(self.environment['HOME'], '.ros', os.path.basename(self.folder))
        self.assertEqual(os.listdir(ours), ['localhost%3A11399'])
        self.assertIn('set XDG_RUNTIME_DIR', self.refusal(XDG_RUNTIME_DIR='/dev/null', HOME='/dev/null', ROS_HOME='/dev/null'))

    def test_is_not_made_where_another_user_could_have_made_it(self):
        os.mkdir(self.folder)
        os.chmod(self.folder, 0o777)
        self.assertIn('other users may write to this folder', self.refusal())
        os.chmod(self.folder, 0o700)
        victim = os.path.join(os.path.dirname(self.folder), 'victim')
        with open(victim, 'w', encoding='utf-8') as file:
            file.write('kept')
        os.symlink(victim, os.path.join(self.folder, 'localhost%3A11399'))
        self.assertIn('cannot note this launch in ' + self.folder, self.refusal())
        with open(victim, encoding='utf-8') as file:
            self.assertEqual(file.read(), 'kept')
        os.rename(self.folder, self.folder + '.own')
        os.symlink(self.folder + '.own', self.folder)
        self.assertIn('cannot note this launch in ' + self.folder, self.refusal())


if __name__ == '__main__':
    unittest.main()
