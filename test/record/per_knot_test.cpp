#include "knot_utm/record/per_knot.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

#include "knot_utm/numeric/invalid_input.hpp"

namespace knot_utm {
namespace {

TEST(PerKnot, TakesNoMoreThanItHasRoomFor) {
  EXPECT_EQ(PerKnot::unknown(PerKnot::kMost).size(), PerKnot::kMost);
  EXPECT_THROW(PerKnot::unknown(PerKnot::kMost + 1), std::length_error);
  EXPECT_THROW(PerKnot::of(std::vector<double>(PerKnot::kMost + 1)), std::length_error);
}

TEST(PerKnot, IsLoadedWithItsLength) {
  PerKnot saved{0.25, PerKnot::kUnknown, 2.0}, loaded{7.0, 7.0, 7.0, 7.0};
  std::string bytes;
  Archive::to(bytes).save(saved);
  Archive archive = Archive::from(bytes, "readings", "a file");
  archive(loaded);
  archive.end();
  ASSERT_EQ(loaded.size(), 3u);
  EXPECT_EQ(loaded[0], 0.25);
  EXPECT_TRUE(std::isnan(loaded[1]));
  EXPECT_EQ(loaded[2], 2.0);
  EXPECT_TRUE(std::isnan(static_cast<const PerKnot&>(loaded)[3]));

  std::string too_many;
  int knots = static_cast<int>(PerKnot::kMost) + 1;
  Archive::to(too_many)(knots);
  Archive refused = Archive::from(too_many, "readings", "a file");
  EXPECT_THROW(refused(loaded), InvalidInput);
}

}  // namespace
}  // namespace knot_utm
