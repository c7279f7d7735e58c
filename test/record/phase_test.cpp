#include "knot_utm/record/phase.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace knot_utm {
namespace {

TEST(Phase, HasANameOfItsOwn) {
  for (const PhaseTraits& traits : all_phases()) {
    EXPECT_EQ(phase_named(traits.name), traits.phase);
    EXPECT_STREQ(phase_name(traits.phase), traits.name);
  }
  EXPECT_EQ(phase_named("pulling"), std::nullopt);
}

/// The rest of the package takes these for granted.
TEST(Phase, HasTraitsThatGoTogether) {
  for (const PhaseTraits& traits : all_phases()) {
    if (traits.pulls) {
      EXPECT_TRUE(traits.moves && !traits.prepares) << traits.name;
    }
    if (traits.forms) {
      EXPECT_TRUE(traits.prepares && traits.ends_by_itself && !traits.moves) << traits.name;
    }
    if (!traits.is_step) {
      EXPECT_FALSE(traits.moves || traits.forms || traits.can_break) << traits.name;
    }
  }
  EXPECT_THAT(step_names(), testing::ElementsAre("tie", "release", "mount", "preload", "balance", "pull", "hold",
                                                 "cycle", "return", "follow"));
}

}  // namespace
}  // namespace knot_utm
