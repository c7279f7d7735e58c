#include <gtest/gtest.h>

#include <cmath>

#include "knot_utm/topology/knot_hole.hpp"

namespace knot_utm {
namespace {

constexpr int kNodes = 400;
constexpr double kRadius = 0.02;

/// An open rod once around two rollers that are `distance` apart, turned by `turn` along itself [m].
Points loop(double distance, double turn) {
  const double around = M_PI * kRadius, whole = 2.0 * (distance + around);
  Points out(3, kNodes);
  for (int i = 0; i < kNodes; ++i) {
    double s = 0.99 * whole * i / (kNodes - 1) + 0.5 * distance + turn;  // from the foot of the near side, upwards
    s = std::fmod(s + whole, whole);
    if (s < distance) {
      out.col(i) = Vec3(kRadius, 0.0, s);
    } else if (s < distance + around) {
      const double angle = (s - distance) / kRadius;
      out.col(i) = Vec3(kRadius * std::cos(angle), 0.0, distance + kRadius * std::sin(angle));
    } else if (s < 2.0 * distance + around) {
      out.col(i) = Vec3(-kRadius, 0.0, 2.0 * distance + around - s);
    } else {
      const double angle = (s - 2.0 * distance - around) / kRadius;
      out.col(i) = Vec3(-kRadius * std::cos(angle), 0.0, -kRadius * std::sin(angle));
    }
  }
  return out;
}

TEST(LoopTurn, IsTheWayOfTheLoopAlongItself) {
  LoopTurn turned;
  turned.add(loop(0.25, 0.0));
  EXPECT_EQ(turned.largest(), 0.0);
  turned.add(loop(0.25, 0.03));
  EXPECT_NEAR(turned.largest(), 0.03, 2e-3);
  turned.add(loop(0.25, -0.01));
  EXPECT_NEAR(turned.largest(), 0.03, 2e-3);
}

TEST(LoopTurn, IsNotTheWayOfTheRollers) {
  LoopTurn turned;
  turned.add(loop(0.25, 0.0));
  turned.add(loop(0.32, 0.0));
  EXPECT_LT(turned.largest(), 3e-3);
}

}  // namespace
}  // namespace knot_utm
