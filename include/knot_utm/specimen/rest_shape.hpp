#pragma once

namespace knot_utm {

struct RodProperties;
struct RodState;
struct SpecimenOptions;

/// Curves and twists a rod at rest as its specimen says: by the natural curvature kappa_0 that it has from its reel or
/// packet, and by the pre-twist rho with which it is laid into the grips.
///
/// Before it was twisted, the rod lay in a plane at rest, in a circle of radius 1/kappa_0. A direction of the drawing
/// says towards which side it turns at its first edge, as far as it is across that edge. Twisting it by phi(s) = 2 pi
/// rho s turns that side about the rod, to the right of it where rho > 0. The frames that lie parallel along the drawn
/// centreline then have
///
///     kappabar_i = kappa_0 lbar_i (cos(alpha + phi), sin(alpha + phi)),   mbar_i = -2 pi rho lbar_i,
///
/// alpha being the angle of that side at the first edge. Held straight, such a rod needs the couple k_b kappa_0, and
/// its torque is 2 pi rho k_t. Without either nothing changes, nor are there frames. Throws InvalidInput where the
/// direction is that of the first edge.
void give_rest_shape(const SpecimenOptions& specimen, RodProperties* rod, RodState* state);

}  // namespace knot_utm
