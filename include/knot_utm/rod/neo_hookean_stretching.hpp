#pragma once

#include "knot_utm/numeric/law_registry.hpp"
#include "knot_utm/rod/stretching_law.hpp"

namespace knot_utm {

struct RodMaterial;

/// A bar of rubber that keeps its volume: an incompressible neo-Hookean solid of shear modulus k_s/(3 A), A being the
/// section at rest, under uniaxial tension,
///
///     W = k_s/6 (lambda^2 + 2/lambda - 3)
///     T = k_s/3 (lambda - lambda^-2)           nominal, a force
///     dT/dlambda = k_s/3 (1 + 2 lambda^-3)
///
/// Pulled, it softens to a third of k_s; compressed, it stiffens. Rubber follows it up to a strain of about 50 %. The
/// bar grows thinner in its tension alone, unless material.section is soft: contacts keep the radius at rest, and
/// bending and twisting their stiffnesses. Source: Treloar 1975, chapter 4; Ogden 1997, chapter 4.
struct NeoHookeanStretching {
  static constexpr const char* kName = "neo_hookean";
  static constexpr NoKeys kKeys{};
  static constexpr bool kStudied = false;

  static NeoHookeanStretching of(const RodMaterial& /*material*/) { return {}; }

  StretchingResponse respond(const StretchedEdge& edge) const {
    const double lambda = edge.stretch, inverse = 1.0 / lambda, third = edge.k_s / 3.0;
    // lambda^2 + 2/lambda - 3 with its double root at 1 factored out, which keeps its digits at small strains.
    const double strain = lambda - 1.0, energy = strain * strain * (1.0 + 2.0 * inverse);
    return {0.5 * third * energy * edge.rest_length, third * (lambda - inverse * inverse),
            third * (1.0 + 2.0 * inverse * inverse * inverse)};
  }

  /// The positive root of lambda^3 - 3 T/k_s lambda^2 - 1, by Newton's method from the right, where the cubic is
  /// convex.
  double strain(double k_s, double tension) const {
    const double three_t = 3.0 * tension / k_s;
    double lambda = 1.0 + three_t;
    for (double before = 2.0 * lambda; lambda < before;) {
      before = lambda;
      lambda -= (lambda * lambda * (lambda - three_t) - 1.0) / (lambda * (3.0 * lambda - 2.0 * three_t));
    }
    return lambda - 1.0;
  }
};

}  // namespace knot_utm
