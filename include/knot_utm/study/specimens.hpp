#pragma once

#include <string>
#include <utility>
#include <vector>

#include "knot_utm/io/method.hpp"

namespace knot_utm {

/// One of the specimens that a method describes.
struct DrawnSpecimen {
  int number = 0;                                     ///< from 1
  std::vector<std::pair<std::string, double>> drawn;  ///< keys that scatter, and the value of each, in its unit
  Method method;                                      ///< of this specimen alone
};

/// Draws all specimens of a method, as `Method::specimens` says. What is drawn for one depends on the seed, its number
/// and the key only: a larger count, or another key, leaves it as it is. All are tested with
/// one load cell, which has other noise for each. Throws InvalidInput where a method that is drawn would be refused.
std::vector<DrawnSpecimen> draw_specimens(const Method& method);

}  // namespace knot_utm
