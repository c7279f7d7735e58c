#include "knot_utm/rod/rod.hpp"

#include <gtest/gtest.h>

#include "knot_utm/specimen/material.hpp"

namespace knot_utm {
namespace {

TEST(Rod, MassIsDensityTimesVolumeAndEndNodesCarryHalf) {
  Material material;
  material.radius = 2e-3;
  material.density = 1000.0;
  const RodProperties rod = make_rod(material, Eigen::VectorXd::Constant(10, 0.01));
  EXPECT_EQ(rod.nodes(), 11);
  EXPECT_NEAR(rod.mass.sum(), 1000.0 * M_PI * 4e-6 * 0.1, 1e-15);
  EXPECT_NEAR(rod.mass[0], 0.5 * rod.mass[1], 1e-18);
}

}  // namespace
}  // namespace knot_utm
