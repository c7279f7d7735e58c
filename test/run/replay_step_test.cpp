// tensile_test leaves the step that it could not make, and replay_step tries it again.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>

#include "knot_utm/rod/rod.hpp"
#include "knot_utm/run/run_folder.hpp"
#include "knot_utm/sim/saved_step.hpp"
#include "run/command.hpp"
#include "run/own_folder.hpp"
#include "sim/scenes.hpp"

namespace knot_utm {
namespace {

using testing::HasSubstr;

class ReplayStep : public MadeFolder {
 protected:
  Answer replay(const std::string& name) const { return answer_of(tool("replay_step", "'" + in(name) + "'")); }
};

/// No double holds the forces of a rod as stiff and as limp as this to the tolerance that is asked for.
constexpr const char* kImpossible =
    "/config/overhand.yaml' --set physics.residual=1e-12 --set physics.accuracy=draft --set specimen.edge_length=0.006 "
    "--set 'material={radius: 0.003, density: 1000, stretching_stiffness: 1e9, bending_stiffness: 1e-12, "
    "twisting_stiffness: 1e-12, friction_coefficient: 0.1, load_cell: 20N}' --set physics.drag=0 --out '";

TEST_F(ReplayStep, FailsForTheReasonThatTheTestGave) {
  const std::string out = in("out");
  const Answer test = answer_of(tool("tensile_test", "'" + std::string(KNOT_UTM_SOURCE_DIR) + kImpossible + out + "'"));
  ASSERT_EQ(test.code, 1) << test.text;
  EXPECT_THAT(test.text, HasSubstr("replay-step " + out + "/failed_step.bin"));
  std::smatch found;
  const std::string said = test.text;
  ASSERT_TRUE(std::regex_search(said, found, std::regex(R"( s: ([^(]*) \((residual .* N, tolerance [^ ]* N))")))
      << said;

  const Answer again = replay("out/failed_step.bin");
  EXPECT_EQ(again.code, 1) << again.text;
  EXPECT_THAT(again.text, HasSubstr("not accepted: " + found.str(1)));
  EXPECT_THAT(again.text, HasSubstr(found.str(2)));

  // A run that may write over this one does not leave it.
  const std::string straight = std::string(KNOT_UTM_SOURCE_DIR) + "/config/straight.yaml";
  const std::string shorter = " --set 'program=[{hold: {duration: 0.1}}]' --quiet --overwrite --out '" + out + "'";
  EXPECT_EQ(answer_of(tool("tensile_test", "'" + straight + "'" + shorter)).code, 0);
  EXPECT_FALSE(std::filesystem::exists(out + "/failed_step.bin"));
}

TEST_F(ReplayStep, SaysThatAStepIsAccepted) {
  const Material material = braided_rope();
  const RodProperties rod = make_rod(material, Eigen::VectorXd::Constant(20, material.radius));
  const std::unique_ptr<TimeStep> stepper = TimeStep::make(rod, straight_state(rod), closed_form_settings(material));
  Boundary boundary;
  boundary.forces = {{7, Vec3(0.0, 0.0, 1e-3)}};
  write_whole(in("step.bin"), save_step(*stepper, boundary, 0.0, 0.01));
  const Answer answer = replay("step.bin");
  EXPECT_EQ(answer.code, 0) << answer.text;
  EXPECT_THAT(answer.text, HasSubstr("rod of 21 nodes"));
  EXPECT_THAT(answer.text, HasSubstr("1 forces"));
  EXPECT_THAT(answer.text, HasSubstr("\naccepted\n"));
}

TEST_F(ReplayStep, RefusesInOneLineWhatIsNoStep) {
  write_whole(in("curve.csv"), "time,extension\n");
  for (const char* name : {"curve.csv", "nowhere.bin"}) {
    const Answer answer = replay(name);
    EXPECT_EQ(answer.code, 2);
    EXPECT_THAT(answer.text, HasSubstr(in(name) + ": "));
    EXPECT_EQ(std::count(answer.text.begin(), answer.text.end(), '\n'), 1) << answer.text;
  }
}

}  // namespace
}  // namespace knot_utm
