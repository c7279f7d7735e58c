// The machine: runs the test program against the physics of knot_node.
#include "knot_utm/ros/utm_node.hpp"

#include "knot_utm/ros/test_setup.hpp"

int main(int argc, char** argv) {
  ros::init(argc, argv, "utm_node");
  return knot_utm::run_node("utm_node", [] {
    const ros::NodeHandle node;
    const ros::NodeHandle own("~");
    knot_utm::UtmOptions options;
    own.getParam("real_time_factor", options.real_time_factor);
    own.getParam("autostart", options.autostart);
    own.getParam("record", options.record);
    own.getParam("exit_at_end", options.exit_at_end);
    if (!(options.real_time_factor >= 0.0)) {
      throw knot_utm::InvalidInput("real_time_factor", std::to_string(options.real_time_factor), "0 or more");
    }
    return knot_utm::UtmNode(node, knot_utm::read_test_setup(node).method, options).spin();
  });
}
