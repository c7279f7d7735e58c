#include "load_terms.hpp"

#include <stdexcept>

#include "knot_utm/numeric/number.hpp"

namespace knot_utm::fields {

LoadTerms::LoadTerms(const Material& material)
    : breaking_force_(material.breaking_force), reference_tension_(reference_tension(material)) {}

std::optional<double> LoadTerms::load(const std::string& text) const {
  if (text == "reference_tension") return reference_tension_;
  if (text.empty() || text.back() != '%') return std::nullopt;
  const std::string before = text.substr(0, text.size() - 1);
  const std::optional<double> percent = parse_number(before.substr(0, before.find_last_not_of(' ') + 1));
  if (!percent) return std::nullopt;
  if (!breaking_force_)
    throw std::invalid_argument("the material has no breaking_force, of which this is a percentage");
  return *percent * *breaking_force_ / 100.0;
}

double reference_tension(const Material& material) {
  const double d = 2e3 * material.radius;  // [mm]
  return 10.0 * d * d / 8.0;
}

}  // namespace knot_utm::fields
