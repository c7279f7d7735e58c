#include <gtest/gtest.h>

#include "knot_utm/specimen/knot.hpp"

namespace knot_utm {
namespace {

/// The machine follows these, and lets those among them that are no loop pull without drag. A shape from a file is one
/// of them, since nobody knows what its file holds.
TEST(Knots, AllButAStraightRodAndAStrandOnPostsMayHoldAKnot) {
  for (const char* name : {"fisherman", "overhand", "file"})
    EXPECT_TRUE(knot_of(knot_named(name)).about().may_hold_a_knot()) << name;
  for (const char* name : {"straight", "capstan"})
    EXPECT_FALSE(knot_of(knot_named(name)).about().may_hold_a_knot()) << name;
}

}  // namespace
}  // namespace knot_utm
