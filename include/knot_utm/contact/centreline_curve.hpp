#pragma once

#include <algorithm>
#include <cmath>
#include <iterator>

#include "knot_utm/numeric/lanes.hpp"
#include "knot_utm/numeric/points.hpp"

namespace knot_utm {

/// The smooth centreline: a quadratic B-spline whose control points are the rod's nodes. Segment i, 1 <= i <= N-2,
/// stands on nodes i-1, i, i+1 and runs from the middle of edge i-1 to the middle of edge i for 0 <= u <= 1:
///
///     c(u) = sum_k B_k(u) x_{i-1+k},  B_0 = (1-u)^2/2,  B_1 = 1/2 + u - u^2,  B_2 = u^2/2.
struct SegmentWeights {
  double value[3];
  double derivative[3];

  explicit SegmentWeights(double u)
      : value{0.5 * (1.0 - u) * (1.0 - u), 0.5 + u * (1.0 - u), 0.5 * u * u}, derivative{u - 1.0, 1.0 - 2.0 * u, u} {}
};

/// A segment in powers of u: c(u) = m + t u + k u^2/2, m the middle of an edge, t the edge, k the second difference.
struct SegmentParabola {
  Lanes m, t, k;  ///< [m]
  Lanes chord;    ///< c(1) - c(0) [m]
  double bulge;   ///< |k|/8, the largest distance of the segment from its chord [m]

  void set(const Lanes& before, const Lanes& node, const Lanes& after) {
    m = 0.5 * (before + node);
    t = node - before;
    k = (after - node) - t;
    chord = t + 0.5 * k;
    bulge = 0.125 * std::sqrt(dot(k, k));
  }
};

/// Contact is integrated along a segment by the midpoint rule on its halves.
constexpr double kIntegrationPoints[2] = {0.25, 0.75};

/// Weights of an integration point. Where a rod with edges of length l is bent by kappa, its spline runs l^2 kappa/12
/// inside the arc that has the rod's own length. The point is therefore moved outwards by a fraction of x_{i-1} - 2 x_i
/// + x_{i+1}. With the whole fraction, 1/12, the force of a strand that is wound around something, and its distance,
/// are right to fourth order in l.
struct PointWeights {
  double value[3];

  PointWeights(double u, double fraction) : value{0.0, 0.0, 0.0} {
    const SegmentWeights w(u);
    for (int k = 0; k < 3; ++k) value[k] = w.value[k] - fraction * kSecondDifference[k];
  }

  static constexpr double kWhole = 1.0 / 12.0;
  static constexpr double kSecondDifference[3] = {1.0, -2.0, 1.0};
};

inline Vec3 combine(const double* weights, const Points& nodes, int segment) {
  return weights[0] * nodes.col(segment - 1) + weights[1] * nodes.col(segment) + weights[2] * nodes.col(segment + 1);
}

/// x_{i-1} - 2 x_i + x_{i+1}: c'' on segment i.
inline Vec3 second_difference(const Points& nodes, int segment) {
  return nodes.col(segment - 1) - 2.0 * nodes.col(segment) + nodes.col(segment + 1);
}

/// The places at which a rod's contact is integrated, two for each inner node and in their order along the rod. Of
/// nodes on a circle, with edges l, they lie within l^4/R^3 of the circle of radius R whose circumference is as long as
/// all edges. Without columns where there are fewer than three nodes.
inline Points sampled_centreline(const Points& nodes) {
  constexpr auto kEach = static_cast<Eigen::Index>(std::size(kIntegrationPoints));
  const Eigen::Index segments = std::max<Eigen::Index>(nodes.cols() - 2, 0);
  Points places(3, kEach * segments);
  for (Eigen::Index i = 0; i < segments; ++i)
    for (Eigen::Index k = 0; k < kEach; ++k)
      places.col(kEach * i + k) =
          combine(PointWeights(kIntegrationPoints[k], PointWeights::kWhole).value, nodes, static_cast<int>(i) + 1);
  return places;
}

}  // namespace knot_utm
