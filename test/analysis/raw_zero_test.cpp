// The zero of raw data: a curve that is held against itself as a machine would have recorded it differs by rounding.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "complaint.hpp"
#include "knot_utm/analysis/comparison.hpp"
#include "knot_utm/analysis/statistics.hpp"
#include "knot_utm/words/invalid_input.hpp"

namespace knot_utm {
namespace {

using testing::HasSubstr;

/// A pull that slides and locks, read at a rate while the crosshead moves at a speed.
struct Pulled {
  double speed = 3.3e-3;  ///< [m/s]
  double rate = 3.0;      ///< [Hz]

  /// As curve.csv has it: mounted elsewhere, balanced, and pulled from 14 s on.
  std::vector<CurveRow> rows() const {
    std::vector<CurveRow> out;
    const auto add = [&](double time, double s, double load, Phase phase, double end_to_end) {
      CurveRow row;
      row.time = time;
      row.extension = s;
      row.load = load;
      row.phase = phase;
      row.end_to_end = end_to_end;
      out.push_back(row);
    };
    add(13.9, 7e-4, 3.2, Phase::kMount, 0.25);
    const auto count = static_cast<int>(0.12 / speed * rate);
    for (int i = 0; i <= count; ++i) {
      const double s = speed * i / rate, turn = 1e-3;
      const double load = -0.02 + 6.0 * std::min(1.0, s / turn) + 2e5 * std::max(0.0, s - 0.08);
      add(14.0 + i / rate, s, load, i == 0 ? Phase::kBalance : Phase::kPull, 0.25 + s);
    }
    return out;
  }
};

/// Units in which a machine writes what it recorded.
struct Units {
  double newtons, millimetres;
};
const Units kUnits[] = {{1.0, 1.0}, {1e3, 1.0}, {1e-3, 1e3}};

struct Offset {
  double load, extension;  ///< [N], [m]
};

/// Rows as raw data with an offset, rounded as their units round them.
std::vector<CurveRow> recorded(std::vector<CurveRow> rows, const Units& units, const Offset& offset) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  for (CurveRow& row : rows) {
    row.extension = 1e3 * (row.extension + offset.extension) / units.millimetres * (1e-3 * units.millimetres);
    row.load = (row.load + offset.load) / units.newtons * units.newtons;
    row.end_to_end = row.load_lower = kNone;
    row.phase = Phase::kPull;
  }
  return rows;
}

void expect_the_same(const Pull& a, const Pull& b) {
  const Comparison found = compare(a, b);
  ASSERT_TRUE(found.difference);
  const double peak = *found.a.peak_force;
  EXPECT_LT(std::abs(found.difference->largest), 1e-10 * peak);
  EXPECT_NEAR(*found.b.peak_force, peak, 1e-10 * peak);
  ASSERT_TRUE(found.a.plateau_force && found.b.plateau_force);
  EXPECT_NEAR(*found.b.plateau_force, *found.a.plateau_force, 1e-9);
  // At 20 mm/s and 3 Hz too few readings tell where it locks.
  ASSERT_EQ(found.b.lock_extension_by_load.has_value(), found.a.lock_extension_by_load.has_value());
  if (!found.a.lock_extension_by_load) return;
  EXPECT_NEAR(*found.b.lock_extension_by_load, *found.a.lock_extension_by_load, 1e-12);
}

TEST(RawZero, ACurveDiffersFromItsOwnRawDataByRounding) {
  for (const double speed : {1e-3, 3.3e-3, 2e-2})
    for (const double rate : {3.0, 17.0, 60.0})
      for (const Units& units : kUnits)
        for (const Offset& offset : {Offset{0.0, 0.0}, Offset{3.0, 0.013}, Offset{-40.0, -0.3}}) {
          SCOPED_TRACE(testing::Message()
                       << speed << " m/s, " << rate << " Hz, " << units.newtons << " N, " << offset.load);
          const std::vector<CurveRow> ours = Pulled{speed, rate}.rows();
          const Pull pull = pull_of(ours);
          // At zero.
          std::vector<CurveRow> rows(ours.begin() + 1, ours.end());
          std::vector<CurveRow> raw = recorded(rows, units, offset);
          EXPECT_EQ(zero_at_rest(raw).readings, 1u);
          expect_the_same(pull, pull_of(balanced(raw, zero_at_rest(raw, pull))));
          // Before: it stood still.
          for (int i = 0; i < 20; ++i) {
            CurveRow rest = rows.front();
            rest.time -= 0.1;
            rows.insert(rows.begin(), rest);
          }
          raw = recorded(rows, units, offset);
          EXPECT_EQ(zero_at_rest(raw).readings, 21u);
          expect_the_same(pull, pull_of(balanced(raw, zero_at_rest(raw, pull))));
        }
}

TEST(RawZero, ACurveOfOursThatWasCutHasItsZeroStill) {
  const std::vector<CurveRow> ours = Pulled().rows(), cut(ours.begin() + 7, ours.end());
  EXPECT_TRUE(has_its_zero(cut));
  EXPECT_EQ(curve_difference(pull_of(ours), pull_of(cut))->largest, 0.0);
  EXPECT_FALSE(has_its_zero(recorded(cut, kUnits[0], {})));
}

TEST(RawZero, ThePullOfOursBeginsAtZero) {
  std::vector<CurveRow> ours = Pulled().rows();
  EXPECT_EQ(pull_of(ours).front().extension, 0.0);
  EXPECT_EQ(pull_of(ours).front().force, -0.02);
  ours.erase(ours.begin() + 1);  // the balance lies between two readings
  EXPECT_EQ(pull_of(ours).front().extension, 0.0);
  EXPECT_EQ(pull_of(ours).front().force, 0.0);
  ours.erase(ours.begin());
  EXPECT_GT(pull_of(ours).front().extension, 0.0);
}

TEST(RawZero, NoiseOfTheRestIsAveraged) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  std::vector<CurveRow> rows = Pulled{3.3e-3, 100.0}.rows();
  rows.erase(rows.begin());
  rows.insert(rows.begin(), 400, rows.front());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].time = 0.01 * static_cast<double>(i);
    rows[i].load += 0.1 * normal(random);
  }
  const std::vector<CurveRow> raw = recorded(rows, kUnits[0], {3.0, 0.013});
  const RawZero zero = zero_at_rest(raw);
  EXPECT_EQ(zero.readings, 401u);
  EXPECT_NEAR(zero.load, 3.0 - 0.02, 0.02);
  EXPECT_NEAR(zero.extension, 0.013, 1e-9);
}

TEST(RawZero, AWayBackAtTheEndIsNoRest) {
  std::vector<CurveRow> rows = Pulled().rows();
  rows.erase(rows.begin());
  CurveRow back = rows.front();
  back.time = rows.back().time + 30.0;
  rows.push_back(back);
  EXPECT_EQ(zero_at_rest(recorded(rows, kUnits[0], {3.0, 0.013})).first, 0u);
}

Pull line(double (*force)(double), double end, int points) {
  Pull out;
  for (int i = 0; i <= points; ++i) out.push_back({0.0, end * i / points, 0.0, force(end * i / points)});
  return out;
}

TEST(CurveDifference, OfLinesIsTheirExactIntegral) {
  // F_b - F_a = 100 s - 1 over s from 0.01 to 0.03: its mean square is 4/3, over points that do not coincide.
  const Pull a = line([](double s) { return 1.0 + 100.0 * s; }, 0.03, 7);
  Pull b = line([](double s) { return 200.0 * s; }, 0.05, 11);
  b.erase(b.begin(), b.begin() + 2);
  const auto difference = curve_difference(a, b);
  ASSERT_TRUE(difference);
  const double low = b.front().extension, high = 0.03;
  EXPECT_DOUBLE_EQ(difference->common.low, low);
  EXPECT_DOUBLE_EQ(difference->common.high, high);
  const auto cube = [](double s) { return std::pow(100.0 * s - 1.0, 3) / 300.0; };
  EXPECT_NEAR(difference->rms, std::sqrt((cube(high) - cube(low)) / (high - low)), 1e-12);
  EXPECT_NEAR(difference->largest, 2.0, 1e-12);
  EXPECT_DOUBLE_EQ(difference->largest_at, high);
  EXPECT_NEAR(difference->load, 4.0, 1e-12);
}

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
  EXPECT_THAT(complaint_of([&] { told.compare(still, ours()); }),
              HasSubstr("raw.csv: nothing is pulled: no reading has a larger extension than the first"));
  lost.rows[3].load = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(told.compare(ours(), lost), InvalidInput);
}

/// Three digits behind the point as tables print them (ISO 2602, table 1).
TEST(Statistics, StudentsPointIsThatOfTheTables) {
  EXPECT_NEAR(student_95(1), 12.706, 5e-4);
  EXPECT_NEAR(student_95(4), 2.776, 5e-4);
  EXPECT_NEAR(student_95(9), 2.262, 5e-4);
  EXPECT_NEAR(student_95(120), 1.980, 5e-4);
}

TEST(Statistics, FiveReadings) {
  const Statistics s = statistics_of({2.0, 4.0, 4.0, 5.0, 10.0});
  EXPECT_EQ(s.n, 5u);
  EXPECT_DOUBLE_EQ(*s.mean, 5.0);
  EXPECT_DOUBLE_EQ(*s.sd, 3.0);  // 9 + 1 + 1 + 0 + 25 = 36 over 4
  EXPECT_DOUBLE_EQ(*s.cv, 0.6);
  EXPECT_DOUBLE_EQ(*s.minimum, 2.0);
  EXPECT_DOUBLE_EQ(*s.maximum, 10.0);
  EXPECT_NEAR(*s.high - *s.mean, 2.776 * 3.0 / std::sqrt(5.0), 1e-3);
  EXPECT_NEAR(*s.mean - *s.low, *s.high - *s.mean, 1e-12);
}

TEST(Statistics, WhatTooFewReadingsDoNotTellIsNotSaid) {
  const Statistics none = statistics_of({});
  EXPECT_FALSE(none.mean || none.sd || none.minimum);
  const Statistics one = statistics_of({3.0});
  EXPECT_EQ(*one.mean, 3.0);
  EXPECT_FALSE(one.sd || one.cv || one.low || one.high);
  const Statistics about_zero = statistics_of({-1.0, 1.0});
  EXPECT_TRUE(about_zero.sd);
  EXPECT_FALSE(about_zero.cv);
}

TEST(Statistics, WhatIsConstantButForRoundingHasNoSpread) {
  for (const std::vector<double>& same : {std::vector<double>{31.000374, 31.000419, 31.000331},
                                          {-0.25, -0.25 * (1.0 + 1e-15)},
                                          {1e-15, -3e-14},
                                          {0.0, 0.0}}) {
    const Statistics s = statistics_of(same);
    EXPECT_FALSE(s.sd || s.cv || s.low || s.high) << same.front();
    EXPECT_EQ(s.n, same.size());
    EXPECT_EQ(*s.maximum, *std::max_element(same.begin(), same.end()));
  }
  EXPECT_TRUE(statistics_of({31.0, 31.01}).sd);
}

}  // namespace
}  // namespace knot_utm
