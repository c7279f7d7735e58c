#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "knot_utm/verdict/result_keys.hpp"
#include "knot_utm/words/invalid_input.hpp"

namespace knot_utm {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

YamlLines results() {
  YamlLines lines;
  lines.number("peak_force", 60.0);
  lines.number("lock_extension", std::nullopt);
  lines.count("steps", 7);
  return lines;
}

TEST(Verdict, IsNoneWhereNothingWasAskedFor) { EXPECT_EQ(verdict({}, results()).passed, std::nullopt); }

TEST(Verdict, LimitsThemselvesAreAllowed) {
  const Verdict found = verdict({{"peak_force", 60.0, 60.0}, {"steps", std::nullopt, 7.0}}, results());
  EXPECT_EQ(found.passed, true);
  EXPECT_THAT(found.failed, IsEmpty());
}

TEST(Verdict, SaysOfEachRequirementWhyItIsNotMet) {
  const Verdict found = verdict({{"peak_force", 61.5, std::nullopt},
                                 {"steps", 8.0, 9.0},
                                 {"peak_force", std::nullopt, 59.0},
                                 {"lock_extension", std::nullopt, 0.1}},
                                results());
  EXPECT_EQ(found.passed, false);
  EXPECT_THAT(found.failed, ElementsAre("peak_force is 60, less than the least that is allowed, 61.5",
                                        "steps is 7, less than the least that is allowed, 8",
                                        "peak_force is 60, more than the most that is allowed, 59",
                                        "lock_extension has no value in this test"));
}

TEST(Specification, MayNameNumbersOfTheResultOnly) {
  for (const char* key : {"peak_force", "plateau_force", "lock_extension", "untangled_at", "steps", "wall_time"})
    EXPECT_NO_THROW(check_specification({{key, 1.0, {}}})) << key;
  for (const char* key : {"motion_pattern", "warnings", "knot_type_preserved", "excess_length", "version"})
    EXPECT_THROW(check_specification({{key, 1.0, {}}}), InvalidInput) << key;
}

}  // namespace
}  // namespace knot_utm
