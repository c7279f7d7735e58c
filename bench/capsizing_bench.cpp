// A knot that stops a rod in a hole is pulled until it flips.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <exception>
#include <map>
#include <string>
#include <vector>

#include "knot_utm/rod/rod.hpp"
#include "sim/stopper_knot.hpp"

namespace {

using knot_utm::StopperKnot;

void print_curve(const std::vector<StopperKnot::Reading>& readings) {
  constexpr double kSpacing = 0.1;  // of the clamp's way; between two of them the largest force is printed
  std::printf("curve:\n");
  for (std::size_t i = 0; i < readings.size();) {
    std::size_t largest = i;
    const double until = readings[i].way + kSpacing;
    for (; i < readings.size() && readings[i].way < until; ++i)
      if (readings[i].force > readings[largest].force) largest = i;
    const StopperKnot::Reading& one = readings[largest];
    std::printf("- [%.6g, %.6g, %.6g, %.6g]\n", one.way, one.force, one.torque, one.passed);
  }
}

void print_shape(const char* name, const knot_utm::Points& points) {
  std::printf("%s:\n", name);
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    std::printf("- [%.5g, %.5g, %.5g]\n", points(0, i), points(1, i), points(2, i));
}

struct Arguments {
  StopperKnot::Options scene;
  double farthest = 80.0;  // way of the clamp, where it does not flip as often as asked for
  int flips = 1;
};

void run(const Arguments& arguments) {
  constexpr double kBeyond = 10.0;
  const std::clock_t start = std::clock();
  StopperKnot scene(arguments.scene);
  scene.tie();
  std::vector<StopperKnot::Flip> flips;
  std::vector<knot_utm::Points> shapes;  // one after every radius of the way
  while (scene.way < arguments.farthest && static_cast<int>(flips.size()) < arguments.flips) {
    shapes.push_back(scene.stepper->state().position);
    if (const auto flip = scene.pull_until_it_flips(scene.way + 1.0)) flips.push_back(*flip);
  }
  shapes.push_back(scene.stepper->state().position);
  if (!flips.empty()) scene.pull_by(kBeyond);
  const double cpu_time = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  std::printf("cpu_time: %.6g\nnodes: %d\nsteps: %llu\nnewton_iterations: %llu\n", cpu_time, scene.last + 1,
              static_cast<unsigned long long>(scene.control.counters().steps),
              static_cast<unsigned long long>(scene.control.counters().iterations));
  double largest_force = 0.0, largest_twisting = 0.0;
  for (const StopperKnot::Reading& one : scene.readings) {
    largest_force = std::max(largest_force, one.force);
    largest_twisting = std::max(largest_twisting, one.twisting);
  }
  std::printf("largest_force: %.17g\nlargest_twisting: %.17g\n", largest_force, largest_twisting);
  std::printf("end_force: %.17g\nflips:%s\n", scene.readings.back().force, flips.empty() ? " []" : "");
  for (const StopperKnot::Flip& flip : flips) {
    const StopperKnot::Reading &from = scene.readings[flip.before], &to = scene.readings[flip.after];
    std::printf("- {force: %.17g, way: %.17g, passed: %.17g, change_of_shape: %.17g, torque: %.17g}\n", from.force,
                from.way, to.passed - from.passed, flip.change_of_shape, from.torque);
  }
  print_curve(scene.readings);
  if (flips.empty()) return;
  const auto before = static_cast<std::size_t>(scene.readings[flips.back().before].way);
  print_shape("before", shapes[before]);
  print_shape("after", shapes.back());
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Pulls a knot against a hole until it flips. Lengths are in radii h of the rod, forces in k_b/h^2. Prints YAML.");
  Arguments arguments;
  StopperKnot::Options& options = arguments.scene;
  const std::map<std::string, StopperKnot::Kind> kinds = {{"overhand", StopperKnot::Kind::kOverhand},
                                                          {"figure-eight", StopperKnot::Kind::kFigureEight}};
  app.add_option("--knot", options.kind, "overhand or figure-eight")->transform(CLI::CheckedTransformer(kinds));
  app.add_option("--edge", options.edge, "length of an edge")->check(CLI::Range(0.1, 1.5));
  app.add_option("--friction", options.friction, "mu")->check(CLI::NonNegativeNumber);
  app.add_option("--couple", options.couple, "eta")->check(CLI::Range(0.0, 1.0));
  app.add_option("--twisting", options.twisting, "k_t/k_b")->check(CLI::PositiveNumber);
  app.add_option("--stretching", options.stretching, "k_s h^2/k_b")->check(CLI::PositiveNumber);
  app.add_option("--preload", options.preload, "at the tail, before it is let go")->check(CLI::PositiveNumber);
  app.add_option("--speed", options.speed, "radii a second")->check(CLI::PositiveNumber);
  app.add_option("--longest-step", options.longest_step, "[s]")->check(CLI::PositiveNumber);
  app.add_option("--residual", options.residual)->check(CLI::PositiveNumber);
  app.add_option("--presliding", options.presliding)->check(CLI::PositiveNumber);
  app.add_option("--contact-tolerance", options.contact_tolerance)->check(CLI::PositiveNumber);
  app.add_option("--gap", options.gap, "width of the hole")->check(CLI::Range(2.1, 4.0));
  app.add_option("--rim", options.rim, "radius of its edges")->check(CLI::PositiveNumber);
  app.add_option("--below", options.below, "from the clamp to the hole")->check(CLI::Range(5.0, 1000.0));
  app.add_option("--flips", arguments.flips, "after how many it ends")->check(CLI::PositiveNumber);
  app.add_option("--farthest", arguments.farthest, "way of the clamp without a flip")->check(CLI::PositiveNumber);
  try {
    app.parse(argc, argv);
    run(arguments);
    return 0;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "capsizing_bench: %s\n", error.what());
    return 1;
  }
}
