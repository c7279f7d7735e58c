#pragma once

#include <string>

#include "knot_utm/words/invalid_input.hpp"

namespace knot_utm {

/// What is said of wrong input; empty: nothing was wrong.
template <typename Act>
std::string complaint_of(Act act) {
  try {
    act();
  } catch (const InvalidInput& invalid) {
    return invalid.what();
  }
  return "";
}

}  // namespace knot_utm
