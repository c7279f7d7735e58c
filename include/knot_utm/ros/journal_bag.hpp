#pragma once

#include <string>

#include "knot_utm/io/recovery.hpp"

namespace knot_utm {

/// Carries out a recovery completely, including test.bag.
void recover_with_bag(Recovery& recovery);

/// Writes the bag of a test up to the end of the journal in `folder`, while the test goes on.
void save_bag(const std::string& folder, const Method& method, const std::string& file);

}  // namespace knot_utm
