#!/usr/bin/python3
"""Without being asked to, no process of the system listens to other machines."""
import os
import re
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), '../../../bench'))

from launched import LAST_RESORT, METHOD, ROOT, Launch, free_port, wait_for

NODES = ['master', 'utm_node', 'knot_node', 'recorder_node']
BARE = {key: value for key, value in os.environ.items() if key not in ('ROS_HOSTNAME', 'ROS_IP')}


def listening(pid):
    """Addresses on which a process listens: 0.0.0.0%lo is every address, but of the loopback device only."""
    said = subprocess.run(['ss', '-ltnpH'], check=True, stdout=subprocess.PIPE, universal_newlines=True).stdout
    return [line.split()[3].rsplit(':', 1)[0] for line in said.splitlines() if re.search(r'\bpid=%d,' % pid, line)]


class LoopbackTest(unittest.TestCase):

    def stays_inside(self, launch):
        launch.wait_for_rows(2)
        processes = launch.processes()
        for node in NODES:
            pid = next(pid for name, pid in processes.items() if name.startswith(node))
            addresses = listening(pid)
            self.assertGreaterEqual(len(addresses), 1, node)
            self.assertLessEqual(set(addresses), {'127.0.0.1', '0.0.0.0%lo'}, node)
        self.assertEqual(set(listening(launch.roslaunch())), {'127.0.0.1'})

    def test_script(self):
        with Launch('method:=' + METHOD, 'rviz:=false', command=[ROOT + '/scripts/tighten']) as launch:
            self.stays_inside(launch)

    def test_setup_and_roslaunch_in_a_folder_with_a_blank(self):
        def prepare(folder):
            os.symlink(ROOT, os.path.join(folder, 'a copy'))

        shell = ['env', '-u', 'ROS_HOSTNAME', '-u', 'ROS_IP', 'bash', '-c',
                 '. "a copy/build/devel/setup.bash" && exec roslaunch knot_utm tighten.launch "$@"', 'bash']
        with Launch('method:=' + METHOD, command=shell, prepare=prepare) as launch:
            self.stays_inside(launch)
            self.assertNotIn('ld.so', launch.console())

    def node_beside_a_master(self, of_master, of_node):
        """What a node says that is started by hand, with these variables for the master and for itself."""
        port = free_port()
        log = tempfile.TemporaryDirectory()
        self.addCleanup(log.cleanup)
        master = subprocess.Popen(['rosmaster', '--core', '-p', str(port)], env=dict(BARE, ROS_LOG_DIR=log.name, **of_master),
                                  stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.addCleanup(master.wait)
        self.addCleanup(master.kill)
        wait_for('master', lambda: listening(master.pid))
        node = subprocess.run([os.path.join(ROOT, 'build/devel/lib/knot_utm/knot_node')], check=False, timeout=LAST_RESORT,
                              env=dict(BARE, ROS_MASTER_URI='http://localhost:%d' % port, ROS_LOG_DIR=log.name, **of_node),
                              stderr=subprocess.PIPE, universal_newlines=True)
        self.assertEqual(node.returncode, 2)
        return node.stderr

    def test_node_on_other_address(self):
        said = self.node_beside_a_master({'ROS_HOSTNAME': 'localhost'}, {'ROS_HOSTNAME': '192.0.2.7'})
        self.assertIn('this node can be reached from other machines (192.0.2.7), and ROS 1 has no authentication: '
                      'set ROS_HOSTNAME=localhost', said)

    def test_master_on_every_address(self):
        self.assertIn('the ROS master can be reached from other machines', self.node_beside_a_master({}, {}))

    def test_opened(self):
        with Launch('method:=' + METHOD, 'network:=true') as launch:
            launch.wait_for_rows(2)
            self.assertEqual(launch.console().count('ROS 1 has no authentication'), 1)


if __name__ == '__main__':
    unittest.main()
