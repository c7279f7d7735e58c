// Ends the launch when its test is over.
#include "knot_utm/ros/watch_node.hpp"

#include "knot_utm/ros/method_setup.hpp"

int main(int argc, char** argv) {
  return knot_utm::run_node(argc, argv, "watch_node", [&] {
    const ros::NodeHandle node = knot_utm::join_ros(argc, argv, "watch_node");
    std::string verdict;
    knot_utm::read_parameter(ros::NodeHandle("~"), "verdict", &verdict, "a file");
    return knot_utm::WatchNode(node, verdict).spin();
  });
}
