#include "knot_utm/analysis/statistics.hpp"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

namespace knot_utm {
namespace {

// Readings of one test differ by more where its tolerances change; by less, only rounding and the place of the last
// time step tell them apart.
constexpr double kSame = 1e-4;      // of the largest one
constexpr double kNothing = 1e-12;  // in SI units, which no reading resolves

bool is_constant(const Statistics& of) {
  const double largest = std::max(std::abs(*of.minimum), std::abs(*of.maximum));
  return largest < kNothing || *of.maximum - *of.minimum <= kSame * largest;
}

}  // namespace

double student_95(std::size_t degrees) {
  return boost::math::quantile(boost::math::students_t(static_cast<double>(degrees)), 0.975);
}

Statistics statistics_of(const std::vector<double>& readings) {
  Statistics out;
  out.n = readings.size();
  if (readings.empty()) return out;
  const auto n = static_cast<double>(out.n);
  double sum = 0.0;
  for (const double x : readings) sum += x;
  const double mean = sum / n;
  out.mean = mean;
  out.minimum = *std::min_element(readings.begin(), readings.end());
  out.maximum = *std::max_element(readings.begin(), readings.end());
  if (out.n < 2 || is_constant(out)) return out;
  double squares = 0.0;
  for (const double x : readings) squares += (x - mean) * (x - mean);
  const double sd = std::sqrt(squares / (n - 1.0));
  const double half = student_95(out.n - 1) * sd / std::sqrt(n);
  out.sd = sd;
  out.low = mean - half;
  out.high = mean + half;
  if (mean != 0.0) out.cv = sd / std::abs(mean);
  return out;
}

}  // namespace knot_utm
