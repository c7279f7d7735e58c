#pragma once

#include "knot_utm/specimen/knot.hpp"

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
  double straight = 0.0;        ///< least straight length of its strands beyond the middles of the drawn coils [m]
  double coarsening = 1.0;      ///< edges of the far side are longer by this factor, up to the rod's diameter [-]
};

/// Distance that a knot of several windings may run outwards, as it tightens, beyond that of a single winding [m]. Its
/// coils are drawn with the radius R = looseness h. Three strands run through a tight coil, each against the other two:
/// standing part, threaded strand and tail. Its centreline therefore has the radius (2 + 2/sqrt 3) h, and each winding
/// gives up
///
///     2 pi (R - (2 + 2/sqrt 3) h)
///
/// of the rod, half of it to the standing part and half to the tail, as friction is the same towards both. Where the
/// standing part is held, the knot runs outwards by its half.
double runs_out(int windings, double looseness, double h);

/// Throws InvalidInput (specimen.*, machine.roller_diameter) where the shape does not fit on the machine or overlaps.
Centreline fisherman_loop(const FishermanShape& shape);

/// knot: fisherman.
class FishermanKnot : public Knot {
 public:
  FishermanKnot();
  SpecimenOptions defaults(double h) const override;
  void suit(const SpecimenOptions& known, double roller_diameter, double h, SpecimenOptions& out) const override;
  std::optional<double> roller_diameter(double h) const override;
  double pull(const SpecimenOptions& specimen, double h) const override;
  void check(const SpecimenOptions& specimen, double h) const override;
  Centreline centreline(const SpecimenOptions& specimen, const Material& material,
                        const Mounting& mounting) const override;
  /// The bottom and the top of the loop.
  HeldNode held_below(const Centreline& centreline, bool clamped) const override;
  HeldNode held_above(const Centreline& centreline, bool clamped) const override;

 protected:
  /// Another knot of the same loop.
  explicit FishermanKnot(KnotDescription about) : Knot(std::move(about)) {}
  static KnotDescription description();

 private:
  /// How often each tail is wound around.
  virtual int windings(const SpecimenOptions&) const { return 1; }
};

}  // namespace knot_utm
