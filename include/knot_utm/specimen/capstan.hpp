#pragma once

#include "knot_utm/specimen/knot.hpp"

namespace knot_utm {

/// knot: capstan. A rod lies around a fixed post by the angle `wrap` [rad]. A dead load T1, `tail_load` [N], pulls at
/// its first node along the `tail` [m], as a weight does over a pulley that turns freely. The upper grip pulls its last
/// node along +z with T2. A rod without bending stiffness that slides has T2/T1 = exp(mu wrap), mu being
/// `machine.roller_friction`.
///
/// The rod's centreline lies on a circle of radius rho = post_diameter/2 + h around the post's axis, which goes through
/// the origin along y. Beyond half a turn the tails would cross. The rod then lies on a helix of pitch 4 h, whose
/// tangents turn by `wrap` in all, and the axis is tilted so that the strand to the grip still runs along z.
class CapstanSpecimen final : public Knot {
 public:
  CapstanSpecimen();
  SpecimenOptions defaults(double h) const override;
  void suit(const SpecimenOptions& known, double roller_diameter, double h, SpecimenOptions& out) const override;
  double pull(const SpecimenOptions& specimen, double h) const override;
  std::optional<double> longest_pull(const SpecimenOptions& specimen, double h) const override;
  void check(const SpecimenOptions& specimen, double h) const override;
  Centreline centreline(const SpecimenOptions& specimen, const Material& material,
                        const Mounting& mounting) const override;
  Supports supports(const SpecimenOptions& specimen, const Material& material) const override;
};

/// T1 [N]; `specimen.tail_load: auto` is k_b/h^2, but at most k_s/100.
double tail_load(const SpecimenOptions& specimen, const Material& material);

}  // namespace knot_utm
