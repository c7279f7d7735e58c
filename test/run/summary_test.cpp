// What a person sees at the end: ten lines with units and as many digits as mean something.

#include "knot_utm/run/summary.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "knot_utm/method/shipped.hpp"
#include "knot_utm/run/run_folder.hpp"
#include "knot_utm/words/invalid_input.hpp"
#include "run/command.hpp"
#include "run/own_folder.hpp"

namespace knot_utm {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

TEST(ReadingText, HasThePrefixAndTheDigitsThatSuitIt) {
  EXPECT_EQ(reading_text(4.976520961, "N", 0.2440667), "4.98 ± 0.24 N");
  EXPECT_EQ(reading_text(0.083404934, "m", 6.88e-4), "83.40 ± 0.69 mm");
  EXPECT_EQ(reading_text(345199.83, "N/m", 2497.2), "345.2 ± 2.5 kN/m");
  EXPECT_EQ(reading_text(4985.1524, "N"), "4.985 kN");
  EXPECT_EQ(reading_text(-20.0, "N"), "-20.00 N");
  EXPECT_EQ(reading_text(2.5e-3, "N"), "2.500 mN");
  EXPECT_EQ(reading_text(3e-8, "N"), "0.03000 µN");
  EXPECT_EQ(reading_text(0.0, "N"), "0 N");
  EXPECT_EQ(reading_text(0.4196, "of the gauge length"), "41.96 % of the gauge length");
  EXPECT_EQ(reading_text(1.4, "-"), "1.400");
  EXPECT_EQ(reading_text(31.0, "N", 1e-14), "31.00 N") << "an error of rounding is none";
  EXPECT_EQ(reading_text(120.0, "N", 4000.0), "120 ± 4000 N");
  EXPECT_EQ(reading_text(498.52, "N", 9.97), "499 ± 10 N") << "9.97 of two digits is 10";
  EXPECT_EQ(reading_text(999.96, "N"), "1000 N");
}

class Summary : public MadeFolder {
 protected:
  static void write(const std::string& name, const std::string& text) { write_whole(folder() + "/" + name, text); }
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
      "specification_passed: false\nspecification_failed: [\"a\", \"b\"]\n");
  const std::string text = run_summary(folder());
  EXPECT_THAT(text,
              AllOf(StartsWith("the test ended by break after 44.7 s, at 5.1 times real time\n"),
                    HasSubstr("motion pattern        sliding (confidence 0.71)\n"),
                    HasSubstr("plateau force         4.98 ± 0.24 N, between 3.92 N and 6.73 N\n"),
                    HasSubstr("lock extension        83.40 ± 0.69 mm\n"), HasSubstr("largest load          4.985 kN\n"),
                    HasSubstr("specification         not met in 2 of its requirements\n"), Not(HasSubstr("null"))));
  EXPECT_LE(lines(text), 10);
}

TEST_F(Summary, OfABatchHasMeansAndScatter) {
  write("statistics.yaml",
        "specimens: 3\nrejected:\n  - {specimen: 2, reason: \"it came undone\"}\nmotion_pattern: {sliding: 2}\n"
        "plateau_force: {mean: 5.1, sd: 0.12345, cv: 0.02, low: 4, high: 6, minimum: 4, maximum: 6, n: 2}\n"
        "lock_extension: {mean: null, sd: null, cv: null, low: null, high: null, minimum: null, maximum: null, n: 0}\n"
        "peak_force: {mean: 2500, sd: 1e-13, cv: 0, low: 2500, high: 2500, minimum: 2500, maximum: 2500, n: 2}\n");
  EXPECT_EQ(run_summary(folder()),
            "2 of 3 specimens count\n"
            "  plateau force         5.10 ± 0.12 N (mean ± standard deviation of 2)\n"
            "  largest load          2.500 kN (mean ± standard deviation of 2)\n");
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

TEST_F(Summary, OfWhatIsNoRunIsRefused) {
  EXPECT_THROW(run_summary(folder()), InvalidInput);
  for (const char* text : {"", "a: [", "[1, 2]"}) {
    write("result.yaml", text);
    EXPECT_THROW(run_summary(folder()), InvalidInput) << text;
  }
}

TEST_F(Summary, IsWhatTheToolsEndWith) {
  const std::string begin = "cd '" + folder() + "' && ";
  const auto asked = [&](const std::string& name, const std::string& words) {
    const Answer answer = answer_of(begin + tool(name, words));
    EXPECT_EQ(answer.code, 0) << answer.text;
    return answer.text;
  };
  const std::string ended =
      asked("tensile_test", "straight --set physics.accuracy=draft --set material.breaking_force=2500 --out 'a run'");
  EXPECT_THAT(ended, AllOf(HasSubstr("the test ended by break after "), HasSubstr("largest load          2.500"),
                           HasSubstr("all results are in a run/result.yaml\n")));
  EXPECT_LE(lines(ended), 10);
  EXPECT_EQ(asked("tensile_test", "--show 'a run'") + "all results are in a run/result.yaml\n", ended);
  const std::string compared = asked("compare", "'a run/curve.csv' 'a run/curve_full.csv'");
  EXPECT_THAT(compared, AllOf(HasSubstr("A is a run/curve.csv, B is a run/curve_full.csv\n"), Not(HasSubstr("null")),
                              HasSubstr("largest load          2.500 kN")));
  EXPECT_LE(lines(compared), 10);
}

TEST(Listing, SaysWhatComesWithThePackage) {
  for (const char* kind : {"methods", "materials", "knots", "standards", "studies"}) {
    const std::string own = shipped_listing(kind);
    EXPECT_GE(std::count(own.begin(), own.end(), '\n'), 5) << kind;
    EXPECT_THAT(shipped_listing(""), AllOf(HasSubstr(std::string(kind) + ":\n"), HasSubstr(own)));
  }
  EXPECT_THAT(shipped_listing("materials"),
              HasSubstr("nylon                   Braided nylon rope of the source paper"));
  EXPECT_THAT(shipped_listing("methods"), Not(HasSubstr("usp_881")));
  EXPECT_THAT(shipped_listing("standards"), HasSubstr("usp_881_knot_pull"));
  EXPECT_THAT(shipped_listing("validation"), HasSubstr("overhand_inversion_3  An overhand of 3 turns"));
  EXPECT_EQ(answer_of(tool("tensile_test", "--list knots")).text, shipped_listing("knots"));
  EXPECT_EQ(answer_of(tool("tensile_test", "--list")).text, shipped_listing(""));
  EXPECT_EQ(answer_of(tool("tensile_test", "--list knot")).text,
            "tensile_test: --list is \"knot\", but must be methods, materials, knots, standards, validation or "
            "studies; did you "
            "mean knots?\n");
}

}  // namespace
}  // namespace knot_utm
