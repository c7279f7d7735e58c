#include "knot_utm/verdict/foreseen.hpp"

#include <cmath>
#include <utility>

#include "knot_utm/grips/grips.hpp"
#include "knot_utm/program/phases.hpp"
#include "knot_utm/program/preparing_steps.hpp"
#include "knot_utm/settings/step_settings.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/tying/before_tying.hpp"
#include "knot_utm/words/number.hpp"

namespace knot_utm {
namespace {

/// From here on L has no effect on a sliding force: with F_p = 50 N, e = 0.2 m and L = 0.25 m, which is 15.7 h more,
/// polypropylene slides at 5.06 N, and with a longer loop at 6.60 N.
constexpr double kClearOfRollers = 19.0;  // L - e [h]

/// Warns of a loop whose knots are tied near its rollers.
std::string near_the_rollers(const Method& method) {
  const SpecimenOptions& specimen = method.specimen;
  if (!specimen.to_be_tied || !rollers_hold(specimen, method.machine)) return "";
  const double h = method.material.radius, clear = specimen.knot_distance + kClearOfRollers * h;
  if (specimen.end_to_end >= clear) return "";
  return "specimen.end_to_end is " + short_number(specimen.end_to_end) + " m, only " +
         short_number((specimen.end_to_end - specimen.knot_distance) / h) +
         " radii more than specimen.knot_distance, so the rollers are near the knots and change the sliding force, by "
         "up to a quarter; it does not depend on the rollers from " +
         short_number(kClearOfRollers) + " radii more on, which is a specimen.end_to_end of " + short_number(clear) +
         " m";
}

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

/// `section`: that of the material, with a dot.
void ask_about(const Material& material, const std::string& section, std::vector<std::string>& all) {
  const double density = material.density, stretched = modulus(material), bent = bending(material);
  if (density < kLightest || density > kHeaviest)
    all.push_back(section + "density is " + short_number(density) +
                  " kg/m3, where cork has 200, water 1000 and steel 7850: is it in kg/m3, and " + section + "radius, " +
                  short_number(material.radius) + ", in m?");
  if (stretched < kSoftest || stretched > kStiffest)
    all.push_back(
        section + "stretching_stiffness is " + short_number(material.stretching_stiffness) +
        " N, which is E = " + pascals(stretched) +
        ", where rubber has 1 MPa, nylon 2 GPa and steel 200 GPa: is it E times the cross-section, in Pa times "
        "m2, and " +
        section + "radius in m?");
  else if (bent < kLeastBending || bent > kMostBending)
    all.push_back(section + "bending_stiffness is " + short_number(material.bending_stiffness) + " N m2, which is " +
                  short_number(bent) +
                  " of that of a solid rod that stretches alike, where ropes have 0.0001 to 1: is it in N m2?");
  if (material.breaking_force && *material.breaking_force < kLeastStrain * material.stretching_stiffness)
    all.push_back(section + "breaking_force is " + short_number(*material.breaking_force) +
                  " N, with which the rod breaks at a strain of " +
                  short_number(*material.breaking_force / material.stretching_stiffness) + ": is it in N?");
}

constexpr double kTiedByDefault = 3.15;  // `program.tie.speed: auto` of src/method/method.cpp [radii/s]
/// Here the plateaus of nylon and polypropylene are 1.1 and 0.3 % lower: config/tighten.yaml with
/// program.tie.speed=0.029 [radii/s].
constexpr double kTiedSlow = 3.0 * kTiedByDefault;
/// Ten times the default moved the plateau of nylon by -8 %, of polypropylene by -7 %
/// (config/tighten.yaml with program.tie.speed=0.1).
constexpr const char* kTiedFast =
    "; ten times the default changes a sliding force by up to 8 %, so choose a lower program.tie.speed";

constexpr double kPulledAsShipped = 1.04;  // [radii/s]
/// At three times that the plateaus of nylon and polypropylene are the same to 0.4 % (five starts).
constexpr double kPulledSlow = 5.0 * kPulledAsShipped;
/// Ten times moved the plateau of nylon by 2.9 %, of polypropylene by 1.2 %.
constexpr const char* kPulledFast =
    "; ten times that changes a sliding force by up to 3 %, so choose a lower program.pull.speed";

}  // namespace

std::vector<std::string> foreseen_warnings(const Method& method) {
  std::vector<std::string> all;
  if (method.specimen.to_be_tied) all = tying_warnings(method.specimen, method.material, method.physics);
  all.insert(all.end(), method.overruled.begin(), method.overruled.end());
  if (const std::string found = near_the_rollers(method); !found.empty()) all.push_back(found);
  ask_about(method.material, "material.", all);
  if (method.material.other) ask_about(*method.material.other, "other_material.", all);
  return all;
}

std::vector<std::string> speed_warnings(const Method& method) {
  std::vector<std::string> all;
  for (const ProgramStep& step : method.program) {
    const double speed = step->speed / thickest(method.material);
    const std::string told = format_number(std::round(10.0 * speed) / 10.0);
    if (step.as<TieStep>() && speed > kTiedSlow)
      all.push_back("the knots are tied at " + told + " radii a second, by default at " +
                    format_number(kTiedByDefault) + kTiedFast);
    if (pulls(step->phase()) && speed > kPulledSlow && knot_of(method.specimen).about().loop)
      all.push_back("the loop is pulled at " + told + " radii a second, as shipped at " +
                    format_number(kPulledAsShipped) + kPulledFast);
  }
  return all;
}

std::string rod_in_words(const Material& material) {
  return short_number(1e3 * material.density * area(material)) + " g/m at a diameter of " +
         short_number(2e3 * material.radius) + " mm, E = " + pascals(modulus(material)) +
         " stretched, bending stiffness " + short_number(bending(material)) +
         " of that of a solid rod of this E, friction coefficient " + short_number(material.friction_coefficient);
}

std::string what_keeps_a_knot(const Method& method) {
  const Material& material = method.material;
  if (method.specimen.to_be_tied && friction_rolls(material, method.machine, method.physics))
    return "the couple of friction rolls its strands: a larger material.rolling_resistance (now " +
           short_number(material.rolling_resistance) + ") may keep it";
  const double preload = method.specimen.preload.value_or(default_preload(material));
  return (method.specimen.to_be_tied ? "a higher specimen.preload (now " + short_number(preload) + " N) or " : "") +
         "a higher material.friction_coefficient (now " + short_number(material.friction_coefficient) + ") may keep it";
}

}  // namespace knot_utm
