// Single words: a number, and the name of a phase.
#include <cmath>

#include "fuzz/target.hpp"
#include "knot_utm/numeric/number.hpp"
#include "knot_utm/record/program.hpp"

namespace knot_utm {

namespace {

bool same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

}  // namespace

void fuzz(const std::string& text) {
  if (const std::optional<double> value = parse_number(text)) {
    promise(same(parse_number(format_number(*value)).value(), *value), "a number reads back to the same");
    promise(same(parse_number(format_yaml_number(*value)).value(), *value), "and so it does as YAML");
    const std::string sign = text.substr(0, 1) == "+" || text.substr(0, 1) == "-" ? text.substr(1) : text;
    promise(sign.find_first_of("+-") != 0, "a number has one sign");
  }
  if (const std::optional<Phase> phase = phase_named(text)) promise(phase_name(*phase) == text, "a phase has one name");
}

}  // namespace knot_utm
