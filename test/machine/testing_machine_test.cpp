#include "knot_utm/machine/testing_machine.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

#include "knot_utm/numeric/archive.hpp"
#include "knot_utm/record/command.hpp"
#include "knot_utm/record/sample.hpp"
#include "knot_utm/rod/rod.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/words/invalid_input.hpp"
#include "overhand_specimen.hpp"
#include "rod/materials.hpp"

namespace knot_utm {
namespace {

SpecimenOptions straight_rod() {
  SpecimenOptions out;
  out.knot = knot_named("straight");
  out.length = 0.25;
  out.edge_length = 0.005;
  return out;
}

TestingMachine bench(const SpecimenOptions& specimen, GripKind grips = GripKind::kClamps,
                     double stiffness = std::numeric_limits<double>::infinity()) {
  MachineOptions machine;
  machine.grips = grips;
  machine.stiffness = stiffness;
  PhysicsOptions physics;
  physics.accuracy = Accuracy::kDraft;
  return TestingMachine(specimen, nylon(), machine, physics);
}

Command pull(std::uint64_t sequence, double time, double displacement) {
  Command out;
  out.sequence = sequence;
  out.time = time;
  out.displacement = displacement;
  out.step = 1;
  out.phase = Phase::kPull;
  return out;
}

/// The key that is complained about; empty: nothing was wrong.
std::string wrong_key(const SpecimenOptions& specimen) {
  try {
    bench(specimen);
  } catch (const InvalidInput& invalid) {
    return invalid.key;
  }
  return "";
}

/// Two commands, out to three times the load at which the crosshead stops and back to none.
TEST(TestingMachine, TheCrossheadStopsWithinACommandAtItsLoadAndStands) {
  for (const double stiffness : {std::numeric_limits<double>::infinity(), 1e6}) {
    TestingMachine machine = bench(straight_rod(), GripKind::kClamps, stiffness);
    machine.respond(Command());
    Command out = pull(1, 0.1, 1e-3);
    out.velocity = 1e-2;
    out.stop_load = 100.0;
    const Sample there = machine.respond(out);
    EXPECT_NEAR(there.load, 100.0, 1.0);
    EXPECT_LT(there.highest_load, 101.0);
    EXPECT_EQ(there.time, out.time);
    EXPECT_LT(there.displacement, out.displacement);
    Command on = pull(2, 0.2, 2e-3);  // already there
    on.velocity = 1e-2;
    on.stop_load = 99.0;
    EXPECT_EQ(machine.respond(on).displacement, there.displacement);
    Command back = pull(3, 0.3, 0.0);
    back.velocity = -1e-2;
    back.stop_load = 20.0;
    EXPECT_NEAR(machine.respond(back).load, 20.0, 0.2);
    back = pull(4, 0.4, 0.0);  // without a load to stop at
    back.velocity = -1e-2;
    EXPECT_EQ(machine.respond(back).displacement, 0.0);
  }
}

/// A slack overhand is a hundred thousand times softer than taut strands: on a soft frame, too, its grip stays where
/// forces balance, within what the frame's own damping makes at this speed.
TEST(TestingMachine, OnASoftFrameASlackKnotFollowsTheCrosshead) {
  constexpr double kStiffness = 1e4, kSpeed = 3.3e-3;
  TestingMachine machine = bench(overhand_specimen(1.0, 0.7, 0.005), GripKind::kNodes, kStiffness);
  Command rest;
  const Sample start = machine.respond(rest);
  for (std::uint64_t i = 1; i <= 30; ++i) {
    const double time = static_cast<double>(i) / 3.0;
    const Sample sample = machine.respond(pull(i, time, kSpeed * time));
    ASSERT_EQ(sample.status, BenchStatus::kRunning);
    const double lag = sample.displacement - (sample.end_to_end - start.end_to_end) - sample.force_upper / kStiffness;
    if (i > 15) {
      EXPECT_LT(std::abs(lag), 1e-4) << "after " << time << " s";
    }
  }
}

/// Two springs in series, F = D/(1/K + L/k_s), of a frame that is softer than the rod, as stiff and stiffer.
TEST(TestingMachine, OnACompliantFrameAStraightRodIsOneOfTwoSpringsInSeries) {
  const double rod = nylon().stretching_stiffness / 0.25;
  for (const double frame : {0.1 * rod, rod, 10.0 * rod}) {
    TestingMachine machine = bench(straight_rod(), GripKind::kClamps, frame);
    machine.respond(Command{});
    const double upper = machine.upper_grip()[2], speed = 3.3e-3, period = 0.1;
    const double series = 1.0 / (1.0 / frame + 1.0 / rod);
    // In motion the frame bears more than the rod, by Z + K tau times the speed of the grip, series/rod of the
    // crosshead's: a rod of just the stiffness that the frame counts on adds nothing.
    const double wave = std::sqrt(nylon().stretching_stiffness * nylon().density * M_PI) * nylon().radius;
    const double lag = (wave + 3e-3 * frame) * speed * series / rod;
    Command command;
    for (std::uint64_t k = 1; k <= 20; ++k) {
      command = pull(k, period * static_cast<double>(k), speed * period * static_cast<double>(k));
      const Sample sample = machine.respond(command);
      ASSERT_EQ(sample.status, BenchStatus::kRunning) << sample.message;
      const double exact = series * sample.displacement;
      EXPECT_LE(sample.force_upper, exact * (1.0 + 1e-5));
      EXPECT_GE(sample.force_upper, exact * (1.0 - 1e-5) - lag);
      // The rod's own curve does not know of the frame.
      EXPECT_NEAR(sample.force_upper, rod * sample.extension, 1e-5 * sample.force_upper);
      EXPECT_EQ(sample.raw_extension, sample.displacement);
      EXPECT_DOUBLE_EQ(machine.upper_grip()[2], upper + sample.extension);
    }
    for (std::uint64_t k = 21; k <= 40; ++k) {
      command.sequence = k;
      command.time = period * static_cast<double>(k);
      command.phase = Phase::kHold;
      command.step = 2;
      machine.respond(command);
    }
    command.sequence = 41;
    command.time += period;
    const Sample held = machine.respond(command);
    EXPECT_NEAR(held.force_upper, series * held.displacement, 1e-5 * held.force_upper);
    EXPECT_NEAR(held.extension, held.raw_extension - held.force_upper / frame, 1e-5 * held.extension);
  }
}

TEST(TestingMachine, OnACompliantFrameBalanceZeroesBothExtensions) {
  TestingMachine machine = bench(straight_rod(), GripKind::kClamps, 1e5);
  machine.respond(Command{});
  const Sample before = machine.respond(pull(1, 0.1, 3.3e-4));
  Command command = pull(2, 0.2, 6.6e-4);
  command.balance = true;
  const Sample sample = machine.respond(command);
  EXPECT_DOUBLE_EQ(sample.raw_extension, 3.3e-4);
  EXPECT_NEAR(sample.extension, sample.end_to_end - before.end_to_end, 1e-16);
  EXPECT_LT(sample.extension, sample.raw_extension);
  EXPECT_TRUE(std::isnan(bench(straight_rod()).respond(Command{}).raw_extension));
}

TEST(TestingMachine, HoldsAShapeFromAFileAtItsFirstAndLastEdge) {
  const std::string name = ::testing::TempDir() + "knot_utm_bench_shape.csv";
  std::ofstream(name) << "x,y,z\n0,0,0\n0,0,0.03\n0.01,0,0.05\n0,0,0.07\n0,0,0.1\n";
  SpecimenOptions file;
  file.knot = knot_named("file");
  file.file = name;
  file.edge_length = 0.005;
  TestingMachine machine = bench(file);
  machine.respond(Command{});
  const Points sketched = machine.state().position;
  const Eigen::Index last = sketched.cols() - 1;
  const Sample sample = machine.respond(pull(1, 0.1, 1e-4));
  EXPECT_EQ(sample.status, BenchStatus::kRunning) << sample.message;
  const Points& now = machine.state().position;
  const Vec3 up(0.0, 0.0, 1e-4);
  for (const Eigen::Index i : {Eigen::Index(0), Eigen::Index(1)})
    EXPECT_LT((now.col(i) - sketched.col(i)).norm(), 1e-12);
  for (const Eigen::Index i : {last - 1, last}) EXPECT_LT((now.col(i) - sketched.col(i) - up).norm(), 1e-12);

  std::ofstream(name) << "0,0,0.1\n0,0,0.07\n0.01,0,0.05\n0,0,0\n";
  EXPECT_EQ(wrong_key(file), "specimen.file") << "upside down";
  std::filesystem::remove(name);
}

SpecimenOptions drawn_overhand() {
  SpecimenOptions out;
  out.knot = knot_named("overhand");
  out.end_to_end = 0.7;
  out.edge_length = 0.0063;
  return out;
}

/// A loose knot pulls with less than the drag on its length, were there any.
TEST(TestingMachine, ThereIsNoDragInTheForceBetweenClampsUnlessTheMethodSetsOne) {
  MachineOptions machine;
  machine.grips = GripKind::kClamps;
  for (const double drag : {0.0, 0.1}) {
    PhysicsOptions physics;
    physics.accuracy = Accuracy::kDraft;
    if (drag > 0.0) physics.drag = drag;
    TestingMachine bench(drawn_overhand(), nylon(), machine, physics);
    Command settle;
    settle.time = 1.5;
    const Sample settled = bench.respond(settle);
    EXPECT_GT(settled.dissipation, settled.friction_loss);
    const Sample pulled = bench.respond(pull(1, 2.5, 0.0033));
    ASSERT_EQ(pulled.status, BenchStatus::kRunning) << pulled.message;
    const double loss = pulled.dissipation - pulled.friction_loss - settled.dissipation + settled.friction_loss;
    if (drag > 0.0) {
      const double length = bench.rod().rest_length.sum();
      EXPECT_GT(loss, 0.1 * drag * length * 0.0033 * 0.0033 / 3.0);  // c l v^2/3 of a rod that one end pulls
    } else {
      EXPECT_NEAR(loss, 0.0, 1e-12 * pulled.dissipation);
    }
  }
}

/// The shape as sketched stores energy that would throw it about. Friction's part of a force is at most mu times its
/// pressure, and tangential.
TEST(TestingMachine, ADrawnOverhandSettlesGentlyAndItsForcesBetweenStrandsAreThoseOfTheReading) {
  TestingMachine machine = bench(drawn_overhand());
  machine.respond(Command{});
  EXPECT_TRUE(machine.contact_forces().empty());
  Sample sample;
  for (std::uint64_t k = 1; k <= 10; ++k) {
    sample = machine.respond(pull(k, 0.2 * static_cast<double>(k), 0.0));
    ASSERT_EQ(sample.status, BenchStatus::kRunning) << sample.message;
    if (sample.time < 1.0) continue;  // under the drag that fades
    for (const Sample& substep : machine.substeps()) EXPECT_LT(substep.fastest_node, 0.1) << substep.time;
  }
  const std::vector<ContactForce> forces = machine.contact_forces();
  ASSERT_GT(sample.contacts, 0);
  EXPECT_EQ(forces.size(), static_cast<std::size_t>(sample.contacts));
  double sum = 0.0;
  for (const ContactForce& contact : forces) {
    sum += contact.force.norm();
    const double nearest = (machine.state().position.colwise() - contact.place).colwise().norm().minCoeff();
    EXPECT_LT(nearest, std::hypot(nylon().radius, 0.5 * drawn_overhand().edge_length) * 1.05) << "between two strands";
  }
  const double rounding = 1e-12 * sample.normal_force, mu = nylon().friction_coefficient;
  EXPECT_GE(sum, sample.normal_force - rounding);
  EXPECT_LE(sum, sample.normal_force * std::hypot(1.0, mu) + rounding);

  // Between strands each force presses on both; on a roller, on the rod alone.
  const Eigen::VectorXd load = machine.contact_load();
  EXPECT_GE(load.minCoeff(), 0.0) << "strands press, and do not pull";
  EXPECT_NEAR(load.dot(machine.rod().voronoi_length), 2.0 * sample.normal_force, rounding);
  for (const ContactForce& contact : forces) {
    Eigen::Index nearest = 0;
    (machine.state().position.colwise() - contact.place).colwise().norm().minCoeff(&nearest);
    EXPECT_GT(load[nearest], 0.0) << "where the strands press";
  }
}

/// As it is tied, and as it is let go at the beginning of a mount without a release: to the bit as without gravity.
TEST(TestingMachine, ALoopHasNoWeightUntilTheRollersTakeIt) {
  SpecimenOptions specimen;
  specimen.to_be_tied = true;
  specimen.edge_length = 0.005;
  specimen.preload = 20.0;
  PhysicsOptions physics;
  physics.accuracy = Accuracy::kDraft;
  TestingMachine light(specimen, polypropylene(), {}, physics);
  physics.gravity = {9.81, 0.0, 0.0};
  TestingMachine heavy(specimen, polypropylene(), {}, physics);
  Command command;
  command.step = 1;
  command.phase = Phase::kTie;
  command.speed = 0.01;
  while (light.respond(command).status == BenchStatus::kRunning) {
    ++command.sequence;
    command.time += 0.3;
  }
  Archive saved("bench");
  saved(light);
  Archive loaded("bench", saved.bytes(), "here");
  loaded(heavy);

  command.phase = Phase::kMount;
  command.step = 2;
  const double begin = command.time;
  for (const double behind : {0.1, 0.3, 0.4, 0.7}) {  // the rollers take it from the third of these on
    ++command.sequence;
    command.time = begin + behind;
    light.respond(command);
    ASSERT_NE(heavy.respond(command).status, BenchStatus::kFailed);
    const double moved = (heavy.state().position - light.state().position).cwiseAbs().maxCoeff();
    EXPECT_EQ(moved > 0.0, behind > 0.5) << behind;
  }
}

/// physics.twist: auto.
bool twists(const SpecimenOptions& specimen, GripKind grips, TwistMode twist = TwistMode::kAuto,
            const Material& material = pink_vps(), FrictionAt at = FrictionAt::kSurface) {
  MachineOptions machine;
  machine.grips = grips;
  PhysicsOptions physics;
  physics.accuracy = Accuracy::kDraft;
  physics.twist = twist;
  physics.friction_at = at;
  return TestingMachine(specimen, material, machine, physics).state().twist.size() > 0;
}

TEST(TestingMachine, TwistIsOnByItselfWhereClampsHoldTwoFramesAndWhereFrictionRollsStrands) {
  SpecimenOptions loop;
  loop.edge_length = 0.005;
  EXPECT_FALSE(twists(loop, GripKind::kRollers));
  EXPECT_FALSE(twists(loop, GripKind::kNodes));
  EXPECT_TRUE(twists(loop, GripKind::kClamps));
  EXPECT_TRUE(twists(drawn_overhand(), GripKind::kClamps));
  EXPECT_FALSE(twists(drawn_overhand(), GripKind::kNodes));
  EXPECT_FALSE(twists(drawn_overhand(), GripKind::kClamps, TwistMode::kOff));
  EXPECT_FALSE(twists(straight_rod(), GripKind::kClamps));
  EXPECT_TRUE(twists(straight_rod(), GripKind::kClamps, TwistMode::kOn));

  Material rope = polypropylene();
  rope.friction_couple = 1.0;
  EXPECT_TRUE(twists(loop, GripKind::kRollers, TwistMode::kAuto, rope));
  EXPECT_FALSE(twists(loop, GripKind::kRollers, TwistMode::kAuto, rope, FrictionAt::kCentreline));
  rope.friction_coefficient = 0.0;
  EXPECT_FALSE(twists(loop, GripKind::kRollers, TwistMode::kAuto, rope));
}

TEST(TestingMachine, OnceFailedItAnswersEveryCommandWithTheSame) {
  TestingMachine machine = bench(straight_rod());
  machine.respond(Command{});
  const Sample failed = machine.respond(pull(1, 1e-6, 0.2));  // faster than any step may move
  ASSERT_EQ(failed.status, BenchStatus::kFailed);
  EXPECT_NE(failed.message, "");
  const Points position = machine.state().position;
  for (std::uint64_t k = 2; k < 5; ++k) {
    Command command = pull(k, 0.1 * static_cast<double>(k), 0.0);
    command.step = static_cast<int>(k);
    const Sample sample = machine.respond(command);
    EXPECT_EQ(sample.sequence, k);
    EXPECT_EQ(sample.status, BenchStatus::kFailed);
    EXPECT_EQ(sample.message, failed.message);
    EXPECT_EQ(sample.time, failed.time);
    EXPECT_EQ(sample.displacement, failed.displacement);
    EXPECT_EQ(machine.substeps().size(), 1u);
  }
  EXPECT_TRUE(machine.contact_forces().empty());
  EXPECT_EQ(machine.contact_load().size(), 0);
  EXPECT_EQ(machine.state().position, position);
}

}  // namespace
}  // namespace knot_utm
