#include "knot_utm/contact/sampled_centreline.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace knot_utm {
namespace {

TEST(SampledCentreline, LiesOnTheCircleThatHasTheRodsOwnLengthToFourthOrder) {
  for (const int edges : {20, 40}) {
    Points nodes(3, edges + 1);
    for (int i = 0; i <= edges; ++i)
      nodes.col(i) = Vec3(std::cos(2.0 * M_PI * i / edges), std::sin(2.0 * M_PI * i / edges), 0.0);
    const Points places = sampled_centreline(nodes);
    ASSERT_EQ(places.cols(), 2 * (edges - 1));
    const double edge = 2.0 * std::sin(M_PI / edges);
    const double radius = edges * edge / (2.0 * M_PI);
    for (Eigen::Index i = 0; i < places.cols(); ++i) EXPECT_NEAR(places.col(i).norm(), radius, std::pow(edge, 4));
  }
}

}  // namespace
}  // namespace knot_utm
