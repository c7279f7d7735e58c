// Writes what a test measures.
#include "knot_utm/ros/recorder_node.hpp"

#include "knot_utm/ros/test_setup.hpp"

int main(int argc, char** argv) {
  return knot_utm::run_node("recorder_node", [&] {
    const ros::NodeHandle node = knot_utm::join_ros(argc, argv, "recorder_node");
    return knot_utm::RecorderNode(node, knot_utm::read_test_setup(node)).spin();
  });
}
