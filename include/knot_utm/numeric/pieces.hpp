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
std::vector<Piece> pieces_between(Eigen::Index nodes, const std::vector<int>& missing);

/// Length of all pieces [m].
double length_of_pieces(const Points& points, const std::vector<int>& missing);

}  // namespace knot_utm
