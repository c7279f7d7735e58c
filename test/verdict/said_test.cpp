// What happened is said right: of whole runs that once were told wrongly.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "knot_utm/run/run_folder.hpp"
#include "knot_utm/verdict/run_warnings.hpp"
#include "run/command.hpp"
#include "run/own_folder.hpp"

namespace knot_utm {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

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
    return YAML::LoadFile(in("result.yaml"));
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
  EXPECT_THAT(read_whole(in("result.yaml")), HasSubstr("locked_stiffness: null  # a knot jumped open at "));
}

TEST_F(Said, TheSameWithAndWithoutABalance) {
  const std::string begin =
                        "--overwrite --set material=polypropylene --set 'program=[{tie: {}}, {release: {}}, {mount: "
                        "{}}, ",
                    end = "{pull: {until: {extension: 0.12}}}]' ";
  for (const std::string more : {"", "--set material.friction_coefficient=0.455"}) {
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

class Untangled : public OwnFolder {
 protected:
  static Answer test(const std::string& more) {
    return answer_of(tool("tensile_test", "tighten --quiet --out '" + folder() + "' --set specimen.edge_length=0.005 " +
                                              "--set physics.accuracy=draft --set material=polypropylene " +
                                              "--set material.bending_law=elastic --set material.friction_couple=0 " +
                                              more));
  }
  static std::string result() { return read_whole(in("result.yaml")); }
};

constexpr const char* kSlippery = "--set specimen.preload=20 --set material.friction_coefficient=0.05 ";

TEST_F(Untangled, BeforeItIsPulledItEndsTheTestAndSaysWhatWouldKeepIt) {
  const Answer answer = test(kSlippery);
  EXPECT_EQ(answer.code, 1) << answer.text;
  EXPECT_THAT(answer.text, AllOf(HasSubstr("the knot came undone: a higher specimen.preload (now 20 N"),
                                 HasSubstr("a higher material.friction_coefficient (now 0.05)")));
  EXPECT_THAT(result(), AllOf(HasSubstr("motion_pattern: untangling\n"), HasSubstr("ended_by: untangled\n"),
                              HasSubstr(": the knot came undone\"\n"), HasSubstr("knot_type_preserved: false\n")));
  EXPECT_THAT(read_whole(in("curve.csv")), Not(HasSubstr("pull")));
}

TEST_F(Untangled, NotWhatIsMountedAndPulledAsItWasTied) {
  const Answer answer = test(
      "--set specimen.preload=20 --set 'program=[{tie: {}}, {mount: {}}, {balance: {}}, {pull: {until: "
      "{extension: 0.01}}}]'");
  EXPECT_EQ(answer.code, 0) << answer.text;
  EXPECT_THAT(result(), AllOf(HasSubstr("ended_by: extension\n"), HasSubstr("knot_type_preserved: true\n"),
                              HasSubstr("motion_pattern: sliding\n")));
}

/// A knot from a file, in slippery rope, with weights of a hundredth of the pre-load on its tails.
TEST_F(Untangled, AKnotThatLetsGoOfItsWeightsOrOfAnotherRope) {
  const std::string heavy = folder() + "-reef.yaml";
  std::ofstream(heavy) << read_whole(std::string(KNOT_UTM_SOURCE_DIR) + "/config/knots/reef.yaml")
                       << "weights: {lower_tail: 0.01, upper_tail: 0.01}\n";
  for (const std::string& settings :
       {"--set material=dyneema_2mm --set specimen.preload=30 --set specimen.knot='" + heavy + "'",
        std::string("--set material=polyester_cord --set other_material=dyneema_2mm --set specimen.knot=reef")}) {
    const Answer answer = answer_of(tool(
        "tensile_test", "knot --quiet --overwrite --out '" + folder() + "' --set physics.accuracy=draft " + settings));
    EXPECT_EQ(answer.code, 0) << answer.text;
    EXPECT_THAT(result(), HasSubstr("motion_pattern: untangling\n")) << settings;
  }
  std::filesystem::remove(heavy);
}

}  // namespace
}  // namespace knot_utm
