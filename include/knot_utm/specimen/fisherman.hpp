#pragma once

#include "knot_utm/specimen/centreline.hpp"
#include "knot_utm/specimen/options.hpp"

namespace knot_utm {

/// The fisherman's loop: one open rod laid once around two rollers, each end tied by an overhand knot around the
/// other strand.
///
/// Rollers lie along y, centres at the origin and at (0, 0, end_to_end); the loop lies in the x-z plane, its straight
/// side at x < 0, the knots at x > 0, `knot_distance` less `outward_shift` apart along z and symmetric about z =
/// end_to_end/2. In cylindrical coordinates about the knots' axis, each knot's standing part runs outwards at radius a,
/// turns by a half circle to radius R, coils by 450 degrees over an axial length 4 h back over itself (and by another
/// turn over 3.2 h for each further winding), turns in to radius b and leaves as a tail inside its own coil, outwards.
/// The threaded strand runs through the coil at radius a opposite the standing part. With a = (2 - sqrt 3) R and b = R
/// - 2 a the standing part, the threaded strand, the tail and the coil are equally far apart, 2 a. The shape is
/// smoothed along arclength by a Gaussian of standard deviation h.
///
/// Same-handed: the two knots are images of each other under a half turn about an axis normal to the load axis.
/// Opposite-handed: the lower knot is the mirror image of that.
struct FishermanShape {
  double radius = 3.175e-3;        ///< h, of the rod [m]
  double knot_distance = 0.1;      ///< e, distance of the middles of the two coils, once tied [m]
  double outward_shift = 0.0;      ///< distance by which tying moves the coils apart [m]
  double end_to_end = 0.25;        ///< L, distance of the rollers' centres [m]
  double roller_radius = 0.01905;  ///< [m]
  double tail = 0.03;              ///< free tail beyond the outermost point of the coil [m]
  Handedness handedness = Handedness::kSame;
  int windings = 1;             ///< of each tail: 2 of the double fisherman's knot
  double looseness = 4.7;       ///< R/h, radius of the coil over that of the rod (3.9 to 8)
  double edge_length = 0.0032;  ///< target where strands may slide along each other [m]
  double refinement = 1.0;      ///< edges of both strands between and within the knots are shorter by this factor [-]
  double straight = 0.0;        ///< least straight length of its strands beyond the middles of the sketched coils [m]
  double coarsening = 1.0;      ///< edges of the far side are longer by this factor, up to the rod's diameter [-]
};

/// Throws InvalidInput (specimen.*, machine.roller_diameter) where the shape does not fit on the machine or overlaps.
Centreline fisherman_loop(const FishermanShape& shape);

}  // namespace knot_utm
