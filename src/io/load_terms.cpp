#include "load_terms.hpp"

#include <stdexcept>

#include "knot_utm/numeric/number.hpp"

namespace knot_utm::fields {

LoadTerms::LoadTerms(const Material& material)
    : breaking_force_(material.breaking_force), reference_tension_(reference_tension(material)) {}

std::optional<double> LoadTerms::load(const std::string& text) const {
  if (text == "reference_tension") return reference_tension_;
  const std::size_t sign = text.size() - 1;
  if (text.empty() || text[sign] != '%') return std::nullopt;
  const std::optional<double> percent = parse_number(text.substr(0, text.find_last_not_of(' ', sign - 1) + 1));
  if (!percent) return std::nullopt;
  if (!breaking_force_)
    throw std::invalid_argument("the material has no breaking_force, of which this is a percentage");
  return *percent / 100.0 * *breaking_force_;
}

double reference_tension(const Material& material) {
  const double d = 2e3 * material.radius;  // [mm]
  return 10.0 * d * d / 8.0;
}

}  // namespace knot_utm::fields
