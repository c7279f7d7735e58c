// physics.twist on the machine.

#include <gtest/gtest.h>

#include "knot_utm/machine/testing_machine.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "machine/overhand_specimen.hpp"
#include "rod/materials.hpp"

namespace knot_utm {
namespace {

TestingMachine bench(const SpecimenOptions& specimen, GripKind grips, TwistMode twist) {
  MachineOptions machine;
  machine.grips = grips;
  PhysicsOptions physics;
  physics.twist = twist;
  return TestingMachine(specimen, pink_vps(), machine, physics);
}

SpecimenOptions loop() {
  SpecimenOptions specimen;
  specimen.edge_length = 0.005;
  return specimen;
}

SpecimenOptions open_overhand() { return overhand_specimen(1.0, 0.7, 0.005); }

bool has_twist(const TestingMachine& machine) { return machine.state().twist.size() > 0; }

TEST(TwistOnTheMachine, AutoIsOnWhereClampsHoldTwoFrames) {
  const auto by_itself = [](const SpecimenOptions& specimen, GripKind grips) {
    return has_twist(bench(specimen, grips, TwistMode::kAuto));
  };
  SpecimenOptions straight;
  straight.knot = knot_named("straight");
  EXPECT_FALSE(by_itself(loop(), GripKind::kRollers));
  EXPECT_FALSE(by_itself(loop(), GripKind::kNodes));
  EXPECT_TRUE(by_itself(loop(), GripKind::kClamps));
  EXPECT_TRUE(by_itself(open_overhand(), GripKind::kClamps));
  EXPECT_FALSE(by_itself(open_overhand(), GripKind::kNodes));
  EXPECT_FALSE(by_itself(straight, GripKind::kClamps));
  EXPECT_TRUE(has_twist(bench(straight, GripKind::kClamps, TwistMode::kOn)));
  EXPECT_FALSE(has_twist(bench(open_overhand(), GripKind::kClamps, TwistMode::kOff)));
}

TEST(TwistOnTheMachine, AutoIsOnWhereFrictionRollsStrands) {
  const auto by_itself = [](double couple, FrictionAt at, double mu) {
    Material material = polypropylene();
    material.friction_couple = couple;
    material.friction_coefficient = mu;
    PhysicsOptions physics;
    physics.friction_at = at;
    return has_twist(TestingMachine(loop(), material, MachineOptions(), physics));
  };
  EXPECT_TRUE(by_itself(0.5, FrictionAt::kSurface, 0.3));
  EXPECT_FALSE(by_itself(0.5, FrictionAt::kCentreline, 0.3));
  EXPECT_FALSE(by_itself(0.0, FrictionAt::kSurface, 0.3));
  EXPECT_FALSE(by_itself(0.5, FrictionAt::kSurface, 0.0));
}

}  // namespace
}  // namespace knot_utm
