#include "knot_utm/contact/memory_friction.hpp"

namespace knot_utm {

MemoryFriction MemoryFriction::of(const FrictionOptions&, const FrictionScales& scales) {
  return {scales.coefficient, scales.presliding * scales.radius};
}

}  // namespace knot_utm
