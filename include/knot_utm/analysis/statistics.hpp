#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace knot_utm {

/// Statistics of n readings x_i of one quantity, in its unit:
///
///     mean        m = sum x_i / n
///     sd          standard deviation of single specimens, s = sqrt(sum (x_i - m)^2 / (n - 1))
///     cv          coefficient of variation, s/|m| [-]
///     low, high   m -+ t s/sqrt(n): the 95 % confidence interval of the mean of all specimens, where t is the 97.5 %
///                 quantile of Student's distribution with n - 1 degrees of freedom
///
/// Source: ISO 2602 (mean and its interval).
struct Statistics {
  std::size_t n = 0;
  std::optional<double> mean;           ///< empty: there is no reading
  std::optional<double> sd, low, high;  ///< empty: fewer than two readings, or all the same but for rounding
  std::optional<double> cv;             ///< empty also where the mean is zero
  std::optional<double> minimum, maximum;
};

Statistics statistics_of(const std::vector<double>& readings);

/// The number t for which |T| <= t in 95 % of cases, where T follows Student's distribution. `degrees`: degrees of
/// freedom, at least 1.
double student_95(std::size_t degrees);

}  // namespace knot_utm
