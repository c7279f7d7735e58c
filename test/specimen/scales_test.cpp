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

TEST(SpecimenScales, SimilarSpecimensOfAnyDensityMoveAlike) {
  for (const double lengths : {0.04, 1.0, 6.0})
    for (const double forces : {1e-5, 1.0, 1e4}) {
      Material material = similar(lengths, forces);
      // More than tau = 2e-4 s takes.
      material.density *= std::pow((1.0 + lengths) * 2e-4 / specimen_scales(material).own_time, 2);
      const Material moving = as_it_moves(material, {}, 0.0);
      EXPECT_NEAR(specimen_scales(moving).own_time, 2e-4, 1e-16);
      const double h2 = material.radius * material.radius;
      EXPECT_NEAR(drag_to_rest(moving, false) * h2 * h2 / material.bending_stiffness, 1.2e-7, 1e-19);
      EXPECT_NEAR(specimen_scales(moving).rest_speed / material.radius, 0.0063, 1e-15);
    }
}

TEST(SpecimenScales, SimilarLoopsAccelerateTheSameMassWhateverTheirOwnIs) {
  Material light = nylon();
  light.density *= 1e-3;
  EXPECT_NEAR(inertia_factor(light, {}, 0.0), 1e3 * inertia_factor(nylon(), {}, 0.0), 1e-9);
  EXPECT_LT(inertia_factor(nylon(), {}, 0.0), 1.0);
  // A rod with slack swings, and no more than its own mass is accelerated.
  for (const double slack : {1e-3, 10.0}) EXPECT_LE(inertia_factor(light, {}, slack), 1.0) << slack;
}

TEST(SpecimenScales, ALoopHasADragHoweverLightItIs) {
  Material thread = nylon();
  for (const double lighter : {1e-3, 1e-9}) {
    thread.density = lighter * nylon().density;
    EXPECT_NEAR(drag_to_rest(thread, true) * std::pow(thread.radius, 4) / thread.bending_stiffness, 1.2e-9, 1e-21);
    EXPECT_EQ(drag_to_rest(thread, false), 3.0 * specimen_scales(thread).mass);
  }
  EXPECT_EQ(drag_to_rest(nylon(), true), drag_to_rest(nylon(), false));
}

TEST(SpecimenScales, ASlackLoopSpringsFast) {
  const Material material = nylon();
  const double h = material.radius, tight = 100.0 * h, slack = 1000.0 * h, radius = slack / (2.0 * M_PI);
  EXPECT_EQ(inertia_factor(material, {}, tight), inertia_factor(material, {}, 0.0));
  const SpecimenScales moving = specimen_scales(as_it_moves(material, {}, slack));
  EXPECT_NEAR(radius * radius * std::sqrt(moving.mass / material.bending_stiffness), 0.1, 1e-12);
}

}  // namespace
}  // namespace knot_utm
