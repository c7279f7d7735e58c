#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace knot_utm {

/// What a laboratory says of n readings x_i of one quantity, in its unit:
///
///     mean        m = sum x_i / n
///     sd          s = sqrt(sum (x_i - m)^2 / (n - 1)), of single specimens
///     cv          s/|m| [-]
///     low, high   m -+ t s/sqrt(n): the interval that holds the mean of all specimens with 95 % confidence, t being
///                 the 97.5 % point of Student's distribution with n - 1 degrees of freedom
///
/// Source: ISO 2602 (mean and its interval).
struct Statistics {
  std::size_t n = 0;
  std::optional<double> mean;           ///< none: no reading
  std::optional<double> sd, low, high;  ///< none: fewer than two readings
  std::optional<double> cv;             ///< none also where the mean is zero
  std::optional<double> minimum, maximum;
};

Statistics statistics_of(const std::vector<double>& readings);

/// t with which |T| <= t in 95 % of cases, of Student's distribution; `degrees` of freedom, 1 or more.
double student_95(std::size_t degrees);

}  // namespace knot_utm
