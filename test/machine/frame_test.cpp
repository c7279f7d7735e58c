#include "knot_utm/machine/frame.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "knot_utm/rod/invalid_input.hpp"
#include "rod/materials.hpp"

namespace knot_utm {
namespace {

constexpr double kLength = 0.25;
const double kRod = nylon().stretching_stiffness / kLength;

TEST(Frame, ARigidOneTakesTheGripAlongToTheBit) {
  const Frame frame(std::numeric_limits<double>::infinity(), nylon(), 2, kLength);
  EXPECT_TRUE(frame.rigid());
  EXPECT_EQ(frame.grip_after(0.1, 1.0 / 3.0, 1e4, 0.1), 1.0 / 3.0);
}

TEST(Frame, WithoutAForceTheGripComesToTheCrosshead) {
  const Frame frame(1e6, nylon(), 1, kLength);
  double grip = 0.0;
  for (int i = 0; i < 200; ++i) grip = frame.grip_after(grip, 0.01, 0.0, 0.1);
  EXPECT_DOUBLE_EQ(grip, 0.01);
}

/// Of a spring no stiffer than what the frame counts on, whatever the stiffness of the frame and the length of steps.
TEST(Frame, TheGripComesToWhereForcesAreInBalanceFromOneSide) {
  for (const double stiffness : {1e-3 * kRod, kRod, 1e3 * kRod}) {
    const Frame frame(stiffness, nylon(), 1, kLength);
    for (const double specimen : {1e-3 * kRod, 0.5 * kRod, kRod}) {
      const double balance = stiffness * 0.01 / (stiffness + specimen);
      for (const double dt : {1e-6, 1e-3, 0.1}) {
        double grip = 0.0;
        for (int i = 0; i < 1000; ++i) {
          const double next = frame.grip_after(grip, 0.01, specimen * grip, dt);
          ASSERT_GE(next, grip * (1.0 - 1e-15));
          ASSERT_LE(next, balance * (1.0 + 1e-12));
          grip = next;
        }
        if (dt == 0.1 && stiffness >= kRod) {
          EXPECT_NEAR(grip, balance, 1e-12 * balance);
        }
      }
    }
  }
}

/// A rod that snaps leaves the grip no time to jump.
TEST(Frame, InShortStepsTheGripMovesLittle) {
  const Frame frame(1e5, nylon(), 1, kLength);
  const double at_rest = 0.05;  // 5 kN
  const double wide = frame.grip_after(0.0, at_rest, 0.0, 1e-3), narrow = frame.grip_after(0.0, at_rest, 0.0, 1e-6);
  EXPECT_LT(narrow, 1e-2 * wide);
  const double impedance = std::sqrt(nylon().stretching_stiffness * nylon().density * M_PI) * nylon().radius;
  EXPECT_LT(narrow / 1e-6, 1e5 * at_rest / impedance) << "no faster than a wave in the rod lets it";
}

TEST(Frame, HasAStiffness) {
  EXPECT_THROW(Frame(0.0, nylon(), 1, kLength), InvalidInput);
  EXPECT_THROW(Frame(std::nan(""), nylon(), 1, kLength), InvalidInput);
}

}  // namespace
}  // namespace knot_utm
