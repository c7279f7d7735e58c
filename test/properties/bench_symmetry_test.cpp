// A whole bench: an open overhand that settles and is pulled a little.
#include <gtest/gtest.h>

#include <cstdio>
#include <string>

#include "knot_utm/machine/testing_machine.hpp"
#include "knot_utm/record/command.hpp"
#include "knot_utm/record/sample.hpp"
#include "knot_utm/run/csv.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/specimen/material.hpp"
#include "knot_utm/specimen/overhand.hpp"
#include "properties/scene.hpp"

namespace knot_utm::properties {
namespace {

struct Overhand {
  SpecimenOptions specimen;
  Material material;
  MachineOptions machine;
  PhysicsOptions physics;
  double way = 2e-3, settling = 1.2, pulling = 1.0;  // [m], [s], [s]

  Overhand() {
    specimen.knot = knot_named("overhand");
    specimen.length = 0.6;
    specimen.end_to_end = 0.35;
    specimen.edge_length = 0.0063;
    specimen.refinement = 1.0;
    material.radius = 3.175e-3;
    material.density = 900.0;
    material.stretching_stiffness = 40.0;
    material.bending_stiffness = material.twisting_stiffness = 1.2e-4;
    material.friction_coefficient = 0.3;
    machine.grips = GripKind::kClamps;
  }

  TestingMachine bench() const { return {specimen, material, machine, physics}; }

  /// Settles, and is pulled; the last reading.
  Sample pull(TestingMachine& bench) const {
    Command command;
    bench.respond(command);
    command.sequence = 1;
    command.time = settling;
    command.phase = Phase::kPull;
    bench.respond(command);
    command.sequence = 2;
    command.time = settling + pulling;
    command.displacement = way;
    return bench.respond(command);
  }
};

/// A similar rod of another size and stiffness, whose own mass is similar, too.
/// The unit of time is the second: doc/developers/reliability.md says what is counted in seconds.
Overhand scaled(Overhand overhand, double length, double force) {
  overhand.specimen.length *= length;
  overhand.specimen.end_to_end *= length;
  overhand.specimen.edge_length *= length;
  overhand.way *= length;
  overhand.machine.travel *= length;
  overhand.material.radius *= length;
  overhand.material.density *= force / (length * length * length * length);  // tau is the same
  overhand.material.stretching_stiffness *= force;
  overhand.material.bending_stiffness *= force * length * length;
  overhand.material.twisting_stiffness *= force * length * length;
  return overhand;
}

TEST(BenchSymmetry, LengthsAndForcesInOtherPowersOfTwoGiveTheSameBits) {
  const Overhand overhand;
  TestingMachine bench = overhand.bench();
  const Sample now = overhand.pull(bench);
  ASSERT_EQ(now.status, BenchStatus::kRunning) << now.message;
  ASSERT_GT(now.contacts, 0);
  for (const double length : {0.25, 8.0}) {
    const double force = 0.5 * length * length * length;
    const Overhand other = scaled(overhand, length, force);
    TestingMachine other_bench = other.bench();
    const Sample then = other.pull(other_bench);
    EXPECT_EQ(then.steps, now.steps);
    EXPECT_EQ(then.newton_iterations, now.newton_iterations);
    EXPECT_EQ(then.force_upper, force * now.force_upper);
    EXPECT_EQ(then.force_lower, force * now.force_lower);
    EXPECT_EQ(then.max_penetration, now.max_penetration);
    EXPECT_EQ(then.bending_energy, force * length * now.bending_energy);
    EXPECT_EQ(then.grip_work, force * length * now.grip_work);
    EXPECT_EQ(other_bench.state().position, length * bench.state().position);
    EXPECT_EQ(other_bench.state().twist, bench.state().twist);
  }
}

/// A shape from a file, which may stand as it likes across the load axis.
class BenchOfAFile : public testing::Test {
 protected:
  void TearDown() override { std::remove(file_.c_str()); }

  TestingMachine bench(const Points& points) {
    write_centreline(file_, points);
    Overhand overhand = overhand_;
    overhand.specimen.knot = knot_named("file");
    overhand.specimen.file = file_;
    overhand.machine.grips = GripKind::kNodes;
    return overhand.bench();
  }
  static Points drawn() {
    OverhandShape shape;
    shape.length = 0.6;
    shape.end_to_end = 0.35;
    shape.edge_length = 0.0063;
    return overhand(shape).points;
  }

  const Overhand overhand_;
  const std::string file_ = testing::TempDir() + "knot_utm_bench_symmetry_" +
                            testing::UnitTest::GetInstance()->current_test_info()->name() + ".csv";
};

TEST_F(BenchOfAFile, MirroredItGivesTheSameBits) {
  TestingMachine right = bench(drawn());
  const Sample now = overhand_.pull(right);
  ASSERT_EQ(now.status, BenchStatus::kRunning) << now.message;
  ASSERT_GT(now.contacts, 0);
  const Vec3 mirror(-1.0, 1.0, 1.0);
  TestingMachine left = bench(mirror.asDiagonal() * drawn());
  const Sample then = overhand_.pull(left);
  EXPECT_EQ(then.newton_iterations, now.newton_iterations);
  EXPECT_EQ(then.force_upper, now.force_upper);
  EXPECT_EQ(then.force_lower, now.force_lower);
  EXPECT_EQ(left.state().position, mirror.asDiagonal() * right.state().position);
}

/// Newton leaves a residual at every node, and nothing else differs.
TEST_F(BenchOfAFile, TurnedAboutTheAxisAndMovedItGivesTheSameForces) {
  TestingMachine one = bench(drawn());
  const Sample now = overhand_.pull(one);
  const Motion motion{Eigen::AngleAxisd(0.7, Vec3::UnitZ()).toRotationMatrix(), Vec3(0.1, -0.2, 0.05)};
  TestingMachine other = bench(motion.of(drawn()));
  const Sample then = overhand_.pull(other);
  ASSERT_EQ(then.status, BenchStatus::kRunning) << then.message;
  ASSERT_EQ(then.steps, now.steps) << "other steps, other errors of them";
  // Along a rod in tension the residuals of its nodes add up, of either run.
  const double h = overhand_.material.radius, bending_force = overhand_.material.bending_stiffness / (h * h);
  const double residual = 1e-4 * bending_force + 2e-6 * now.force_upper;
  const double error = 2.0 * residual * static_cast<double>(one.rod().nodes());
  EXPECT_NEAR(then.force_upper, now.force_upper, error);
  EXPECT_NEAR(then.force_lower, now.force_lower, error);
  EXPECT_NEAR(then.bending_energy, now.bending_energy, error * h);
}

}  // namespace
}  // namespace knot_utm::properties
