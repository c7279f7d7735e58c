#pragma once

#include "knot_utm/specimen/fisherman.hpp"

namespace knot_utm {

/// knot: multiple_fisherman. The double fisherman's knot (grapevine) and its longer kin: the loop of the fisherman's
/// knot, whose tails are each wound `turns` times around the other strand and themselves before they go through.
class MultipleFishermanKnot final : public FishermanKnot {
 public:
  const char* name() const override { return "multiple_fisherman"; }
  std::vector<std::string> keys() const override;
  ErrorStudy error_study() const override { return ErrorStudy::kNone; }
  SpecimenOptions defaults(double h) const override;
  void check(const SpecimenOptions& specimen, double h) const override;

 private:
  int windings(const SpecimenOptions& specimen) const override { return specimen.turns; }
};

}  // namespace knot_utm
