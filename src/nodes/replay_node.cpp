// Plays a recorded test, without physics.
#include "knot_utm/ros/replay_node.hpp"

#include <filesystem>

#include "knot_utm/record/ended_by.hpp"
#include "knot_utm/ros/launched.hpp"
#include "knot_utm/ros/method_setup.hpp"
#include "knot_utm/ros/names.hpp"
#include "knot_utm/run/run_folder.hpp"

namespace {

constexpr char kHelp[] = R"(Plays a recorded test without physics.
It is a part of: roslaunch knot_utm replay.launch bag:=FILE (doc/ros.md).

  _bag:=FILE                  the test.bag of a run
  _method:=FILE               what was tested [method.yaml beside the bag]
  _rate:=NUMBER               time of the test over wall-clock time; 0: as fast as possible [1]
  _patience:=NUMBER           how long it waits for somebody to look [s] [5]
  _exit_at_end:=FLAG          ends when the bag has ended [false]
  _working_directory:=FOLDER  where relative paths begin [the present folder]
  _check:=FLAG                checks its parameters, and no more [false]
  _marker_rate, _color_by     as of knot_node
)";

}  // namespace

int main(int argc, char** argv) {
  namespace fs = std::filesystem;
  return knot_utm::run_node(argc, argv, knot_utm::names::kReplayNode, kHelp, [&] {
    const ros::NodeHandle node = knot_utm::join_ros(argc, argv, knot_utm::names::kReplayNode);
    const knot_utm::SimTimeFound sim_time_found;
    const ros::NodeHandle own("~");
    std::string bag, method, base;
    bool check = false;
    knot_utm::ReplayOptions options;
    knot_utm::read_parameter(own, "bag", &bag, "a file");
    knot_utm::read_parameter(own, "method", &method, "a file");
    knot_utm::read_parameter(own, "working_directory", &base, "a folder");
    knot_utm::read_parameter(own, "rate", &options.rate, "a number, 0 or more");
    knot_utm::read_parameter(own, "patience", &options.patience, "a number of seconds, 0 or more");
    knot_utm::read_parameter(own, "exit_at_end", &options.exit_at_end, "true or false");
    knot_utm::read_parameter(own, "check", &check, "true or false");
    if (bag.empty()) throw knot_utm::InvalidInput::missing("bag", "the bag of a test, bag:=out/tighten/test.bag");
    if (!(options.rate >= 0.0))
      throw knot_utm::InvalidInput("rate", std::to_string(options.rate), "0 (as fast as possible) or more");
    const fs::path file = (fs::path(base) / bag).lexically_normal();
    // As every run has it beside its bag.
    const fs::path beside = method.empty() ? file.parent_path() / "method.yaml" : fs::path(base) / method;
    options.bag = file.string();
    options.ended_by = knot_utm::result_of(file.parent_path().string(), "ended_by").value_or("");
    if (options.ended_by == knot_utm::ended_by_name(knot_utm::EndedBy::kNotYet)) options.ended_by.clear();
    if (!fs::exists(file)) throw knot_utm::InvalidInput::cannot_read(options.bag);
    knot_utm::ReplayNode replay(node, knot_utm::load_method(beside.string()), options);
    return check ? 0 : replay.spin();
  });
}
