#include "knot_utm/verdict/knot_advice.hpp"

#include <vector>

#include "knot_utm/machine/step_settings.hpp"
#include "knot_utm/numeric/number.hpp"
#include "knot_utm/specimen/knot.hpp"

namespace knot_utm {

namespace {

/// Advises longer tails where those of a loop are shorter than by default: an end that slips out of its coil unties the
/// knot, however hard it was tied. It is empty where they are not.
std::string longer_tail(const Method& method) {
  const Knot& knot = knot_of(method.specimen);
  if (!knot.about().loop || !knot.has("tail")) return "";
  const double h = method.material.radius;
  SpecimenOptions usual = knot.defaults(h);
  knot.suit(method.specimen, method.machine.roller_diameter, h, usual);
  constexpr double kShorter = 0.99;
  if (!(method.specimen.tail < kShorter * usual.tail)) return "";
  return "a longer specimen.tail (now " + short_number(method.specimen.tail) + " m; auto is " +
         short_number(usual.tail) + " m)";
}

std::string higher_preload(const Method& method) {
  const double usual = default_preload(method.material), preload = method.specimen.preload.value_or(usual);
  std::string now = short_number(preload) + " N";
  if (preload < usual) now += "; auto is " + short_number(usual) + " N";
  return "a higher specimen.preload (now " + now + ")";
}

}  // namespace

std::string what_keeps_a_knot(const Method& method) {
  const Material& material = method.material;
  const bool rolls = method.specimen.to_be_tied && friction_rolls(material, method.machine, method.physics);
  std::vector<std::string> remedies{longer_tail(method)};
  if (rolls) {
    remedies.push_back("a smaller material.friction_couple (now " +
                       short_number(friction_couple(material, method.physics)) + ")");
    remedies.push_back("a larger material.bending_set (now " + short_number(material.bending_set) + ")");
  } else {
    if (method.specimen.to_be_tied) remedies.push_back(higher_preload(method));
    remedies.push_back("a higher material.friction_coefficient (now " + short_number(material.friction_coefficient) +
                       ")");
    remedies.push_back(knot_of(method.specimen).what_keeps_it());
  }
  std::string all;
  for (const std::string& remedy : remedies)
    if (!remedy.empty()) all += (all.empty() ? "" : " or ") + remedy;
  return (rolls ? "the couple of friction rolls its strands: " : "") + all + " may keep it";
}

}  // namespace knot_utm
