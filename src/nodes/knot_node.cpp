// The physics: answers the commands of utm_node.
#include "knot_utm/ros/knot_node.hpp"

#include "knot_utm/ros/method_setup.hpp"
#include "knot_utm/ros/process.hpp"

namespace {

constexpr char kHelp[] = R"(The physics: answers each command of utm_node with forces and shape.
It is a part of: roslaunch knot_utm tighten.launch. It reads the test from the parameters test/..., which the launch
file sets (doc/ros.md).

  _marker_rate:=NUMBER        most pictures per second for rviz [25]
  _color_by:=WORD             what the colours of the rod show, tension or curvature [tension]
  _contact_forces:=FLAG       shows them in the picture [true]
)";

}  // namespace

int main(int argc, char** argv) {
  return knot_utm::run_node(argc, argv, "knot_node", kHelp, [&] {
    const ros::NodeHandle node = knot_utm::join_ros(argc, argv, "knot_node");
    const knot_utm::KnotNode knot(node, knot_utm::read_test_setup(node).method);
    ros::spin();
    return 0;
  });
}
