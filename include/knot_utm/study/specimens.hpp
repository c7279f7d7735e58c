#pragma once

#include <string>
#include <utility>
#include <vector>

#include "knot_utm/io/method.hpp"

namespace knot_utm {

/// One of the specimens that a method describes, with its drawn values.
struct DrawnSpecimen {
  int number = 0;                                     ///< from 1
  std::vector<std::pair<std::string, double>> drawn;  ///< keys that scatter, each with its value in its unit
  Method method;                                      ///< method of this specimen alone
};

/// Draws the values of all specimens of a method, as `Method::specimens` says. The values of a specimen depend only on
/// the seed, its number and the key, so neither a larger count nor a further key changes them. All specimens are tested
/// with one load cell, whose noise is different for each. Throws InvalidInput where a drawn method would be refused.
std::vector<DrawnSpecimen> draw_specimens(const Method& method);

}  // namespace knot_utm
