#pragma once

#include <optional>

namespace knot_utm {

struct Material;

/// Tension at which a straight rod parts [N]: the least of the breaking force F_b and the tension at a strain of the
/// breaking strain eps_b by the rod's stretching law, k_s eps_b where that is linear (fracture.hpp). Empty where the
/// material has neither limit.
std::optional<double> straight_strength(const Material& material);

}  // namespace knot_utm
