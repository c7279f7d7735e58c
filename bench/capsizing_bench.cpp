// A knot that stops a rod in a hole is pulled against it, until it capsizes.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <map>
#include <string>

#include "sim/stopper_knot.hpp"

namespace {
using knot_utm::StopperKnot;

void print_shape(const StopperKnot& scene, const char* name) {
  const knot_utm::Points& x = scene.stepper->state().position;
  for (Eigen::Index i = 0; i < x.cols(); ++i)
    std::printf("shape,%s,%.5g,%.5g,%.5g\n", name, x(0, i), x(1, i), x(2, i));
}

void run(const StopperKnot::Options& options, double way) {
  StopperKnot scene(options);
  print_shape(scene, "drawn");
  double next = 0.0;
  auto watch = [&](StopperKnot& self) {
    if (self.time >= next) {
      next = self.time + 0.5;
      const StopperKnot::Reading r = self.read();
      std::printf("row,%.4g,%.4g,%.5g,%.4g,%.4g,%.4g,%.4g,%.4g,%.4g,%.4g,%d\n", self.time, r.way, r.force, r.torque, r.drawn,
                  r.writhe, r.crossings, r.height, r.bending, r.twisting, (int)self.control.counters().iterations);
      std::fflush(stdout);
    }
    return true;
  };
  try {
    scene.tie(watch);
    print_shape(scene, "tied");
    for (int k = 1; k * 1.0 <= way; ++k) {
      scene.pull(1.0, watch);
      print_shape(scene, std::to_string(k).c_str());
    }
  } catch (...) {
    print_shape(scene, "last");
    throw;
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Pulls a stopper knot against a hole. Lengths are in radii h of the rod, forces in k_b/h^2.");
  StopperKnot::Options options;
  double way = 60.0;
  const std::map<std::string, StopperKnot::Kind> kinds = {{"overhand", StopperKnot::Kind::kOverhand},
                                                          {"figure-eight", StopperKnot::Kind::kFigureEight}};
  app.add_option("--knot", options.kind)->transform(CLI::CheckedTransformer(kinds));
  app.add_option("--edge", options.edge);
  app.add_option("--friction", options.friction);
  app.add_option("--couple", options.couple);
  app.add_option("--twisting", options.twisting);
  app.add_option("--preload", options.preload);
  app.add_option("--seating", options.seating);
  app.add_option("--below", options.below);
  app.add_option("--gap", options.gap);
  app.add_option("--rim", options.rim);
  app.add_option("--stretching", options.stretching);
  app.add_option("--speed", options.speed);
  app.add_option("--tail", options.tail);
  app.add_option("--longest", options.longest);
  app.add_option("--residual", options.residual);
  app.add_option("--way", way);
  try {
    app.parse(argc, argv);
    run(options, way);
    return 0;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "capsizing_bench: %s\n", error.what());
    return 1;
  }
}
