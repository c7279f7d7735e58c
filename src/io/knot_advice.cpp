#include "knot_utm/io/knot_advice.hpp"

#include "knot_utm/machine/step_settings.hpp"
#include "knot_utm/numeric/number.hpp"
#include "knot_utm/specimen/knot.hpp"

namespace knot_utm {

std::string what_keeps_a_knot(const Method& method) {
  const std::string friction =
      "a higher material.friction_coefficient (now " + short_number(method.material.friction_coefficient) + ")";
  const SpecimenOptions& specimen = method.specimen;
  const std::string other = knot_of(specimen).what_keeps_it();
  if (!other.empty()) return friction + " or " + other + " may keep it";
  if (!specimen.to_be_tied) return friction + " may keep it";
  if (friction_rolls(method.material, method.machine, method.physics))
    return "the couple of friction rolls its strands: a smaller material.friction_couple (now " +
           short_number(friction_couple(method.material, method.physics)) + ") or a larger material.bending_set (now " +
           short_number(method.material.bending_set) + ") may keep it";
  const double usual = default_preload(method.material), preload = specimen.preload.value_or(usual);
  std::string now = short_number(preload) + " N";
  if (preload < usual) now += "; auto is " + short_number(usual) + " N";
  return "a higher specimen.preload (now " + now + ") or " + friction + " may keep it";
}

}  // namespace knot_utm
