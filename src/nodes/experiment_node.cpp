// Tells an experiment's record beside the test that follows it.
#include "knot_utm/ros/experiment_node.hpp"

#include "knot_utm/ros/method_setup.hpp"
#include "knot_utm/ros/names.hpp"

namespace {

constexpr char kHelp[] = R"(Publishes an experiment's record beside the test that follows it.
It is a part of: roslaunch knot_utm experiment.launch data:=FILE (doc/ros.md).

  _autostart:=FLAG            starts the test [false]
  _balance:=auto|true|false   whether the record gets a zero; auto: raw data do [auto]
  _check:=FLAG                checks its parameters, and no more [false]
)";

}  // namespace

int main(int argc, char** argv) {
  return knot_utm::run_node(argc, argv, knot_utm::names::kExperimentNode, kHelp, [&] {
    const ros::NodeHandle node = knot_utm::join_ros(argc, argv, knot_utm::names::kExperimentNode);
    knot_utm::MethodSetup setup = knot_utm::read_test_setup(node);
    if (setup.data.empty()) throw knot_utm::InvalidInput::missing("data", "the record of an experiment, data:=FILE");
    const ros::NodeHandle own("~");
    bool autostart = false, check = false;
    knot_utm::read_parameter(own, "autostart", &autostart, "true or false");
    knot_utm::read_parameter(own, "check", &check, "true or false");
    std::string balance = "auto";
    knot_utm::read_parameter(own, "balance", &balance, "auto, true or false");
    const auto tell = [](const std::string& line) { ROS_INFO("%s", line.c_str()); };
    for (const std::string& line : setup.told) tell(line);
    knot_utm::ExperimentNode experiment(node, std::move(setup.record), knot_utm::record_balance_named(balance),
                                        [&](const std::string& line) { tell(setup.data + ": " + line); });
    if (!check) experiment.spin(autostart);
    return 0;
  });
}
