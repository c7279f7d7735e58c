#pragma once

#include <string>
#include <vector>

namespace knot_utm {

/// How a value of the method differs from one specimen to the next, x0 being what the method says and d the spread:
///
///     normal      x0 (1 + d z), z normal and no further out than 3 standard deviations; d is the cv
///     log_normal  x0 exp(d z), with the same z
///     uniform     x0 (1 + d u), u uniform from -1 to 1
enum class ScatterLaw { kNormal, kLogNormal, kUniform };

struct Scatter {
  std::string key;  ///< dotted key of the method, as `--set` has it
  ScatterLaw law = ScatterLaw::kNormal;
  double spread = 0.0;  ///< d [-]
};

inline constexpr int kMostSpecimens = 10000;

/// The `specimens` section of a method: how many are tested, and how they differ.
struct SpecimensOptions {
  int count = 1;
  unsigned seed = 1;
  std::vector<Scatter> scatter;
};

}  // namespace knot_utm
