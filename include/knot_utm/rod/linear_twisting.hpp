#pragma once

#include "knot_utm/numeric/archive.hpp"
#include "knot_utm/numeric/law_keys.hpp"
#include "knot_utm/rod/material.hpp"
#include "knot_utm/rod/twisting_law.hpp"

namespace knot_utm {

/// E = k_t/(2 lbar) (m - mbar)^2.
struct LinearTwisting {
  static constexpr const char* kName = "linear";
  static constexpr NoKeys kKeys{};
  static constexpr bool kStudied = true;

  static LinearTwisting of(const Material& /*material*/) { return {}; }

  template <typename Real>
  TwistingResponse<Real> respond(const TwistedNode<Real>& node) const {
    const Real moment = node.k_t_over_length * node.twist;
    return {0.5 * moment * moment / node.k_t_over_length, moment, node.k_t_over_length};
  }

  void state(Archive& /*archive*/) {}
};

}  // namespace knot_utm
