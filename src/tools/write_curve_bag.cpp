// A curve.csv as a bag with the topics of a simulated test: import_instron calls it.
#include <cstdio>

#include "knot_utm/ros/curve_bag.hpp"
#include "tool.hpp"

int main(int argc, char** argv) {
  constexpr const char* kTool = "write_curve_bag";
  if (argc != 3) return knot_utm::complain(kTool, "give a curve.csv and the bag to be written", knot_utm::kWrongInput);
  return knot_utm::run_tool(kTool, [&] {
    knot_utm::write_curve_bag(argv[2], knot_utm::read_curve(argv[1]));
    return static_cast<int>(knot_utm::kDone);
  });
}
