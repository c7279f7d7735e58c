"""What the tests of the running nodes share."""
import threading
import time
import xmlrpc.client

import rospy
from knot_utm.srv import StartTest

LAST_RESORT = 180.0  # [s] on a machine however busy: a test waits for what is to happen, not for time


class Latest:
    """The messages of one topic."""

    def __init__(self, topic, kind, queue_size=1000):
        self._changed = threading.Condition()
        self.messages = []
        self._subscriber = rospy.Subscriber(topic, kind, self._take, queue_size=queue_size)

    def _take(self, message):
        with self._changed:
            self.messages.append(message)
            self._changed.notify_all()

    @property
    def last(self):
        return self.messages[-1] if self.messages else None

    def connected(self):
        return self._subscriber.get_num_connections() > 0

    def wait(self, what, condition, timeout=LAST_RESORT):
        """The first message from now on, or the latest, for which condition(message) holds."""
        end = time.monotonic() + timeout
        with self._changed:
            while not (self.messages and condition(self.messages[-1])):
                left = end - time.monotonic()
                if left <= 0.0 or not self._changed.wait(left):
                    raise AssertionError('timed out: %s; last: %s' % (what, self.last))
            return self.messages[-1]

    def wait_for_more(self, number):
        """The latest message, once so many more have come."""
        known = len(self.messages)
        return self.wait('%d more messages' % number, lambda _: len(self.messages) >= known + number)


def wait_for_connection(publisher, topic, subscriber):
    """Until what one node publishes reaches another: what it publishes before is lost to that one."""
    topic, subscriber = rospy.resolve_name(topic), rospy.resolve_name(subscriber)
    end = time.monotonic() + LAST_RESORT
    while time.monotonic() < end:
        _, _, uri = rospy.get_master().lookupNode(rospy.resolve_name(publisher))
        if uri:
            _, _, connections = xmlrpc.client.ServerProxy(uri).getBusInfo(rospy.get_name())
            if any(one[4] == topic and one[1] == subscriber and one[2] == 'o' for one in connections):
                return
        time.sleep(0.05)
    raise AssertionError('%s does not reach %s' % (topic, subscriber))


def start_test(**fields):
    """By the service, which refuses as long as the physics is not there. Returns its answer."""
    end = time.monotonic() + LAST_RESORT
    while True:
        answer = call('utm/start_test', StartTest, **fields)
        if answer.accepted:
            return answer
        if time.monotonic() > end:
            raise AssertionError('the test does not start: ' + answer.message)
        time.sleep(0.05)


def call(service, kind, **fields):
    rospy.wait_for_service(service, timeout=LAST_RESORT)
    return rospy.ServiceProxy(service, kind)(**fields)
