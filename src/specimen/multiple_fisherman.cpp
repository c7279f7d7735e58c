#include "knot_utm/specimen/multiple_fisherman.hpp"

#include <string>

#include "knot_utm/numeric/invalid_input.hpp"

namespace knot_utm {

std::vector<std::string> MultipleFishermanKnot::keys() const {
  std::vector<std::string> out = FishermanKnot::keys();
  out.emplace_back("turns");
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
