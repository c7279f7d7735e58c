// What a bag that is played by itself shows beside the rod: without rviz, and without a display.
#include "knot_utm/ros/bag_panel.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "knot_utm/machine/load_cell.hpp"
#include "knot_utm/ros/names.hpp"

namespace knot_utm {
namespace {

constexpr double kHalf = 0.25;        // of the panel's height [m]
const Vec3 kMiddle(0.01, 0.02, 0.2);  // of the panel [m]
constexpr double kMachine = 0.63;     // half the width that is left to the machine
constexpr double kWidest = 1.55;      // half the width of all

using testing::HasSubstr;
using testing::Not;
using visualization_msgs::Marker;

Sample reading(double extension, double load, Phase phase = Phase::kPull) {
  Sample out;
  out.time = 7.25;
  out.phase = phase;
  out.extension = extension;
  out.load = out.highest_load = load;
  out.balance_offset = 0.2;
  out.knot_distance = 0.1;
  return out;
}

class BagPanelTest : public testing::Test {
 protected:
  static ColorScale scale() {
    Material material;
    material.breaking_force = 500.0;
    return ColorScale::of_tension(material, LoadCellOptions());
  }
  std::vector<Marker> draw(const Sample& sample) const { return panel.draw(sample, "sliding", scale()); }
  static std::string text_of(const std::vector<Marker>& markers) {
    std::string all;
    for (const Marker& marker : markers) all += marker.text + "\n";
    return all;
  }
  /// A place in halves of the panel's height.
  static Vec3 place(const geometry_msgs::Point& point) { return (Vec3(point.x, point.y, point.z) - kMiddle) / kHalf; }
  /// Corners of a kind of lines.
  static std::vector<Vec3> corners(const std::vector<Marker>& markers, const char* ns) {
    std::vector<Vec3> out;
    for (const Marker& marker : markers)
      if (marker.ns == ns)
        for (const auto& point : marker.points) out.push_back(place(point));
    return out;
  }
  void slide_and_lock() {
    for (int i = 0; i < 700; ++i) panel.add(reading(1e-4 * i, i < 10 ? 0.6 * i : 6.0), true);
    for (int i = 700; i < 1000; ++i) panel.add(reading(1e-4 * i, 6.0 + 20.0 * (i - 700)), false);
  }

  BagPanel panel{"nylon, fisherman", kMiddle, kHalf};
};

TEST_F(BagPanelTest, SaysEachReadingWithItsNameAndUnit) {
  const std::string text = text_of(draw(reading(0.0, 12.5)));
  for (const char* words :
       {"nylon, fisherman", "time 7.2 s", "state: running", "phase: pull", "motion pattern: sliding",
        "extension 0.0 mm", "load 12.5 N", "knot distance 100.0 mm", "end-to-end distance 0.0 mm", "red 500 N"})
    EXPECT_THAT(text, HasSubstr(words));
}

TEST_F(BagPanelTest, SaysHowTheTestStands) {
  Sample sample = reading(0.1, 480.0);
  EXPECT_EQ(condition_of(sample, "untangling"), "a knot opened");
  sample.knot_type = KnotType::kChanged;
  EXPECT_EQ(condition_of(sample, "untangling"), "came undone");
  sample.knot_type = KnotType::kCrossed;
  EXPECT_EQ(condition_of(sample, "sliding"), "ran through itself");
  sample.status = BenchStatus::kFailed;
  EXPECT_EQ(condition_of(sample, "sliding"), "the physics gave up");
  sample.status = BenchStatus::kBroken;
  sample.load = -3.0;  // its ends recoil
  const std::string text = text_of(draw(sample));
  EXPECT_THAT(text, HasSubstr("state: broke\n"));
  EXPECT_THAT(text, HasSubstr("load at the break 480 N"));
  EXPECT_THAT(text, HasSubstr("tension not known"));
  EXPECT_THAT(text, Not(HasSubstr("-3 N")));
  EXPECT_THAT(text, Not(HasSubstr("red")));
}

TEST_F(BagPanelTest, TheCurveBeginsAtTheZeroOfThePull) {
  for (const Phase phase : {Phase::kTie, Phase::kRelease, Phase::kMount}) {
    Sample before = reading(0.3, 900.0, phase);
    before.balance_offset = 0.0;
    panel.add(before, false);
  }
  EXPECT_TRUE(corners(draw(reading(0.0, 0.0)), "curve").empty());
  Sample hold = reading(0.2, 700.0, Phase::kHold);
  hold.balance_offset = 0.0;
  panel.add(hold, false);
  panel.add(reading(0.0, 0.0, Phase::kBalance), false);
  panel.add(reading(0.01, 3.0), false);
  panel.add(reading(0.02, 4.0), false);
  const std::vector<Marker> markers = draw(reading(0.02, 4.0));
  EXPECT_EQ(corners(markers, "curve").size(), 4u);
  EXPECT_THAT(text_of(markers), HasSubstr("\n30\n"));  // [mm]
  EXPECT_THAT(text_of(markers), HasSubstr("\n5\n"));   // [N]
}

TEST_F(BagPanelTest, ShowsSmallLoadsAgainWhereLargeOnesHideThem) {
  panel.add(reading(0.0, 0.0), true);
  panel.add(reading(0.02, 6.0), true);
  EXPECT_THAT(text_of(draw(reading(0.02, 6.0))), Not(HasSubstr("small loads")));
  slide_and_lock();
  EXPECT_THAT(text_of(draw(reading(0.1, 6000.0))), HasSubstr("small loads [N]"));
}

/// Texts are as wide as their letters, which rviz draws at most half as wide as high. It sets the lines of one text 1
/// cm apart, which is out of the panel of a thin thread: each line is a text of its own.
TEST_F(BagPanelTest, AllOfItIsInItsPlaceAndLeavesTheMachineFree) {
  slide_and_lock();
  for (const Sample& sample : {reading(0.1, 6000.0), reading(-0.1, -123456.0)})
    for (const Marker& marker : draw(sample)) {
      EXPECT_EQ(marker.header.frame_id, names::kBaseFrame);
      if (marker.type != Marker::TEXT_VIEW_FACING) continue;
      const Vec3 middle = place(marker.pose.position);
      EXPECT_THAT(marker.text, Not(HasSubstr("\n")));
      const double letter = marker.scale.z / kHalf;
      const double half_width = 0.25 * letter * static_cast<double>(marker.text.size());
      EXPECT_LE(std::abs(middle.x()) + half_width, kWidest) << marker.text;
      EXPECT_LE(std::abs(middle.z()) + 0.5 * letter, 1.0) << marker.text;
      EXPECT_GE(std::abs(middle.x()) - half_width, kMachine) << marker.text;
    }
  std::vector<Vec3> drawn = corners(draw(reading(0.1, 6000.0)), "curve"),
                    axes = corners(draw(reading(0.1, 6000.0)), "axes");
  ASSERT_FALSE(drawn.empty());
  EXPECT_LT(drawn.size(), 1000u);  // however long the test
  const auto range = [](const std::vector<Vec3>& points, int i) {
    const auto [low, high] =
        std::minmax_element(points.begin(), points.end(), [i](const Vec3& a, const Vec3& b) { return a[i] < b[i]; });
    return std::pair((*low)[i], (*high)[i]);
  };
  for (const int i : {0, 2}) {
    EXPECT_GE(range(drawn, i).first, range(axes, i).first - 1e-9);
    EXPECT_LE(range(drawn, i).second, range(axes, i).second + 1e-9);
    EXPECT_LE(range(axes, i).second, i == 0 ? kWidest : 1.0);
  }
  EXPECT_GT(range(axes, 0).first, kMachine);
}

}  // namespace
}  // namespace knot_utm
