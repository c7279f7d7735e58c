#include "knot_utm/ros/shown_state.hpp"

#include <gtest/gtest.h>

namespace knot_utm {
namespace {

using Clock = ShownState::Clock;

Clock::time_point wall(double seconds) {
  return Clock::time_point(std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds)));
}

Moment moment(double time, double place, Eigen::Index nodes = 4) {
  Moment m;
  m.stamp = ros::Time(time);
  m.points = Points::Constant(3, nodes, place);
  m.tension = Eigen::VectorXd::Constant(nodes - 1, 10.0 * place);
  m.upper_grip = Vec3(0.0, 0.0, place);
  m.sample.load = place;
  return m;
}

TEST(ShownState, GoesFromTheLastStateButOneToTheLast) {
  ShownState shown;
  shown.add(moment(1.0, 0.0), wall(100.0));
  shown.add(moment(2.0, 1.0), wall(100.4));
  EXPECT_EQ(shown.at(wall(100.4)).points, Points::Zero(3, 4));
  const Moment half = shown.at(wall(100.6));
  EXPECT_NEAR(half.points(0, 0), 0.5, 1e-6);
  EXPECT_NEAR(half.tension[0], 5.0, 1e-5);
  EXPECT_NEAR(half.upper_grip.z(), 0.5, 1e-6);
  EXPECT_NEAR(half.stamp.toSec(), 1.5, 1e-6);
  EXPECT_EQ(half.sample.load, 0.0);  // of what was, not between
  EXPECT_FALSE(shown.settled(wall(100.79)));
  EXPECT_TRUE(shown.settled(wall(100.81)));
  EXPECT_EQ(shown.at(wall(105.0)).points, Points::Ones(3, 4));
  EXPECT_EQ(shown.at(wall(105.0)).sample.load, 1.0);
}

/// A stretched edge would be drawn across the gap, and tensions of a rod that has parted are none.
TEST(ShownState, ARodPartsAtOnce) {
  ShownState shown;
  shown.add(moment(1.0, 0.0), wall(100.0));
  Moment parted = moment(2.0, 1.0);
  parted.sample.break_arclength = 0.1;
  shown.add(parted, wall(100.4));
  EXPECT_EQ(shown.at(wall(100.4)).points, Points::Ones(3, 4));
  EXPECT_TRUE(shown.settled(wall(100.4)));
}

/// At 25 pictures a second and 3 states a second no two pictures are alike, and none goes back.
TEST(ShownState, MovesWithEveryPicture) {
  ShownState shown;
  double place = 0.0, before = -1.0;
  for (int picture = 0; picture < 100; ++picture) {
    const double now = picture / 25.0;
    if (picture % 8 == 0) shown.add(moment(now, place++), wall(now));
    const double seen = shown.at(wall(now)).points(0, 0);
    EXPECT_TRUE(picture <= 16 || seen > before) << picture;
    before = seen;
  }
}

TEST(ShownState, SettledItShowsTheLastState) {
  ShownState shown;
  shown.add(moment(1.0, 0.0), wall(1.0));
  shown.add(moment(2.0, 1.0), wall(2.0));
  shown.settle();
  EXPECT_EQ(shown.at(wall(2.0)).points, Points::Ones(3, 4));
}

TEST(ShownState, ANewSpecimenIsShownAtOnce) {
  ShownState shown;
  shown.add(moment(1.0, 5.0), wall(1.0));
  shown.begin();
  EXPECT_TRUE(shown.empty());
  shown.add(moment(1.5, 0.0), wall(2.0));
  EXPECT_EQ(shown.at(wall(2.0)).points, Points::Zero(3, 4));
  shown.add(moment(2.0, 1.0, 6), wall(3.0));  // other nodes
  EXPECT_EQ(shown.at(wall(3.0)).points, Points::Ones(3, 6));
}

}  // namespace
}  // namespace knot_utm
