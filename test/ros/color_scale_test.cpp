#include "knot_utm/ros/color_scale.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace knot_utm {
namespace {

ColorScale of_rope(double breaking_force) {
  Material material;
  material.breaking_force = breaking_force;
  return ColorScale::of_tension(material, LoadCellOptions());
}

TEST(ColorScale, EndsAtARoundNumberBeyondTheBreakingForce) {
  EXPECT_DOUBLE_EQ(of_rope(2500.0).full(), 5000.0);
  EXPECT_DOUBLE_EQ(of_rope(5000.0).full(), 5000.0);
  EXPECT_DOUBLE_EQ(of_rope(0.011).full(), 0.02);
  Material material;  // of a rod that does not part: half of its stiffness, or its pre-load
  material.stretching_stiffness = 22.15;
  LoadCellOptions cell;
  EXPECT_DOUBLE_EQ(ColorScale::of_tension(material, cell).full(), 20.0);
  cell.capacity = 4.0;
  EXPECT_DOUBLE_EQ(ColorScale::of_tension(material, cell).full(), 5.0);
  material.tying_preload = 40.0;
  EXPECT_DOUBLE_EQ(ColorScale::of_tension(material, cell).full(), 50.0);
}

/// Equal ratios are equally far apart, and the sliding of a rope that locks at kilonewtons is not lost.
TEST(ColorScale, TellsDecadesApart) {
  const ColorScale scale = of_rope(5000.0);
  EXPECT_DOUBLE_EQ(scale.place(5000.0), 1.0);
  EXPECT_DOUBLE_EQ(scale.place(0.0), 0.0);
  EXPECT_DOUBLE_EQ(scale.place(-20.0), -scale.place(20.0));
  EXPECT_NEAR(scale.place(500.0) - scale.place(50.0), 0.25, 0.01);
  EXPECT_GT(scale.place(2.0), 0.15);
  EXPECT_DOUBLE_EQ(scale.place(1e6), 1.0);
}

/// Of a polypropylene rope that slides under 2 N and ends at 5000 N.
TEST(ColorScale, ShowsSlidingAsNeitherZeroNorLocked) {
  const ColorScale scale = of_rope(5000.0);
  const auto saturation = [&scale](double tension) {
    const auto c = scale.color(tension);
    return std::max({c.r, c.g, c.b}) - std::min({c.r, c.g, c.b});
  };
  EXPECT_NEAR(saturation(0.0), 0.0, 1e-6);
  EXPECT_GT(saturation(2.0), 0.3);
  EXPECT_GT(scale.color(2.0).g, scale.color(2.0).r);  // green
  EXPECT_GT(scale.color(500.0).r, scale.color(500.0).g);
}

TEST(ColorScale, BarHasTheColoursOfItsTicks) {
  for (const ColorScale& scale : {of_rope(5000.0), ColorScale::of_curvature()}) {
    const ColorBar bar = scale.bar();
    ASSERT_EQ(bar.ticks.size(), bar.places.size());
    EXPECT_DOUBLE_EQ(bar.places.front(), 0.0);
    EXPECT_DOUBLE_EQ(bar.places.back(), 1.0);
    for (std::size_t i = 0; i < bar.ticks.size(); ++i) {
      const double last = static_cast<double>(bar.colors.size() - 1);
      const auto& on_bar = bar.colors[static_cast<std::size_t>(std::lround(bar.places[i] * last))];
      const auto expected = scale.color(bar.ticks[i]);
      EXPECT_NEAR(on_bar.r, expected.r, 0.02) << bar.ticks[i];
      EXPECT_NEAR(on_bar.b, expected.b, 0.02) << bar.ticks[i];
    }
  }
}

}  // namespace
}  // namespace knot_utm
