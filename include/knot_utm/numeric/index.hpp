#pragma once

#include <cstddef>

namespace knot_utm {

/// The number of a node or an edge, as containers of the standard library take it.
inline std::size_t at(int i) { return static_cast<std::size_t>(i); }

}  // namespace knot_utm
