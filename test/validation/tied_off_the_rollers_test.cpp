// A loop is tied and released off the rollers, and then put on them: neither L nor a roller enters what is tied.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "knot_utm/machine/testing_machine.hpp"
#include "knot_utm/record/command.hpp"
#include "knot_utm/record/sample.hpp"
#include "knot_utm/rod/rod.hpp"
#include "rod/materials.hpp"

namespace knot_utm {
namespace {

constexpr double kRadius = 0.003175;

SpecimenOptions loop(double end_to_end, double knot_distance = 0.15) {
  SpecimenOptions out;
  out.end_to_end = end_to_end;
  out.knot_distance = knot_distance;
  out.preload = 50.0;
  out.to_be_tied = true;
  return out;
}

PhysicsOptions draft() {
  PhysicsOptions out;
  out.accuracy = Accuracy::kDraft;
  return out;
}

/// Rows of a phase, until the bench says that it is over.
class Driver {
 public:
  Driver(const SpecimenOptions& specimen, const MachineOptions& machine)
      : bench_(specimen, polypropylene(), machine, draft()) {}

  Sample through(Phase phase, double speed, double duration = 0.0) {
    ++command_.step;
    command_.phase = phase;
    command_.speed = speed;
    command_.duration = duration;
    Sample answer;
    for (int k = 0; k < 1000; ++k) {
      ++command_.sequence;
      command_.time += kPeriod;
      if (phase == Phase::kMount) command_.displacement += speed * kPeriod;
      answer = bench_.respond(command_);
      most_ = std::max(most_, std::max(std::abs(answer.force_upper), std::abs(answer.force_lower)));
      if (answer.status != BenchStatus::kRunning) return answer;
    }
    ADD_FAILURE() << "the phase does not end";
    return answer;
  }

  double most_force() const { return most_; }
  TestingMachine& bench() { return bench_; }

 private:
  static constexpr double kPeriod = 1.0 / 6.0;
  TestingMachine bench_;
  Command command_;
  double most_ = 0.0;
};

Sample tied_and_released(Driver& driver) {
  EXPECT_EQ(driver.through(Phase::kTie, 0.01).status, BenchStatus::kPhaseDone);
  Sample released = driver.through(Phase::kRelease, 0.0, 3.0);
  EXPECT_EQ(released.status, BenchStatus::kPhaseDone);
  return released;
}

/// What rest leaves moving, 2e-5 m/s for 0.3 s, is nothing beside these; meshes differ by one node or so.
TEST(TiedOffTheRollers, TheSameKnotsInLoopsOfAnyLength) {
  Driver near(loop(0.25), {}), far(loop(0.45), {});
  const Sample a = tied_and_released(near), b = tied_and_released(far);
  EXPECT_NEAR(a.normal_force, b.normal_force, 0.01 * b.normal_force);
  EXPECT_NEAR(a.knot_distance, b.knot_distance, 0.1 * kRadius);
  EXPECT_EQ(near.most_force(), 0.0) << "a roller was touched";
}

/// Where rollers at their places would leave no straight strands beyond the knots, the loop is drawn longer and
/// narrower.
TEST(TiedOffTheRollers, KnotsNearTheRollersAreTiedAsAnyOthers) {
  Driver crowded(loop(0.25, 0.19), {}), roomy(loop(0.5, 0.19), {});
  const Sample a = tied_and_released(crowded), b = tied_and_released(roomy);
  EXPECT_NEAR(a.normal_force, b.normal_force, 0.05 * b.normal_force);
  EXPECT_NEAR(a.knot_distance, b.knot_distance, 0.3 * kRadius);
  const Sample mounted = crowded.through(Phase::kMount, 0.0033);
  EXPECT_EQ(mounted.status, BenchStatus::kPhaseDone);
  EXPECT_NEAR(mounted.end_to_end, 0.25, 2.0 * kRadius);
  EXPECT_GT(mounted.force_upper, 0.0);
}

/// The middle of the far side, which is the loop's own middle, stays half-way: within what the difference of the forces
/// on the two grips is to the spring that holds it.
TEST(TiedOffTheRollers, TheFarSideIsHeldHalfWay) {
  for (const FarSide far_side : {FarSide::kHeld, FarSide::kFree}) {
    MachineOptions machine;
    machine.far_side = far_side;
    SpecimenOptions specimen = loop(0.3);
    PhysicsOptions physics;
    physics.gravity = {0.0, 0.0, -9.81};
    specimen.to_be_tied = false;
    TestingMachine bench(specimen, polypropylene(), machine, physics);
    const double middle = 0.5 * (bench.lower_grip().z() + bench.upper_grip().z());
    const auto far_middle = [&] {
      const Points& x = bench.state().position;
      Eigen::Index node = 0;
      (x.row(0).transpose().array() + 1e-3 * (x.row(2).transpose().array() - middle).abs()).minCoeff(&node);
      return node;
    };
    const Eigen::Index node = far_middle();
    const double before = bench.state().position(2, node);
    Command hold;
    hold.step = 1;
    hold.phase = Phase::kHold;
    for (int k = 1; k <= 60; ++k) {
      hold.sequence = static_cast<std::uint64_t>(k);
      hold.time = k / 6.0;
      ASSERT_EQ(bench.respond(hold).status, BenchStatus::kRunning);
    }
    const double moved = std::abs(bench.state().position(2, node) - before);
    // The slack lets half-way come down by 0.3 h, and the spring gives way by the weight of the loop, 0.4 h.
    if (far_side == FarSide::kHeld)
      EXPECT_LT(moved, 0.8 * kRadius);
    else
      EXPECT_GT(moved, 2.0 * kRadius) << "nothing holds it";
  }
}

}  // namespace
}  // namespace knot_utm
