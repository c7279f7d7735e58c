#pragma once

#include <functional>
#include <string>

#include "knot_utm/numeric/invalid_input.hpp"

namespace knot_utm {

/// A number of a method that lies outside the range of its key.
struct OutOfRange : InvalidInput {
  OutOfRange(const InvalidInput& sentence, double min_, double max_) : InvalidInput(sentence), min(min_), max(max_) {}

  double min, max;  ///< the ends of the range, both of which are allowed
};

/// The same sentence with what the other values of this method allow, where that is less than the range: "must be 1e-6
/// to 0.1 m, and here at most twice the radius, 0.00635 m". `attempt` receives an override for each end of the range,
/// and throws InvalidInput where the method with it would be refused.
InvalidInput narrowed(const OutOfRange& wrong, const std::function<void(const std::string& override)>& attempt);

}  // namespace knot_utm
