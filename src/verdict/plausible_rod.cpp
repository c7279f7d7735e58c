#include "knot_utm/verdict/plausible_rod.hpp"

#include <cmath>
#include <utility>

#include "knot_utm/numeric/number.hpp"
#include "knot_utm/specimen/material.hpp"

namespace knot_utm {
namespace {

constexpr double kLightest = 150.0, kHeaviest = 12000.0;    // [kg/m3]
constexpr double kSoftest = 1e4, kStiffest = 1.5e12;        // modulus [Pa]
constexpr double kLeastBending = 1e-6, kMostBending = 4.0;  // over that of a solid rod that stretches alike
constexpr double kLeastStrain = 1e-4;                       // at break

double area(const Material& material) { return M_PI * material.radius * material.radius; }
double modulus(const Material& material) { return material.stretching_stiffness / area(material); }

/// Bending stiffness over that of a solid rod of the same stretching stiffness, k_s h^2/4.
double bending(const Material& material) {
  return 4.0 * material.bending_stiffness / (material.stretching_stiffness * material.radius * material.radius);
}

/// "2.3 GPa".
std::string pascals(double value) {
  for (const auto& [size, name] : {std::pair<double, const char*>{1e9, " GPa"}, {1e6, " MPa"}, {1e3, " kPa"}})
    if (value >= size) return short_number(value / size) + name;
  return short_number(value) + " Pa";
}

}  // namespace

std::string rod_in_words(const Material& material) {
  return short_number(1e3 * material.density * area(material)) + " g/m at a diameter of " +
         short_number(2e3 * material.radius) + " mm, E = " + pascals(modulus(material)) +
         " stretched, bending stiffness " + short_number(bending(material)) +
         " of that of a solid rod of this E, friction coefficient " + short_number(material.friction_coefficient);
}

std::vector<std::string> questions_about(const Material& material) {
  std::vector<std::string> all;
  const double density = material.density, stretched = modulus(material), bent = bending(material);
  if (density < kLightest || density > kHeaviest)
    all.push_back("material.density is " + short_number(density) +
                  " kg/m3, where cork has 200, water 1000 and steel 7850: is it in kg/m3, and material.radius, " +
                  short_number(material.radius) + ", in m?");
  if (stretched < kSoftest || stretched > kStiffest)
    all.push_back(
        "material.stretching_stiffness is " + short_number(material.stretching_stiffness) +
        " N, which is E = " + pascals(stretched) +
        ", where rubber has 1 MPa, nylon 2 GPa and steel 200 GPa: is it E times the cross-section, in Pa times "
        "m2, and material.radius in m?");
  else if (bent < kLeastBending || bent > kMostBending)
    all.push_back("material.bending_stiffness is " + short_number(material.bending_stiffness) + " N m2, which is " +
                  short_number(bent) +
                  " of that of a solid rod that stretches alike, where ropes have 0.0001 to 1: is it in N m2?");
  if (material.breaking_force && *material.breaking_force < kLeastStrain * material.stretching_stiffness)
    all.push_back("material.breaking_force is " + short_number(*material.breaking_force) +
                  " N, with which the rod breaks at a strain of " +
                  short_number(*material.breaking_force / material.stretching_stiffness) + ": is it in N?");
  return all;
}

}  // namespace knot_utm
