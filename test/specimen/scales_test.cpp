// What a specimen is measured in, and what mass and drag follow from it.
#include "knot_utm/specimen/scales.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "rod/materials.hpp"

namespace knot_utm {
namespace {

Material similar(double lengths, double forces) {
  Material out = nylon();
  out.radius *= lengths;
  out.bending_stiffness *= forces * lengths * lengths;
  return out;
}

TEST(SpecimenScales, AreMassAndTheTimeInWhichItBends) {
  const Material material = nylon();
  const double h = material.radius, mass = material.density * M_PI * h * h;
  const SpecimenScales scales = specimen_scales(material);
  EXPECT_DOUBLE_EQ(scales.mass, mass);
  EXPECT_DOUBLE_EQ(scales.own_time, h * h * std::sqrt(mass / material.bending_stiffness));
}

TEST(SpecimenScales, SimilarSpecimensOfAnyDensityMoveAlike) {
  for (const double lengths : {0.04, 1.0, 6.0})
    for (const double forces : {1e-5, 1.0, 1e4}) {
      Material material = similar(lengths, forces);
      material.density *= 1.0 + lengths;
      const Material moving = as_it_moves(material, {});
      EXPECT_NEAR(specimen_scales(moving).own_time, 2e-4, 1e-16);
      const double h2 = material.radius * material.radius;
      EXPECT_NEAR(drag_to_rest(moving) * h2 * h2 / material.bending_stiffness, 1.2e-7, 1e-19);
      EXPECT_NEAR(specimen_scales(moving).rest_speed / material.radius, 0.0063, 1e-15);
    }
}

TEST(SettlingDrag, RelaxesWavesOfALengthInATenthOfItsTime) {
  const Material material = nylon();
  const double wave = 20.0 * material.radius, time = 0.5;
  const double fading_rate = material.bending_stiffness * std::pow(2.0 * M_PI / wave, 4);  // times the drag [1/s]
  EXPECT_NEAR(settling_drag(material, wave, time) / fading_rate, 0.1 * time, 1e-12);
}

TEST(SpecimenScales, AMethodMayAskForTheRodsOwnMass) {
  PhysicsOptions physics;
  physics.inertia = 1.0;
  EXPECT_EQ(as_it_moves(nylon(), physics).density, nylon().density);
  physics.inertia = 0.25;
  EXPECT_EQ(inertia_factor(nylon(), physics), 0.25);
}

}  // namespace
}  // namespace knot_utm
