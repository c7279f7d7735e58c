// The samples of a test as a bag, or a curve.csv as one with the topics of a simulated test: tensile_test and
// import_instron call it.
#include <cstdio>
#include <filesystem>

#include "knot_utm/method/method.hpp"
#include "knot_utm/ros/curve_bag.hpp"
#include "knot_utm/ros/run_bag.hpp"
#include "tool.hpp"

int main(int argc, char** argv) {
  constexpr const char* kTool = "write_curve_bag";
  if (argc != 3)
    return knot_utm::complain(kTool, "give a curve.csv or the folder of a test, and the bag to be written",
                              knot_utm::kWrongInput);
  return knot_utm::run_tool(kTool, [&] {
    const std::string from = argv[1];
    if (std::filesystem::is_directory(from))
      knot_utm::write_run_bag(argv[2], from, knot_utm::load_method(from + "/method.yaml"));
    else
      knot_utm::write_curve_bag(argv[2], knot_utm::read_curve(from));
    return static_cast<int>(knot_utm::kDone);
  });
}
