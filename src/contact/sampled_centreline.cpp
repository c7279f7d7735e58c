#include "knot_utm/contact/sampled_centreline.hpp"

#include <algorithm>
#include <iterator>

#include "knot_utm/contact/centreline_curve.hpp"

namespace knot_utm {

Points sampled_centreline(const Points& nodes) {
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
