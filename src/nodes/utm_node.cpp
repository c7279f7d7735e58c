// The machine: runs the test program against the physics of knot_node.
#include "knot_utm/ros/utm_node.hpp"

#include "knot_utm/ros/launched.hpp"
#include "knot_utm/ros/method_setup.hpp"

namespace {

constexpr char kHelp[] = R"(The machine: runs the test program against the physics of knot_node, one command at a time.
It is a part of: roslaunch knot_utm tighten.launch. It reads the test from the parameters test/..., which the launch
file sets (doc/ros.md).

  _real_time_factor:=NUMBER   simulated time over wall-clock time; 1: as on the bench; 0: as fast as possible [1]
  _autostart:=FLAG            starts the test when knot_node is there; false: utm/start_test starts it [true]
  _record:=FLAG               waits for recorder_node [false]
  _exit_at_end:=FLAG          ends when the test has ended, and the launch with it [false]
  _check:=FLAG                checks its parameters, and no more [false]
)";

}  // namespace

int main(int argc, char** argv) {
  std::string verdict;
  const int code = knot_utm::run_node(argc, argv, "utm_node", kHelp, [&] {
    const ros::NodeHandle node = knot_utm::join_ros(argc, argv, "utm_node");
    const knot_utm::SimTimeFound sim_time_found;
    const ros::NodeHandle own("~");
    knot_utm::UtmOptions options;
    knot_utm::read_parameter(own, "verdict", &verdict, "a file");
    options.verdict = verdict;
    knot_utm::read_parameter(own, "real_time_factor", &options.real_time_factor, "a number, 0 or more");
    knot_utm::read_parameter(own, "autostart", &options.autostart, "true or false");
    knot_utm::read_parameter(own, "record", &options.record, "true or false");
    knot_utm::read_parameter(own, "exit_at_end", &options.exit_at_end, "true or false");
    bool check = false;
    knot_utm::read_parameter(own, "check", &check, "true or false");
    if (!(options.real_time_factor >= 0.0)) {
      throw knot_utm::InvalidInput("real_time_factor", std::to_string(options.real_time_factor),
                                   "0 (as fast as possible) or more");
    }
    knot_utm::UtmNode machine(node, knot_utm::read_test_setup(node), options);
    return check ? 0 : machine.spin();
  });
  constexpr int kInvalidInput = 2;
  if (code == kInvalidInput) knot_utm::write_verdict(verdict, code, "");
  return code;
}
