// A test that follows the record of another one, through the command line.

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "knot_utm/numeric/invalid_input.hpp"
#include "knot_utm/record/loading_steps.hpp"
#include "knot_utm/record/sample.hpp"
#include "knot_utm/run/csv.hpp"
#include "knot_utm/run/curve_file.hpp"
#include "knot_utm/run/load_test.hpp"
#include "knot_utm/run/run_folder.hpp"
#include "run/command.hpp"
#include "run/own_folder.hpp"

namespace knot_utm {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

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

  /// A method that follows a file of test/raw/files.
  static Method following(const std::string& file, const std::string& keys, const Tell& tell = nullptr) {
    const std::string source = KNOT_UTM_SOURCE_DIR;
    return load_test(source + "/config/straight.yaml",
                     {"program=[{follow: {record: '" + source + "/test/raw/files/" + file + "', " + keys + "}}]"},
                     tell);
  }

  static std::string refusal(const std::string& rows) {
    const std::string file = in("record.csv");
    std::ofstream(file) << "time,extension,load,knot_distance,end_to_end,load_lower,phase\ns,m,N,m,m,N,-\n" << rows;
    try {
      read_course(file);
    } catch (const InvalidInput& invalid) {
      return invalid.what();
    }
    return "";
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

TEST_F(Follow, ABalanceBehindTheLastPullEndsTheRecordAndIsTold) {
  const std::string file = in("record.csv");
  std::ofstream(file) << "time,extension,load,knot_distance,end_to_end,load_lower,phase\ns,m,N,m,m,N,-\n"
                         "0,0,0,nan,0.25,0,idle\n1,0.001,1,nan,0.251,1,pull\n2,0.0005,0.5,nan,0.2505,0.5,return\n"
                         "3,0,0,nan,0.2505,0,balance\n4,0,0,nan,0.2505,0,hold\n";
  std::vector<std::string> told;
  const std::vector<CurveRow> rows = read_course(file, {}, [&](const std::string& line) { told.push_back(line); });
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows.back().phase, Phase::kReturn);
  EXPECT_THAT(told, testing::ElementsAre(HasSubstr("followed to reading 3, behind which the test was balanced")));
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
  EXPECT_EQ(refusal(start + "2,0.002,2,nan,0.252,2,pull\n3,0,0,nan,0.252,0,balance\n"), "") << "behind the last pull";
}

/// Raw data of others, which `compare` reads by its options, are read by the same words in the step.
TEST_F(Follow, ARecordIsReadAsTheStepSays) {
  struct Case {
    const char *file, *keys;
    RecordedPlace last;  // [s], [m]
    const char* told;
  };
  for (const Case& one : {Case{"side_by_side.csv", "specimen: 2", {4.0, 2e-3}, "9 readings of specimen 2 of 2"},
                          Case{"no_units.csv", "units: 'time=min,extension=in,load=lbf'", {300.0, 0.0635}, "in in"},
                          Case{"headerless.csv",
                               "columns: 'time=1,extension=2,load=3', units: 'time=s,extension=cm,load=N'",
                               {5.5, 2.75e-2},
                               "load is column 3 in N"},
                          Case{"neg_ext.csv", "invert: falling", {4.5, 2.25e-3}, "the sign of extension"},
                          Case{"neg_load.csv", "invert: both", {4.5, -2.25e-3}, "the sign of extension and load"}}) {
    std::vector<std::string> told;
    const Method method = following(one.file, one.keys, [&](const std::string& line) { told.push_back(line); });
    const FollowStep& step = *method.program.front().as<FollowStep>();
    EXPECT_NEAR(step.recorded.back().time, one.last.time, 1e-9) << one.file;
    EXPECT_NEAR(step.recorded.back().displacement, one.last.displacement, 1e-12) << one.file;
    EXPECT_THAT(told, testing::Contains(HasSubstr(one.told))) << one.file;
    // Resolved, it says the same.
    std::ofstream(in("method.yaml")) << method_yaml(method);
    EXPECT_EQ(load_test(in("method.yaml")).program.front().as<FollowStep>()->recorded.back().displacement,
              step.recorded.back().displacement);
  }
}

TEST_F(Follow, WhatCannotBeReadIsSaidInTheWordsOfAMethod) {
  const std::string key = "program.0.follow.";
  const std::vector<std::array<std::string, 3>> cases{
      {"side_by_side.csv", "", "2 specimens, side by side: choose one by " + key + "specimen: 1 to 2"},
      {"side_by_side.csv", "specimen: 3", key + "specimen is 3, but the file holds 2 specimens"},
      {"side_by_side.csv", "specimen: both", key + "specimen is both, but must be a number from 1 on"},
      {"no_units.csv", "", "give ms, s, min or h, by " + key + "units: time=UNIT"},
      {"headerless.csv", "", "such as " + key + "columns: time=1,extension=2,load=3"},
      {"extenso.csv", "units: load=MPa", key + "units is load=MPa, but must be"},
      {"neg_load.csv", "invert: up", key + "invert is up, but must be falling, extension, load or both"},
      {"no_time.csv", "", "no row names the columns time, extension and load"}};
  for (const auto& [file, keys, why] : cases) {
    try {
      following(file, keys);
      ADD_FAILURE() << file << ' ' << keys;
    } catch (const InvalidInput& invalid) {
      EXPECT_THAT(invalid.what(), HasSubstr(why));
      EXPECT_THAT(invalid.what(), Not(HasSubstr("--")));
    }
  }
}

/// The largest load is one of tension; where there is none, that is said.
TEST_F(Follow, ARecordOfCompressionHasNoPeak) {
  std::ofstream(in("record.csv")) << "Time (s),Extension (mm),Load (N)\n0,0,0\n1,-0.1,-10\n2,-0.2,-20\n";
  const Answer answer = test("[{follow: {record: " + in("record.csv") + "}}]", "compressed");
  ASSERT_EQ(answer.code, 0) << answer.text;
  const std::string result = read_whole(in("compressed/result.yaml"));
  for (const char* key : {"peak_force", "true_peak_force", "energy_to_peak"})
    EXPECT_THAT(result, HasSubstr("\n" + std::string(key) + ": null  # the specimen was never in tension\n"));
  EXPECT_THAT(result, HasSubstr("\nno_plateau_because: \"the specimen was never in tension\"\n"));
  EXPECT_THAT(result, HasSubstr("\nwarnings: [\"the strand bore a thrust of "));
  EXPECT_THAT(result, HasSubstr("but a straight one buckles at "));
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
  const auto of_ours = [&](const std::string& record) {
    std::vector<std::string> told;
    load_test(KNOT_UTM_SOURCE_DIR "/config/straight.yaml", {"program=[{follow: {record: " + in(record) + "}}]"},
              [&](const std::string& line) { told.push_back(line); });
    return told;
  };
  EXPECT_THAT(of_ours("source, units: load=lbf"),
              testing::ElementsAre(HasSubstr("for which program.0.follow.units changes nothing")));
  EXPECT_THAT(of_ours("source/curve.csv, specimen: 3, invert: load"),
              testing::ElementsAre(HasSubstr("program.0.follow.invert and program.0.follow.specimen change nothing")));
  EXPECT_THAT(of_ours("source, specimen: 1"), testing::IsEmpty());
  try {
    of_ours("source, specimen: 3");
    ADD_FAILURE() << "there is no third one";
  } catch (const InvalidInput& invalid) {
    EXPECT_THAT(invalid.what(), HasSubstr("program.0.follow.specimen is 3, but the folder is that of a single test"));
  }
  const Answer answer = test("[{follow: {record: " + in("source") + "}}]", "source/../source");
  EXPECT_EQ(answer.code, 2);
  EXPECT_THAT(answer.text, testing::AllOf(HasSubstr("the method follows "), HasSubstr("choose another folder"),
                                          HasSubstr("curve.csv")));
  EXPECT_EQ(std::count(answer.text.begin(), answer.text.end(), '\n'), 1) << answer.text;
  EXPECT_EQ(content(), before);
}

}  // namespace
}  // namespace knot_utm
