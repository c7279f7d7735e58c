#include "load_terms.hpp"

#include <stdexcept>

#include "knot_utm/numeric/number.hpp"

namespace knot_utm::fields {

std::optional<double> load_in_terms(const std::string& text, const Material& material) {
  // The tension under which a rope is measured, d^2/8 in decanewtons for a rope of d millimetres: doc/standards.md.
  const double d = 2e3 * material.radius;
  if (text == "reference_tension") return 10.0 * d * d / 8.0;
  if (text.empty() || text.back() != '%') return std::nullopt;
  const std::string before = text.substr(0, text.size() - 1);
  const std::optional<double> percent = parse_number(before.substr(0, before.find_last_not_of(' ') + 1));
  if (!percent) return std::nullopt;
  if (!material.breaking_force)
    throw std::invalid_argument("material has no breaking_force, of which this is a percentage");
  return *percent * *material.breaking_force / 100.0;
}

}  // namespace knot_utm::fields
