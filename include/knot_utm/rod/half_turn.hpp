#pragma once

#include <optional>
#include <vector>

#include "knot_utm/numeric/index.hpp"
#include "knot_utm/numeric/lanes.hpp"
#include "knot_utm/numeric/points.hpp"

namespace knot_utm {

/// The half-turn that maps a rod of n nodes onto itself and exchanges its ends: a rotation by pi about an axis k,
///
///     x_{n-1-i} = R x_i + t,   s_{n-2-j} = -s_j,   R = 2 k k^T - 1
///
/// with x_i its nodes and s_j the spins of its edges, as an edge and its image run against each other. The first half
/// are nodes 0 to half() - 1, with the middle one where n is odd, and the edges behind them.
struct HalfTurn {
  int nodes = 0;              ///< n
  Mat3 turn = Mat3::Zero();   ///< R [-]
  Lanes column[3] = {};       ///< of R
  bool aligned = false;       ///< k is a coordinate axis, and R diagonal
  Vec3 shift = Vec3::Zero();  ///< t [m]

  /// That of a shape, if no node is further than `tolerance` [m] from the image of another one.
  static std::optional<HalfTurn> of(const Points& shape, double tolerance);

  int half() const { return (nodes + 1) / 2; }
  int image(int node) const { return nodes - 1 - node; }
  int image_of_edge(int edge) const { return nodes - 2 - edge; }

  /// (R v, -s): what a node and an edge have, as their images have it.
  Lanes operator*(const Lanes& v) const {
    constexpr Lanes kSense = {0.0, 0.0, 0.0, -1.0};
    if (aligned) return (kSense + column[0] + column[1] + column[2]) * v;
    return kSense * v + v[0] * column[0] + v[1] * column[1] + v[2] * column[2];
  }

  /// Places the second half as the image of the first one.
  void mirror(Points& position) const {
    for (int i = half(); i < nodes; ++i) position.col(i) = turn * position.col(image(i)) + shift;
  }
  /// Changes of all nodes and spins, from those of the first half.
  void spread(const std::vector<Lanes>& first, std::vector<Lanes>& all) const;
  /// Adds to the forces and torques on the first half those on it, and the images of those on the second half.
  void fold(const std::vector<Lanes>& all, std::vector<Lanes>& first) const;

 private:
  /// A vector of a node from one node, and of its edge from another.
  Lanes image_of(const std::vector<Lanes>& from, int node) const {
    Lanes out = *this * from[at(image(node))];
    out[3] = node + 1 < nodes ? -from[at(image_of_edge(node))][3] : 0.0;
    return out;
  }
};

}  // namespace knot_utm
