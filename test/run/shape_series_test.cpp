#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <sstream>

#include "knot_utm/run/run_writer.hpp"

namespace knot_utm {
namespace {

using ::testing::HasSubstr;

constexpr double kPeriod = 0.25;  // between two records [s]

/// The `number`th, of a rod of three nodes.
Record reading(int number) {
  Record record;
  record.answer.time = kPeriod * number;
  record.shape = Points::Constant(3, 3, number);
  record.tension.resize(2);
  record.tension << 1.5, -2.5;
  RodReadings readings{Eigen::VectorXd::Constant(1, 0.125), Eigen::VectorXd(3)};
  readings.contact_load << 0.0, 7e4, 0.5;
  record.readings = readings;
  return record;
}

std::set<double> times_in(const std::string& csv) {
  std::set<double> out;
  std::istringstream lines(csv);
  std::string line;
  for (int row = 1; std::getline(lines, line); ++row)
    if (row > 2) out.insert(std::stod(line));
  return out;
}

TEST(ShapeSeries, KeepsEvenlySpacedShapesWithTheFirstAndTheLastHoweverLongTheTest) {
  for (const int count : {1, 2, 119, 120, 121, 122, 240, 241, 1000, 5003}) {
    ShapeSeries series;
    for (int i = 0; i < count; ++i) series.add(reading(i));
    const std::set<double> times = times_in(series.csv());
    EXPECT_LE(times.size(), ShapeSeries::kMost + 1) << count;
    EXPECT_GE(times.size(), std::min<std::size_t>(static_cast<std::size_t>(count), ShapeSeries::kMost / 2)) << count;
    EXPECT_EQ(*times.begin(), 0.0);
    EXPECT_EQ(*times.rbegin(), kPeriod * (count - 1));
    std::set<double> steps;
    for (auto t = times.begin(), next = std::next(t); next != times.end(); ++t, ++next) steps.insert(*next - *t);
    EXPECT_LE(steps.size(), 2u) << count << ": all but the last are equal";
  }
}

TEST(ShapeSeries, HasARowANodeWithWhatIsKnownThere) {
  ShapeSeries series;
  series.add(reading(4));
  EXPECT_EQ(series.csv(),
            "time,node,x,y,z,tension,twist,contact_force\n"
            "s,-,m,m,m,N,rad/m,N/m\n"
            "1,0,4,4,4,1.5,nan,0\n"
            "1,1,4,4,4,-2.5,0.125,70000\n"
            "1,2,4,4,4,nan,nan,0.5\n");
  series.add_parted(1.5, Points::Zero(3, 1));
  EXPECT_THAT(series.csv(), HasSubstr("\n1.5,0,0,0,0,nan,nan,nan\n"));
}

TEST(ShapeSeries, NumbersSeveralRopesAndKnowsNothingBetweenThem) {
  ShapeSeries series({1});
  Record record = reading(4);
  record.shape = Points::Constant(3, 4, 4.0);
  record.tension = Eigen::Vector3d(1.5, 0.0, 2.5);
  record.readings = RodReadings{Eigen::Vector2d(0.25, 0.5), Eigen::VectorXd::Zero(4)};
  series.add(record);
  EXPECT_EQ(series.csv(),
            "time,node,x,y,z,tension,twist,contact_force,rope\n"
            "s,-,m,m,m,N,rad/m,N/m,-\n"
            "1,0,4,4,4,1.5,nan,0,1\n"
            "1,1,4,4,4,nan,nan,0,1\n"
            "1,2,4,4,4,2.5,nan,0,2\n"
            "1,3,4,4,4,nan,nan,0,2\n");
}

}  // namespace
}  // namespace knot_utm
