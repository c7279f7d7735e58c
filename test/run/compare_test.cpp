// compare holds two curves against each other, whoever recorded them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pty.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "knot_utm/method/shipped.hpp"
#include "knot_utm/record/sample.hpp"
#include "knot_utm/run/csv.hpp"
#include "knot_utm/run/load_test.hpp"
#include "knot_utm/run/run_folder.hpp"
#include "knot_utm/run/summary.hpp"
#include "knot_utm/words/invalid_input.hpp"
#include "knot_utm/words/number.hpp"
#include "run/command.hpp"
#include "run/own_folder.hpp"

namespace knot_utm {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

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

TEST_F(Compare, TakesTheFolderOfARun) {
  std::filesystem::create_directories(in("run"));
  std::filesystem::create_directories(in("batch/specimen_001"));
  std::filesystem::create_directories(in("batch/specimen_002"));
  for (const char* name : {"run/curve.csv", "batch/specimen_001/curve.csv"}) write_curve(name, 1.0);
  write_curve("batch/specimen_002/curve.csv", 2.0);
  EXPECT_EQ(compare("run", "run/curve.csv", "--tolerance 0").code, 0);
  EXPECT_EQ(compare("run", "batch", "--tolerance 0 --specimen 1").code, 0);
  EXPECT_THAT(compare("batch", "batch", "--specimen 1,2").text, HasSubstr("peak_force: {a: 100, b: 200"));
  EXPECT_THAT(compare("run", ".").text, HasSubstr("has no curve.csv, so it is not that of a run"));
  EXPECT_EQ(compare("run", "batch", "--specimen 2").code, 2);
  EXPECT_THAT(compare("run", "batch", "--specimen 1,2").text, HasSubstr("peak_force: {a: 100, b: 200"));
  for (const char* wrong : {"0", "1,2,3", "a", "1.5"})
    EXPECT_EQ(compare("batch", "batch", std::string("--specimen ") + wrong).code, 2) << wrong;
}

/// A LineScale's log: two slips of 1 and 2 kN on the way to 5 kN, and the break.
TEST_F(Compare, ReadsLoadsOverTimeWhereThereIsNoTravel) {
  const std::string head = "0A:1B:2C\n02.03.21\n10:14:25\nLogNo=007\nUnit=kN\nMode=ABS\nRelZero=0.00\nSpeed=10\n";
  write_whole(in("line.csv"),
              head + "Trig=0.10\n0.00\n1.00\n2.00\n1.50\n1.00\n3.00\n4.00\n2.00\n4.90\n5.00\n0.10\n0.00\n");
  write_curve("a.csv", 1.0);
  const Answer answer = compare("line.csv", "a.csv");
  EXPECT_EQ(answer.code, 0) << answer.text;
  EXPECT_THAT(answer.text,
              AllOf(HasSubstr("line.csv: it has no travel"), HasSubstr("peak_force: {a: 5000, b: 100"),
                    HasSubstr("largest_drop: {a: 2000, b: 0"), HasSubstr("slips: {a: 2, b: 0"),
                    HasSubstr("peak_time: {a: 0.9, b: 10"), HasSubstr("plateau_force: {a: null, b: null")));
  EXPECT_THAT(compare("line.csv", "a.csv", "--rate 9").text, HasSubstr("peak_time: {a: 1, b: 10"));
  EXPECT_THAT(compare("line.csv", "a.csv", "--tolerance 0.5").text, HasSubstr("compare: peak_force: the relative"));
  EXPECT_EQ(compare("line.csv", "a.csv", "--report '" + in("page") + "'").code, 2);
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

TEST(ProgressLine, NamesTheLoadAndHasNoMinusBeforeAZero) {
  int terminal = 0, end = 0;
  ASSERT_EQ(openpty(&terminal, &end, nullptr, nullptr, nullptr), 0);
  std::FILE* out = fdopen(end, "w");
  Sample sample;
  sample.extension = -1e-6;
  sample.load = -0.0;
  ProgressLine(out).show(sample, make_program(load_method(KNOT_UTM_SOURCE_DIR "/config/straight.yaml"), 0.1), 1.0);
  std::string said(200, '\0');
  EXPECT_GT(read(terminal, said.data(), said.size()), 0);
  EXPECT_THAT(said, HasSubstr("%  s    0.00 mm  load         0 N  "));
  std::fclose(out);
  close(terminal);
}

TEST(ReadingText, HasThePrefixAndTheDigitsThatSuitIt) {
  EXPECT_EQ(reading_text(4.976520961, "N", 0.2440667), "4.98 ± 0.24 N");
  EXPECT_EQ(reading_text(0.083404934, "m", 6.88e-4), "83.40 ± 0.69 mm");
  EXPECT_EQ(reading_text(345199.83, "N/m", 2497.2), "345.2 ± 2.5 kN/m");
  EXPECT_EQ(reading_text(4985.1524, "N"), "4.985 kN");
  EXPECT_EQ(reading_text(-20.0, "N"), "-20.00 N");
  EXPECT_EQ(reading_text(2.5e-3, "N"), "2.500 mN");
  EXPECT_EQ(reading_text(3e-8, "N"), "0.03000 µN");
  for (const double zero : {0.0, -0.0}) EXPECT_EQ(reading_text(zero, "N"), "0 N");
  EXPECT_EQ(reading_text(0.4196, "of the gauge length"), "41.96 % of the gauge length");
  EXPECT_EQ(reading_text(1.4, "-"), "1.400");
  EXPECT_EQ(reading_text(31.0, "N", 1e-14), "31.00 N") << "an error of rounding is none";
  EXPECT_EQ(reading_text(120.0, "N", 4000.0), "120 ± 4000 N");
  EXPECT_EQ(reading_text(498.52, "N", 9.97), "499 ± 10 N") << "9.97 of two digits is 10";
  EXPECT_EQ(reading_text(999.96, "N"), "1000 N");
}

class Summary : public MadeFolder {
 protected:
  static void write(const std::string& name, const std::string& text) { write_whole(in(name), text); }
  static long lines(const std::string& text) { return std::count(text.begin(), text.end(), '\n'); }
};

TEST_F(Summary, OfARunHasTheMainReadingsAndNoNull) {
  write(
      "result.yaml",
      "motion_pattern: sliding\nmotion_pattern_confidence: 0.7127653560028229\nended_by: break\nplateau_force: 4.9765\n"
      "plateau_force_low: 3.92371\nplateau_force_high: 6.72736\nplateau_force_error: 0.24406\nforce_ratio: null  # no\n"
      "lock_extension: 0.0834049\nlock_extension_error: 0.00068807\nlocked_stiffness: 345199.8\n"
      "locked_stiffness_error: 2497.1\npeak_force: 4985.15\nbreak_extension: 0.1030345\nelongation_at_break: 0.4196\n"
      "relaxation: 0.1\nhysteresis: 2\nno_plateau_because: null\nsimulated_time: 44.66\nreal_time_factor: 5.11\n"
      "final_excess_length: [0.0401]\nspecification_passed: false\nspecification_failed: [\"a\", \"b\"]\n");
  const std::string text = run_summary(folder());
  EXPECT_THAT(text,
              AllOf(StartsWith("the test ended by break after 44.7 s, at 5.1 times real time\n"),
                    HasSubstr("motion pattern        sliding (confidence 0.71)\n"),
                    HasSubstr("plateau force         4.98 ± 0.24 N, between 3.92 N and 6.73 N\n"),
                    HasSubstr("lock extension        83.40 ± 0.69 mm\n"), HasSubstr("largest load          4.985 kN\n"),
                    HasSubstr("rod in the knot       40.10 mm\n"),
                    HasSubstr("specification         not met in 2 of its requirements\n"), Not(HasSubstr("null"))));
  EXPECT_LE(lines(text), 10);
}

TEST(ComparisonSummary, ShowsNoRounding) {
  Comparison same;
  same.a.peak_force = 20.0;
  same.b.peak_force = 20.0 - 1e-13;
  same.difference = CurveDifference{};
  same.difference->common = {0.0, 0.01};
  same.difference->load = 20.0;
  same.difference->rms = 1e-15;
  same.difference->largest = -3e-15;
  const std::string text = comparison_summary(same, "a", "b");
  EXPECT_THAT(text, AllOf(HasSubstr("20.00 N         20.00 N         0.0 %\n"), HasSubstr("differ by 0 N (0.00 %"),
                          HasSubstr("at most by 0 N at")));
}

}  // namespace
}  // namespace knot_utm
