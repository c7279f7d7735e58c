#include "shape_checks.hpp"

#include <limits>
#include <sstream>

#include "knot_utm/numeric/invalid_input.hpp"
#include "knot_utm/numeric/number.hpp"

namespace knot_utm {

namespace {

constexpr int kDigits = 4;

std::string text(double value, int digits) {
  std::ostringstream out;
  out.precision(digits);
  out << value;
  return out.str();
}

}  // namespace

std::string text(double value) { return text(value, kDigits); }

std::string range_text(double low, double high) {
  int digits = kDigits;
  while (digits < std::numeric_limits<double>::max_digits10 && text(low, digits) == text(high, digits)) ++digits;
  return low == high ? text(low) : text(low, digits) + " to " + text(high, digits);
}

void check_edge_length(double edge_length, double radius) {
  if (!(edge_length >= 0.05 * radius && edge_length <= 2.0 * radius)) {
    throw InvalidInput("specimen.edge_length", text(edge_length),
                       text(0.05 * radius) + " to " + text(2.0 * radius) + " m: at most the rod's diameter");
  }
}

void check_edges_of_length(const SpecimenOptions& specimen) {
  if (specimen.edge_length > specimen.length / 4.0)
    throw InvalidInput("specimen.edge_length", format_number(specimen.edge_length),
                       "at most a quarter of length, " + format_number(specimen.length / 4.0) + " m");
}

void check_radius(double radius) {
  if (!(radius > 0.0 && radius < 1.0)) throw InvalidInput("material.radius", text(radius), "above 0 and below 1 m");
}

}  // namespace knot_utm
