#include "knot_utm/machine/frame.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "rod/materials.hpp"

namespace knot_utm {
namespace {

constexpr double kLength = 0.25;
const double kRod = nylon().stretching_stiffness / kLength;

TEST(Frame, ARigidOneTakesTheGripAlongToTheBit) {
  const Frame frame(std::numeric_limits<double>::infinity(), nylon(), 2, 0.0);
  EXPECT_TRUE(frame.rigid());
  EXPECT_EQ(frame.grip_after(0.1, 1.0 / 3.0, 1e4, kLength, 0.1, 0.0), 1.0 / 3.0);
}

/// Of a spring no stiffer than what the frame counts on, whatever the stiffness of the frame and the length of steps.
TEST(Frame, TheGripComesToWhereForcesAreInBalanceFromOneSide) {
  for (const double stiffness : {1e-3 * kRod, kRod, 1e3 * kRod}) {
    const Frame frame(stiffness, nylon(), 1, 0.0);
    for (const double specimen : {1e-3 * kRod, 0.5 * kRod, kRod}) {
      const double balance = stiffness * 0.01 / (stiffness + specimen);
      for (const double dt : {1e-6, 1e-3, 0.1}) {
        double grip = 0.0;
        for (int i = 0; i < 1000; ++i) {
          const double next = frame.grip_after(grip, 0.01, specimen * grip, kLength, dt, 0.0);
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

/// A slack knot is a hundred thousand times softer than taut strands. The grip follows the balance of forces, lagging
/// by K tau and the impedance of the strand at the speed of the crosshead only. As the knot tightens at once, the step
/// is refused until the grip does not pass the balance by more than a tenth of the force.
TEST(Frame, OnASlackSpecimenThatTightensTheGripStaysAtTheBalanceOfForces) {
  constexpr double kSpeed = 3.3e-3, kLongest = 0.17, kTightens = 0.05;
  const double soft = 1e-5 * kRod;
  for (const double stiffness : {1e-3 * kRod, 1e-1 * kRod, kRod}) {
    Frame frame(stiffness, nylon(), 1, 0.0);
    const auto force = [&](double grip) { return soft * grip + kRod * std::max(0.0, grip - kTightens); };
    double grip = 0.0, displacement = 0.0, dt = kLongest;
    int refused = 0;
    for (int i = 0; i < 400; ++i) {
      dt = std::min(2.0 * dt, kLongest);
      double next = 0.0, travel = 0.0;
      for (;; dt *= 0.5, ++refused) {
        travel = displacement + kSpeed * dt;
        next = frame.grip_after(grip, travel, force(grip), kLength, dt, 0.0);
        if (!frame.passed_balance(next - grip, next, travel, force(next), kLength, dt, 0.0, 0.0)) break;
      }
      frame.follow(next - grip, force(next) - force(grip), kLength);
      grip = next;
      displacement = travel;
      const double too_much = force(grip) - stiffness * (displacement - grip);
      ASSERT_LE(too_much, 0.1 * force(grip)) << stiffness << " N/m, step " << i;
      if (i > 40 && grip < kTightens) {  // it begins as if the specimen were taut
        EXPECT_LT(-too_much, 0.1 * kSpeed * kLongest * stiffness + kSpeed * 3e-3 * stiffness + 0.2);
      }
    }
    EXPECT_GT(grip, kTightens);
    EXPECT_GT(refused, 0);
  }
}

/// A rod that snaps leaves the grip no time to jump.
TEST(Frame, InShortStepsTheGripMovesLittle) {
  const Frame frame(1e5, nylon(), 1, 0.0);
  const double at_rest = 0.05;  // 5 kN
  const double wide = frame.grip_after(0.0, at_rest, 0.0, kLength, 1e-3, 0.0),
               narrow = frame.grip_after(0.0, at_rest, 0.0, kLength, 1e-6, 0.0);
  EXPECT_LT(narrow, 1e-2 * wide);
  const double impedance = std::sqrt(nylon().stretching_stiffness * nylon().density * M_PI) * nylon().radius;
  EXPECT_LT(narrow / 1e-6, 1e5 * at_rest / impedance) << "no faster than a wave in the rod lets it";
}

/// What lies around a roller is a mass on two strands that take its waves along. F of each step is that of the motion
/// before it.
TEST(Frame, AMassOnTheGripComesToRestHoweverSoftTheFrameAndShortTheStep) {
  constexpr double kAround = 0.06;
  const double line_density = nylon().density * M_PI * nylon().radius * nylon().radius;
  const double mass = line_density * kAround, wave = 2.0 * std::sqrt(nylon().stretching_stiffness * line_density);
  for (const double stiffness : {1.0, 1e3, 1e6}) {
    const Frame frame(stiffness, nylon(), 2, kAround);
    for (const double dt : {1e-7, 1e-5, 1e-3}) {
      double before = -1e-3, grip = 0.0, speed_before = 0.0, largest = 0.0;
      for (int i = 0; i < 1000; ++i) {
        const double speed = (grip - before) / dt;
        const double force = mass * (speed - speed_before) / dt + wave * speed;
        before = grip;
        grip = frame.grip_after(grip, grip, force, kLength, dt, 0.0);  // the crosshead along, so that K pulls nowhere
        ASSERT_LT(std::abs(grip), 1.0) << stiffness << " N/m, " << dt << " s";
        speed_before = speed;
        largest = i < 900 ? 0.0 : std::max(largest, std::abs(grip - before));
      }
      EXPECT_LT(largest, 1e-12) << stiffness << " N/m, " << dt << " s";
    }
  }
}

}  // namespace
}  // namespace knot_utm
