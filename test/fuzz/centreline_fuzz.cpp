// The points of a specimen (specimen.file), and the rod that is made of them.
#include <sstream>

#include "fuzz/target.hpp"
#include "knot_utm/specimen/centreline.hpp"
#include "knot_utm/specimen/centreline_file.hpp"
#include "knot_utm/specimen/polyline.hpp"

namespace knot_utm {

void fuzz(const std::string& text) {
  std::istringstream in(text);
  const Points points = read_centreline(in, "fuzz.csv");
  promise(points.cols() >= 4 && points.allFinite(), "four finite points or more");

  constexpr double kRadius = 0.1, kEdge = 0.15;
  // Each edge is held against each other one: what is long, but not too long, would take seconds here.
  const double length = arclengths(points).back();
  if (length > 500.0 * kEdge && length < 1e5 * kEdge) return;
  const Centreline rod = from_points(points, false, kRadius, kEdge);
  promise(rod.points.allFinite(), "a rod of finite nodes");
  promise(rod.points.leftCols(1) == points.leftCols(1) && rod.points.rightCols(1) == points.rightCols(1),
          "a rod that ends where its points do");
  const Eigen::Index edges = rod.points.cols() - 1;
  const double longest = (rod.points.rightCols(edges) - rod.points.leftCols(edges)).colwise().norm().maxCoeff();
  promise(longest < 2.0 * kEdge, "edges about as long as was asked for");
}

}  // namespace knot_utm
