#include "knot_utm/tying/before_tying.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "knot_utm/specimen/knot_drawing.hpp"
#include "knot_utm/words/invalid_input.hpp"
#include "rod/materials.hpp"

namespace knot_utm {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

struct Loop {
  SpecimenOptions specimen;
  Material material = nylon();
  PhysicsOptions physics;

  Loop() {
    specimen.to_be_tied = true;
    specimen.preload = 150.0;
  }
  std::vector<std::string> warnings() const { return tying_warnings(specimen, material, physics); }
  /// The key that is refused; empty: none is.
  std::string refused() const {
    try {
      check_tying(specimen, material);
    } catch (const InvalidInput& invalid) {
      return invalid.key;
    }
    return "";
  }
};

/// In units of k_b/h^2 [N].
double bending_force(const Material& material) {
  return material.bending_stiffness / (material.radius * material.radius);
}

TEST(BeforeTying, APreloadThatStretchesTheRodToMoreThanSixTimesItsLengthIsRefused) {
  for (const auto& [law, largest] : {std::pair(0, 5.0), std::pair(1, (6.0 - 1.0 / 36.0) / 3.0)}) {
    Loop loop;
    loop.material = pink_vps();
    loop.material.stretching.law = static_cast<StretchingLaw>(law);
    loop.specimen.preload = 0.999 * largest * loop.material.stretching_stiffness;
    EXPECT_EQ(loop.refused(), "") << law;
    loop.specimen.preload = 1.001 * largest * loop.material.stretching_stiffness;
    EXPECT_EQ(loop.refused(), "specimen.preload") << law;
  }
}

TEST(BeforeTying, WithoutFrictionACoilClosesAtAnEighthOfTheBendingForce) {
  Loop loop;
  loop.material.friction_coefficient = 0.0;
  EXPECT_DOUBLE_EQ(closing_preload(loop.material), bending_force(loop.material) / 8.0);
  EXPECT_DOUBLE_EQ(coil_radius(loop.material, closing_preload(loop.material)), 2.0 * loop.material.radius);
  EXPECT_NEAR(coil_radius(loop.material, 0.5 * bending_force(loop.material)), loop.material.radius, 1e-12);
}

TEST(BeforeTying, APreloadThatMovesNoCoilIsRefused) {
  Loop loop;
  loop.specimen.preload = 0.02 * bending_force(loop.material);
  EXPECT_EQ(loop.refused(), "specimen.preload");
  // Friction alone may hold such strands until the pull closes them.
  loop.material.friction_coefficient = 1.5;
  loop.specimen.preload = 0.13 * bending_force(loop.material);
  EXPECT_EQ(loop.refused(), "");
}

TEST(BeforeTying, AStrainThatTheLooseCoilHasAlreadyIsRefusedAndThatOfATiedOneIsAWarning) {
  Loop loop;
  loop.material.breaking.law = static_cast<BreakingLaw>(1);
  loop.material.breaking.set("bending_share", 1.0);
  const auto parts_at = [&](double strain) {
    loop.material.breaking_force = strain * loop.material.stretching_stiffness;
  };
  parts_at(0.2);
  EXPECT_EQ(loop.refused(), "material.breaking.bending_share");
  parts_at(0.3);
  EXPECT_EQ(loop.refused(), "");
  EXPECT_THAT(loop.warnings(), ElementsAre(HasSubstr("up to 1.67 times what parts them (material.breaking)")));
  parts_at(0.6);
  EXPECT_THAT(loop.warnings(), IsEmpty());
}

}  // namespace
}  // namespace knot_utm
