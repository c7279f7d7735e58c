#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "knot_utm/analysis/comparison.hpp"
#include "knot_utm/words/invalid_input.hpp"

namespace knot_utm {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// 10 N/mm from an extension on [m], `offset` [N] off. What knows L is a curve of ours.
CurveOfFile curve(const std::string& file, double length, double from = 0.0, double offset = 0.0) {
  CurveOfFile out{file, {}};
  for (int i = 0; i <= 10; ++i) {
    CurveRow row;
    row.time = i;
    row.extension = from + 1e-3 * i;
    row.load = offset + 10.0 * i;
    row.end_to_end = length + row.extension;
    row.phase = Phase::kPull;
    out.rows.push_back(row);
  }
  return out;
}
CurveOfFile ours(double from = 0.0) { return curve("ours.csv", 0.2, from); }
CurveOfFile raw(double from = 0.0, double offset = 0.0) {
  return curve("raw.csv", std::numeric_limits<double>::quiet_NaN(), from, offset);
}

struct Told {
  std::vector<std::string> lines;
  ComparedCurves compare(const CurveOfFile& a, const CurveOfFile& b) {
    return compare_curves(a, b, true, [&](const std::string& line) { lines.push_back(line); });
  }
};

TEST(ComparedCurves, SayWhatIsTakenForZero) {
  Told told;
  const ComparedCurves compared = told.compare(ours(), raw(0.0, 5.0));  // raw data have one by default
  EXPECT_NEAR(compared.comparison.difference->largest, 0.0, 1e-9);
  EXPECT_THAT(told.lines, ElementsAre(HasSubstr("ours.csv: the curve is one of knot_utm and keeps its own zero"),
                                      HasSubstr("raw.csv: the record shows no rest before the pull")));
}

/// Where the other curve does not begin at 0 N, the raw data get its load; what is said is what the file itself has.
TEST(ComparedCurves, SayTheZeroOfEachFileFromItsOwnReadings) {
  Told told;
  CurveOfFile offset = ours();
  for (CurveRow& row : offset.rows) row.load += 0.25;
  CurveOfFile resting = raw(0.01, 5.0);
  CurveRow rest = resting.rows.front();
  for (const double more : {1.0, -1.0}) {
    rest.time -= 1.0;
    rest.load = 5.0 + more;
    resting.rows.insert(resting.rows.begin(), rest);
  }
  const ComparedCurves compared = told.compare(offset, resting);
  EXPECT_NEAR(compared.comparison.difference->largest, 0.0, 1e-9);
  EXPECT_THAT(told.lines,
              testing::Contains(HasSubstr("raw.csv: zero is 5 N at 0.01 m, the mean of its 3 readings before the "
                                          "crosshead moves; its load there becomes 0.25 N")));
  const std::string yaml = comparison_yaml(compared.comparison, "ours.csv", "raw.csv");
  EXPECT_THAT(yaml, HasSubstr("zero_a: own\n"));
  EXPECT_THAT(yaml, HasSubstr("zero_b: {extension: 0.01, load: 5, readings: 3, load_there: 0.25}\n"));
  const ComparedCurves as_they_are = told.compare(offset, offset);
  EXPECT_THAT(comparison_yaml(as_they_are.comparison, "a", "b"), testing::Not(HasSubstr("zero_")));
  const ComparedCurves both = told.compare(resting, raw(0.01, 7.0));
  EXPECT_EQ(both.comparison.zeros->a->load, 5.0);
  EXPECT_EQ(both.comparison.zeros->b->load, 7.0);
}

TEST(ComparedCurves, AreRefusedWhereTheyCannotBeCompared) {
  Told told;
  EXPECT_THROW(told.compare(ours(), ours(1.0)), InvalidInput);
  CurveOfFile few = ours(), lost = ours();
  few.rows.resize(1);
  EXPECT_THROW(told.compare(few, ours()), InvalidInput);
  CurveOfFile still = raw();
  for (CurveRow& row : still.rows) row.extension = 0.01;
  try {
    told.compare(still, ours());
    ADD_FAILURE() << "a record in which nothing is pulled has no curve";
  } catch (const InvalidInput& invalid) {
    EXPECT_THAT(invalid.what(),
                HasSubstr("raw.csv: nothing is pulled: no reading has a larger extension than the first"));
  }
  lost.rows[3].load = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(told.compare(ours(), lost), InvalidInput);
}

}  // namespace
}  // namespace knot_utm
