#include "knot_utm/run/csv.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>

#include "complaint.hpp"
#include "knot_utm/record/sample.hpp"
#include "knot_utm/run/run_folder.hpp"
#include "knot_utm/run/run_writer.hpp"
#include "run/own_folder.hpp"

namespace knot_utm {
namespace {

using testing::HasSubstr;

class Csv : public MadeFolder {
 protected:
  std::string complaint(const std::string& content) {
    std::ofstream(path_) << content;
    return complaint_of([&] { read_curve(path_); });
  }
  const std::string path_ = in("curve.csv");
};

TEST_F(Csv, CurveIsExactlyAsPromised) {
  CurveWriter writer(path_);
  Sample sample;
  sample.time = 1.0 / 3.0;
  sample.extension = 0.01;
  sample.load = 2.5;
  sample.end_to_end = 0.26;
  sample.force_lower = 2.0;
  sample.balance_offset = 0.25;
  sample.phase = Phase::kPull;
  writer.write(sample);
  // Read while the writer is still open: a killed run keeps its rows.
  EXPECT_EQ(read_whole(path_),
            "time,extension,load,knot_distance,end_to_end,load_lower,phase,balance_offset\n"
            "s,m,N,m,m,N,-,N\n"
            "0.3333333333333333,0.01,2.5,nan,0.26,1.75,pull,0.25\n");
  EXPECT_EQ(writer.rows(), 1u);
}

/// What judges a curve needs the force that the rod bears: both loads are balanced, by an amount that stands beside
/// them. Files of earlier versions have a true load_lower, and no such column.
TEST_F(Csv, TheTrueForceIsTheBalancedOneAndItsOffset) {
  Sample sample;
  sample.phase = Phase::kPull;
  sample.load = 2.0;
  sample.force_upper = sample.force_lower = 5.0;
  sample.balance_offset = 3.0;
  {
    CurveWriter writer(path_);
    writer.write(sample);
  }
  const Pull pull = pull_of(read_curve(path_));
  ASSERT_EQ(pull.size(), 1u);
  EXPECT_EQ(read_curve(path_)[0].load, read_curve(path_)[0].load_lower);
  EXPECT_EQ(pull[0].force, 2.0);
  EXPECT_EQ(pull[0].borne, 5.0);
  std::ofstream(path_) << "time,extension,load,knot_distance,end_to_end,load_lower,phase\ns,m,N,m,m,N,-\n"
                          "0,0,2,nan,1,5,pull\n";
  EXPECT_EQ(pull_of(read_curve(path_)).at(0).borne, 5.0);
}

TEST_F(Csv, OfACompliantFrameTheTravelOfTheCrossheadIsTheLastColumn) {
  Sample sample;
  sample.extension = 0.01;
  sample.raw_extension = 0.0125;
  sample.phase = Phase::kPull;
  CurveWriter writer(path_, true);
  writer.write(sample);
  EXPECT_EQ(read_whole(path_),
            "time,extension,load,knot_distance,end_to_end,load_lower,phase,balance_offset,crosshead_travel\n"
            "s,m,N,m,m,N,-,N,m\n"
            "0,0.01,0,nan,0,0,pull,0,0.0125\n");
  const std::string names = "time,extension,load,knot_distance,end_to_end,load_lower,phase,";
  const CurveRow row = read_curve(path_).at(0);
  EXPECT_EQ(row.extension, 0.01);
  EXPECT_EQ(travel_of(row), 0.0125);
  EXPECT_EQ(travel_of(curve_row(Sample())), 0.0);
  EXPECT_THAT(complaint(names + "crosshead_travel\ns,m,N,m,m,N,-,mm\n"),
              HasSubstr("row 2: the unit of crosshead_travel is \"mm\", but must be m"));
  EXPECT_THAT(complaint(names + "crosshead_travel\ns,m,N,m,m,N,-,m\n0,0,0,0,0,0,pull,x\n"),
              HasSubstr("crosshead_travel is \"x\", but must be a number"));
}

TEST_F(Csv, WrongCurvesAreNamed) {
  EXPECT_THAT(complaint(""), HasSubstr("a curve.csv begins with a row of names"));
  EXPECT_THAT(complaint("time,load\ns,N\n"), HasSubstr("no column extension"));
  const std::string names = "time,extension,load,knot_distance,end_to_end,load_lower,phase\n";
  EXPECT_THAT(complaint(names + "s,mm,N,m,m,N,-\n"), HasSubstr("the unit of extension is \"mm\""));
  const std::string head = names + "s,m,N,m,m,N,-\n";
  EXPECT_THAT(complaint(head + "0,0,0,0,0,0,pull\n0,0,0\n"), HasSubstr("row 4 has 3 columns, but must have 7"));
  EXPECT_THAT(complaint(head + "0,0,x,0,0,0,pull\n"), HasSubstr("row 3: load is \"x\""));
  EXPECT_THAT(complaint(head + "0,0,0,0,0,0,push\n"), HasSubstr("row 3: phase is \"push\""));
  EXPECT_THAT(complaint(head + std::string(5000, '0') + "\n"), HasSubstr("row 3 is longer than 4096 characters"));
}

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

}  // namespace
}  // namespace knot_utm
