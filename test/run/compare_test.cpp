// compare holds two curves against each other, whoever recorded them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "knot_utm/run/csv.hpp"
#include "knot_utm/run/run_folder.hpp"
#include "knot_utm/words/number.hpp"
#include "run/command.hpp"
#include "run/own_folder.hpp"

namespace knot_utm {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class Compare : public MadeFolder {
 protected:
  /// Load 10 N/mm times `factor`, from 1 mm on.
  void write_curve(const std::string& name, double factor) const {
    CurveWriter writer(in(name));
    for (int i = 0; i <= 10; ++i) {
      CurveRow row;
      row.time = i;
      row.extension = 1e-3 * (i + 1);
      row.load = factor * 10.0 * i;
      row.phase = Phase::kPull;
      writer.write(row);
    }
  }
  /// The same beyond an offset of the load, the crosshead standing at `place` to begin with [N], [mm].
  void write_raw_data(const std::string& name, double factor, int offset = 0, int place = 1) const {
    std::string text = "Zeit;Traversenweg;Kraft\r\n(s);(mm);(kN)\r\n";
    for (int i = 0; i <= 10; ++i) {
      const int newtons = offset + static_cast<int>(factor * 10.0 * i), tenths = newtons % 1000;
      const std::string digits = std::to_string(1000 + tenths).substr(1);
      text += std::to_string(i) + ",0;" + std::to_string(i + place) + ",0;" + std::to_string(newtons / 1000) + ',' +
              digits + "\r\n";
    }
    write_whole(in(name), text);
  }
  Answer compare(const std::string& a, const std::string& b, const std::string& more = "") const {
    return answer_of(tool("compare", "'" + in(a) + "' '" + in(b) + "' --yaml " + more));
  }
};

TEST_F(Compare, ACurveIsTheSameAsItselfAndAsItsRawData) {
  write_curve("a.csv", 1.0);
  write_raw_data("raw.csv", 1.0);
  for (const char* other : {"a.csv", "raw.csv"}) {
    // Millimetres and metres may differ by a rounding.
    const Answer same = compare("a.csv", other, "--tolerance 1e-12 --no-balance");
    EXPECT_EQ(same.code, 0) << same.text;
    EXPECT_THAT(same.text, AllOf(HasSubstr("peak_force: {a: 100, b: 100, difference: 0, relative: 0}"),
                                 HasSubstr("plateau_force: {a: null, b: null")));
  }
}

TEST_F(Compare, SaysWhatIsBeyondTheTolerance) {
  write_curve("a.csv", 1.0);
  write_raw_data("b.csv", 1.5);
  const Answer within = compare("a.csv", "b.csv", "--tolerance 0.51 --no-balance");
  EXPECT_EQ(within.code, 0) << within.text;
  const Answer beyond = compare("a.csv", "b.csv", "--tolerance 0.4 --no-balance");
  EXPECT_EQ(beyond.code, 1);
  EXPECT_THAT(beyond.text,
              AllOf(HasSubstr("compare: peak_force: the relative difference is 0.5, but must be within 0.4\n"),
                    HasSubstr("largest_difference: 50\n"), HasSubstr("largest_difference_at: 0.011")));
}

TEST_F(Compare, WithoutAnyLoadACurveIsTheSameAsItself) {
  write_curve("zero.csv", 0.0);
  EXPECT_EQ(compare("zero.csv", "zero.csv", "--tolerance 0").code, 0);
}

TEST_F(Compare, ANoteOfAPhaseIsNoCurveOfOurs) {
  write_raw_data("raw.csv", 1.0);
  write_whole(in("note.csv"), "Note : phase,time\r\n" + read_whole(in("raw.csv")));
  EXPECT_EQ(compare("raw.csv", "note.csv", "--tolerance 0").code, 0);
}

TEST_F(Compare, BalancesRawDataAlone) {
  write_curve("a.csv", 1.0);
  write_raw_data("b.csv", 1.0, 25, 14);
  write_raw_data("c.csv", 1.0, 3, 40);
  EXPECT_EQ(compare("a.csv", "b.csv", "--tolerance 0.01 --no-balance").code, 2) << "they have no extension in common";
  // Each begins at its zero; which of them was cut nobody knows.
  const Answer both = compare("b.csv", "c.csv", "--tolerance 1e-12");
  EXPECT_EQ(both.code, 0) << both.text;
  EXPECT_THAT(both.text, AllOf(HasSubstr("b.csv: the record shows no rest before the pull, so its first reading, 25 N"),
                               HasSubstr("c.csv: the record shows")));
  const Answer ours = compare("a.csv", "a.csv", "--tolerance 0");
  EXPECT_EQ(ours.code, 0);
  EXPECT_THAT(ours.text, HasSubstr("common_extension: [0.001, 0.011]"));
}

TEST_F(Compare, SaysWhatItReadOfRawData) {
  write_curve("a.csv", 1.0);
  write_raw_data("raw.csv", 1.0);
  const Answer answer = compare("a.csv", "raw.csv", "--no-balance");
  EXPECT_THAT(answer.text, HasSubstr("raw.csv: 11 readings: time is column 1 \"Zeit\" in s, extension is column 2"));
  EXPECT_THAT(answer.text, testing::Not(HasSubstr("a.csv: ")));
}

TEST_F(Compare, TakesTheFolderOfARun) {
  std::filesystem::create_directories(in("run"));
  std::filesystem::create_directories(in("batch/specimen_001"));
  std::filesystem::create_directories(in("batch/specimen_002"));
  for (const char* name : {"run/curve.csv", "batch/specimen_001/curve.csv"}) write_curve(name, 1.0);
  write_curve("batch/specimen_002/curve.csv", 2.0);
  EXPECT_EQ(compare("run", "run/curve.csv", "--tolerance 0").code, 0);
  EXPECT_EQ(compare("run", "batch", "--tolerance 0 --specimen 1").code, 0);
  EXPECT_THAT(compare("batch", "batch", "--specimen 1,2").text, HasSubstr("peak_force: {a: 100, b: 200"));
  EXPECT_THAT(compare("run", "batch").text, HasSubstr("the folder holds 2 specimens: choose one by --specimen 1 to 2"));
  EXPECT_THAT(compare("run", ".").text, HasSubstr("has no curve.csv, so it is not that of a run"));
  EXPECT_EQ(compare("run", "batch", "--specimen 2").code, 2);
  EXPECT_THAT(compare("run", "batch", "--specimen 2").text,
              HasSubstr("run: --specimen is 2, but the folder is that of a single test"));
  EXPECT_THAT(compare("run", "batch", "--specimen 1,2").text, HasSubstr("peak_force: {a: 100, b: 200"));
  EXPECT_THAT(compare("run", "batch", "--specimen 1,2").text, testing::Not(HasSubstr("nothing")));
  EXPECT_THAT(compare("run", "run/curve.csv", "--units load=N").text, HasSubstr("for which --units changes nothing"));
  EXPECT_THAT(compare("run/curve.csv", "run/curve.csv", "--specimen 3 --invert").text,
              HasSubstr("both curves are of knot_utm, for which --invert and --specimen change nothing"));
  for (const char* wrong : {"0", "1,2,3", "a", "1.5"})
    EXPECT_EQ(compare("batch", "batch", std::string("--specimen ") + wrong).code, 2) << wrong;
}

TEST_F(Compare, NeedsNoTime) {
  write_curve("a.csv", 1.0);
  std::string text = "extension,load\nm,N\n";
  for (int i = 0; i <= 10; ++i) text += format_number(1e-3 * (i + 1)) + ',' + std::to_string(10 * i) + '\n';
  write_whole(in("pull.csv"), text);
  const Answer answer = compare("a.csv", "pull.csv", "--tolerance 0 --no-balance");
  EXPECT_EQ(answer.code, 0) << answer.text;
  EXPECT_THAT(answer.text, HasSubstr("pull.csv: 11 readings: extension is column 1"));
  EXPECT_THAT(compare("a.csv", "pull.csv", "--columns load=1,extension=2 --units load=N,extension=m").text,
              AllOf(HasSubstr("extension is column 2"), HasSubstr("load is column 1")));
}

TEST_F(Compare, ARecordThatRunsDownwardsIsToldAndTurned) {
  write_curve("a.csv", 1.0);
  std::string of_load = "Time,Extension,Load\ns,mm,N\n", of_extension = of_load;
  for (int i = 0; i <= 10; ++i) {
    const std::string time = std::to_string(i) + ',', place = std::to_string(i + 1) + ',';
    of_load += time + place + std::to_string(-10 * i) + '\n';
    of_extension += time + '-' + place + std::to_string(10 * i) + '\n';
  }
  write_whole(in("load.csv"), of_load);
  write_whole(in("extension.csv"), of_extension);
  const Answer told = compare("a.csv", "load.csv");
  EXPECT_EQ(told.code, 0);
  EXPECT_THAT(told.text, HasSubstr("load.csv: the load falls from 0 to -100 N"));
  const Answer refused = compare("a.csv", "extension.csv");
  EXPECT_EQ(refused.code, 2);
  EXPECT_EQ(std::count(refused.text.begin(), refused.text.end(), '\n'), 1) << refused.text;
  EXPECT_THAT(refused.text, HasSubstr("extension.csv: the extension falls from its first reading on"));
  for (const char* name : {"load.csv", "extension.csv"})
    EXPECT_EQ(compare("a.csv", name, "--invert --tolerance 1e-12 --no-balance").code, 0) << name;
  EXPECT_EQ(compare("a.csv", "load.csv", "--invert=load --tolerance 1e-12 --no-balance").code, 0);
  EXPECT_EQ(compare("a.csv", "load.csv", "--invert=up").code, 2);
}

TEST_F(Compare, ReadingsBehindOthersAreCounted) {
  write_curve("a.csv", 1.0);
  std::string text = "Time,Extension,Load\ns,mm,N\n";
  for (int i = 0; i <= 30; ++i) {
    const int place = i < 10 ? i : i < 15 ? 20 - i : i - 10;  // there, half of the way back, and there again
    text += std::to_string(i) + ',' + std::to_string(place) + ',' + std::to_string(10 * place) + '\n';
  }
  write_whole(in("back.csv"), text);
  EXPECT_THAT(compare("a.csv", "back.csv").text,
              HasSubstr("back.csv: 9 of 31 readings are not compared, since they lie up to 5 mm behind an extension"));
}

TEST_F(Compare, RefusesInOneLine) {
  write_curve("a.csv", 1.0);
  write_whole(in("no_unit.csv"), "Time,Extension,Load\n0,0,0\n");
  for (const char* other : {"no_unit.csv", "not_there.csv", "not_there.bag"}) {
    const Answer answer = compare("a.csv", other);
    EXPECT_EQ(answer.code, 2) << other;
    EXPECT_EQ(std::count(answer.text.begin(), answer.text.end(), '\n'), 1) << answer.text;
    EXPECT_THAT(answer.text, HasSubstr(other));
  }
  for (const char* tolerance : {"-1", "nan", "inf"})
    EXPECT_EQ(compare("a.csv", "a.csv", std::string("--tolerance ") + tolerance).code, 2) << tolerance;
  EXPECT_EQ(compare("a.csv", ".").code, 2);
  EXPECT_NE(answer_of("( " + tool("compare", "'" + in("a.csv") + "' '" + in("a.csv") + "' > /dev/full") + " )").code,
            0);

  const double nan = std::nan("");
  write_curve("nan.csv", nan);
  EXPECT_THAT(compare("a.csv", "nan.csv").text, HasSubstr("nan.csv: reading 1 has no time, no extension or no load"));
}

}  // namespace
}  // namespace knot_utm
