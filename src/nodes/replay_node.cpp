// Plays a recorded test, without physics.
#include "knot_utm/ros/replay_node.hpp"

#include <filesystem>

#include "knot_utm/io/run_folder.hpp"
#include "knot_utm/record/ended_by.hpp"
#include "knot_utm/ros/method_setup.hpp"
#include "knot_utm/ros/names.hpp"

int main(int argc, char** argv) {
  namespace fs = std::filesystem;
  return knot_utm::run_node(argc, argv, knot_utm::names::kReplayNode, [&] {
    const ros::NodeHandle node = knot_utm::join_ros(argc, argv, knot_utm::names::kReplayNode);
    const ros::NodeHandle own("~");
    std::string bag, method, base;
    knot_utm::ReplayOptions options;
    knot_utm::read_parameter(own, "bag", &bag, "a file");
    knot_utm::read_parameter(own, "method", &method, "a file");
    knot_utm::read_parameter(own, "working_directory", &base, "a folder");
    knot_utm::read_parameter(own, "rate", &options.rate, "a number, 0 or more");
    knot_utm::read_parameter(own, "patience", &options.patience, "a number of seconds, 0 or more");
    knot_utm::read_parameter(own, "exit_at_end", &options.exit_at_end, "true or false");
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
    return knot_utm::ReplayNode(node, knot_utm::load_method(beside.string()), options).spin();
  });
}
