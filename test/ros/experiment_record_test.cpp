// The record that a test follows has the same zero on its topics as in `compare --balance`.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "knot_utm/numeric/invalid_input.hpp"
#include "knot_utm/raw/comparison.hpp"
#include "knot_utm/record/loading_steps.hpp"
#include "knot_utm/record/sample.hpp"
#include "knot_utm/ros/experiment_node.hpp"
#include "knot_utm/ros/method_setup.hpp"

namespace knot_utm {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A machine that read 10.5 N and stood at 13 mm before it pulled.
std::vector<CurveRow> raw() {
  std::vector<CurveRow> rows;
  for (int i = 0; i < 30; ++i) {
    CurveRow row;
    row.time = 0.1 * i;
    row.extension = 0.013 + 1e-3 * std::max(0, i - 9);
    row.load = 10.5 + (i % 2 == 0 ? 0.1 : -0.1) + 0.7 * std::max(0, i - 9);
    row.phase = Phase::kPull;
    row.end_to_end = Sample::kNone;
    rows.push_back(row);
  }
  return rows;
}

struct Told {
  std::vector<std::string> lines;
  std::vector<CurveRow> zeroed(const std::vector<CurveRow>& rows, RecordBalance balance) {
    return record_with_zero(rows, balance, [&](const std::string& line) { lines.push_back(line); });
  }
};

TEST(ExperimentRecord, RawDataHaveTheZeroOfCompare) {
  for (const RecordBalance balance : {RecordBalance::kAuto, RecordBalance::kYes}) {
    Told told;
    const std::vector<CurveRow> found = told.zeroed(raw(), balance);
    ASSERT_EQ(found.size(), raw().size() - 9);
    EXPECT_NEAR(found[0].extension, 0.0, 1e-12);
    EXPECT_NEAR(found[0].load, -0.1, 1e-12);
    EXPECT_THAT(told.lines, ElementsAre(HasSubstr("10.5 N at 0.013 m, the mean of its 10 readings")));
    const auto [a, b, comparison] =
        compare_curves({"raw.csv", raw()}, {"raw.csv", raw()}, {true, std::nullopt}, [](const std::string&) {});
    EXPECT_NEAR(found.back().load, a.back().force, 1e-12);
    EXPECT_NEAR(found.back().extension, a.back().extension, 1e-12);
    for (const auto& zero : {comparison.zeros->a, comparison.zeros->b}) EXPECT_NEAR(zero->load, 10.5, 1e-12);
  }
}

/// Its last reading was once taken for zero, although the rest before it moves is there.
TEST(ExperimentRecord, CompressionHasTheZeroOfItsRest) {
  std::vector<CurveRow> rows = raw();
  for (CurveRow& row : rows) row.extension = -row.extension;
  Told told;
  const std::vector<CurveRow> found = told.zeroed(rows, RecordBalance::kAuto);
  ASSERT_EQ(found.size(), rows.size() - 9);
  EXPECT_NEAR(found[0].extension, 0.0, 1e-12);
  EXPECT_NEAR(found.back().extension, -0.02, 1e-12);
  EXPECT_THAT(told.lines, ElementsAre(HasSubstr("10.5 N at -0.013 m, the mean of its 10 readings")));
}

/// A launch says how raw data are read, and is told in its own words what it must say.
TEST(ExperimentRecord, IsReadAsTheLaunchSays) {
  TestWords words;
  words.method = "straight";
  words.shipped_methods = KNOT_UTM_SOURCE_DIR "/config";
  const auto with = [&](const char* data, const RecordWords& record) {
    words.data = std::string(KNOT_UTM_SOURCE_DIR "/test/raw/files/") + data;
    words.record = record;
    return set_up(words);
  };
  const auto refusal = [&](const char* data, const RecordWords& record) -> std::string {
    try {
      with(data, record);
    } catch (const InvalidInput& invalid) {
      return invalid.what();
    }
    return "";
  };
  const MethodSetup setup = with("side_by_side.csv", {"", "load=kN", "2", "load"});
  EXPECT_NEAR(setup.record.back().load, -4125.0, 1e-9);
  EXPECT_THAT(setup.told, testing::Contains(HasSubstr("specimen 2 of 2")));
  EXPECT_NEAR(setup.method.program.back().as<FollowStep>()->recorded.back().time, 4.0, 1e-9);
  EXPECT_THAT(refusal("side_by_side.csv", {}), HasSubstr("2 specimens, side by side: choose one by specimen:=1 to 2"));
  EXPECT_THAT(refusal("no_units.csv", {}), HasSubstr("by units:=time=UNIT"));
  EXPECT_THAT(refusal("headerless.csv", {}), HasSubstr("such as columns:=time=1,extension=2,load=3"));
  EXPECT_THAT(refusal("extenso.csv", {"", "", "", "up"}), HasSubstr("invert is up, but must be falling, extension, "));
}

TEST(ExperimentRecord, IsLeftAsItIsWhereAskedAndWhereItHasItsZero) {
  Told told;
  EXPECT_EQ(told.zeroed(raw(), RecordBalance::kNo).front().load, raw().front().load);
  std::vector<CurveRow> ours = raw();
  for (CurveRow& row : ours) row.end_to_end = 0.25;
  EXPECT_EQ(told.zeroed(ours, RecordBalance::kAuto).front().load, ours.front().load);
  EXPECT_TRUE(told.zeroed({}, RecordBalance::kAuto).empty());
  EXPECT_THAT(told.lines, IsEmpty());
  EXPECT_EQ(told.zeroed(ours, RecordBalance::kYes).front().extension, ours.front().extension);
  EXPECT_THAT(told.lines, ElementsAre(HasSubstr("keeps its own zero")));
}

TEST(ExperimentRecord, WhetherItIsBalancedHasThreeNames) {
  EXPECT_EQ(record_balance_named("auto"), RecordBalance::kAuto);
  EXPECT_EQ(record_balance_named("true"), RecordBalance::kYes);
  EXPECT_EQ(record_balance_named("false"), RecordBalance::kNo);
  EXPECT_THROW(record_balance_named("on"), InvalidInput);
}

}  // namespace
}  // namespace knot_utm
