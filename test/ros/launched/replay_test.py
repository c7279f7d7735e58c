#!/usr/bin/python3
"""replay.launch plays what was recorded, all of it and without physics, and ends."""
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), '../../../bench'))
sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), '..'))

from launched import LAST_RESORT, ROOT, TOOL, Headless, free_port, wait_for

METHOD = os.path.join(ROOT, 'test/ros/pull_for_seconds.yaml')


class Replay:
    """replay.launch with a master of its own."""

    def __init__(self, *arguments):
        self.port = free_port()
        self.uri = 'http://localhost:%d' % self.port
        self.log = tempfile.mkdtemp(prefix='knot_utm_')
        environment = dict(os.environ, ROS_MASTER_URI=self.uri, ROS_HOME=self.log, ROS_LOG_DIR=self.log, DISPLAY='')
        with open(os.path.join(self.log, 'console'), 'wb') as console:
            self.process = subprocess.Popen(
                ['roslaunch', '-p', str(self.port), 'knot_utm', 'replay.launch'] + list(arguments), env=environment,
                stdout=console, stderr=subprocess.STDOUT)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGINT)
            self.process.wait(LAST_RESORT)
        shutil.rmtree(self.log)

    def console(self):
        with open(os.path.join(self.log, 'console'), encoding='utf-8', errors='replace') as file:
            return file.read()

    def answers(self):
        import xmlrpc.client
        try:
            return xmlrpc.client.ServerProxy(self.uri).lookupNode('/test', '/replay_node')[0] == 1
        except OSError:
            return False


class ReplayTest(unittest.TestCase):

    def test_all_of_it_is_played(self):
        with Headless(METHOD) as run, Replay('bag:=' + run.folder + '/test.bag', 'rate:=4', 'patience:=600') as replay:
            wait_for('the node', replay.answers)
            os.environ['ROS_MASTER_URI'] = replay.uri
            # Not before: they take the master's address when they are loaded.
            import rosbag
            import rospy
            import yaml
            from knot_utm.msg import Crosshead, KnotShape, KnotState, TestStatus
            from node_test import Latest
            from rosgraph_msgs.msg import Clock
            from sensor_msgs.msg import Image
            from visualization_msgs.msg import MarkerArray
            rospy.init_node('replay_test', disable_signals=True)
            heard = {'/knot/state': Latest('knot/state', KnotState), '/knot/shape': Latest('knot/shape', KnotShape),
                     '/utm/crosshead': Latest('utm/crosshead', Crosshead)}
            clock = Latest('/clock', Clock)
            status = Latest('utm/status', TestStatus)
            panel = subprocess.Popen([os.path.join(ROOT, 'python/knot_utm/panel/panel_node')],
                                     env=dict(os.environ, ROS_LOG_DIR=replay.log))
            self.addCleanup(panel.wait, LAST_RESORT)
            self.addCleanup(panel.terminate)
            panels = Latest('view/panel', Image)
            empty = panels.wait('the panel before anything is played', lambda _: True)
            for latest in [*heard.values(), clock, status]:
                wait_for('a connection', lambda one=latest: one.connected())
            pictures = Latest('knot/markers', MarkerArray)  # the last one: it begins when somebody looks
            self.assertEqual(replay.process.wait(LAST_RESORT), 0, replay.console())

            with open(run.folder + '/result.yaml', encoding='utf-8') as text:
                ended_by = yaml.safe_load(text)['ended_by']
            self.assertEqual((status.last.state, status.last.ended_by), (TestStatus.ENDED, ended_by))
            self.assertEqual({message.state for message in status.messages[:-1]}, {TestStatus.RUNNING})

            shown = panels.wait('the panel', lambda image: image.data != empty.data)
            self.assertEqual((shown.encoding, len(shown.data)), ('rgb8', 3 * shown.width * shown.height))

            with rosbag.Bag(run.folder + '/test.bag') as bag:
                for topic, latest in heard.items():
                    recorded = [message for _, message, _ in bag.read_messages(topics=[topic])]
                    sequences = [message.sequence for message in latest.messages]
                    self.assertEqual(sequences, [message.sequence for message in recorded], topic)
                    latest.last.header.seq = recorded[-1].header.seq  # counted anew by whoever publishes
                    self.assertEqual(str(latest.last), str(recorded[-1]))  # NaN is no number, but a text
                end = bag.get_end_time()
            stamps = [message.clock.to_sec() for message in clock.messages]
            self.assertEqual(stamps, sorted(stamps))
            self.assertEqual(stamps[-1], end)
            shape = heard['/knot/shape'].last
            markers = {marker.ns: marker for marker in pictures.last.markers}
            for axis in 'xyz':
                rod = [getattr(point, axis) for point in markers['rod'].points]
                nodes = [getattr(point, axis) for point in shape.points]
                self.assertAlmostEqual(min(rod), min(nodes), delta=1.001 * shape.radius)
                self.assertAlmostEqual(max(rod), max(nodes), delta=1.001 * shape.radius)
            self.assertGreater(len(pictures.messages), 10)

    def refused(self, *words):
        with Replay(*words) as replay:
            replay.process.wait(LAST_RESORT)
            self.assertIn('exit code 2', replay.console())
            return replay.console()

    def test_bad_input_is_refused_in_one_line(self):
        with tempfile.TemporaryDirectory() as folder:
            self.assertIn('replay_node: cannot read ' + folder + '/none.bag: no such file', self.refused('bag:=none.bag', 'working_directory:=' + folder))
            # A measured curve has no shapes.
            raw = os.path.join(folder, 'raw.csv')
            with open(raw, 'w', encoding='utf-8') as file:
                file.write('Time,Extension,Load\n(s),(mm),(N)\n' + ''.join('%d,%d,%d\n' % (i, i, i) for i in range(9)))
            subprocess.run([os.path.join(os.path.dirname(TOOL), 'import_instron'), raw, folder + '/x.bag'], check=True)
            self.assertIn('topic knot/shape', self.refused('bag:=' + folder + '/x.bag',
                                                           'method:=' + ROOT + '/config/straight.yaml'))


if __name__ == '__main__':
    unittest.main()
