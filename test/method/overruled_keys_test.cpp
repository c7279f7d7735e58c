// Keys that another choice leaves without effect.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "knot_utm/method/method.hpp"
#include "knot_utm/verdict/run_warnings.hpp"

namespace knot_utm {
namespace {

using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string kTighten = std::string(KNOT_UTM_SOURCE_DIR) + "/config/tighten.yaml";

/// What a nearer choice leaves without effect goes, whether a file of a material gave it or the method.
TEST(OverruledKeys, OfAFormerLawGo) {
  const std::string own =
      "material={radius: 1e-3, density: 1000, stretching_stiffness: 1e4, bending_stiffness: 1e-6, twisting_stiffness: "
      "1e-6, friction_coefficient: 0.4, bending_law: frictional, friction_moment: 0.05, rolling_resistance: 0.1}";
  for (const std::string& material : {std::string("material=nylon"), own}) {
    const std::string elastic = method_yaml(load_method(kTighten, {"material.bending_law=elastic", material}));
    EXPECT_THAT(elastic, Not(AnyOf(HasSubstr("friction_moment"), HasSubstr("stick_ratio"), HasSubstr("compaction"))));
  }
  const std::string power =
      method_yaml(load_method(kTighten, {"physics.friction={law: power, exponent: 0.9, reference_pressure: 100}"}));
  const std::string memory = method_yaml(parse_method(power, "method.yaml", {"physics.friction.law=memory"}));
  EXPECT_EQ(memory, method_yaml(parse_method(method_yaml(load_method(kTighten)), "method.yaml")));
}

/// A soft rod is taken as round by a method that needs it so.
TEST(OverruledKeys, OfASectionThatMustBeRoundGo) {
  ASSERT_TRUE(load_method(kTighten, {"material=pink_vps"}).material.is_soft());
  for (const char* needs :
       {"material.friction_couple=0", "physics.friction.at=centreline", "material.stretching_stiffness=1700"}) {
    const Method method = load_method(kTighten, {"material=pink_vps", "material.rolling_hysteresis=0", needs});
    EXPECT_FALSE(method.material.is_soft()) << needs;
    EXPECT_THAT(method.overruled, testing::ElementsAre(HasSubstr("material.section is soft, but must be round w")));
  }
}

TEST(OverruledKeys, OfStrandsThatDoNotRollGo) {
  ASSERT_GT(load_method(kTighten).material.rolling_resistance, 0.0);
  EXPECT_THAT(load_method(kTighten).overruled, testing::IsEmpty());
  for (const char* held : {"material.friction_couple=0", "physics.friction.at=centreline",
                           "physics.friction={at: centreline}", "material.friction_coefficient=0"}) {
    const Method method = load_method(kTighten, {held});
    EXPECT_EQ(method.material.rolling_resistance, 0.0) << held;
    EXPECT_THAT(method.overruled,
                testing::ElementsAre(HasSubstr("material.rolling_resistance is 0.3, but has an effect only with ")));
    EXPECT_THAT(foreseen_warnings(method), testing::Contains(method.overruled.front()));
  }
}

}  // namespace
}  // namespace knot_utm
