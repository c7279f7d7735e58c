#include "knot_utm/numeric/known_names.hpp"

#include <gtest/gtest.h>

namespace knot_utm {
namespace {

const std::vector<std::string> kKeys{"knot", "handedness", "preload", "edge_length", "refinement", "tail"};

TEST(KnownNames, AreListedAsOneSaysThem) {
  EXPECT_EQ(listed({}), "");
  EXPECT_EQ(listed({"a"}), "a");
  EXPECT_EQ(listed({"a", "b"}), "a or b");
  EXPECT_EQ(listed({"a", "b", "c"}, " and "), "a, b and c");
}

TEST(KnownNames, AMisspeltOneIsTakenForTheNearest) {
  EXPECT_EQ(nearest_name("prelaod", kKeys), "preload");  // swapped
  EXPECT_EQ(nearest_name("pre_load", kKeys), "preload");
  EXPECT_EQ(nearest_name("Preload", kKeys), "preload");
  EXPECT_EQ(nearest_name("edgelength", kKeys), "edge_length");
  EXPECT_EQ(nearest_name("refinment", kKeys), "refinement");
  EXPECT_EQ(nearest_name("knots", kKeys), "knot");
  EXPECT_EQ(nearest_name("tial", kKeys), "tail");
}

TEST(KnownNames, WhatIsNearNoneIsTakenForNone) {
  EXPECT_EQ(nearest_name("", kKeys), "");
  EXPECT_EQ(nearest_name("speed", kKeys), "");
  EXPECT_EQ(nearest_name("no", kKeys), "");
  EXPECT_EQ(nearest_name("preload", {}), "");
  EXPECT_EQ(nearest_name(std::string(100000, 'x'), kKeys), "");
}

}  // namespace
}  // namespace knot_utm
