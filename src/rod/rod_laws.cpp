#include "knot_utm/rod/rod_laws.hpp"

namespace knot_utm {

RodLaws RodLaws::of(const Material& material) {
  return {stretching_law_of(material), bending_law_of(material), TwistingRegistry::of(material.twisting.law, material)};
}

void RodLaws::state(Archive& archive) {
  StretchingRegistry::archive(archive, "stretching law", stretching);
  BendingRegistry::archive(archive, "bending law", bending);
  TwistingRegistry::archive(archive, "twisting law", twisting);
}

}  // namespace knot_utm
