// What an Archive loads: the state of a time step, and that of a bench, as it stands in a tied specimen. The input as
// the file itself and, as no random bytes have the right checksum, as the state that a whole file holds; and as bytes
// that stand in a good state, from the place that the input's first two bytes tell. What could be loaded goes on by a
// step. "<random>" stands for the load cell's random numbers, which take 6 KB of a bench.
#include <zlib.h>

#include <cstdint>
#include <random>
#include <sstream>
#include <utility>

#include "fuzz/target.hpp"
#include "knot_utm/machine/testing_machine.hpp"
#include "knot_utm/numeric/archive.hpp"
#include "knot_utm/program/loading_steps.hpp"
#include "knot_utm/program/program_runner.hpp"
#include "knot_utm/record/sample.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/specimen/material.hpp"
#include "sim/saved.hpp"

namespace knot_utm {

namespace {

std::string little_endian(std::uint64_t value, int bytes) {
  std::string out;
  for (int i = 0; i < bytes; ++i) out += static_cast<char>(static_cast<unsigned char>(value >> (8 * i)));
  return out;
}

constexpr std::size_t kLengthBytes = 8, kSumBytes = 4;

std::string file_of(const std::string& kind, const std::string& state) {
  const std::string empty = Archive(kind).bytes();
  const std::string all =
      empty.substr(0, empty.size() - kLengthBytes - kSumBytes) + little_endian(state.size(), kLengthBytes) + state;
  return all + little_endian(crc32_z(0, reinterpret_cast<const Bytef*>(all.data()), all.size()), kSumBytes);
}

std::string state_of(const std::string& kind, const std::string& file) {
  return file.substr(Archive(kind).bytes().size() - kSumBytes, file.size() - Archive(kind).bytes().size());
}

Material thread() {
  Material out;
  out.name = "thread";
  out.radius = 1e-3;
  out.density = 1000.0;
  out.stretching_stiffness = 1e4;
  out.bending_stiffness = 1e-3;
  out.twisting_stiffness = 1e-3;
  out.friction_coefficient = 0.2;
  return out;
}

/// A step of a rod of four edges, pulled over a roller.
namespace step {

constexpr double kLength = 1e-3;  // [s]

std::unique_ptr<TimeStep> make() {
  const Material material = thread();
  const RodProperties rod = make_rod(material, Eigen::VectorXd::Constant(4, 2.0 * material.radius));
  RodState state;
  state.position = Points::Zero(3, rod.nodes());
  state.position.row(2) = rod.arclength().transpose();
  state.velocity = Points::Zero(3, rod.nodes());
  StepSettings settings;
  settings.pressure_law = NormalLaw{1e5, 1e-5, 1e-5};
  settings.residual = 1e-6;
  settings.newton_cap = settings.motion_limit = settings.overlap_limit = settings.candidate_margin = 1e-3;
  return TimeStep::make(rod, state, settings);
}

Boundary boundary() {
  Boundary out;
  out.fixed_nodes = {{0, Vec3::Zero()}};
  out.forces = {{4, Vec3(0.0, 0.0, 1e-3)}};
  out.rollers = {{Vec3(2e-3, 0.0, 4e-3), Vec3::UnitY(), 1e-3}};
  return out;
}

std::string good() {
  const std::unique_ptr<TimeStep> stepper = make();
  promise(stepper->step(boundary(), kLength).accepted(), "a step of the rod");
  return saved(*stepper);
}

std::unique_ptr<TimeStep> loaded(const std::string& file) {
  std::unique_ptr<TimeStep> stepper = make();
  load(file, *stepper);
  return stepper;
}

std::string written(const std::string& file) { return saved(*loaded(file)); }

StepSummary take(TimeStep& stepper) {
  StepSummary out = stepper.step(boundary(), kLength);
  if (!out.newton.converged()) out = stepper.step(boundary(), kLength, SolveStrategy::kSecants);
  return out;
}

/// Whatever the state: the step is made, or changes nothing and says why. What candidates of contact were sought at is
/// part of a state, and sought at once: after a step as before, so the second one leaves what the first one left.
void go_on(const std::string& file) {
  const std::unique_ptr<TimeStep> stepper = loaded(file);
  const StepSummary summary = take(*stepper);
  promise(!summary.accepted() || stepper->state().position.allFinite(), "an accepted step leads to places");
  if (summary.accepted()) return;
  const std::string once = saved(*stepper);
  promise(take(*stepper).reason == summary.reason && saved(*stepper) == once,
          "a step that was not accepted changes nothing");
}

}  // namespace step

/// Of a test of a rod a few edges long.
namespace bench {

constexpr const char* kKind = "bench";

TestingMachine make() {
  SpecimenOptions specimen;
  specimen.knot = knot_named("straight");
  specimen.length = 0.008;
  specimen.edge_length = 0.002;
  MachineOptions machine;
  machine.grips = GripKind::kClamps;
  PhysicsOptions physics;
  physics.accuracy = Accuracy::kDraft;
  return TestingMachine(specimen, thread(), machine, physics);
}

ProgramRunner program_of(const TestingMachine& bench) {
  PullStep pull;
  pull.until.extension = 0.001;
  return {{pull}, 10.0, bench.longest_step(), {}};
}

std::string saved(TestingMachine& bench) {
  Archive archive(kKind);
  archive(bench);
  return archive.bytes();
}

TestingMachine loaded(const std::string& file) {
  TestingMachine bench = make();
  Archive archive(kKind, file, kKind);
  archive(bench);
  archive.end();
  return bench;
}

/// In the middle of its pull, and the command that comes next.
std::pair<std::string, Command> good() {
  TestingMachine bench = make();
  ProgramRunner program = program_of(bench);
  for (int i = 0; i < 3; ++i) program.next(bench.respond(program.last()));
  return {saved(bench), program.last()};
}

std::string written(const std::string& file) {
  TestingMachine bench = loaded(file);
  return saved(bench);
}

/// Whatever the state: a command that comes soon is answered.
void go_on(const std::string& file, const Command& next) {
  TestingMachine bench = loaded(file);
  const double ahead = next.time - bench.time();
  if (ahead >= 0.0 && ahead <= 2.0 * bench.longest_step()) bench.respond(next);
}

}  // namespace bench

/// What is loaded may be written in another form, as numbers in a text are, but then it stays.
template <typename Written, typename Use>
void hold(Written write, Use use, const std::string& file) {
  std::string once;
  if (!understood([&] { once = write(file); })) return;
  promise(understood([&] { promise(write(once) == once, "what was written is written again"); }),
          "what was written can be loaded");
  use(once);
}

std::string with_random_numbers(std::string state) {
  static const std::string mark = "<random>", numbers = [] {
    std::ostringstream out;
    out << std::mt19937_64();
    return little_endian(out.str().size(), kLengthBytes) + out.str();
  }();
  const std::size_t place = state.find(mark);
  return place == std::string::npos ? state : state.replace(place, mark.size(), numbers);
}

std::string with(const std::string& good, const std::string& text) {
  if (text.size() < 2) return good;
  const std::size_t place =
      static_cast<unsigned char>(text[0]) | static_cast<std::size_t>(static_cast<unsigned char>(text[1])) << 8;
  std::string out = good;
  out.replace(place % good.size(), text.size() - 2, text.substr(2));
  return out;
}

void fuzz_archive(const std::string& text) {
  static const std::string good_step = step::good();
  static const std::pair<std::string, Command> good = bench::good();
  static const bool loads = step::written(good_step) == good_step && bench::written(good.first) == good.first;
  promise(loads, "what is good is loaded");

  const auto hold_step = [](const std::string& file) { hold(step::written, step::go_on, file); };
  hold_step(text);
  hold_step(file_of("time step", text));
  hold_step(file_of("time step", with(state_of("time step", good_step), text)));
  const auto hold_bench = [](const std::string& file) {
    hold(
        bench::written, [](const std::string& written) { bench::go_on(written, good.second); }, file);
  };
  hold_bench(text);
  hold_bench(file_of(bench::kKind, with_random_numbers(text)));
  hold_bench(file_of(bench::kKind, with(state_of(bench::kKind, good.first), text)));
}
const FuzzTarget archive("archive", fuzz_archive);

}  // namespace

}  // namespace knot_utm
