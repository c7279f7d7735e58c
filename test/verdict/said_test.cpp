// What happened is said right: of whole runs that once were told wrongly.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <string>

#include "knot_utm/run/run_folder.hpp"
#include "run/command.hpp"
#include "run/own_folder.hpp"

namespace knot_utm {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// A loop that is tied and pulled in a second or two, with more to set. Its rod is elastic, and friction acts on the
/// centrelines.
class Said : public OwnFolder {
 protected:
  static YAML::Node run(const std::string& more) {
    const Answer answer = answer_of(
        tool("tensile_test",
             "tighten --quiet --out '" + folder() +
                 "' --set physics.accuracy=draft --set material.bending_law=elastic --set material.friction_couple=0 " +
                 more));
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

/// Its load follows 17 mm behind where the other knot's distance stops falling.
TEST_F(Said, AfterAJumpThereIsNoLock) {
  const YAML::Node result = run("--set material=nylon --set specimen.preload=40 --set material.breaking_force=none");
  ASSERT_FALSE(result["jump_force"].IsNull());
  EXPECT_GT(result["jump_extension"].as<double>(), 0.0);
  EXPECT_GT(result["peak_force"].as<double>(), 1000.0);
  for (const char* key : {"lock_extension", "lock_extension_error", "lock_extension_by_load", "locked_stiffness",
                          "locked_stiffness_error", "plateau_force"})
    EXPECT_TRUE(result[key].IsNull()) << key;
  EXPECT_THAT(read_whole(folder() + "/result.yaml"), HasSubstr("locked_stiffness: null  # a knot jumped open at "));
}

/// Of loops that bear different loads as they are put on.
TEST_F(Said, TheBalanceTakesLittleOfThePlateau) {
  for (const char* length : {"0.25", "0.3", "0.5"}) {
    const YAML::Node result =
        run("--overwrite --set material=polypropylene --set specimen.end_to_end=" + std::string(length));
    ASSERT_FALSE(result["true_plateau_force"].IsNull()) << length;
    EXPECT_LT(result["balance_offset"].as<double>(), 0.08 * result["true_plateau_force"].as<double>()) << length;
    EXPECT_THAT(said_, Not(HasSubstr("balance"))) << length;
  }
}

TEST_F(Said, TheSameWithAndWithoutABalance) {
  const std::string begin =
                        "--overwrite --set material=polypropylene --set 'program=[{tie: {}}, {release: {}}, {mount: "
                        "{}}, ",
                    end = "{pull: {until: {extension: 0.12}}}]' ";
  for (const std::string more : {"", "--set material.friction_coefficient=0.45"}) {
    const YAML::Node balanced = run(begin + "{balance: {}}, " + end + more), as_it_is = run(begin + end + more);
    const char* key = more.empty() ? "true_plateau_force" : "true_jump_force";
    ASSERT_FALSE(balanced[key].IsNull());
    ASSERT_FALSE(as_it_is[key].IsNull());
    // The guides go a command earlier where nothing is balanced.
    EXPECT_NEAR(as_it_is[key].as<double>() / balanced[key].as<double>(), 1.0, more.empty() ? 0.02 : 0.15);
    EXPECT_EQ(as_it_is["lock_extension"].IsNull(), balanced["lock_extension"].IsNull());
  }
}

/// It took 8,300 iterations with 108 times its mass. With its own it coasted around the rollers for ever.
TEST_F(Said, AThreadComesToRestWithItsOwnMass) {
  const YAML::Node result = run("--set material=suture_3-0_nylon --set program.pull.until.extension=0.001");
  EXPECT_LT(result["newton_iterations"].as<int>(), 5000) << "when this test was written it took 2,100";
  EXPECT_FALSE(result["not_equilibrated"].as<bool>());
}

}  // namespace
}  // namespace knot_utm
