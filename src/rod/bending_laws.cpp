#include "knot_utm/rod/bending_laws.hpp"

namespace knot_utm {

BendingLaws bending_law_of(const Material& material) { return BendingRegistry::of(material.bending.law, material); }

bool bends_on_frames(const BendingLaws& law) { return !std::holds_alternative<ElasticBending>(law); }

bool bends_on_frames(const Material& material) { return bends_on_frames(bending_law_of(material)); }

bool remembers(const BendingLaws& law) {
  return std::visit([](const auto& of) { return of.kRemembers; }, law);
}

bool remembers_bends(const Material& material) { return remembers(bending_law_of(material)); }

}  // namespace knot_utm
