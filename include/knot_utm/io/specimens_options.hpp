#pragma once

#include <string>
#include <vector>

namespace knot_utm {

/// How a value of the method scatters from specimen to specimen. With x0 the value in the method and d the spread:
///
///     normal      x0 (1 + d z), where z is standard normal, limited to 3 standard deviations; d is the cv
///     log_normal  x0 exp(d z), with the same z
///     uniform     x0 (1 + d u), where u is uniform from -1 to 1
enum class ScatterLaw { kNormal, kLogNormal, kUniform };

struct Scatter {
  std::string key;  ///< dotted key of the method, as `--set` takes it
  ScatterLaw law = ScatterLaw::kNormal;
  double spread = 0.0;  ///< d [-]
};

inline constexpr int kMostSpecimens = 10000;

/// The `specimens` section of a method: how many specimens are tested, and how they differ.
struct SpecimensOptions {
  int count = 1;
  unsigned seed = 1;
  std::vector<Scatter> scatter;
};

}  // namespace knot_utm
