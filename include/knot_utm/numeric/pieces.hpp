#pragma once

#include <vector>

#include "knot_utm/numeric/points.hpp"

namespace knot_utm {

/// Nodes in a row of a polyline.
struct Piece {
  Eigen::Index begin = 0, end = 0;  ///< the first one, and the one behind the last

  Eigen::Index nodes() const { return end - begin; }
};

/// The pieces of a polyline of so many nodes between those of its edges that are missing, ascending: the ropes of a rod
/// between its cuts (RodProperties::cuts), for example. A piece may be a single node. Edges that it does not have count
/// as none.
inline std::vector<Piece> pieces_between(Eigen::Index nodes, const std::vector<int>& missing) {
  std::vector<Piece> out;
  Eigen::Index begin = 0;
  for (const int edge : missing) {
    if (edge + 1 >= nodes) break;
    out.push_back({begin, edge + 1});
    begin = edge + 1;
  }
  out.push_back({begin, nodes});
  return out;
}

/// Length of all pieces [m].
inline double length_of_pieces(const Points& points, const std::vector<int>& missing) {
  double length = 0.0;
  for (const Piece& piece : pieces_between(points.cols(), missing)) {
    const Eigen::Index edges = piece.nodes() - 1;
    length +=
        (points.middleCols(piece.begin + 1, edges) - points.middleCols(piece.begin, edges)).colwise().norm().sum();
  }
  return length;
}

}  // namespace knot_utm
