// What a run left that was killed: curves, bag and result, written anew from its method and journal.
#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <optional>
#include <string>

#include "knot_utm/io/command_hint.hpp"
#include "knot_utm/io/recovery.hpp"
#include "knot_utm/io/run_folder.hpp"
#ifdef KNOT_UTM_HAS_ROS
#include "knot_utm/ros/journal_bag.hpp"
#endif
#include "tool.hpp"

namespace knot_utm {
namespace {

constexpr const char* kTool = "recover";

struct Arguments {
  std::string folder;
  std::string out;
};

int run(const Arguments& arguments) {
  if (is_settled(arguments.folder)) {
    std::printf("%s is complete: there is nothing to recover\n", arguments.folder.c_str());
    return kDone;
  }
  if (arguments.out.empty() && was_interrupted(arguments.folder)) {
    std::printf("%s holds all that was measured until it was interrupted; go on with: %s\n", arguments.folder.c_str(),
                command_line({program_beside("tensile_test"), "--resume", arguments.folder}).c_str());
    return kDone;
  }
  Recovery recovery(arguments.folder, arguments.out.empty() ? arguments.folder : arguments.out);
#ifdef KNOT_UTM_HAS_ROS
  recover_with_bag(recovery);
#else
  Record record;
  while (recovery.next(record)) {
  }
  recovery.finish();
#endif
  std::printf("%s\n", recovery.summary().c_str());
  return kDone;
}

/// Reads the command line; an exit code where that is all there is to do.
std::optional<int> read_arguments(int argc, char** argv, Arguments& arguments) {
  CLI::App app("Writes the results of a run that was killed, from its method.yaml and its journal.");
  app.add_option("DIR", arguments.folder, "the run's folder")->required();
  app.add_option("--out", arguments.out, "the folder to write to; unless given, DIR itself");
  return parse(app, kTool, argc, argv);
}

}  // namespace
}  // namespace knot_utm

int main(int argc, char** argv) {
  return knot_utm::run_tool(knot_utm::kTool, [&] {
    knot_utm::Arguments arguments;
    if (const std::optional<int> code = knot_utm::read_arguments(argc, argv, arguments)) return *code;
    std::signal(SIGXFSZ, SIG_IGN);
    return knot_utm::run(arguments);
  });
}
