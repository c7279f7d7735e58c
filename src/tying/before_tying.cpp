#include "knot_utm/tying/before_tying.hpp"

#include <algorithm>
#include <cmath>

#include "knot_utm/breaking/breaking_laws.hpp"
#include "knot_utm/rod/bending_laws.hpp"
#include "knot_utm/rod/stretching_laws.hpp"
#include "knot_utm/settings/accuracy.hpp"
#include "knot_utm/settings/step_settings.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/specimen/knot_drawing.hpp"
#include "knot_utm/specimen/material.hpp"
#include "knot_utm/words/invalid_input.hpp"
#include "knot_utm/words/number.hpp"

namespace knot_utm {
namespace {

constexpr double kClosed = 2.0;        // radius of a coil that lies on the strands in it [h]
constexpr double kSharpestBend = 0.5;  // of a tied knot, 1/kClosed [1/h]
constexpr double kCoarsestEdge = 0.9;  // of ropes that slide as with finer edges [h]: doc/developers/history.md
constexpr double kMostStretch = 2.0;   // strain by a pre-load up to which stretching laws were measured [-]
// Pink VPS was tied and mounted with a linear law up to a strain of 4.8 (4.8 k_s) and with a neo-Hookean one up to 5.6
// (2.2 k_s); at 6 and 6.8 the tail grips came to the end of their way first (config/tighten.yaml with material=pink_vps
// and specimen.preload= at draft).
constexpr double kLargestStrain = 5.0;  // by a pre-load [-]

double sketched_coil(const SpecimenOptions& specimen) { return knot_of(specimen).about().sketched_coil; }  // R_0 [h]

double bending_force(const Material& material) {
  return material.bending_stiffness / (material.radius * material.radius);
}

/// Pre-load below which the coils stay as they are sketched; at most that which closes them without friction, because
/// strands that only friction holds may still be pulled tight later.
double least_preload(const SpecimenOptions& specimen, const Material& material) {
  const double closed = closing_preload(material), fraction = kClosed / sketched_coil(specimen);
  return std::min(closed * fraction * fraction, bending_force(material) / (2.0 * kClosed * kClosed));
}

/// Strain of the outermost fibre of a rod that is stretched and bent, over the strain at which it parts; 0: bending
/// does not part it.
double exposed_by(double stretch, double bend, const Material& material) {
  if (!parts_by_bending(material)) return 0.0;
  return std::get<FibreBreaking>(breaking_law_of(material)).fraction({0.0, stretch, bend, 0.0});
}

/// Warning about a strain that the outermost fibre of a tied knot may not bear; empty: nothing is known to fail.
std::string strain_warning(double stretch, const Material& material) {
  const double strain = stretch + kSharpestBend, exposed = exposed_by(stretch, kSharpestBend, material);
  if (exposed > 1.0)
    return "tied knots strain their fibres by up to " + short_number(exposed) +
           " times what parts them (material.breaking), so the rod may part while it is tied";
  if (remembers_bends(material)) return "";
  if (material.yield_strain && *material.yield_strain < strain)
    return "tied knots strain the outermost fibre by up to " + short_number(strain) +
           ", and the material yields at a strain of " + short_number(*material.yield_strain) +
           " (material.yield_strain), which only material.bending_law: plastic simulates";
  return "";
}

/// Warning about edges that are too long for the bends of a tied rope; empty: they are not. Knots of solid rods came
/// out the same with edges of 2 h.
std::string mesh_warning(double edge, const Material& material) {
  const double h = thickest(material);
  if (edge <= kCoarsestEdge * h || is_solid(material)) return "";
  return "edges of " + short_number(edge / h) +
         " radii are too long for the bends of a tied knot, in which the rod turns by " +
         short_number(edge / (kClosed * h)) +
         " rad from one to the next, so the knot may open where it would hold with shorter edges; choose a smaller "
         "specimen.edge_length or a higher specimen.refinement, so that edges in knots are at most " +
         short_number(kCoarsestEdge) + " radii long";
}

}  // namespace

bool tied_by_preload(const SpecimenOptions& specimen) { return !specimen.drawing || !specimen.drawing->tie.empty(); }

bool preload_acts(const SpecimenOptions& specimen) {
  return tied_by_preload(specimen) || !specimen.drawing->weights.empty();
}

double closing_preload(const Material& material) {
  return std::exp(M_PI * material.friction_coefficient) * bending_force(material) / (2.0 * kClosed * kClosed);
}

double coil_radius(const Material& material, double preload) {
  return kClosed * material.radius * std::sqrt(closing_preload(material) / preload);
}

namespace {

double tension_at(const Material& material, double strain) {
  const StretchedEdge edge{material.stretching_stiffness, 1.0, 1.0 + strain};
  return std::visit([&](const auto& law) { return law.respond(edge).tension; }, stretching_law_of(material));
}

/// `section`: that of the method which describes this material.
void check_stretch(double preload, const Material& material, const std::string& section) {
  const double largest = tension_at(material, kLargestStrain);
  if (preload <= largest) return;
  throw InvalidInput("specimen.preload", short_number(preload),
                     "at most " + short_number(largest) + " N for a rod with " + section + ".stretching_stiffness " +
                         short_number(material.stretching_stiffness) + " N and " + section + ".stretching_law: " +
                         StretchingRegistry::entry(material.stretching.law).name + ", which stretches it to " +
                         short_number(1.0 + kLargestStrain) + " times its length: a larger one cannot be tied");
}

}  // namespace

void check_tying(const SpecimenOptions& specimen, const Material& material) {
  if (!tied_by_preload(specimen)) return;
  const double preload = tying_load(specimen, material), least = least_preload(specimen, material);
  if (preload < least)
    throw InvalidInput("specimen.preload", short_number(preload),
                       "at least " + least_text(least) + " N for a rod with material.bending_stiffness " +
                           short_number(material.bending_stiffness) + " N m2, radius " + short_number(material.radius) +
                           " m and friction_coefficient " + short_number(material.friction_coefficient) +
                           ": a smaller one does not move the coils, which close only at " +
                           short_number(closing_preload(material)) + " N");
  check_stretch(preload, material, "material");
  if (material.other) check_stretch(preload, *material.other, "other_material");
  const double exposed = exposed_by(strain_under(material, preload), 1.0 / sketched_coil(specimen), material);
  if (exposed >= 1.0)
    throw InvalidInput(
        "material.breaking.bending_share", short_number(material.breaking.number(FibreBreaking::kBendingShare)),
        "so small that the loose coil from which a knot is tied bears specimen.preload, " + short_number(preload) +
            " N: it strains the outermost fibre by " + short_number(exposed) + " times what parts it");
}

std::vector<std::string> tying_warnings(const SpecimenOptions& specimen, const Material& material,
                                        const PhysicsOptions& physics) {
  std::vector<std::string> all;
  double stretch = 0.0;
  if (tied_by_preload(specimen)) {
    const double preload = tying_load(specimen, material), closing = closing_preload(material);
    stretch = strain_under(material, preload);
    if (preload < closing)
      all.push_back("a pre-load of " + short_number(preload) + " N leaves the coils open, at a radius of about " +
                    short_number(std::min(coil_radius(material, preload) / material.radius, sketched_coil(specimen))) +
                    " radii of the rod: they close at " + short_number(closing) + " N");
    if (stretch > kMostStretch)
      all.push_back("a pre-load of " + short_number(preload) + " N stretches the rod to " +
                    short_number(1.0 + stretch) + " times its length");
  }
  const double edge = specimen.edge_length / tolerances(physics, specimen, material).refinement;
  for (const std::string& found : {strain_warning(stretch, material), mesh_warning(edge, material)})
    if (!found.empty()) all.push_back(found);
  return all;
}

}  // namespace knot_utm
