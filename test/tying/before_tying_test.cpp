#include "knot_utm/tying/before_tying.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

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

TEST(BeforeTying, NothingIsSaidOfTheShippedRope) {
  const Loop loop;
  EXPECT_EQ(loop.refused(), "");
  EXPECT_THAT(loop.warnings(), IsEmpty());
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

TEST(BeforeTying, APreloadThatLeavesTheCoilsOpenIsAWarning) {
  Loop loop;
  loop.specimen.preload = 0.5 * closing_preload(loop.material);
  EXPECT_EQ(loop.refused(), "");
  EXPECT_THAT(loop.warnings(), ElementsAre(HasSubstr("leaves the coils open, at a radius of about 2.83 radii")));
}

/// A figure-eight has no free end: a pre-load can be neither too large nor too small where nothing is pulled with it.
TEST(BeforeTying, NothingIsSaidOfThePreloadOfAKnotThatNothingTies) {
  Loop loop;
  KnotDrawing drawing;
  loop.specimen.preload = 1e-3 * closing_preload(loop.material);
  for (const bool pulled : {true, false}) {
    drawing.tie.assign(pulled ? 1 : 0, {{"tail", 1.0}});
    loop.specimen.drawing = std::make_shared<const KnotDrawing>(drawing);
    EXPECT_EQ(loop.refused(), pulled ? "specimen.preload" : "");
    EXPECT_EQ(loop.warnings().empty(), !pulled);
    EXPECT_EQ(preload_acts(loop.specimen), pulled);
  }
  drawing.weights = {{"tail", 0.1}};
  loop.specimen.drawing = std::make_shared<const KnotDrawing>(drawing);
  EXPECT_TRUE(preload_acts(loop.specimen));
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

TEST(BeforeTying, ARodThatYieldsIsAWarning) {
  Loop loop;
  loop.material.yield_strain = 0.07;
  EXPECT_THAT(loop.warnings(), ElementsAre(HasSubstr("the material yields at a strain of 0.07")));
  loop.material.yield_strain.reset();
  loop.material.stretching_stiffness = 4.0 * bending_force(loop.material);
  loop.specimen.preload = 10.0 * bending_force(loop.material);
  EXPECT_THAT(loop.warnings(), testing::Contains(HasSubstr("stretches the rod to 3.5 times its length")));
}

TEST(BeforeTying, EdgesTooLongForTheBendsOfARopeAreAWarning) {
  Loop loop;
  loop.specimen.refinement = 1.0;
  EXPECT_THAT(
      loop.warnings(),
      ElementsAre(HasSubstr(
          "edges of 1.01 radii are too long for the bends of a tied knot, in which the rod turns by 0.504 rad")));
  loop.material.stretching_stiffness =
      4.0 * loop.material.bending_stiffness / (loop.material.radius * loop.material.radius);
  EXPECT_THAT(loop.warnings(), Not(testing::Contains(HasSubstr("edges of"))));
}

}  // namespace
}  // namespace knot_utm
