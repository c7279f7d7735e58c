// The whole test of the shipped loop. The source paper's ropes break: nylon at an extension of about 0.10 m,
// polypropylene at 0.13 m. And the softest material's loop is tied and pulled on frames much softer and much stiffer
// than it is.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "knot_utm/analysis/results.hpp"
#include "knot_utm/grips/grips.hpp"
#include "knot_utm/machine/testing_machine.hpp"
#include "knot_utm/program/program_runner.hpp"
#include "knot_utm/record/sample.hpp"
#include "knot_utm/run/load_test.hpp"

namespace knot_utm {
namespace {

constexpr const char* kMethod = KNOT_UTM_SOURCE_DIR "/config/tighten.yaml";

Results pulled_to_the_break(const std::string& material, std::vector<std::string> overrides) {
  overrides.insert(overrides.end(), {"material=" + material, "program.pull.until={extension: 0.2, break: true}"});
  const Method method = load_method(kMethod, overrides);
  TestingMachine bench(method.specimen, method.material, method.machine, method.physics);
  ProgramRunner program = make_program(method, bench.longest_step());
  std::vector<Sample> samples;
  run_test(bench, program, [&](const Command&, const Sample&) {
    samples.insert(samples.end(), bench.substeps().begin(), bench.substeps().end());
  });
  EXPECT_EQ(program.ended_by(), EndedBy::kBreak) << program.reason();
  return analyse(samples, samples, program.ended_by(), rollers_hold(method.specimen, method.machine));
}

/// The shipped breaking forces were inferred from these very extensions: this holds the files to them, to the two
/// digits that the paper gives.
TEST(TheLoop, BreaksWhereThePapersDid) {
  const Results nylon = pulled_to_the_break("nylon", {}), polypropylene = pulled_to_the_break("polypropylene", {});
  EXPECT_NEAR(nylon.break_extension.value_or(0.0), 0.10, 0.005);
  EXPECT_NEAR(polypropylene.break_extension.value_or(0.0), 0.13, 0.005);
  EXPECT_EQ(nylon.failure_mode, "sliding then fracture");
  EXPECT_EQ(polypropylene.failure_mode, "sliding then fracture");
}

/// With what catalogues give for 1/4 in ropes of these fibres without a knot, fitted to nothing, the order is the
/// paper's.
TEST(TheLoop, BreaksInThePapersOrderByTheStrengthOfCatalogues) {
  const std::vector<std::string> draft = {"physics.accuracy=draft"};
  std::vector<std::string> with_nylon = draft, with_polypropylene = draft;
  with_nylon.push_back("material.breaking_force=6610");
  with_polypropylene.push_back("material.breaking_force=5000");
  const Results nylon = pulled_to_the_break("nylon", with_nylon);
  const Results polypropylene = pulled_to_the_break("polypropylene", with_polypropylene);
  EXPECT_LT(nylon.break_extension.value_or(1.0), polypropylene.break_extension.value_or(0.0));
}

class CompliantLoop : public testing::TestWithParam<double> {};

/// Nothing but the pre-load of the tying pulls at the rod, and the crosshead by 0.02 m, over which the knots slide.
TEST_P(CompliantLoop, OnRollersIsTiedAndPulledWithinTheTyingForce) {
  const Method method =
      load_method(kMethod, {"material=pink_vps", "physics.accuracy=draft",
                            "machine.stiffness=" + std::to_string(GetParam()), "program.pull.until={time: 6}"});
  TestingMachine bench(method.specimen, method.material, method.machine, method.physics);
  ProgramRunner program = make_program(method, bench.longest_step());
  double largest = 0.0;
  bool rests = true;
  run_test(bench, program, [&](const Command& command, const Sample& sample) {
    rests &= sample.status != BenchStatus::kNotEquilibrated;
    for (const Sample& step : bench.substeps())
      largest = std::max({largest, std::abs(step.force_upper), std::abs(step.force_lower)});
    if (command.time > 300.0) program.stop();  // nothing in this test waits so long
  });
  EXPECT_EQ(program.ended_by(), EndedBy::kProgram) << program.reason();
  EXPECT_LT(largest, *method.material.tying_preload);
  EXPECT_GT(largest, 0.0);
  // On 1 N/m, a tenth of the loop's own stiffness, the rig does not wait long enough, and says so.
  EXPECT_TRUE(rests || GetParam() < 10.0);
}

INSTANTIATE_TEST_SUITE_P(Frame, CompliantLoop, testing::Values(1.0, 1e4),
                         [](const auto& test) { return "K" + std::to_string(static_cast<int>(test.param)); });

}  // namespace
}  // namespace knot_utm
