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

/// A limit that a message names, with few digits, and still on the allowed side of the true one: `least_text` is no
/// smaller than the smallest value that is allowed, `most_text` no larger than the largest.
std::string least_text(double limit, int digits = 4);
std::string most_text(double limit, int digits = 4);

/// "A to B" of both, with more digits where these would make the ends equal. Only A where nothing lies between them.
std::string limits_text(double least, double most);

}  // namespace knot_utm
