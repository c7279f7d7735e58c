#!/usr/bin/python3
"""doc/ros.md, to the letter, in bare shells: a whole test, nodes that stay beside a test in a namespace, and a bag that is played."""
import os
import sys
import unittest

HERE = os.path.dirname(os.path.realpath(__file__))
sys.path[:0] = [os.path.join(HERE, '../../../bench'), HERE]

from launched import ROOT, wait_for
from ten_lines_test import InBareShells, blocks

RUN_ELSEWHERE = {'-p 11312': 'two_launches_test', 'sudo nft': 'by hand, on a machine of its own', 'rviz -d': 'scripts/picture --rviz',
                 'experiment.launch': 'experiment_test'}


class RosPageTest(InBareShells):

    def next_line(self, begin):
        """The next one of the page, which has to begin so."""
        while any(words in self.lines[0] for words in RUN_ELSEWHERE):
            self.lines.pop(0)
        line = self.lines.pop(0)
        self.assertTrue(line.startswith(begin), line)
        return line

    def begun(self, line, said='', node=''):
        """A shell in which this line goes on, once it has said something, or is a node."""
        self.shells += 1
        shell = self.shell('shell_%d' % self.shells)
        shell.begin([self.source, line])
        wait_for(line, lambda: self.master_finds('lookupNode', node) if node else said in shell.said())
        return shell

    def test_lines(self):
        self.shells = 0
        self.lines = [line for block in blocks('ros.md') for line in block]
        os.symlink(os.path.join(ROOT, 'config'), os.path.join(self.folder, 'config'))
        self.source = self.next_line('source ')
        whole = self.begun(self.next_line('roslaunch knot_utm tighten.launch method:='), 'readings were written to')
        whole.run(['true'], 'the launch')
        self.assertTrue(os.path.exists(os.path.join(self.folder, 'out/tighten/test.bag')))
        asks = self.shell('asks')
        asks.begin([self.source])
        second, echo = self.next_line('roslaunch '), self.next_line('rosrun tf tf_echo ')
        stays = self.begun(self.next_line('roslaunch '), node='/recorder_node')
        wait_for('the nodes', lambda: self.master_finds('lookupService', '/utm/start_test'))
        self.assertIn('accepted: True', asks.run([self.next_line('rosservice call ')], 'the call'))
        beside = self.begun(second, node='/second/recorder_node')
        tools = os.path.exists('/usr/share/robot_state_publisher')  # and tf_echo: Debian's packages that the page names
        asked = [self.begun(echo, 'Translation')] if tools else []
        bag = [self.next_line(begin) for begin in ('roscore', 'rosparam set', 'rosrun knot_utm panel_node', 'rosbag play')]
        description = self.next_line('rostopic echo -b ')
        model, fixed = self.next_line('rosrun robot_state_publisher '), self.next_line('rosrun tf static_transform_publisher ')
        if tools:
            asked += [self.begun(model, node='/robot_state_publisher'), self.begun(fixed),
                      self.begun('rosrun tf tf_echo world urdf/upper_grip', 'Translation')]
        self.assertEqual(self.lines, [])
        for shell in asked + [beside, stays]:
            shell.interrupt()
            shell.run(['true'], 'the end')
        self.begun('roscore() { command roscore -p %s; }; %s' % (self.uri.rsplit(':', 1)[1], bag[0]), node='/rosout')
        asks.run([bag[1]], 'the parameter')
        panel = self.begun(bag[2], node='/panel_node')
        said = asks.run([bag[3] + ' --rate 20', description, 'rosparam get /robot_description | grep -c "<link"'], 'the bag')
        self.assertRegex(said, r'\n[1-9]\d*\n')
        panel.interrupt()
        for word in ('failed: ', 'rror', 'knows nothing'):
            self.assertNotIn(word, said)


if __name__ == '__main__':
    unittest.main()
