#include "knot_utm/machine/frame.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "knot_utm/machine/load_cell.hpp"
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

TEST(LoadCell, ReadsTheTrueForceUnlessToldOtherwise) {
  LoadCell cell{LoadCellOptions()};
  EXPECT_EQ(cell.read(12.345), 12.345);
  cell.balance(2.0);
  EXPECT_EQ(cell.read(12.5), 10.5);
  EXPECT_EQ(cell.balanced(2.0), 0.0);
}

TEST(LoadCell, NoiseHasItsDeviationAndFollowsFromTheSeed) {
  LoadCellOptions options;
  options.noise = 0.1;
  LoadCell cell(options);
  LoadCell same(options);
  options.seed = 2;
  LoadCell other(options);
  constexpr int kReadings = 20000;
  double sum = 0.0;
  double squares = 0.0;
  int equal = 0;
  for (int i = 0; i < kReadings; ++i) {
    const double reading = cell.read(5.0);
    EXPECT_EQ(same.read(5.0), reading);
    equal += other.read(5.0) == reading ? 1 : 0;
    sum += reading - 5.0;
    squares += (reading - 5.0) * (reading - 5.0);
  }
  // Five standard deviations of mean and of variance.
  EXPECT_NEAR(sum / kReadings, 0.0, 5.0 * 0.1 / std::sqrt(kReadings));
  EXPECT_NEAR(squares / kReadings, 0.01, 5.0 * 0.01 * std::sqrt(2.0 / kReadings));
  EXPECT_LT(equal, 3);
}

/// Of 400 cells of one class; and reading two forces tells the gain of each.
TEST(LoadCell, AccuracyIsAnErrorOfTheGainWithinItsBoundsAndAllOverThem) {
  constexpr int kCells = 400;
  double sum = 0.0, squares = 0.0;
  for (unsigned seed = 0; seed < kCells; ++seed) {
    LoadCellOptions options;
    options.accuracy = 0.005;
    options.seed = seed;
    LoadCell cell(options);
    cell.balance(10.0);
    const double share = (cell.read(110.0) - 100.0) / (100.0 * options.accuracy);
    EXPECT_NEAR(cell.read(-190.0), -2.0 * cell.read(110.0), 1e-10);
    EXPECT_EQ(cell.read(10.0), 0.0);
    EXPECT_LE(std::abs(share), 1.0);
    sum += share;
    squares += share * share;
  }
  // Five standard deviations of mean and mean square of a uniform distribution from -1 to 1.
  EXPECT_NEAR(sum / kCells, 0.0, 5.0 * std::sqrt(1.0 / 3.0 / kCells));
  EXPECT_NEAR(squares / kCells, 1.0 / 3.0, 5.0 * std::sqrt(4.0 / 45.0 / kCells));
}

TEST(LoadCell, ItsClassSaysHowFarAReadingMayBeOff) {
  LoadCellOptions cell;
  cell.capacity = 1000.0;
  EXPECT_FALSE(class_error(cell, 100.0));
  cell.accuracy = 0.005;
  EXPECT_DOUBLE_EQ(*class_error(cell, -100.0), 0.5);
  cell.floor = 0.01;
  EXPECT_DOUBLE_EQ(*class_error(cell, 10.0), 0.05);
  EXPECT_DOUBLE_EQ(*class_error(cell, 9.9), 10.0);
  EXPECT_TRUE(is_below_floor(cell, -9.9));
  EXPECT_FALSE(is_below_floor(cell, 10.0));
}

}  // namespace
}  // namespace knot_utm
