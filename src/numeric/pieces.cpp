#include "knot_utm/numeric/pieces.hpp"

namespace knot_utm {

std::vector<Piece> pieces_between(Eigen::Index nodes, const std::vector<int>& missing) {
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

double length_of_pieces(const Points& points, const std::vector<int>& missing) {
  double length = 0.0;
  for (const Piece& piece : pieces_between(points.cols(), missing)) {
    const Eigen::Index edges = piece.nodes() - 1;
    length +=
        (points.middleCols(piece.begin + 1, edges) - points.middleCols(piece.begin, edges)).colwise().norm().sum();
  }
  return length;
}

}  // namespace knot_utm
