#pragma once

#include "knot_utm/specimen/knot.hpp"

namespace knot_utm {

/// knot: straight. A straight rod along the load axis. Its `length` is that between the grips, so that the load grows
/// by k_s/length per extension (`stretching_law: linear`).
class StraightRod final : public Knot {
 public:
  StraightRod();
  SpecimenOptions defaults(double h) const override;
  void suit(const SpecimenOptions& known, double roller_diameter, double h, SpecimenOptions& out) const override;
  double pull(const SpecimenOptions& specimen, double h) const override;
  void check(const SpecimenOptions& specimen, double h) const override;
  Centreline centreline(const SpecimenOptions& specimen, const Material& material,
                        const Mounting& mounting) const override;
  HeldNode held_below(const Centreline& centreline, bool clamped) const override;
  HeldNode held_above(const Centreline& centreline, bool clamped) const override;
};

}  // namespace knot_utm
