// What happened is said right: of whole runs that once were told wrongly.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <string>

#include "io/command.hpp"
#include "io/own_folder.hpp"

namespace knot_utm {
namespace {

using ::testing::HasSubstr;

/// A loop that is tied and pulled in a second or two, with more to set.
class Said : public OwnFolder {
 protected:
  static YAML::Node run(const std::string& more) {
    const Answer answer = answer_of(
        tool("tensile_test", "tighten --quiet --out '" + folder() + "' --set physics.accuracy=draft " + more));
    EXPECT_EQ(answer.code, 0) << answer.text;
    said_ = answer.text;
    return YAML::LoadFile(folder() + "/result.yaml");
  }
  inline static std::string said_;
};

TEST_F(Said, KnotsThatBearKilonewtonsAreNotUntangledWhereverTheyWandered) {
  const YAML::Node result = run("--set material=polypropylene --set specimen.knot_distance=0.18");
  EXPECT_GT(result["peak_force"].as<double>(), 1000.0);
  EXPECT_EQ(result["motion_pattern"].as<std::string>(), "sliding");
  EXPECT_TRUE(result["untangled_at"].IsNull());
  EXPECT_TRUE(result["knot_type_preserved"].as<bool>());
  EXPECT_FALSE(result["plateau_force"].IsNull());
}

TEST_F(Said, KnotsTouchEachOtherBeforeTheLoopStretches) {
  const YAML::Node result = run("--set material=polypropylene --set material.breaking_force=none");
  const double first = result["first_contact_extension"].as<double>(), lock = result["lock_extension"].as<double>();
  EXPECT_LT(first, lock);
  EXPECT_GT(first, 0.6 * lock);
  // Where they touch they are as far apart as a knot is long, a few times the diameter of the rod.
  EXPECT_NEAR(result["tied_knot_distance"].as<double>() - 2.0 * first, 0.02, 0.015);
  EXPECT_LE(result["plateau_force_low"].as<double>(), result["plateau_force"].as<double>());
  EXPECT_GE(result["plateau_force_high"].as<double>(), result["plateau_force"].as<double>());
}

TEST_F(Said, AKnotThatJumpedOpenIsNotReadAsOneThatSlides) {
  const YAML::Node result = run("--set material=nylon --set specimen.preload=20");
  EXPECT_THAT(said_, HasSubstr("a knot jumped open at an extension of "));
  EXPECT_TRUE(result["plateau_force"].IsNull());
  EXPECT_TRUE(result["lock_extension_error"].IsNull());
  EXPECT_GT(result["true_jump_force"].as<double>(), 2.0 * result["true_force_after_jump"].as<double>());
  EXPECT_THAT(result["no_plateau_because"].as<std::string>(), HasSubstr("a knot jumped open"));
}

TEST_F(Said, ALoopHeldByTwoNodesHasNoSlidingForce) {
  const YAML::Node result = run("--set material=nylon --set machine.grips=nodes");
  EXPECT_TRUE(result["plateau_force"].IsNull());
  EXPECT_THAT(result["no_plateau_because"].as<std::string>(), HasSubstr("the knots do not slide steadily"));
}

}  // namespace
}  // namespace knot_utm
