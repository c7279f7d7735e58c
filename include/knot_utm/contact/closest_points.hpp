#pragma once

#include <algorithm>

#include "knot_utm/numeric/points.hpp"

namespace knot_utm {

/// Nearest points p + t a and q + u b of two edges, 0 <= t, u <= 1.
struct ClosestPoints {
  double t = 0.0, u = 0.0;
  bool t_free = false, u_free = false;  ///< strictly inside the edge, where it moves as the edges do
};

/// Minimises, with x = p + t a - q - u b,
///
///     |x|^2 / 2 + r [ (t - 1/2)^2 + (u - 1/2)^2 ] / 2
///
/// over the square, by Lumelsky's algorithm (1985): the free minimum, brought into the range of t; the best u there;
/// where that is out of range, brought back, and the best t for it. Exact for any convex quadratic function.
/// r = 0 gives the nearest points, which jump where edges turn through parallel; r > 0 [m^2] makes them continuous.
inline ClosestPoints closest_points(const Vec3& p, const Vec3& a, const Vec3& q, const Vec3& b, double r) {
  const Vec3 x = p - q;
  const double aa = a.squaredNorm() + r, bb = b.squaredNorm() + r, ab = a.dot(b);
  const double at = 0.5 * r - x.dot(a), bu = 0.5 * r + x.dot(b);
  const double determinant = aa * bb - ab * ab;
  auto in_range = [](double value) { return std::clamp(value, 0.0, 1.0); };

  ClosestPoints out;
  // Without r, parallel edges have no free minimum; any t will do to start from.
  out.t = determinant > 1e-14 * aa * bb ? in_range((at * bb + ab * bu) / determinant) : 0.0;
  const double u = (bu + out.t * ab) / bb;
  out.u = in_range(u);
  if (u != out.u) out.t = in_range((at + out.u * ab) / aa);
  out.t_free = out.t > 0.0 && out.t < 1.0;
  out.u_free = out.u > 0.0 && out.u < 1.0;
  return out;
}

}  // namespace knot_utm
