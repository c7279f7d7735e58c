// Pins that put a slack loop on its rollers.
#include "knot_utm/machine/loop_pins.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace knot_utm {
namespace {

constexpr double kClearance = 0.2;

Points points_of(const std::vector<Vec3>& corners) {
  constexpr int kBetween = 50;
  Points out(3, static_cast<Eigen::Index>(kBetween * corners.size()));
  Eigen::Index i = 0;
  for (std::size_t k = 0; k < corners.size(); ++k)
    for (int j = 0; j < kBetween; ++j, ++i)
      out.col(i) = corners[k] + (corners[(k + 1) % corners.size()] - corners[k]) * (j / static_cast<double>(kBetween));
  return out;
}

double room(const Points& loop, const Pin& pin) { return (loop.colwise() - pin.place).colwise().norm().minCoeff(); }

TEST(LoopPins, StandAtTheEndsOfALoopThatIsWideEnough) {
  const Points loop = points_of({{0, 0, 0}, {4, 0, 0}, {4, 0, 20}, {0, 0, 20}});
  const std::vector<Pin> pins = pins_in(loop, 1.0, kClearance);
  ASSERT_EQ(pins.size(), 2u);
  for (const Pin& pin : pins) {
    EXPECT_EQ(pin.radius, 1.0);
    EXPECT_GE(room(loop, pin), 1.0 + kClearance);
  }
  EXPECT_NEAR(pins[0].place[2], 1.2, 0.3);
  EXPECT_NEAR(pins[1].place[2], 18.8, 0.3);
}

/// The near side lies across the far one in the middle, as that of a loop that was stretched while it was tied.
TEST(LoopPins, StandInWhatTheLoopLeavesOfItsEnds) {
  const Points loop = points_of({{0, 0, 0}, {4, 0, 0}, {4, 0, 4}, {-1, 0, 10}, {4, 0, 16}, {4, 0, 20}, {0, 0, 20}});
  const std::vector<Pin> pins = pins_in(loop, 3.0, kClearance);
  ASSERT_EQ(pins.size(), 2u);
  EXPECT_LT(pins[0].radius, 3.0);
  EXPECT_LT(pins[0].place[2], 6.0);
  EXPECT_GT(pins[1].place[2], 14.0);
  for (const Pin& pin : pins) EXPECT_GE(room(loop, pin), pin.radius + kClearance);
}

TEST(LoopPins, FindNoRoomInALoopThatIsClosed) {
  EXPECT_THAT(pins_in(points_of({{0, 0, 0}, {0.1, 0, 0}, {0.1, 0, 20}, {0, 0, 20}}), 1.0, kClearance),
              testing::IsEmpty());
}

}  // namespace
}  // namespace knot_utm
