// Loads of a program that are given in terms of the material.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "knot_utm/method/method.hpp"
#include "knot_utm/program/loading_steps.hpp"
#include "knot_utm/program/preparing_steps.hpp"

namespace knot_utm {
namespace {

using ::testing::HasSubstr;

const std::string kConfig = std::string(KNOT_UTM_SOURCE_DIR) + "/config/";

Method straight(std::vector<std::string> overrides) { return load_method(kConfig + "straight.yaml", overrides); }

TEST(LoadTerms, APercentageIsOfTheBreakingForceOfTheMaterial) {
  const Method m =
      straight({"material.breaking_force=1700",
                "program=[{preload: {load: 2.5%}}, {cycle: {load: [10 %, 50 %], count: 3}}, {hold: {duration: 1, "
                "control: load, load: 1e1 %}}, {pull: {until: {load: 80%}}}]"});
  EXPECT_DOUBLE_EQ(m.program[0].as<PreloadStep>()->load, 42.5);
  EXPECT_DOUBLE_EQ(m.program[1].as<CycleStep>()->load->low, 170.0);
  EXPECT_DOUBLE_EQ(m.program[1].as<CycleStep>()->load->high, 850.0);
  EXPECT_DOUBLE_EQ(*m.program[2].as<HoldStep>()->held_load, 170.0);
  EXPECT_DOUBLE_EQ(*m.program[3].as<PullStep>()->until.load, 1360.0);
}

TEST(LoadTerms, TheReferenceTensionIsAnEighthOfTheSquaredDiameter) {
  const Method m = straight({"material.radius=0.008", "program.0={preload: {load: reference_tension}}"});
  EXPECT_DOUBLE_EQ(m.program[0].as<PreloadStep>()->load, 320.0);  // 16 mm: 256 / 8 = 32 daN
}

TEST(LoadTerms, AreWrittenAsNewtons) {
  const Method m = straight({"material.breaking_force=1700", "program.0={preload: {load: 50 %}}"});
  EXPECT_THAT(method_yaml(m), HasSubstr("load: 850"));
  EXPECT_EQ(method_yaml(parse_method(method_yaml(m), "method.yaml")), method_yaml(m));
}

}  // namespace
}  // namespace knot_utm
