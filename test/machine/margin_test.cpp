#include "knot_utm/machine/margin.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace knot_utm {
namespace {

TEST(Margin, IsTheShareBelowWhichTheKnotOpens) {
  for (const double critical : {0.26, 0.4, 0.65, 0.9, 0.999}) {
    std::vector<double> tried;
    const double share = share_until_it_opens([&](double factor) {
      tried.push_back(factor);
      return factor < critical;
    });
    EXPECT_EQ(tried.size(), 4u);
    EXPECT_NEAR((1.0 - share) / critical, 1.0, 0.1) << critical;
  }
}

TEST(Margin, OfAKnotThatHoldsEverywhereIsAtLeastTheMost) {
  int runs = 0;
  const double share = share_until_it_opens([&](double) {
    ++runs;
    return false;
  });
  EXPECT_EQ(share, Margin::kMost);
  EXPECT_EQ(runs, 1);
}

}  // namespace
}  // namespace knot_utm
