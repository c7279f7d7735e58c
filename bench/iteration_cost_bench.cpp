// What an iteration of Newton's method costs while a knot is pulled, and what the bare factorisation and solve of its
// matrix do: here and there on the way the matrix is put together for the state at hand and solved once more.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <exception>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "knot_utm/contact/smooth_contact.hpp"
#include "knot_utm/machine/step_settings.hpp"
#include "knot_utm/machine/testing_machine.hpp"
#include "knot_utm/record/sample.hpp"
#include "knot_utm/run/load_test.hpp"
#include "knot_utm/sim/centreline_terms.hpp"
#include "knot_utm/sim/frame_terms.hpp"
#include "knot_utm/sim/roller_turns.hpp"
#include "knot_utm/sim/step_matrix.hpp"

namespace knot_utm {
namespace {

constexpr int kCommandsApart = 10;  // of the states that are looked at
constexpr int kSolves = 20, kRounds = 5;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

double seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Least time of one call over the rounds [s].
template <typename Call>
double time_of(Call call) {
  double least = std::numeric_limits<double>::infinity();
  for (int round = 0; round < kRounds; ++round) {
    const double start = seconds();
    for (int i = 0; i < kSolves; ++i) call();
    least = std::min(least, (seconds() - start) / kSolves);
  }
  return least;
}

/// The matrix of a rod in self-contact, as a step has it but for what rollers add to its band; D = 4: with twist.
template <int D>
class Matrix {
 public:
  Matrix(const RodProperties& rod, const StepSettings& settings, double dt)
      : rod_(rod),
        contact_(rod, settings.pressure_law, settings.friction, settings.candidate_margin, settings.weighting_time),
        centreline_(rod, true),
        frames_(rod, settings),
        matrix_(static_cast<int>(rod.nodes())),
        dt_(dt) {
    for (Eigen::Index i = 0; i < rod.nodes(); ++i)
      diagonal_.push_back(rod.mass[i] / (dt * dt) + settings.drag * rod.voronoi_length[i] / dt);
  }

  /// What its bare factorisation and solve take [s]. They use the matrix up, so that it is copied, which does not
  /// count.
  double solve_time(const RodState& state) {
    set(state);
    const BlockMatrix<D> whole = matrix_.values();
    BlockMatrix<D> used = whole;
    typename BlockMatrix<D>::Vector x(at(static_cast<int>(rod_.nodes())));
    const auto copy = [&] {
      used = whole;
      std::fill(x.begin(), x.end(), Lanes{1.0, 1.0, 1.0, 0.0});
    };
    const double copied = time_of(copy);
    return time_of([&] {
             copy();
             if (!used.solve(x)) throw std::runtime_error("a pivot is singular");
           }) -
           copied;
  }

 private:
  void set(const RodState& state) {
    const Points& position = state.position;
    std::vector<Lanes> force(at(static_cast<int>(rod_.nodes())));
    const Boundary free;
    const StepStart step{state, free, dt_};
    centreline_.add_forces(step, position, force);
    contact_.begin(position);
    contact_.evaluate(position, position, dt_);
    matrix_.locate(contact_.contacts());
    matrix_.set_zero_beyond_band();
    LinearSystem<D> system{step, position, matrix_, force, turns_, {}, nullptr};
    centreline_.add_stiffness(system);
    for (int i = 0; i < static_cast<int>(rod_.nodes()); ++i)
      for (int k = 0; k < 3; ++k) matrix_.band(i, 0, 0).column[k][k] += diagonal_[at(i)];
    if constexpr (D == 4) {
      frames_.begin(step);
      frames_.add_forces(step, position, force);
      frames_.add_stiffness(system);
      matrix_.values().set_identity_row(static_cast<int>(rod_.nodes()) - 1, Lanes{1.0, 1.0, 1.0, 0.0});
    }
    contact_.linearise({}, dt_, models_);
    std::size_t n = 0;
    for (const ContactPoint& contact : contact_.contacts())
      if (contact.active()) {
        matrix_.add(contact, models_[n], n);
        ++n;
      }
    matrix_.commit();
  }

  const RodProperties& rod_;
  SmoothContact contact_;
  CentrelineTerms centreline_;
  FrameTerms frames_;
  StepMatrix<D> matrix_;
  RollerTurns turns_;
  double dt_;
  std::vector<double> diagonal_;
  std::vector<ContactModel> models_;
};

template <int D>
void run(const Method& method, TestingMachine& bench) {
  if (method.physics.contact_law != ContactLaw::kSmooth) throw std::runtime_error("only with contact.law smooth");
  ProgramRunner program = make_program(method, bench.longest_step());
  Matrix<D> matrix(bench.rod(), step_settings(method.specimen, method.material, method.machine, method.physics),
                   bench.longest_step());
  double pulled = 0.0, solved = 0.0;  // [s]
  std::uint64_t iterations = 0, before = 0;
  int commands = 0, solves = 0;
  for (Command command = program.last(); !program.ended();) {
    const double start = seconds();
    const Sample sample = bench.respond(command);
    if (command.phase == Phase::kPull && sample.status == BenchStatus::kRunning) {
      pulled += seconds() - start;
      iterations += sample.newton_iterations - before;
      if (commands++ % kCommandsApart == 0) {
        solved += matrix.solve_time(bench.state());
        ++solves;
      }
    }
    before = sample.newton_iterations;
    command = program.next(sample);
  }
  if (iterations == 0 || solves == 0) throw std::runtime_error("nothing was pulled: " + program.reason());
  std::printf("nodes: %d\niterations: %llu\niteration: %.6g\nstates: %d\nsolve: %.6g\n",
              static_cast<int>(bench.rod().nodes()), static_cast<unsigned long long>(iterations),
              1e3 * pulled / static_cast<double>(iterations), solves, 1e3 * solved / solves);
}

void run(const std::string& file, const std::vector<std::string>& settings) {
  const Method method = load_method(file, settings);
  TestingMachine bench(method.specimen, method.material, method.machine, method.physics);
  bench.state().twist.size() == 0 ? run<3>(method, bench) : run<4>(method, bench);
}

}  // namespace
}  // namespace knot_utm

int main(int argc, char** argv) {
  CLI::App app("Pulls a knot and says what an iteration costs, and what its bare factorisation and solve do [ms].");
  std::string method;
  std::vector<std::string> settings;
  app.add_option("METHOD", method, "the method, a YAML file")->required();
  app.add_option("--set", settings, "dotted.key=YAML")->allow_extra_args(false);
  CLI11_PARSE(app, argc, argv);
  try {
    knot_utm::run(method, settings);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "iteration_cost_bench: %s\n", error.what());
    return 1;
  }
}
