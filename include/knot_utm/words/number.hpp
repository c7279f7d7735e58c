#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace knot_utm {

/// The shortest text that reads back to the same double, the same on every machine and in every locale.
/// Not-a-number is "nan", infinities are "inf" and "-inf".
std::string format_number(double value);

/// The same in a form that every YAML reader takes for a number: ".nan", ".inf", "-.inf", and a point before an
/// exponent.
std::string format_yaml_number(double value);

/// To three digits, for sentences.
std::string short_number(double value);

/// The whole text as a number ("1", "-2.5e-3", ".inf", "nan"); nothing where it is not one.
std::optional<double> parse_number(std::string_view text);

}  // namespace knot_utm
