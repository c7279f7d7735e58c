// Started by the recorder: recovers what it wrote where it dies.
#include "knot_utm/ros/keeper.hpp"

#include <csignal>

#include "knot_utm/ros/method_setup.hpp"

namespace {

constexpr char kHelp[] = "Recovers what recorder_node wrote where that dies. Only recorder_node can start it.\n";

}  // namespace

int main(int argc, char** argv) {
  if (const std::optional<int> answered = knot_utm::answer_words(argc, argv, "keeper", kHelp)) return *answered;
  std::signal(SIGXFSZ, SIG_IGN);
  return knot_utm::keep();
}
