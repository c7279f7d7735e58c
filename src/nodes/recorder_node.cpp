// Writes what a test measures.
#include "knot_utm/ros/recorder_node.hpp"

#include <csignal>

#include "knot_utm/ros/process.hpp"

namespace {

constexpr char kHelp[] = R"(Writes what a test measures: curve, result and bag.
It is a part of: roslaunch knot_utm tighten.launch. What is tested, and where it goes, utm_node says (doc/ros.md).
)";

}  // namespace

int main(int argc, char** argv) {
  // A file as large as is allowed is an error like a full disk, which says what was being written.
  std::signal(SIGXFSZ, SIG_IGN);
  return knot_utm::run_node(argc, argv, "recorder_node", kHelp, [&] {
    const ros::NodeHandle node = knot_utm::join_ros(argc, argv, "recorder_node");
    return knot_utm::RecorderNode(node).spin();
  });
}
