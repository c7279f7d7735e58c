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
    """Addresses on which a process listens, as /proc/net says them."""
    own = set()
    for fd in os.listdir('/proc/%d/fd' % pid):
        try:
            own.update(re.findall(r'socket:\[(\d+)\]', os.readlink('/proc/%d/fd/%s' % (pid, fd))))
        except OSError:
            pass
    found = []
    for table in ('tcp', 'tcp6'):
        with open('/proc/net/' + table, encoding='utf-8') as file:
            for line in file.readlines()[1:]:
                fields = line.split()
                if fields[3] == '0A' and fields[9] in own:
                    found.append(fields[1].split(':')[0])
    return found


class LoopbackTest(unittest.TestCase):

    def stays_inside(self, launch, more=()):
        launch.wait_for_rows(2)
        processes = launch.processes()
        for node in NODES + list(more):
            pid = next(pid for name, pid in processes.items() if name.startswith(node))
            addresses = listening(pid)
            self.assertGreaterEqual(len(addresses), 1, node)
            self.assertEqual(set(addresses), {'0100007F'}, node)
        self.assertEqual(set(listening(launch.roslaunch())), {'0100007F'})

    def test_script(self):
        with Launch('method:=' + METHOD, 'rviz:=false', command=[ROOT + '/scripts/tighten']) as launch:
            self.stays_inside(launch, more=['rosout'])

    def test_setup_and_roslaunch(self):
        shell = ['env', '-u', 'ROS_HOSTNAME', '-u', 'ROS_IP', 'bash', '-c',
                 '. "$0/build/devel/setup.bash" && exec roslaunch knot_utm tighten.launch "$@"', ROOT]
        with Launch('method:=' + METHOD, command=shell) as launch:
            self.stays_inside(launch)

    def test_node_on_other_address(self):
        # A name of loopback which ROS does not know for one: it listens on every address all the same.
        with Launch('method:=' + METHOD, environment={'ROS_HOSTNAME': 'LOCALHOST'}) as launch:
            launch.end()
            self.assertIn('exit code 2', launch.console())
            self.assertIn('ROS 1 has no authentication: set ROS_HOSTNAME=localhost', launch.console())
            self.assertFalse(os.path.exists(launch.out))

    def test_master_on_every_address(self):
        port = free_port()
        log = tempfile.TemporaryDirectory()
        master = subprocess.Popen(['rosmaster', '--core', '-p', str(port)], env=dict(BARE, ROS_LOG_DIR=log.name),
                                  stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            wait_for('master', lambda: listening(master.pid))
            node = subprocess.run([os.path.join(ROOT, 'build/devel/lib/knot_utm/knot_node')], check=False, timeout=LAST_RESORT,
                                  env=dict(BARE, ROS_MASTER_URI='http://localhost:%d' % port, ROS_LOG_DIR=log.name),
                                  stderr=subprocess.PIPE, universal_newlines=True)
            self.assertEqual(node.returncode, 2)
            self.assertIn("the ROS master can be reached from other machines", node.stderr)
        finally:
            master.kill()
            master.wait()
            log.cleanup()

    def test_opened(self):
        with Launch('method:=' + METHOD, 'network:=true') as launch:
            launch.wait_for_rows(2)
            self.assertEqual(launch.console().count('ROS 1 has no authentication'), 1)


if __name__ == '__main__':
    unittest.main()
