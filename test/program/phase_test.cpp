#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "knot_utm/program/phases.hpp"

namespace knot_utm {
namespace {

/// Saved states have the numbers, and files the names.
TEST(Phase, KeepsItsNumberAndItsName) {
  std::vector<std::string> names;
  for (const Phase phase : all_phases()) {
    names.emplace_back(phase_name(phase));
    EXPECT_EQ(phase_named(phase_name(phase)), phase) << "the name stands twice";
  }
  names.resize(static_cast<std::size_t>(Phase::kDone) + 1);
  EXPECT_THAT(names, testing::ElementsAre("idle", "tie", "release", "mount", "preload", "balance", "pull", "hold",
                                          "cycle", "return", "follow", "done"));
  EXPECT_EQ(phase_named("pulling"), std::nullopt);
}

/// The rest of the package takes these for granted.
TEST(Phase, HasTraitsThatGoTogether) {
  for (const Phase phase : all_phases()) {
    const char* name = phase_name(phase);
    EXPECT_TRUE(!pulls(phase) || (moves(phase) && loads(phase) && !prepares(phase))) << name;
    EXPECT_TRUE(!forms(phase) || (prepares(phase) && ends_by_itself(phase) && !moves(phase))) << name;
  }
  for (const Phase phase : {Phase::kIdle, Phase::kDone})
    EXPECT_FALSE(moves(phase) || forms(phase) || can_break(phase)) << phase_name(phase);
}

}  // namespace
}  // namespace knot_utm
