#include "shape_checks.hpp"

#include <array>
#include <cstdio>
#include <sstream>

#include "knot_utm/words/invalid_input.hpp"
#include "knot_utm/words/limit_text.hpp"
#include "knot_utm/words/number.hpp"

namespace knot_utm {

namespace {

constexpr int kDigits = 4;

}  // namespace

std::string text(double value) {
  std::ostringstream out;
  out.precision(kDigits);
  out << value;
  return out.str();
}

std::string place_text(const Vec3& place) {
  std::array<char, 96> out{};
  const Vec3 at = place.array() + 0.0;  // no minus before a zero
  std::snprintf(out.data(), out.size(), "(%.1f, %.1f, %.1f)", at.x(), at.y(), at.z());
  return out.data();
}

void check_edge_length(double edge_length, double radius) {
  if (!(edge_length >= 0.05 * radius && edge_length <= 2.0 * radius)) {
    throw InvalidInput("specimen.edge_length", text(edge_length),
                       limits_text(0.05 * radius, 2.0 * radius) + " m: at most the rod's diameter");
  }
}

void check_edges_of_length(const SpecimenOptions& specimen) {
  if (specimen.edge_length > specimen.length / 4.0)
    throw InvalidInput("specimen.edge_length", format_number(specimen.edge_length),
                       "at most a quarter of length, " + most_text(specimen.length / 4.0) + " m");
}

void check_radius(double radius) {
  if (!(radius > 0.0 && radius < 1.0)) throw InvalidInput("material.radius", text(radius), "above 0 and below 1 m");
}

}  // namespace knot_utm
