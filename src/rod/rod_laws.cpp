#include "knot_utm/rod/rod_laws.hpp"

namespace knot_utm {

RodLaws RodLaws::of(const RodMaterial& material) { return {stretching_law_of(material), bending_law_of(material)}; }

void RodLaws::state(Archive& archive) {
  StretchingRegistry::archive(archive, "stretching law", stretching);
  BendingRegistry::archive(archive, "bending law", bending);
}

}  // namespace knot_utm
