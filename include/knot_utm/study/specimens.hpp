#pragma once

#include <string>
#include <utility>
#include <vector>

#include "knot_utm/method/method.hpp"

namespace knot_utm {

/// One of the specimens that a method describes, with its drawn values.
struct DrawnSpecimen {
  int number = 0;                                     ///< from 1
  std::vector<std::pair<std::string, double>> drawn;  ///< keys that scatter, each with its value in its unit
  Method method;                                      ///< method of this specimen alone
};

/// Throws InvalidInput where the specimen cannot be made, or the machine cannot hold it. The test itself would say so,
/// too, but only once it begins.
void check_fits(const Method& method);

/// Draws the values of one specimen of a method, as `Method::specimens` says. They depend only on the seed, the number
/// of the specimen (from 1) and the key, so neither a larger count nor a further key changes them. All specimens are
/// tested with one load cell, whose noise is different for each. Throws InvalidInput where the drawn method would be
/// refused.
DrawnSpecimen draw_specimen(const Method& method, int number);

/// Draws all specimens of a method.
std::vector<DrawnSpecimen> draw_specimens(const Method& method);

}  // namespace knot_utm
