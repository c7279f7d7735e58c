#pragma once

#include <cstddef>
#include <vector>

#include "knot_utm/numeric/lanes.hpp"

namespace knot_utm {

/// Four vectors, or four numbers, of a list, from the entry `first` on.
inline FourVectors four(const std::vector<Lanes>& vectors, std::size_t first) {
  return FourVectors::of(vectors[first], vectors[first + 1], vectors[first + 2], vectors[first + 3]);
}
inline Lanes four(const std::vector<double>& numbers, std::size_t first) {
  return Lanes{numbers[first], numbers[first + 1], numbers[first + 2], numbers[first + 3]};
}

/// Four vectors, or four numbers, to where they belong in a list.
inline void put(const FourVectors& vectors, std::vector<Lanes>& to, std::size_t first) {
  Lanes a = vectors.x, b = vectors.y, c = vectors.z, d = {};
  transpose(a, b, c, d);
  to[first] = a;
  to[first + 1] = b;
  to[first + 2] = c;
  to[first + 3] = d;
}
inline void put(const Lanes& numbers, std::vector<double>& to, std::size_t first) {
  for (int k = 0; k < 4; ++k) to[first + static_cast<std::size_t>(k)] = numbers[k];
}

}  // namespace knot_utm
