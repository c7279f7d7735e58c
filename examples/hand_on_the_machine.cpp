// A hand on the machine, as hand_on_the_machine.py, in C++: pulls a knot until it bears 100 N, and unloads it.
//
// Run: g++ examples/hand_on_the_machine.cpp -Ibuild/devel/include -o hand `pkg-config --cflags --libs roscpp actionlib`
// Test: test/ros/launched/hand_test.py
#include <actionlib/client/simple_action_client.h>
#include <knot_utm/MoveAction.h>
#include <knot_utm/StartTest.h>
#include <std_srvs/Trigger.h>

int main(int argc, char** argv) {
  ros::init(argc, argv, "hand");
  ros::NodeHandle node;
  actionlib::SimpleActionClient<knot_utm::MoveAction> machine("utm/move", true);
  machine.waitForServer();  // before the test is started: it pulls as its method says until the first goal comes
  ros::service::waitForService("utm/start_test");
  knot_utm::StartTest start;
  while (ros::service::call("utm/start_test", start) && !start.response.accepted) {  // it may not be ready yet
    ROS_INFO("%s", start.response.message.c_str());
    ros::WallDuration(1.0).sleep();
  }
  for (const double load : {100.0, 5.0}) {  // out, and back
    knot_utm::MoveGoal goal;
    goal.load = load;
    machine.sendGoalAndWait(goal);
    ROS_INFO("%.1f N: %s", machine.getResult()->load, machine.getState().getText().c_str());
  }
  std_srvs::Trigger stop;
  return ros::service::call("utm/stop_test", stop) ? 0 : 1;
}
