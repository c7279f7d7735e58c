"""What the tests that talk with running nodes share. To be loaded once ROS_MASTER_URI is that of their launch."""
import threading
import time

import rospy

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

    def wait(self, what, condition):
        """The first message from now on, or the latest, for which condition(message) holds."""
        end = time.monotonic() + LAST_RESORT
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


def call(service, kind, **fields):
    rospy.wait_for_service(service, timeout=LAST_RESORT)
    return rospy.ServiceProxy(service, kind)(**fields)


def shows(image, colour):
    """Whether a picture has this colour, '#rrggbb', anywhere."""
    wanted, pixels = bytes.fromhex(colour[1:]), bytes(image.data)
    return any(pixels[i:i + 3] == wanted for i in range(0, len(pixels), 3))
