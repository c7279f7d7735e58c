// The physics: answers the commands of utm_node.
#include "knot_utm/ros/knot_node.hpp"

#include "knot_utm/ros/method_setup.hpp"

int main(int argc, char** argv) {
  return knot_utm::run_node(argc, argv, "knot_node", [&] {
    const ros::NodeHandle node = knot_utm::join_ros(argc, argv, "knot_node");
    const knot_utm::KnotNode knot(node, knot_utm::read_test_setup(node).method);
    ros::spin();
    return 0;
  });
}
