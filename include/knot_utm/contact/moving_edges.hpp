#pragma once

#include <optional>

#include "knot_utm/numeric/points.hpp"

namespace knot_utm {

/// Two edges, a from a_0 to a_1 and b from b_0 to b_1 [m].
struct EdgePair {
  Vec3 a0, a1, b0, b1;
};

/// Where two edges meet: fractions of the way along each, 0 to 1.
struct EdgeMeeting {
  double on_a = 0.0, on_b = 0.0;
};

/// Continuous collision detection: whether two edges meet while their four ends go straight, and at constant speed,
/// from `start` to `end`. With the gaps g_kl = a_k - b_l, which are linear in time tau, they do not meet where some
/// direction n(tau) has n.g_kl > 0 for all four: a plane stands between them. With n linear from n_0 to n_1,
///
///     n.g = (1 - tau)^2 n_0.g(0) + tau (1 - tau) (n_0.g(1) + n_1.g(0)) + tau^2 n_1.g(1),
///
/// so the edges stay apart if these three terms are positive. n_0 and n_1 are the directions of the shortest gap at
/// both ends of the time interval. Where the test fails, each half of the interval is tested by itself.
///
/// No passage is missed. Edges that come nearer than a millionth of their extent (gap, lengths and motion together)
/// count as meeting, which bounds the number of halvings. So do edges whose coordinates are not numbers.
std::optional<EdgeMeeting> meeting(const EdgePair& start, const EdgePair& end);

}  // namespace knot_utm
