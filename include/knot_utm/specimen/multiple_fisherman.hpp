#pragma once

#include "knot_utm/specimen/fisherman.hpp"

namespace knot_utm {

/// knot: multiple_fisherman. The double fisherman's knot (grapevine) and those with more windings: the loop of the
/// fisherman's knot, with each tail wound `turns` times around the other strand and itself before it goes through.
class MultipleFishermanKnot final : public FishermanKnot {
 public:
  MultipleFishermanKnot();
  SpecimenOptions defaults(double h) const override;
  void check(const SpecimenOptions& specimen, double h) const override;

 private:
  static KnotDescription description();
  int windings(const SpecimenOptions& specimen) const override { return specimen.turns; }
};

}  // namespace knot_utm
