#!/usr/bin/python3
"""Without being asked to, no process of the system listens to other machines."""
import os
import re
import subprocess
import unittest

from launched import METHOD, ROOT, Launch


def listening(pid):
    """Addresses on which a process listens: 0.0.0.0%lo is every address, but of the loopback device only."""
    said = subprocess.run(['ss', '-ltnpH'], check=True, stdout=subprocess.PIPE, universal_newlines=True).stdout
    return [line.split()[3].rsplit(':', 1)[0] for line in said.splitlines() if re.search(r'\bpid=%d,' % pid, line)]


class LoopbackTest(unittest.TestCase):

    def test_setup_and_roslaunch_in_a_folder_with_a_blank(self):
        def prepare(folder):
            os.symlink(ROOT, os.path.join(folder, 'a copy'))

        shell = ['env', '-u', 'ROS_HOSTNAME', '-u', 'ROS_IP', 'bash', '-c',
                 '. "a copy/build/devel/setup.bash" && exec roslaunch knot_utm tighten.launch "$@"', 'bash']
        with Launch('method:=' + METHOD, command=shell, prepare=prepare) as launch:
            launch.wait_for_rows(2)
            processes = launch.processes()
            for node in 'master', 'utm_node', 'knot_node', 'recorder_node':
                pid = next(pid for name, pid in processes.items() if name.startswith(node))
                addresses = listening(pid)
                self.assertGreaterEqual(len(addresses), 1, node)
                self.assertLessEqual(set(addresses), {'127.0.0.1', '127.0.0.1%lo', '0.0.0.0%lo'}, node)
            self.assertEqual(set(listening(launch.roslaunch())), {'127.0.0.1'})

    def test_opened(self):
        with Launch('method:=' + METHOD, 'network:=true') as launch:
            launch.wait_for_rows(2)
            self.assertEqual(launch.console().count('ROS 1 has no authentication'), 1)
            self.assertIn('0.0.0.0', listening(launch.pid('knot_node')))


if __name__ == '__main__':
    unittest.main()
