#!/usr/bin/python3
"""A recorded test is seen again without anything of this package but the panel: by `rosbag play`, as doc/ros.md says it."""
import os
import re
import subprocess
import tempfile
import unittest

from knot_utm.panel.drawing import OURS
from launched import METHOD, ROOT, Headless, free_port, wait_for


class BagTest(unittest.TestCase):

    def begin(self, *command):
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.addCleanup(process.wait)
        self.addCleanup(process.terminate)
        return process

    def test_rosbag_play_and_the_panel(self):
        with tempfile.TemporaryDirectory() as log, Headless(METHOD, 'program.hold.duration=5') as run:
            port = free_port()
            os.environ.update(ROS_MASTER_URI='http://localhost:%d' % port, ROS_LOG_DIR=log)
            self.begin('rosmaster', '--core', '-p', str(port))
            # Not before: they take the master's address when they are loaded.
            import client
            import rosbag
            import rosgraph
            import rospy
            from knot_utm.msg import KnotState, TestStatus
            from sensor_msgs.msg import Image
            from tf2_msgs.msg import TFMessage
            from visualization_msgs.msg import MarkerArray
            wait_for('the master', rosgraph.is_master_online)
            rospy.set_param('use_sim_time', True)
            self.begin(os.path.join(ROOT, 'python/knot_utm/panel/panel_node'))
            rospy.init_node('bag_test', disable_signals=True)
            panels = client.Latest('view/panel', Image)
            self.assertFalse(client.shows(panels.wait('the empty panel', lambda _: True), OURS))
            state, status = client.Latest('knot/state', KnotState), client.Latest('utm/status', TestStatus)
            bodies, pictures = (client.Latest('knot/' + topic, MarkerArray) for topic in ('bodies', 'markers'))
            frames = [client.Latest(topic, TFMessage) for topic in ('/tf', '/tf_static')]
            # It stays, for its last messages are lost where it ends before they have left.
            self.begin('rosbag', 'play', '--clock', '--keep-alive', '--rate', '2', '--delay', '3', run.folder + '/test.bag')
            panels.wait('the curve', lambda image: client.shows(image, OURS))
            with rosbag.Bag(run.folder + '/test.bag') as bag:
                recorded = [message.sequence for _, message, _ in bag.read_messages(topics=['/knot/state'])]
            wait_for('the last state', lambda: state.last.sequence == recorded[-1])
            self.assertEqual([message.sequence for message in state.messages], recorded)
            status.wait('the end of the test', lambda message: message.state == TestStatus.ENDED)
            self.assertEqual({marker.ns for marker in pictures.last.markers}, {'', 'rod', 'gauge_marks'})
            self.assertEqual({marker.ns for marker in bodies.last.markers}, {'', 'grips'})
            known = {transform.child_frame_id for topic in frames for transform in topic.last.transforms}
            self.assertLessEqual({marker.header.frame_id for marker in pictures.last.markers + bodies.last.markers}, known)
            with open(os.path.join(ROOT, 'config/bag.rviz'), encoding='utf-8') as file:
                shown = file.read()
            for topic in 'knot/markers', 'knot/bodies', 'view/panel':
                self.assertIn('Topic: ' + topic, shown)
            self.assertIn(re.search('Target Frame: (.*)', shown)[1], known)


if __name__ == '__main__':
    unittest.main()
