#!/usr/bin/python3
"""While the window of rviz is open the launch goes on after the end of its test; closed, the launch ends."""
import os
import signal
import subprocess
import sys
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), '../../../bench'))

from launched import LAST_RESORT, METHOD, Launch, wait_for

# In the place of rviz a node that needs no display.
LAUNCH = """<launch>
  <arg name="working_directory"/>
  <arg name="out"/>
  <include file="$(find knot_utm)/launch/tighten.launch" pass_all_args="true">
    <arg name="method" value="%s"/>
    <arg name="overrides" value="'program.hold.duration=15'"/>
  </include>
  <node name="rviz" pkg="knot_utm" type="panel_node"/>
</launch>
"""


class WindowTest(unittest.TestCase):

    def test_stays_until_it_is_closed(self):
        def prepare(folder):
            with open(os.path.join(folder, 'mine.launch'), 'w', encoding='utf-8') as file:
                file.write(LAUNCH % METHOD)

        with Launch(prepare=prepare, command=['roslaunch', './mine.launch']) as launch:
            said = 'the launch ends when the window of rviz is closed'
            wait_for('the end of the test', lambda: said in launch.console())
            # Its picture can still be changed, but no other test begins.
            self.assertIn('knot_node', launch.processes())
            said = subprocess.run(['rosservice', 'call', '/utm/start_test', '{}'], env=launch.environment, check=True,
                                  stdout=subprocess.PIPE, universal_newlines=True, timeout=LAST_RESORT).stdout
            self.assertIn('the launch is about to end', said)
            self.assertIsNone(launch.process.poll())
            os.kill(launch.pid('rviz'), signal.SIGINT)
            self.assertEqual(launch.end(), 0)
            for word in ('has died', 'REQUIRED', 'ERROR'):
                self.assertNotIn(word, launch.console())
            self.assertEqual(launch.result('ended_by'), 'program')


if __name__ == '__main__':
    unittest.main()
