#pragma once

#include <string>
#include <vector>

namespace knot_utm {

struct Material;

/// The rod in numbers that a person can check: "36.4 g/m at a diameter of 6.35 mm, E = 2.32 GPa stretched, ...".
std::string rod_in_words(const Material& material);

/// Questions about a rod that is like no rod there is, one line each: most likely a slip of a unit, such as a modulus
/// in MPa. The limits lie far beyond those of threads, ropes, wires and gels.
std::vector<std::string> questions_about(const Material& material);

}  // namespace knot_utm
