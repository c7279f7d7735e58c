#pragma once

namespace knot_utm {

struct RodProperties;
struct RodState;
struct SpecimenOptions;

/// Curves a rod at rest by the natural curvature kappa_0 that its specimen has from its reel or packet.
///
/// There the rod lay in a plane at rest, in a circle of radius 1/kappa_0. At its first edge it turns towards the x axis
/// of the drawing, as far as that is across the edge, or towards y where the edge runs along x. The frames that lie
/// parallel along the drawn centreline then have
///
///     kappabar_i = kappa_0 lbar_i (cos alpha, sin alpha),
///
/// alpha being the angle of that side at the first edge. Held straight, such a rod needs the couple k_b kappa_0.
/// Without a natural curvature nothing changes, nor are there frames.
void give_rest_shape(const SpecimenOptions& specimen, const RodProperties& rod, RodState* state);

}  // namespace knot_utm
