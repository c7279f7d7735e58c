#pragma once

#include <string>

#include "knot_utm/io/recovery.hpp"

namespace knot_utm {

/// A whole recovery, test.bag too.
void recover_with_bag(Recovery& recovery);

/// The bag of a test as far as the journal in `folder` goes, while the test goes on.
void save_bag(const std::string& folder, const Method& method, const std::string& file);

}  // namespace knot_utm
