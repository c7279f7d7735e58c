#include "knot_utm/specimen/multiple_fisherman.hpp"

#include <string>

#include "knot_utm/numeric/invalid_input.hpp"

namespace knot_utm {

MultipleFishermanKnot::MultipleFishermanKnot() : FishermanKnot(description()) {}

KnotDescription MultipleFishermanKnot::description() {
  KnotDescription out = FishermanKnot::description();
  out.name = "multiple_fisherman";
  out.title = "Multiple fisherman's knot";
  out.keys.insert(out.keys.begin(), "turns");
  out.error_study = ErrorStudy::kNone;
  return out;
}

SpecimenOptions MultipleFishermanKnot::defaults(double h) const {
  SpecimenOptions out = FishermanKnot::defaults(h);
  out.turns = 2;
  return out;
}

void MultipleFishermanKnot::check(const SpecimenOptions& specimen, double h) const {
  if (specimen.turns < 2 || specimen.turns > 3)
    throw InvalidInput("specimen.turns", std::to_string(specimen.turns),
                       "2 or 3; knot: fisherman winds its tails once");
  FishermanKnot::check(specimen, h);
}

}  // namespace knot_utm
