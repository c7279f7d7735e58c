#include "knot_utm/ros/curve_bag.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <std_msgs/String.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "knot_utm/ros/conversions.hpp"
#include "knot_utm/ros/names.hpp"
#include "knot_utm/ros/run_bag.hpp"
#include "knot_utm/run/run_folder.hpp"
#include "knot_utm/words/invalid_input.hpp"
#include "run/command.hpp"
#include "run/own_folder.hpp"

namespace knot_utm {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;

class CurveBag : public MadeFolder {
 protected:
  std::string complaint(const char* name) const {
    try {
      read_curve_bag(in(name));
    } catch (const InvalidInput& invalid) {
      return invalid.what();
    }
    return "none";
  }
};

/// To the last digit, also of readings that have one time.
TEST_F(CurveBag, GivesBackAMeasuredCurve) {
  std::vector<CurveRow> rows(6);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].time = 0.1 + static_cast<double>(i / 2) / 3.0;
    rows[i].extension = 1e-3 / static_cast<double>(3 + i);
    rows[i].load = -0.1 + static_cast<double>(i) / 7.0;
    rows[i].phase = Phase::kPull;
  }
  write_curve_bag(in("a.bag"), rows);
  const std::vector<CurveRow> back = read_curve_bag(in("a.bag"));
  ASSERT_EQ(back.size(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(back[i].time, rows[i].time);
    EXPECT_EQ(back[i].extension, rows[i].extension);
    EXPECT_EQ(back[i].load, rows[i].load);
    EXPECT_EQ(back[i].phase, rows[i].phase);
    EXPECT_TRUE(std::isnan(back[i].knot_distance));
  }
  for (CurveRow& row : rows) row.extension = Sample::kNone;  // of a load cell in a line
  write_curve_bag(in("loads.bag"), rows);
  const std::vector<CurveRow> loads = read_record(in("loads.bag"));
  ASSERT_EQ(loads.size(), rows.size());
  EXPECT_FALSE(has_travel(loads));
  EXPECT_EQ(loads[5].load, rows[5].load);
  EXPECT_NEAR(loads[5].time - loads[0].time, rows[5].time - rows[0].time, 1e-8);
  EXPECT_THROW(write_curve_bag(in("no/such/folder.bag"), rows), CannotWrite);
}

TEST_F(CurveBag, OfASimulatedTestIsItsCurve) {
  {
    RunBag bag(in("test.bag"), load_method(KNOT_UTM_SOURCE_DIR "/config/straight.yaml"));
    Record record;
    for (std::uint64_t i = 0; i < 4; ++i) {
      record.command.sequence = record.answer.sequence = i;
      record.command.time = record.answer.time = 0.5 * static_cast<double>(i);
      record.command.read_cell = i % 2 == 1;
      record.command.phase = record.answer.phase = Phase::kPull;
      record.command.displacement = 0.3;
      record.answer.extension = 0.01 * static_cast<double>(i);
      if (i == 3) record.answer.raw_extension = 0.035;  // of a compliant frame
      record.answer.load = 2.0 * static_cast<double>(i);
      record.answer.knot_distance = 0.15;
      bag.add(record);
    }
    bag.close();
  }
  const std::vector<CurveRow> rows = read_curve_bag(in("test.bag"));
  ASSERT_EQ(rows.size(), 2u);  // of readings alone
  EXPECT_EQ(rows[1].time, 1.5);
  EXPECT_EQ(rows[0].extension, 0.01);
  EXPECT_EQ(rows[1].extension, 0.03);
  EXPECT_EQ(rows[1].crosshead_travel, 0.035);
  EXPECT_EQ(rows[1].load, 6.0);
  EXPECT_EQ(rows[1].knot_distance, 0.15);
}

TEST_F(CurveBag, OfOtherFilesIsRefusedInOneLine) {
  write_whole(in("text.bag"), "this is no bag\n");
  EXPECT_THAT(complaint("text.bag"), HasSubstr("text.bag: the file is no bag that can be read: "));
  EXPECT_EQ(complaint("not_there.bag"), "cannot read " + in("not_there.bag") + ": no such file");
  {
    rosbag::Bag bag(in("other.bag"), rosbag::bagmode::Write);
    bag.write("/chatter", ros::Time(1.0), std_msgs::String());
  }
  EXPECT_THAT(complaint("other.bag"), HasSubstr("the bag has no topic utm/load_cell"));
  {
    rosbag::Bag bag(in("strings.bag"), rosbag::bagmode::Write);
    bag.write("/utm/load_cell", ros::Time(1.0), std_msgs::String());
    bag.write("/utm/crosshead", ros::Time(1.0), std_msgs::String());
  }
  EXPECT_THAT(complaint("strings.bag"), ContainsRegex("std_msgs/String .*, but must be knot_utm/Crosshead"));
}

/// One after the other into one bag, as several runs of one launch.
TEST_F(CurveBag, OfSeveralTestsOneIsChosen) {
  {
    BagWriter bag(in("two.bag"));
    for (std::uint32_t run = 1; run <= 2; ++run)
      for (int i = 0; i < 3; ++i) {
        Command command;
        command.time = 0.5 * i;
        command.displacement = 0.001 * i * run;
        command.phase = Phase::kPull;
        command.read_cell = true;
        Sample sample;
        sample.load = 10.0 * run + i;
        const ros::Time stamp(100.0 * run + 0.5 * i);
        bag.write(names::kCrosshead, stamp, to_message(command, run, stamp));
        bag.write(names::kLoadCell, stamp, to_wrench(sample, stamp));
      }
    bag.close();
  }
  EXPECT_THAT(complaint("two.bag"), HasSubstr("two.bag: the bag holds 2 tests: choose one by --specimen 1 to 2"));
  const std::vector<CurveRow> second = read_curve_bag(in("two.bag"), 2);
  ASSERT_EQ(second.size(), 3u);
  EXPECT_EQ(second[2].load, 22.0);
  EXPECT_EQ(second[2].extension, 0.004);
  EXPECT_EQ(read_curve_bag(in("two.bag"), 1)[2].load, 12.0);
  EXPECT_THROW(read_curve_bag(in("two.bag"), 3), InvalidInput);
}

/// A shell pattern that fits two files names the second one as the bag. raw_test has the refusals of other outputs.
TEST_F(CurveBag, NoImportReplacesAFileThatIsNoBag) {
  const std::string data = "Time,Extension,Load\n(s),(mm),(N)\n0,0,1\n1,1,2\n";
  for (const char* name : {"raw_1.csv", "raw_2.csv"}) write_whole(in(name), data);
  std::filesystem::create_hard_link(in("raw_1.csv"), in("hard.bag"));
  const auto import = [&](const std::string& words) {
    return answer_of("cd '" + folder() + "' && " + tool("import_instron", words));
  };
  for (const auto& [words, why] : {std::pair<const char*, const char*>{"raw_*.csv", "exists already"},
                                   {"raw_*.csv --overwrite", "is a file of another kind"},
                                   {"raw_1.csv hard.bag --overwrite", "is an input"}}) {
    const Answer answer = import(words);
    EXPECT_EQ(answer.code, 2) << words;
    EXPECT_EQ(std::count(answer.text.begin(), answer.text.end(), '\n'), 1) << answer.text;
    EXPECT_THAT(answer.text, HasSubstr(why)) << words;
  }
  for (const char* name : {"raw_1.csv", "raw_2.csv"}) EXPECT_EQ(read_whole(in(name)), data);
  EXPECT_EQ(import("raw_1.csv new.bag").code, 0);
  EXPECT_EQ(import("raw_1.csv new.bag").code, 2);
  EXPECT_EQ(import("raw_1.csv new.bag --overwrite --units load=kN").code, 0);
  EXPECT_EQ(read_curve_bag(in("new.bag")).back().load, 2000.0);
}

}  // namespace
}  // namespace knot_utm
