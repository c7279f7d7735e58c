#include <gtest/gtest.h>

#include <cmath>

#include "knot_utm/grips/grips.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/specimen/material.hpp"

namespace knot_utm {
namespace {

constexpr double kRadius = 3.175e-3;

Material rod() {
  Material out;
  out.radius = kRadius;
  return out;
}

SpecimenOptions specimen(const char* knot) {
  SpecimenOptions out = knot_of(knot_named(knot)).defaults(kRadius);
  out.knot = knot_named(knot);
  return out;
}

MachineOptions with(GripKind grips) {
  MachineOptions out;
  out.grips = grips;
  return out;
}

/// A post that stands for the lower grip is drawn as the specimen's own supports have it, aslant where they have it so.
TEST(GripBodies, ThePostOfACapstan) {
  for (const double wrap : {M_PI, 4.0 * M_PI}) {
    SpecimenOptions capstan = specimen("capstan");
    capstan.wrap = wrap;
    const std::vector<GripBody> bodies = grip_bodies(capstan, with(GripKind::kClamps), rod());
    ASSERT_EQ(bodies.size(), 2u);
    const GripBody& post = bodies.front();
    EXPECT_EQ(post.cylinder_radius, 0.5 * capstan.post_diameter);
    const Roller borne_by = knot_of(capstan).supports(capstan, rod()).posts.front();
    EXPECT_EQ(post.axis, borne_by.axis);
    EXPECT_EQ(post.axis == Vec3::UnitY(), wrap == M_PI);
    EXPECT_EQ(bodies[1].cylinder_radius, 0.0);
    EXPECT_TRUE(bodies[1].goes_up);

    // The box holds the rims of both ends.
    const Vec3 side = post.axis.cross(Vec3::UnitX()).normalized(), other = post.axis.cross(side);
    Vec3 farthest = Vec3::Zero();
    for (int i = 0; i < 360; ++i) {
      const double angle = i * M_PI / 180.0;
      const Vec3 rim = post.half_length(kRadius) * post.axis +
                       post.cylinder_radius * (std::cos(angle) * side + std::sin(angle) * other);
      farthest = farthest.cwiseMax(rim.cwiseAbs());
    }
    EXPECT_LT((farthest - post.half_box(kRadius)).norm(), 1e-3 * post.cylinder_radius);
  }
}

}  // namespace
}  // namespace knot_utm
