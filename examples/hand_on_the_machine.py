#!/usr/bin/python3
"""A hand on the machine: pulls a knot until it bears 100 N, and unloads it. Beside it runs
roslaunch knot_utm tighten.launch autostart:=false exit_at_end:=false

Run:    /usr/bin/python3 examples/hand_on_the_machine.py
Test:   test/ros/launched/hand_test.py
"""
import time

import rospy
from actionlib import SimpleActionClient
from knot_utm.msg import MoveAction, MoveGoal
from knot_utm.srv import StartTest
from std_srvs.srv import Trigger

rospy.init_node("hand")
machine = SimpleActionClient("utm/move", MoveAction)
machine.wait_for_server()  # before the test is started: it pulls as its method says until the first goal comes
rospy.wait_for_service("utm/start_test")
start_test = rospy.ServiceProxy("utm/start_test", StartTest)
while not (answer := start_test()).accepted:  # it may not be ready yet
    print(answer.message)
    time.sleep(1.0)
for goal in MoveGoal(load=100.0, speed=0.003), MoveGoal(load=5.0):  # out, and back
    machine.send_goal_and_wait(goal)
    there = machine.get_result()
    print(f"{there.load:.1f} N at {1000 * there.extension:.1f} mm: {machine.get_goal_status_text()}")
rospy.ServiceProxy("utm/stop_test", Trigger)()
