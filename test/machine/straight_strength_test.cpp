#include "knot_utm/machine/straight_strength.hpp"

#include <gtest/gtest.h>

#include "knot_utm/rod/stretching_laws.hpp"
#include "knot_utm/specimen/material.hpp"

namespace knot_utm {
namespace {

TEST(StraightStrength, IsTheFirstLimitThatAStraightRodReaches) {
  Material material;
  material.stretching_stiffness = 1000.0;
  EXPECT_FALSE(straight_strength(material));
  material.breaking_force = 300.0;
  EXPECT_EQ(straight_strength(material), 300.0);
  material.breaking_strain = 0.2;
  EXPECT_NEAR(*straight_strength(material), 200.0, 1e-9);
  material.breaking_strain = 0.4;
  EXPECT_EQ(straight_strength(material), 300.0);
}

TEST(StraightStrength, OfARubberIsItsTensionAtTheBreakingStrain) {
  Material material;
  material.stretching_stiffness = 30.0;
  material.stretching.law = StretchingLaw{1};
  ASSERT_STREQ(StretchingRegistry::kNames[1], "neo_hookean");
  material.breaking_strain = 1.0;
  // T = k_s (lambda - 1/lambda^2)/3
  EXPECT_NEAR(*straight_strength(material), 30.0 * (2.0 - 0.25) / 3.0, 1e-12);
}

}  // namespace
}  // namespace knot_utm
