#include "shape_checks.hpp"

#include <sstream>

#include "knot_utm/rod/invalid_input.hpp"

namespace knot_utm {

std::string text(double value) {
  std::ostringstream out;
  out.precision(4);
  out << value;
  return out.str();
}

void check_edge_length(double edge_length, double radius) {
  if (!(edge_length >= 0.05 * radius && edge_length <= 2.0 * radius)) {
    throw InvalidInput("specimen.edge_length", text(edge_length),
                       text(0.05 * radius) + " to " + text(2.0 * radius) + " m (at most the rod's diameter)");
  }
}

void check_radius(double radius) {
  if (!(radius > 0.0 && radius < 1.0)) throw InvalidInput("material.radius", text(radius), "above 0, below 1 m");
}

}  // namespace knot_utm
