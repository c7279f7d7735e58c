// Steps of a rod from a file, pulled at both ends: the physics alone, without a test around it.
#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <ctime>
#include <exception>
#include <stdexcept>
#include <string>

#include "knot_utm/machine/step_settings.hpp"
#include "knot_utm/rod/rod.hpp"
#include "knot_utm/sim/step_control.hpp"
#include "knot_utm/specimen/centreline.hpp"
#include "knot_utm/specimen/centreline_file.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "sim/scenes.hpp"

namespace knot_utm {
namespace {

struct Arguments {
  std::string file;
  double edge_length = 3.2e-3;  // [m]
  double step = 0.02;           // [s]
  double speed = 1e-3;          // [m/s]
  double duration = 10.0;       // [s]
  PhysicsOptions physics;
};

/// A soft solid rod with the radius of the ropes.
Material soft_rod() { return table1(1170.0, 1.70, 4.34e-6, 4.34e-6, 0.54); }

/// Those of a test of a shape from a file.
StepSettings settings_of(const Material& material, const PhysicsOptions& physics) {
  SpecimenOptions specimen;
  specimen.knot = knot_named("file");
  return step_settings(specimen, material, MachineOptions(), physics);
}

struct Scene {
  std::unique_ptr<TimeStep> stepper;
  Boundary boundary;
  StepControl control;

  explicit Scene(const Arguments& arguments) : control(options_of(arguments)) {
    const Material material = soft_rod();
    const Centreline line = from_points(read_centreline(arguments.file), false, material.radius, arguments.edge_length);
    const Points& x = line.points;
    const RodProperties rod =
        make_rod(material, (x.rightCols(x.cols() - 1) - x.leftCols(x.cols() - 1)).colwise().norm());
    RodState state;
    state.position = x;
    state.velocity = Points::Zero(3, x.cols());
    stepper = TimeStep::make(rod, state, settings_of(material, arguments.physics));
    boundary.fixed_nodes = {{0, x.col(0)}, {static_cast<int>(x.cols()) - 1, x.rightCols(1)}};
  }

  static StepControl::Options options_of(const Arguments& arguments) {
    StepControl::Options out;
    out.longest = arguments.step;
    out.motion = 0.5 * soft_rod().radius;
    return out;
  }

  /// Half of the speed at each end.
  void pull(double duration, double speed, double extra_drag) {
    const Vec3 lower = boundary.fixed_nodes[0].position, upper = boundary.fixed_nodes[1].position;
    boundary.extra_drag = extra_drag;
    double time = 0.0;
    const std::string gave_up = control.advance(
        *stepper, time, duration,
        [&](double, double to) -> const Boundary& {
          boundary.fixed_nodes[0].position = lower - 0.5 * speed * to * Vec3::UnitZ();
          boundary.fixed_nodes[1].position = upper + 0.5 * speed * to * Vec3::UnitZ();
          return boundary;
        },
        [](double, double, const StepSummary&) {});
    if (!gave_up.empty()) throw std::runtime_error(gave_up);
  }
};

void run(const Arguments& arguments) {
  Scene scene(arguments);
  scene.pull(2.0, 0.0, 10.0);
  const StepControl::Counters before = scene.control.counters();
  const std::clock_t start = std::clock();
  scene.pull(arguments.duration, arguments.speed, 0.0);
  const double cpu_time = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  const StepControl::Counters after = scene.control.counters();
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  std::printf("nodes: %d\ncpu_time: %.6g\n", static_cast<int>(scene.stepper->rod().nodes()), cpu_time);
  std::printf("steps: %llu\nrejected_steps: %llu\nnewton_iterations: %llu\n",
              static_cast<unsigned long long>(after.steps - before.steps),
              static_cast<unsigned long long>(after.rejected - before.rejected),
              static_cast<unsigned long long>(after.iterations - before.iterations));
  std::printf("touching: %d\npeak_memory: %ld\n", scene.stepper->readings().contact().touching, 1024 * usage.ru_maxrss);
}

}  // namespace
}  // namespace knot_utm

int main(int argc, char** argv) {
  CLI::App app("Pulls a rod from a file apart along z and says what the steps cost.");
  knot_utm::Arguments arguments;
  app.add_option("FILE", arguments.file, "CSV of x,y,z")->required();
  app.add_option("--edge", arguments.edge_length, "[m]")->check(CLI::PositiveNumber);
  app.add_option("--step", arguments.step, "[s]")->check(CLI::PositiveNumber);
  app.add_option("--speed", arguments.speed, "[m/s]")->check(CLI::NonNegativeNumber);
  app.add_option("--duration", arguments.duration, "[s]")->check(CLI::PositiveNumber);
  app.add_option("--residual", arguments.physics.residual, "[k_b/h^2]; that of a test")->check(CLI::PositiveNumber);
  CLI11_PARSE(app, argc, argv);
  try {
    knot_utm::run(arguments);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "row_of_knots_bench: %s\n", error.what());
    return 1;
  }
}
