#!/usr/bin/python3
"""While a test runs, others publish nonsense on its topics, set the clock, and subscribe without ever reading. The
files are those of the headless tool, and no node hoards what is not read."""
import copy
import math
import os
import socket
import struct
import sys
import unittest
import xmlrpc.client

sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), '../../../bench'))
sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), '..'))

from launched import LAST_RESORT, ROOT, Headless, Launch, memory, wait_for

METHOD = os.path.join(ROOT, 'test/ros/many_samples.yaml')
# Of its own test utm_node keeps 8000 readings of some 400 bytes, most of them taken between the two looks, and reads the
# results from them in the end: 5.1 MB. Queues of 1000 messages for each of the deaf, which may still fill, hold some 3 MB
# in knot_node. What is published between the looks is some 8 MB more.
HOARD = 6e6  # [bytes]


class Bomb:
    """Bytes that no message has: every length in them is four thousand million."""

    def serialize(self, buffer):
        buffer.write(b'\xff' * 4096)


def bomb_of(kind):
    return type('Bomb', (Bomb, kind), {})()


def subscribe(uri, topic, read=0):
    """A connection to a publisher of the topic that reads so many bytes of it and then never again."""
    master = xmlrpc.client.ServerProxy(uri)
    publisher = next(p for t, nodes in master.getSystemState('/deaf')[2][0] if t == topic for p in nodes)
    node = xmlrpc.client.ServerProxy(master.lookupNode('/deaf', publisher)[2])
    _, host, port = node.requestTopic('/deaf', topic, [['TCPROS']])[2]
    connection = socket.create_connection((host, port))
    connection.settimeout(LAST_RESORT)  # rospy has set a shorter one, which a busy machine may exceed
    fields = ['callerid=/deaf', 'topic=' + topic, 'md5sum=*', 'type=*']
    header = b''.join(struct.pack('<I', len(field)) + field.encode() for field in fields)
    connection.sendall(struct.pack('<I', len(header)) + header)
    while read > 0:
        read -= len(connection.recv(min(read, 65536)))
    return connection


class Stranger:
    """Publishes what could do harm, in the shape of what was last published rightfully."""

    def __init__(self, uri):
        os.environ['ROS_MASTER_URI'] = uri
        # Not before: they take the master's address when they are loaded.
        import rospy
        from knot_utm.msg import Crosshead, KnotRecord, KnotState, RecorderStatus, SpecimenInfo, TestStatus
        from rosgraph_msgs.msg import Clock
        rospy.init_node('stranger', disable_signals=True)
        self.latest = {}
        self.publishers = {}
        topics = {'utm/crosshead': Crosshead, 'knot/state': KnotState, 'knot/record': KnotRecord,
                  'knot/specimen': SpecimenInfo, 'utm/status': TestStatus, 'recorder/status': RecorderStatus,
                  '/clock': Clock}
        for topic, kind in topics.items():
            rospy.Subscriber(topic, kind, self.take, callback_args=topic, queue_size=1)
            self.publishers[topic] = rospy.Publisher(topic, kind, queue_size=10)
        self.kinds = topics
        self.spin = rospy

    def wait_until_heard(self):
        """By the nodes that run: knot_node and the recorder, and by itself."""
        for topic, listeners in (('utm/crosshead', 2), ('utm/status', 3), ('knot/record', 2)):
            wait_for(topic, lambda: self.publishers[topic].get_num_connections() >= listeners)

    def take(self, message, topic):
        if message._connection_header['callerid'] != '/stranger':
            self.latest[topic] = message

    def say(self, topic, **changes):
        latest = self.latest.get(topic)
        if latest is None:
            return
        message = copy.deepcopy(latest)
        for field, value in changes.items():
            setattr(message, field, value)
        self.publishers[topic].publish(message)

    def talk(self):
        command = self.latest.get('utm/crosshead')
        state = self.latest.get('knot/state')
        if command is None or state is None:
            return
        self.say('utm/crosshead', sequence=command.sequence + 1, displacement=0.5)
        self.say('utm/crosshead', run=command.run + 7, sequence=0, time=0.0)
        self.say('utm/crosshead', sequence=command.sequence + 1, time=math.nan, velocity=math.inf)
        self.say('utm/crosshead', phase='p' * 1000000, step=-7)
        self.say('knot/state', sequence=command.sequence, load=math.nan)
        self.say('knot/state', sequence=command.sequence, status=4, message='no\nended_by: break')
        self.say('knot/record', steps=[state] * 1000, answer=state)
        self.say('knot/specimen', longest_step=math.nan)
        self.say('utm/status', state=3, ended_by='break', reason='forged\nended_by: break')
        self.say('recorder/status', complete=True, next_sequence=2 ** 60, error='full\ndisk')
        for topic, kind in self.kinds.items():
            if topic != '/clock':
                self.publishers[topic].publish(bomb_of(kind))
        clock = self.kinds['/clock']
        for seconds in (1000000, 0, 3):
            self.publishers['/clock'].publish(clock(clock=self.spin.Time(seconds)))

    def talk_until(self, what, condition):
        def talked():
            self.talk()
            return condition()

        wait_for(what, talked)

    def hurry(self):
        """The test goes on as fast as it goes."""
        from dynamic_reconfigure.client import Client
        Client('utm_node', timeout=LAST_RESORT).update_configuration({'real_time_factor': 0.0})


class StrangersTest(unittest.TestCase):

    def test_same_files_as_headless(self):
        # At its own pace until all have been heard, and it stays when the test has ended, to be looked at.
        with Launch('method:=' + METHOD, 'real_time_factor:=0.2', 'autostart:=false', 'exit_at_end:=false') as launch:
            pids = {node: launch.pid(node) for node in ('utm_node', 'knot_node', 'recorder_node')}
            wait_for('the nodes', lambda: all(launch.answers(node) for node in pids))
            stranger = Stranger(launch.uri)
            stranger.wait_until_heard()
            from node_test import start_test
            start_test()
            launch.wait_for_rows(100)
            deaf = [subscribe(launch.uri, topic, read)
                    for topic in ('/knot/state', '/knot/record', '/utm/crosshead') for read in (0, 100000)]
            deaf.append(subscribe(launch.uri, '/knot/markers'))
            ignored = ['a message on ' + topic + ' from /stranger was ignored: only /' for topic in
                       ('utm/crosshead', 'knot/state', 'knot/record', 'utm/status', 'recorder/status')]
            stranger.talk_until('all is ignored', lambda: all(line in launch.console() for line in ignored))
            stranger.talk_until('2000 rows', lambda: launch.rows() > 2000)
            before = {node: memory(pid) for node, pid in pids.items()}
            self.assertFalse(os.path.exists(os.path.join(launch.out, 'result.yaml')), 'the test goes on')
            stranger.hurry()
            stranger.talk_until('the end', lambda: os.path.exists(os.path.join(launch.out, 'result.yaml')))
            for node in ('utm_node', 'knot_node'):
                self.assertLess(memory(pids[node]) - before[node], HOARD, node)
            for connection in deaf:
                connection.close()
            console = launch.console()
            self.assertEqual(launch.result('ended_by'), 'program', console)
            self.assertNotIn('Exception', console)
            with Headless(METHOD) as headless:
                self.assertEqual(headless.different(launch.out), ([], []))


if __name__ == '__main__':
    unittest.main()
