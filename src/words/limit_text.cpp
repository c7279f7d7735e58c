#include "knot_utm/words/limit_text.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <limits>

#include "knot_utm/words/number.hpp"

namespace knot_utm {
namespace {

constexpr int kAllDigits = std::numeric_limits<double>::max_digits10;

std::string with_digits(double value, int digits) {
  std::array<char, 48> text{};
  const std::to_chars_result end =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, digits);
  return std::string(text.data(), end.ptr);
}

/// The nearest number of so many digits that is not below the limit; of the negative limit, not above the limit.
std::string towards(double limit, int digits, int sign) {
  const std::string exact = format_number(limit), rounded = with_digits(limit, digits);
  if (!std::isfinite(limit) || limit == 0.0 || exact.size() <= rounded.size()) return exact;
  const double unit = std::pow(10.0, std::floor(std::log10(std::abs(limit))) - (digits - 1));
  std::string text = rounded;
  for (double count = std::round(limit / unit); sign * (*parse_number(text) - limit) < 0.0; count += sign)
    text = with_digits(count * unit, digits);
  return text;
}

}  // namespace

std::string least_text(double limit, int digits) { return towards(limit, digits, 1); }
std::string most_text(double limit, int digits) { return towards(limit, digits, -1); }

std::string limits_text(double least, double most) {
  if (!(least < most)) return least_text(least);
  for (int digits = 4;; ++digits) {
    const std::string low = least_text(least, digits), high = most_text(most, digits);
    if (digits >= kAllDigits || *parse_number(low) < *parse_number(high)) return low + " to " + high;
  }
}

}  // namespace knot_utm
