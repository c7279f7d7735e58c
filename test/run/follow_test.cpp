// A test that follows the record of another one, through the command line.

#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "complaint.hpp"
#include "knot_utm/program/loading_steps.hpp"
#include "knot_utm/record/sample.hpp"
#include "knot_utm/run/csv.hpp"
#include "knot_utm/run/run_folder.hpp"
#include "run/command.hpp"
#include "run/own_folder.hpp"

namespace knot_utm {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Follow : public MadeFolder {
 protected:
  /// A straight rod between clamps, of which the program is told.
  static Answer test(const std::string& program, const std::string& out) {
    return answer_of(tool("tensile_test", "'" + std::string(KNOT_UTM_SOURCE_DIR) +
                                              "/config/straight.yaml' --quiet --set physics.accuracy=draft --set "
                                              "'program=" +
                                              program + "' --out '" + in(out) + "'"));
  }

  /// Of rows of a curve, where s was straight between them.
  static double extension_at(const std::vector<CurveRow>& rows, double time) {
    std::size_t i = 1;
    while (i + 1 < rows.size() && rows[i].time < time) ++i;
    const CurveRow &a = rows[i - 1], &b = rows[i];
    return a.extension + (time - a.time) / (b.time - a.time) * (b.extension - a.extension);
  }

  static std::string refusal(const std::string& rows) {
    const std::string file = in("record.csv");
    std::ofstream(file) << "time,extension,load,knot_distance,end_to_end,load_lower,phase\ns,m,N,m,m,N,-\n" << rows;
    return complaint_of([&] { read_course(file); });
  }
};

/// What is pulled, returned and pulled again goes the same way at the same time since the pull began.
TEST_F(Follow, TheWholeWayOfTheRecordIsGone) {
  for (const std::string before : {"", "{preload: {load: 100}}, {hold: {duration: 0.5}}, "}) {
    const Answer source = test("[" + before +
                                   "{pull: {until: {extension: 0.003}}}, {return: {extension: 0.001}}, {hold: "
                                   "{duration: 0.4}}, {pull: {until: {extension: 0.003}}}]",
                               "source");
    ASSERT_EQ(source.code, 0) << source.text;
    const Answer answer = test("[{follow: {record: " + in("source/curve_full.csv") + "}}]", "followed");
    ASSERT_EQ(answer.code, 0) << answer.text;
    const std::vector<CurveRow> recorded = read_course(in("source/curve_full.csv"));
    const std::vector<CurveRow> followed = read_course(in("followed/curve_full.csv"));
    ASSERT_GT(recorded.size(), 10u);
    const double begin = recorded.front().time;
    EXPECT_NEAR(followed.back().time, recorded.back().time - begin, 1.0 / 3.0);
    double lowest_behind = 1.0;
    for (const CurveRow& row : recorded) {
      const double since = row.time - begin;
      if (since > 1.0) lowest_behind = std::min(lowest_behind, row.extension);
      // Commands are at most a sixth of a second apart (draft): a turn within one is cut.
      EXPECT_NEAR(extension_at(followed, since), row.extension - recorded.front().extension, 0.0033 / 6.0) << since;
    }
    EXPECT_NEAR(lowest_behind, 0.001, 0.0033 / 6.0) << "the way back is part of the record";
  }
}

/// What comes behind the last pull belongs to the record, too.
TEST_F(Follow, TheRecordIsFollowedToItsEnd) {
  ASSERT_EQ(
      test("[{pull: {until: {extension: 0.003}}}, {return: {extension: 0.001}}, {hold: {duration: 5}}]", "source").code,
      0);
  const Answer answer = test("[{follow: {record: " + in("source") + "}}]", "followed");
  ASSERT_EQ(answer.code, 0) << answer.text;
  std::ifstream source(in("source/curve.csv")), followed(in("followed/curve.csv"));
  const CurveRow last = read_curve(source, "source").back(), same = read_curve(followed, "followed").back();
  EXPECT_EQ(last.phase, Phase::kHold);
  EXPECT_NEAR(same.time, last.time, 1.0 / 3.0);
  EXPECT_NEAR(same.extension, 0.001, 0.0033 / 6.0);
}

/// Cells are balanced with the first command of the pull behind a pre-load: there the reading before is at zero.
TEST_F(Follow, APreloadThatBalancesIsTheOrigin) {
  ASSERT_EQ(test("[{preload: {load: 100}}, {pull: {until: {extension: 0.002}}}]", "source").code, 0);
  const std::vector<CurveRow> rows = read_course(in("source/curve_full.csv"));
  ASSERT_FALSE(rows.empty());
  EXPECT_EQ(rows.front().phase, Phase::kPreload);
  EXPECT_EQ(rows.front().extension, 0.0);
  EXPECT_NEAR(rows[1].extension, 0.0033 * (rows[1].time - rows[0].time), 1e-12);  // from there at the pull's speed
}

TEST_F(Follow, ARecordWithTwoZerosOrATimeThatGoesBackIsRefused) {
  const std::string start = "0,0,0,nan,0.25,0,idle\n1,0.001,1,nan,0.251,1,pull\n";
  EXPECT_EQ(refusal(start + "2,0.002,2,nan,0.252,2,pull\n"), "");
  EXPECT_THAT(refusal(start + "0.5,0.002,2,nan,0.252,2,pull\n"),
              HasSubstr("record.csv: time goes back at reading 3, from 1 s to 0.5 s"));
  EXPECT_THAT(refusal(start + "2,0.001,1,nan,0.251,1,balance\n3,0.002,2,nan,0.252,2,pull\n"),
              HasSubstr("record.csv: the test was balanced at reading 3"));
  // Between two readings of the cell: L grows on, s begins anew.
  EXPECT_THAT(refusal(start + "2,0.001,1,nan,0.252,1,pull\n"),
              HasSubstr("record.csv: the test was balanced at reading 3"));
  EXPECT_THAT(refusal("0,nan,0,nan,nan,nan,pull\n1,nan,1,nan,nan,nan,pull\n"),
              HasSubstr("record.csv: there is no extension to follow: pull instead, and compare the test with "));
  EXPECT_EQ(refusal(start + "2,0.002,2,nan,0.252,2,pull\n3,0,0,nan,0.252,0,balance\n"), "") << "behind the last pull";
}

TEST_F(Follow, WhatIsNotImportedIsRefused) {
  std::ofstream(in("export.csv")) << "Time,Extension,Load\n(s),(mm),(N)\n0,0,0\n0.1,0.33,1.25\n";
  const Answer answer = test("[{follow: {record: " + in("export.csv") + "}}]", "raw");
  EXPECT_EQ(answer.code, 2);
  EXPECT_EQ(std::count(answer.text.begin(), answer.text.end(), '\n'), 1) << answer.text;
  EXPECT_THAT(answer.text, HasSubstr("export.csv: the file is no curve.csv; import_instron makes one of"));
  EXPECT_EQ(test("[{follow: {record: source, units: load=N}}]", "raw").code, 2) << "no such key";
  EXPECT_FALSE(fs::exists(in("raw")));
  for (const char* folder : {"batch/specimen_001", "batch/specimen_002"}) {
    fs::create_directories(in(folder));
    std::ofstream(in(folder + std::string("/curve.csv")));
  }
  EXPECT_THAT(test("[{follow: {record: " + in("batch") + "}}]", "raw").text,
              HasSubstr("the folder holds 2 specimens: give the folder of one"));
}

/// The folder of a run stands for its curve.
TEST_F(Follow, TheFolderOfTheRecordIsNotWrittenTo) {
  ASSERT_EQ(test("[{pull: {until: {extension: 0.002}}}]", "source").code, 0);
  const auto content = [&] {
    std::string all;
    for (const fs::directory_entry& entry : fs::directory_iterator(in("source"))) {
      std::ifstream file(entry.path());
      all += entry.path().string() + std::string(std::istreambuf_iterator<char>(file), {});
    }
    return all;
  };
  const std::string before = content();
  const Answer answer = test("[{follow: {record: " + in("source") + "}}]", "source/../source");
  EXPECT_EQ(answer.code, 2);
  EXPECT_THAT(answer.text, testing::AllOf(HasSubstr("the method follows "), HasSubstr("choose another folder"),
                                          HasSubstr("curve.csv")));
  EXPECT_EQ(std::count(answer.text.begin(), answer.text.end(), '\n'), 1) << answer.text;
  EXPECT_EQ(content(), before);
}

}  // namespace
}  // namespace knot_utm
