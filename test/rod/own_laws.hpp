#pragma once

#include <memory>

#include "knot_utm/rod/rod.hpp"
#include "knot_utm/rod/rod_laws.hpp"

namespace knot_utm {

/// Gives a rod another law than its material names.
inline void set_law(RodProperties& rod, const StretchingLaws& law) {
  rod.laws = std::make_shared<const RodLaws>(RodLaws{law, rod.laws->bending});
}
inline void set_law(RodProperties& rod, const BendingLaws& law) {
  rod.laws = std::make_shared<const RodLaws>(RodLaws{rod.laws->stretching, law});
}

}  // namespace knot_utm
