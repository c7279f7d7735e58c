// The machine as a process: its parameters, and what launch/check asks of it.
#include <cstdio>
#include <map>

#include "knot_utm/ros/method_setup.hpp"
#include "knot_utm/ros/names.hpp"
#include "knot_utm/ros/nodes.hpp"
#include "knot_utm/ros/process.hpp"
#include "knot_utm/ros/utm_node.hpp"
#include "knot_utm/words/number.hpp"

namespace knot_utm {
namespace {

constexpr char kUtmNodeHelp[] =
    R"(The machine: runs the test program against the physics of knot_node, one command at a time.
It is a part of: roslaunch knot_utm tighten.launch. It reads the test from the parameters test/..., which the launch
file sets (doc/ros.md).

  _real_time_factor:=NUMBER   simulated time over wall-clock time; 1: as on the bench; 0: as fast as possible [1]
  _autostart:=FLAG            starts the test when knot_node is there; false: utm/start_test starts it [true]
  _record:=FLAG               waits for recorder_node [false]
  _exit_at_end:=FLAG          ends when the test has ended, and the launch with it [false]
)";

constexpr int kInvalidInput = 2;

void require_pace(double factor, const std::string& text) {
  if (!(factor >= 0.0))  // not-a-number is none either
    throw InvalidInput("real_time_factor", text, "0 (as fast as possible) or more");
}

/// For launch/check, before there is a master: utm_node --check NAME:=VALUE..., with arguments of the launch file.
int check(int argc, char** argv) {
  std::map<std::string, std::string> given;
  for (int i = 2; i < argc; ++i) {
    const std::string word = argv[i];
    const std::size_t end = word.find(":=");
    if (end != std::string::npos) given[word.substr(0, end)] = word.substr(end + 2);
  }
  try {
    const std::string factor = given["real_time_factor"];
    require_pace(parse_number(factor).value_or(-1.0), factor);
    set_up(read_words([&](const std::string& name) { return given[name]; }));
  } catch (const InvalidInput& invalid) {
    std::fprintf(stderr, "utm_node: %s\n", invalid.what());
    return kInvalidInput;
  }
  return 0;
}

}  // namespace

int run_utm_node(int argc, char** argv) {
  if (argc > 1 && argv[1] == std::string("--check")) return check(argc, argv);
  std::string verdict, sim_time_found;
  const int code = run_node(argc, argv, names::kUtmNode, kUtmNodeHelp, [&] {
    const ros::NodeHandle node = join_ros(argc, argv, names::kUtmNode);
    read_parameter(node, names::kSimTimeFound, &sim_time_found, "a text");
    const ros::NodeHandle own("~");
    UtmOptions options;
    read_parameter(own, "verdict", &verdict, "a file");
    options.verdict = verdict;
    read_parameter(own, "real_time_factor", &options.real_time_factor, "a number, 0 or more");
    read_parameter(own, "autostart", &options.autostart, "true or false");
    read_parameter(own, "record", &options.record, "true or false");
    read_parameter(own, "exit_at_end", &options.exit_at_end, "true or false");
    require_pace(options.real_time_factor, std::to_string(options.real_time_factor));
    return UtmNode(node, read_test_setup(node), options).spin();
  });
  put_back_sim_time(sim_time_found);
  if (code == kInvalidInput) write_verdict(verdict, code, "");
  return code;
}

}  // namespace knot_utm
