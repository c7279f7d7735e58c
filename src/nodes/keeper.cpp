// Started by the recorder: recovers what it wrote where it dies.
#include "knot_utm/ros/keeper.hpp"

#include <csignal>

int main() {
  std::signal(SIGXFSZ, SIG_IGN);
  return knot_utm::keep();
}
