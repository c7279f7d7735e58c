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
