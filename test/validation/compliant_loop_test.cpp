// The whole test of the softest material's loop, on frames much softer and much stiffer than the loop.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "knot_utm/machine/run_test.hpp"
#include "knot_utm/machine/testing_machine.hpp"
#include "knot_utm/record/sample.hpp"
#include "knot_utm/run/load_test.hpp"

namespace knot_utm {
namespace {

class CompliantLoop : public testing::TestWithParam<double> {};

/// Nothing but the pre-load of the tying pulls at the rod, and the crosshead by 0.02 m, over which the knots slide.
TEST_P(CompliantLoop, OnRollersIsTiedAndPulledWithinTheTyingForce) {
  const Method method =
      load_method(std::string(KNOT_UTM_SOURCE_DIR) + "/config/tighten.yaml",
                  {"material=pink_vps", "physics.accuracy=draft", "machine.stiffness=" + std::to_string(GetParam()),
                   "program.pull.until={time: 6}"});
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
