"""A goal of the action utm/run_test, as a client sees it."""
import threading
import time

import actionlib
import rospy
from actionlib_msgs.msg import GoalStatus
from knot_utm.msg import RunTestAction, RunTestGoal
from node_test import LAST_RESORT


class Goal:
    """One goal of the action, and what is heard of it."""

    def __init__(self, count=0):
        self.client = actionlib.SimpleActionClient('utm/run_test', RunTestAction)
        self.client.wait_for_server()
        self.feedback = []
        self._heard = threading.Event()
        self.client.send_goal(RunTestGoal(count=count), feedback_cb=self._take)

    def _take(self, feedback):
        self.feedback.append(feedback)
        self._heard.set()

    def wait_for_feedback(self):
        self._heard.clear()
        if not self._heard.wait(LAST_RESORT):
            raise AssertionError('no feedback: ' + self.client.get_goal_status_text())
        return self.feedback[-1]

    def wait(self):
        """State, result and text at the end."""
        end = time.monotonic() + LAST_RESORT
        while not self.client.wait_for_result(rospy.Duration(0.01)):
            if time.monotonic() > end:
                raise AssertionError('the goal goes on')
            time.sleep(0.01)
        return self.client.get_state(), self.client.get_result(), self.client.get_goal_status_text()


def start(count=0):
    """A goal that runs: the physics may not be there yet."""
    end = time.monotonic() + LAST_RESORT
    while True:
        goal = Goal(count)
        while goal.client.get_state() == GoalStatus.PENDING and time.monotonic() < end:
            time.sleep(0.01)
        if goal.client.get_state() == GoalStatus.ACTIVE:
            return goal
        if time.monotonic() > end:
            raise AssertionError(goal.client.get_goal_status_text())
        time.sleep(0.2)
