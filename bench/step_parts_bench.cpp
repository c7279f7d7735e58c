// What a step of a straight rod pays for things that do nothing there: the search for contacts, a roller far away, and
// readings that nobody takes. Times are of one step [ms], the least of several rounds.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <limits>

#include "knot_utm/contact/smooth_contact.hpp"
#include "knot_utm/rod/rod.hpp"
#include "sim/scenes.hpp"

namespace knot_utm {
namespace {

constexpr double kEdge = 3.2e-3;   // [m]
constexpr double kDt = 0.05;       // [s]
constexpr double kSpeed = 3.3e-3;  // [m/s]
constexpr int kSteps = 50, kRounds = 7;

double milliseconds() { return 1e3 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// A straight rod whose ends are pulled along it, forth and back, so that every step has something to solve.
struct Scene {
  RodProperties rod;
  StepSettings settings;
  std::unique_ptr<TimeStep> stepper;
  Boundary boundary;
  int steps = 0, iterations = 0;

  Scene(int nodes, bool with_roller) {
    rod = make_rod(braided_rope(), Eigen::VectorXd::Constant(nodes - 1, kEdge));
    settings = closed_form_settings(rod.material);
    stepper = TimeStep::make(rod, straight_state(rod), settings);
    const Points& x = stepper->state().position;
    boundary.fixed_nodes = {{0, x.col(0)}, {nodes - 1, x.col(nodes - 1)}};
    if (!with_roller) return;
    Roller roller;
    roller.radius = 0.02;
    roller.centre = Vec3(0.0, 0.0, 1.0);
    boundary.rollers = {roller};
  }

  void pull() {
    const double way = (steps++ % 2 == 0 ? 0.5 : -0.5) * kSpeed * kDt;
    boundary.fixed_nodes.front().position[0] -= way;
    boundary.fixed_nodes.back().position[0] += way;
    iterations += stepper->step(boundary, kDt).newton.iterations;
  }
};

/// Least time of one of `steps` calls over the rounds.
template <typename Call>
double time_of(Call call, int steps = kSteps) {
  double least = std::numeric_limits<double>::infinity();
  for (int round = 0; round < kRounds; ++round) {
    const double start = milliseconds();
    for (int i = 0; i < steps; ++i) call();
    least = std::min(least, (milliseconds() - start) / steps);
  }
  return least;
}

void run(int nodes) {
  Scene bare(nodes, false), rolled(nodes, true);
  const double step = time_of([&] { bare.pull(); });
  const double step_with_roller = time_of([&] { rolled.pull(); });
  const double iterations = static_cast<double>(bare.iterations) / (kRounds * kSteps);

  SmoothContact contact(bare.rod, bare.settings.pressure_law, bare.settings.friction, bare.settings.candidate_margin);
  const Points& x = bare.stepper->state().position;
  const int evaluations = static_cast<int>(std::lround(iterations)) + 1;
  const double search = time_of([&] {
    contact.begin(x);
    for (int i = 0; i < evaluations; ++i) contact.evaluate(x, x, kDt);
    contact.commit(x);
  });

  double sum = 0.0;
  const double reading = time_of([&] {
    const Energies energies = bare.stepper->readings().energies();
    sum += energies.stretching + energies.kinetic + bare.stepper->state().velocity.colwise().squaredNorm().maxCoeff();
  });
  const bool same = bare.stepper->state().position == rolled.stepper->state().position;
  std::printf("nodes: %d\niterations: %.3g\nstep: %.6g\nstep_with_roller: %.6g\nsame_with_roller: %s\n", nodes,
              iterations, step, step_with_roller, same ? "true" : "false");
  std::printf("contact_search: %.6g\ncontacts: %zu\nreading: %.6g\nenergy: %.3g\n", search, contact.contacts().size(),
              reading, sum / (kRounds * kSteps));
}

}  // namespace
}  // namespace knot_utm

int main(int argc, char** argv) {
  CLI::App app("Parts of a straight rod's step.");
  int nodes = 500;
  app.add_option("--nodes", nodes)->check(CLI::Range(10, 100000));
  CLI11_PARSE(app, argc, argv);
  knot_utm::run(nodes);
  return 0;
}
