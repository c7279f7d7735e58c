#include "knot_utm/contact/friction.hpp"

#include <algorithm>
#include <string>

namespace knot_utm {

FrictionLaw law_named(const std::string& name) {
  return static_cast<FrictionLaw>(std::find(kFrictionLawNames.begin(), kFrictionLawNames.end(), name) -
                                  kFrictionLawNames.begin());
}

Friction Friction::of(const FrictionOptions& options, const FrictionScales& scales) {
  Friction out;
  out.law_ = FrictionRegistry::of(options.law, options, scales);
  out.on_ = out.coefficient() > 0.0;
  return out;
}

}  // namespace knot_utm
