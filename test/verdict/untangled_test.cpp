// A knot that comes undone before it is pulled, and one that is pulled as it was tied.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "knot_utm/run/run_folder.hpp"
#include "knot_utm/verdict/run_warnings.hpp"
#include "run/command.hpp"
#include "run/own_folder.hpp"

namespace knot_utm {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class Untangled : public OwnFolder {
 protected:
  static Answer test(const std::string& more) {
    return answer_of(tool("tensile_test", "tighten --quiet --out '" + folder() + "' --set specimen.edge_length=0.005 " +
                                              "--set physics.accuracy=draft --set material=polypropylene " +
                                              "--set material.bending_law=elastic --set material.friction_couple=0 " +
                                              more));
  }
  static std::string result() { return read_whole(folder() + "/result.yaml"); }
};

constexpr const char* kSlippery = "--set specimen.preload=20 --set material.friction_coefficient=0.05 ";

TEST_F(Untangled, BeforeItIsPulledItEndsTheTestAndSaysWhatWouldKeepIt) {
  const Answer answer = test(kSlippery);
  EXPECT_EQ(answer.code, 1) << answer.text;
  EXPECT_THAT(answer.text, AllOf(HasSubstr("the knot came undone: a higher specimen.preload (now 20 N"),
                                 HasSubstr("a higher material.friction_coefficient (now 0.05)")));
  EXPECT_THAT(result(), AllOf(HasSubstr("motion_pattern: untangling\n"), HasSubstr("ended_by: untangled\n"),
                              HasSubstr(": the knot came undone\"\n"), HasSubstr("knot_type_preserved: false\n")));
  EXPECT_THAT(read_whole(folder() + "/curve.csv"), Not(HasSubstr("pull")));
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
