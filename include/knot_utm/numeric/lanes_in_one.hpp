#pragma once

namespace knot_utm {

/// Four numbers in one register, where there are registers of four (AVX).
using LanesInOne = double __attribute__((vector_size(32)));
using LanesInOneMask = decltype(LanesInOne{} < LanesInOne{});

inline LanesInOne select(const LanesInOneMask& where, const LanesInOne& a, const LanesInOne& b) {
  return where ? a : b;
}
inline bool any(const LanesInOneMask& where) { return ((where[0] | where[1]) | (where[2] | where[3])) != 0; }

/// Rows of a 4 x 4 matrix become its columns.
inline void transpose(LanesInOne& a, LanesInOne& b, LanesInOne& c, LanesInOne& d) {
  const LanesInOne ab_even = __builtin_shufflevector(a, b, 0, 4, 2, 6),
                   ab_odd = __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const LanesInOne cd_even = __builtin_shufflevector(c, d, 0, 4, 2, 6),
                   cd_odd = __builtin_shufflevector(c, d, 1, 5, 3, 7);
  a = __builtin_shufflevector(ab_even, cd_even, 0, 1, 4, 5);
  b = __builtin_shufflevector(ab_odd, cd_odd, 0, 1, 4, 5);
  c = __builtin_shufflevector(ab_even, cd_even, 2, 3, 6, 7);
  d = __builtin_shufflevector(ab_odd, cd_odd, 2, 3, 6, 7);
}

/// The last lane of `before`, then the first three lanes of `now`.
inline LanesInOne one_later(const LanesInOne& before, const LanesInOne& now) {
  return __builtin_shufflevector(before, now, 3, 4, 5, 6);
}

/// The last three lanes of `now`, then the first lane of `after`.
inline LanesInOne one_earlier(const LanesInOne& now, const LanesInOne& after) {
  return __builtin_shufflevector(now, after, 1, 2, 3, 4);
}

}  // namespace knot_utm
