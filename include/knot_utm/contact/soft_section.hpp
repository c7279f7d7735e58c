#pragma once

#include <cmath>
#include <vector>

#include "knot_utm/contact/surface_contact.hpp"

namespace knot_utm {

/// Contact of rods whose sections give (material.section: soft). A rod that keeps its volume has the radius
///
///     h_a = h lambda_a^-1/2,    lambda_a = |a'|/|a'|_0,
///
/// lambda being the stretch of the centreline at the contact, an unknown of the step like the gap. The section is
/// flattened by a law of its material, p = 2 h E f(D/2h), which scales with the present radius: with Z = h_a + h_b and
/// k = Z_0/Z, Z_0 of the rod at rest, the law is that of the rod at rest at the overlap k D,
///
///     p = p_0(k D)/k,   E = w e,   e = e_0(k D)/k^2,   D = Z - d,   w per present length: w_0 lambda_a.
///
/// ContactPoint::overlap is k D, `pressure` p_0, `weight` w/k, so that weight times pressure is the force. On a roller
/// Z is h_a alone. A contact squeezes the strands thin: with chi_a = h_a/Z and S = e_0 + p_0 (Z_0 - k D)/2,
///
///     -dE/dlog lambda_a = R_a = w/k^2 (chi_a S - e_0),    -dE/dlog lambda_b = R_b = w/k^2 chi_b S   [J]
///
/// act as forces R_a a^ on the derivative a' of the centreline (a^ = a'/|a'|^2), beside what SurfacePoint has. h_b
/// belongs to the foot; what its slope along the strand would add to friction is left out, and counts as numerical
/// work. Surfaces meet half way between the centrelines, whatever the stretch of either.
/// Source: our own; the flattening by finite elements (doc/developers/history.md).
struct SoftPoint {
  double scale = 1.0;                   ///< k [-]
  double share_a = 0.5, share_b = 0.5;  ///< chi [-]; on a roller 1 and 0
  double sum = 0.0;                     ///< Z_0 [m]
  double rest_growth = 0.0;             ///< d log|b'|_0/du [-]
  double thins_a = 0.0, thins_b = 0.0;  ///< R_a, R_b [J]

  /// With the radius at rest of a, and of b or 0, at these stretches.
  static SoftPoint of(double radius_a, double stretch_a, double radius_b, double stretch_b) {
    SoftPoint out;
    const double a = radius_a / std::sqrt(stretch_a), b = radius_b > 0.0 ? radius_b / std::sqrt(stretch_b) : 0.0;
    out.sum = radius_a + radius_b;
    out.scale = out.sum / (a + b);
    out.share_a = a / (a + b);
    out.share_b = b / (a + b);
    return out;
  }
  double radii() const { return sum / scale; }  ///< Z [m]
};

/// Adds R_a a^ and R_b b^ to the couples of all active contacts, once their forces are known.
void add_thinning(const ContactLaws& laws, const std::vector<ContactPoint>& contacts,
                  std::vector<SurfacePoint>& surfaces, std::vector<SoftPoint>& soft);

/// How k D changes as the gap changes by S, a' by V_a and b' by V_b.
double overlap_change(const ContactPoint& contact, const SurfacePoint& surface, const SoftPoint& soft,
                      const Vec3& shift, const Vec3& turn_a, const Vec3& turn_b);

/// Completes the motion of a contact whose gap was `before` [m] at the beginning of the step: its energy then and now,
/// and the work of R.
void add_thinning(const ContactPoint& contact, const SurfacePoint& surface, const SoftPoint& soft, double before,
                  ContactMotion& motion);

}  // namespace knot_utm
