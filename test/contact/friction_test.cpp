#include "knot_utm/contact/friction.hpp"

#include <gtest/gtest.h>

namespace knot_utm {
namespace {

TEST(FrictionLaws, SecantsMeetTheLawAndBoundItsTangents) {
  for (const FrictionLaw law : {FrictionLaw::kMemory, FrictionLaw::kSmoothed})
    for (const double size : {1e-6, 0.05, 0.5, 1.0, 3.0, 100.0}) {
      const Vec3 y = size * Vec3(0.6, -0.8, 0.0);
      const FrictionDirection secant = linearised_direction(law, true, y);
      const FrictionDirection tangent = linearised_direction(law, false, y);
      EXPECT_EQ(secant.z, friction_direction(law, y));
      EXPECT_NEAR((secant.slope_times(y) - secant.z).norm(), 0.0, 1e-12);
      const double rounding = 1e-12 * secant.across;
      EXPECT_LE(tangent.across, secant.across + rounding);
      EXPECT_LE(tangent.across + tangent.along, secant.across + rounding);
    }
}

TEST(FrictionLaws, SmoothedKeepsALeastSlipInTheShortestSteps) {
  Friction friction;
  friction.law = FrictionLaw::kSmoothed;
  friction.slip_tolerance = 1e-3;
  friction.presliding = 6e-6;
  EXPECT_EQ(friction.scale(0.1), 1e-4);
  EXPECT_EQ(friction.scale(1e-9), Friction::kLeastSlip * 6e-6);
}

}  // namespace
}  // namespace knot_utm
