#include "knot_utm/words/number.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <limits>

namespace knot_utm {
namespace {

constexpr int kAllDigits = std::numeric_limits<double>::max_digits10;

/// `format`: that of std::to_chars, and a number of digits.
template <class... Format>
std::string chars(double value, Format... format) {
  std::array<char, 48> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value, format...).ptr};
}

std::string with_digits(double value, int digits) { return chars(value, std::chars_format::general, digits); }

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

std::string format_number(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0.0 ? "inf" : "-inf";
  return chars(value);
}

std::string format_yaml_number(double value) {
  std::string text = format_number(value);
  if (std::isnan(value)) return ".nan";
  if (std::isinf(value)) return value > 0.0 ? ".inf" : "-.inf";
  const std::size_t exponent = text.find('e');
  if (exponent != std::string::npos && text.find('.') == std::string::npos) text.insert(exponent, ".0");
  return text;
}

std::string short_number(double value) {
  if (!std::isfinite(value)) return format_number(value);
  if (value == 0.0) value = 0.0;  // never "-0"
  const std::string text = with_digits(value, 3);
  // "1970" is read more easily than "1.97e+03".
  const double rounded = parse_number(text).value_or(value);
  const bool plain = std::abs(rounded) >= 1e3 && std::abs(rounded) < 1e6;
  return plain ? chars(rounded, std::chars_format::fixed) : text;
}

std::optional<double> parse_number(std::string_view text) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (text == ".inf" || text == ".Inf" || text == "+.inf" || text == "inf") return kInfinity;
  if (text == "-.inf" || text == "-.Inf" || text == "-inf") return -kInfinity;
  if (text == "nan" || text == ".nan" || text == ".NaN") return std::numeric_limits<double>::quiet_NaN();
  if (text.substr(0, 1) == "+" && text.substr(1, 1) != "-") text.remove_prefix(1);
  // from_chars would also take "infinity" and "nan(...)", which nobody means.
  if (text.find_first_not_of("0123456789+-.eE") != std::string_view::npos) return std::nullopt;
  double value = 0.0;
  const std::from_chars_result end = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end.ec != std::errc() || end.ptr != text.data() + text.size()) return std::nullopt;
  return value;
}

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
