// Ends the launch when its test is over.
#include "knot_utm/ros/watch_node.hpp"

#include "knot_utm/ros/method_setup.hpp"
#include "knot_utm/ros/sim_time_found.hpp"

namespace {

constexpr char kHelp[] = R"(Ends the launch when its test is over. Only a launch file can start it.

  _verdict:=FILE              a file for the exit code of the test and the folder of its files [none]
)";

}  // namespace

int main(int argc, char** argv) {
  return knot_utm::run_node(argc, argv, "watch_node", kHelp, [&] {
    const ros::NodeHandle node = knot_utm::join_ros(argc, argv, "watch_node");
    const knot_utm::SimTimeFound sim_time_found;
    std::string verdict;
    knot_utm::read_parameter(ros::NodeHandle("~"), "verdict", &verdict, "a file");
    return knot_utm::WatchNode(node, verdict).spin();
  });
}
