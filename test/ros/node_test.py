"""What the tests of the running nodes share."""
import threading
import time

import rospy


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

    def wait(self, what, condition, timeout=20.0):
        """The first message from now on, or the latest, for which condition(message) holds."""
        end = time.monotonic() + timeout
        with self._changed:
            while not (self.messages and condition(self.messages[-1])):
                left = end - time.monotonic()
                if left <= 0.0 or not self._changed.wait(left):
                    raise AssertionError('timed out: %s; last: %s' % (what, self.last))
            return self.messages[-1]


def call(service, kind):
    rospy.wait_for_service(service, timeout=10.0)
    return rospy.ServiceProxy(service, kind)()
