// One half of a rod that a half-turn maps onto itself is solved for both.
#include "../../src/sim/half_rod.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "knot_utm/machine/testing_machine.hpp"
#include "knot_utm/record/command.hpp"
#include "knot_utm/record/sample.hpp"
#include "knot_utm/rod/frames.hpp"
#include "knot_utm/settings/step_settings.hpp"
#include "knot_utm/sim/time_step.hpp"
#include "knot_utm/specimen/centreline.hpp"
#include "overhand_specimen.hpp"
#include "rod/materials.hpp"

namespace knot_utm {
namespace {

struct Scene {
  SpecimenOptions specimen;
  Material material = polypropylene();
  MachineOptions machine;
  PhysicsOptions physics;

  TestingMachine bench() const { return {specimen, material, machine, physics}; }
};

Scene loop() {
  Scene out;
  out.specimen.preload = 20.0;
  out.specimen.to_be_tied = true;
  out.material.friction_couple = 1.0;
  out.physics.accuracy = Accuracy::kDraft;
  return out;
}

Scene open_overhand() {
  Scene out;
  out.specimen = overhand_specimen(0.4, 0.15, 0.006);
  out.material = pink_vps();
  out.material.friction_couple = 1.0;
  out.machine.grips = GripKind::kClamps;
  out.physics.accuracy = Accuracy::kDraft;
  return out;
}

/// Through one phase, or as far as `end` [s].
Sample through(TestingMachine& bench, Command& command, Phase phase, double end) {
  ++command.step;
  command.phase = phase;
  command.speed = 0.01;
  command.duration = 1.0;
  Sample out;
  do {
    ++command.sequence;
    command.time += 1.0 / 6.0;
    out = bench.respond(command);
  } while (out.status == BenchStatus::kRunning && command.time < end);
  return out;
}

/// A coil whose turns touch each other, the middle one too, before a step.
struct Coil {
  RodProperties rod;
  RodState state;
  StepSettings settings;
  Boundary boundary;
  StepStart start{state, boundary, 1e-3};

  explicit Coil(int nodes) {
    Scene scene = loop();
    const double h = scene.material.radius, edge = 0.8 * h, radius = 4.0 * h, pitch = 1.97 * h;
    state.position.resize(3, nodes);
    for (int i = 0; i < nodes; ++i) {
      const double turned = (i - 0.5 * (nodes - 1)) * edge / radius;
      state.position.col(i) << radius * std::cos(turned), radius * std::sin(turned), pitch * turned / (2.0 * M_PI);
    }
    state.velocity = Points::Random(3, nodes);
    state.velocity *= 0.02 * h / start.dt;
    rod = make_rod(scene.material, Eigen::VectorXd::Constant(nodes - 1, edge));
    initialise_frames(&state);
    settings = step_settings(scene.specimen, scene.material, scene.machine, scene.physics);
    settings.pressure_law.stiffening = std::numeric_limits<double>::infinity();  // else the matrix is no derivative
    settings.half_turn = HalfTurn::of(state.position, 1e-9 * h);
    HalfTurn of_velocity = *settings.half_turn;
    of_velocity.shift.setZero();
    of_velocity.mirror(state.velocity);
    if (nodes % 2 != 0) state.velocity.col(nodes / 2) *= 0.0;
  }
};

/// The largest deviation of the forces' derivative from the matrix: Newton's change d solves K d = f, and along it f
/// falls by f itself. [of the largest force]
double error_of_matrix(Equation<4>& equation, const StepStart& start, int nodes) {
  Increment<4> increment(equation, start, false);
  increment.residual();
  const std::vector<Lanes> before = equation.force;
  EXPECT_TRUE(increment.solve(Linearisation::kTangent));
  const Points from = equation.x;
  increment.move(1e-6);
  increment.residual();
  double along = 0.0, length2 = 0.0;  // `move` moves by less where it is far
  for (int i = 0; i < nodes; ++i) {
    along += (equation.x - from).col(i).dot(to_vec3(equation.change[at(i)]));
    length2 += to_vec3(equation.change[at(i)]).squaredNorm();
  }
  double largest = 0.0, off = 0.0;
  for (int i = 0; i < nodes; ++i)
    for (int k = 0; k < 4; ++k) {
      if (i + 1 == static_cast<int>(before.size()) && k == 3) continue;
      const double scale = k < 3 ? 1.0 : 1.0 / equation.rod.material.radius;
      largest = std::max(largest, scale * std::abs(before[at(i)][k]));
      off = std::max(
          off, scale * std::abs(length2 / along * (equation.force[at(i)][k] - before[at(i)][k]) + before[at(i)][k]));
    }
  EXPECT_GT(largest, 0.0);
  return off / largest;
}

TEST(HalfRod, HasTheDerivativeOfItsForces) {
  for (const int nodes : {110, 111}) {
    Coil coil(nodes);
    ASSERT_TRUE(coil.settings.half_turn);
    const HalfTurn& image = *coil.settings.half_turn;
    Equation<4> whole(coil.rod, coil.state, coil.settings);
    HalfRod<4> half(image, coil.rod, coil.state, coil.settings);
    const double of_half = error_of_matrix(half.equation(), half.begin(coil.start, whole), image.half());
    int across = 0, in_the_middle = 0;
    for (const ContactPoint& contact : half.equation().strands.points()) {
      if (!contact.touches()) continue;
      across += contact.b0 + 1 >= image.half() ? 1 : 0;
      in_the_middle += contact.a0 + 1 >= image.half() - 1 ? 1 : 0;
    }
    EXPECT_GT(across, 10);
    EXPECT_GT(in_the_middle, 0);
    const double of_whole = error_of_matrix(whole, coil.start, nodes);
    EXPECT_LT(of_half, 1e-5) << nodes << " nodes";
    EXPECT_LT(of_whole, 1e-5) << nodes << " nodes";
  }
}

/// Both take the same steps.
TEST(HalfRod, ReadsWhatTheWholeRodReads) {
  Scene scene = loop();
  scene.material = pink_vps();
  scene.material.friction_couple = 1.0;
  scene.specimen.preload = 0.5;
  TestingMachine by_half = scene.bench();
  scene.physics.symmetry = Symmetry::kOff;
  TestingMachine as_a_whole = scene.bench();
  Command command_of_half, command;
  const auto tied_and_released = [](TestingMachine& bench, Command& to) {
    through(bench, to, Phase::kTie, 100.0);
    return through(bench, to, Phase::kRelease, 200.0);
  };
  const Sample half = tied_and_released(by_half, command_of_half), whole = tied_and_released(as_a_whole, command);
  ASSERT_EQ(half.status, BenchStatus::kPhaseDone) << half.message;
  EXPECT_EQ(half.half_iterations, half.newton_iterations);
  EXPECT_EQ(whole.half_iterations, 0U);
  const auto expect_same = [](double a, double b) { EXPECT_NEAR(a, b, 1e-6 * std::abs(b)); };
  EXPECT_EQ(half.contacts, whole.contacts);
  expect_same(half.normal_force, whole.normal_force);
  expect_same(half.bending_energy, whole.bending_energy);
  expect_same(half.twisting_energy, whole.twisting_energy);
  expect_same(half.contact_energy, whole.contact_energy);
  expect_same(half.dissipation, whole.dissipation);
  expect_same(half.knot_distance, whole.knot_distance);
  expect_same(half.max_penetration, whole.max_penetration);
  for (std::size_t k = 0; k < 2; ++k) expect_same(half.excess_length[k], whole.excess_length[k]);
  const Sample pulled = through(by_half, command_of_half, Phase::kPull, command_of_half.time);  // the knots hold
  EXPECT_GT(pulled.half_iterations, half.half_iterations);
  EXPECT_EQ(pulled.half_iterations, pulled.newton_iterations);
}

TEST(HalfRod, OfALoopIsSolvedUntilItsKnotsSlide) {
  const Scene scene = loop();
  TestingMachine bench = scene.bench();
  Command command;
  Sample last, sample;
  for (const Phase phase : {Phase::kTie, Phase::kRelease, Phase::kMount}) last = through(bench, command, phase, 200.0);
  EXPECT_EQ(last.half_iterations, last.newton_iterations);
  for (sample = last; sample.knot_distance > last.knot_distance - scene.material.radius;)
    sample = through(bench, command, Phase::kPull, command.time);
  const Sample later = through(bench, command, Phase::kPull, command.time);
  EXPECT_GT(later.newton_iterations, sample.newton_iterations);
  EXPECT_EQ(later.half_iterations, sample.half_iterations);
}

/// A symmetric method with values drawn at random.
Scene drawn(std::mt19937& random) {
  const auto between = [&](double low, double high) { return std::uniform_real_distribution<>(low, high)(random); };
  Scene out = random() % 4 == 0 ? open_overhand() : loop();
  if (random() % 2 == 0) out.material = random() % 2 == 0 ? nylon() : pink_vps();
  out.material.friction_couple = random() % 2 == 0 ? 1.0 : 0.0;
  out.material.friction_coefficient = between(0.1, 0.6);
  out.specimen.edge_length = between(0.0032, 0.006);
  out.specimen.tail = between(0.025, 0.04);
  out.specimen.knot_distance = between(0.13, 0.16);
  out.specimen.preload = between(2.0, 6.0) * out.material.bending_stiffness / std::pow(out.material.radius, 2);
  return out;
}

Sample begun(const Scene& scene, double seconds) {
  TestingMachine bench = scene.bench();
  Command command;
  return through(bench, command, scene.specimen.to_be_tied ? Phase::kTie : Phase::kPull, seconds);
}

TEST(HalfRod, IsSolvedWhereTheSpecimenIsSymmetric) {
  std::mt19937 random(7);
  for (int i = 0; i < 20; ++i) {
    const Sample sample = begun(drawn(random), 1.5);
    EXPECT_GT(sample.newton_iterations, 20U);
    EXPECT_EQ(sample.half_iterations, sample.newton_iterations) << "method " << i;
  }
}

TEST(HalfRod, IsNotSolvedWhereItIsNot) {
  std::mt19937 random(8);
  for (int i = 0; i < 20; ++i) {
    Scene scene = drawn(random);
    if (scene.specimen.to_be_tied)
      scene.specimen.handedness = Handedness::kOpposite;
    else
      scene.physics.gravity = Vec3(0.0, 3.0, -9.0);
    const Sample sample = begun(scene, 0.2);
    EXPECT_GT(sample.newton_iterations, 20U);
    EXPECT_EQ(sample.half_iterations, 0U) << "method " << i;
  }
}

/// A load on one half only: to the bit as if the whole rod had been solved from the start.
TEST(HalfRod, IsGivenUpWhereTheWholeRodIsNotSolvedWithIt) {
  const Scene scene = open_overhand();
  const Centreline shape = specimen_centreline(scene.specimen, scene.material, scene.machine, scene.physics);
  const TestingMachine bench = scene.bench();
  StepSettings settings = step_settings(scene.specimen, scene.material, scene.machine, scene.physics);
  const auto whole = TimeStep::make(bench.rod(), bench.state(), settings);
  settings.half_turn = shape.half_turn;
  ASSERT_TRUE(settings.half_turn);
  const auto half = TimeStep::make(bench.rod(), bench.state(), settings);
  Boundary boundary;
  const int last = static_cast<int>(bench.rod().nodes()) - 1;
  for (const int node : {0, last}) boundary.fixed_nodes.push_back({node, bench.state().position.col(node)});
  const auto step = [&](int by_half) {
    const StepSummary of_half = half->step(boundary, 2e-4), of_whole = whole->step(boundary, 2e-4);
    ASSERT_TRUE(of_half.accepted()) << of_half.reason;
    EXPECT_EQ(of_half.by_half > 0 ? 1 : 0, by_half);
    EXPECT_EQ(of_whole.by_half, 0);
  };
  step(1);
  boundary.forces.push_back({last / 3, Vec3(1e-4, 2e-4, 0.0)});
  step(0);
  boundary.forces.clear();
  step(0);

  const auto loaded = [&](const StepSettings& of) {
    auto stepper = TimeStep::make(bench.rod(), bench.state(), of);
    Boundary one_sided = boundary;
    one_sided.forces.push_back({last / 3, Vec3(1e-4, 2e-4, 0.0)});
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(stepper->step(one_sided, 2e-4).accepted());
    return stepper->state().position;
  };
  const Points with_half = loaded(settings);
  settings.half_turn.reset();
  EXPECT_EQ(with_half, loaded(settings));
}

TEST(HalfRod, IsNotSolvedInARodThatIsNotSymmetric) {
  const Points shape = open_overhand().bench().state().position;
  const auto found = HalfTurn::of(shape, 1e-9);
  ASSERT_TRUE(found);
  EXPECT_NEAR((found->turn * found->turn - Mat3::Identity()).norm(), 0.0, 1e-14);
  EXPECT_NEAR(found->turn.determinant(), 1.0, 1e-14);
  Points moved = shape;
  moved(0, 3) += 1e-8;
  EXPECT_FALSE(HalfTurn::of(moved, 1e-9));
}

}  // namespace
}  // namespace knot_utm
