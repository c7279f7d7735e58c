// The whole test of the shipped loop with sections that give, in silicone without a fitted number.

#include <gtest/gtest.h>

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

Results pulled(const std::string& preload) {
  const Method method =
      load_method(KNOT_UTM_SOURCE_DIR "/config/tighten.yaml",
                  {"material=pink_vps", "specimen.preload=" + preload, "program.pull.until.extension=0.06"});
  TestingMachine bench(method.specimen, method.material, method.machine, method.physics);
  ProgramRunner program = make_program(method, bench.longest_step());
  std::vector<Sample> samples;
  run_test(bench, program, [&](const Command&, const Sample&) {
    samples.insert(samples.end(), bench.substeps().begin(), bench.substeps().end());
  });
  return analyse(samples, samples, program.ended_by(), rollers_hold(method.specimen, method.machine), 0.0,
                 method.specimen.knot_distance);
}

/// The source paper's picture: loose knots slide at little force, tight ones hold while the rod is stretched. As
/// tightly tied, knots of round sections slide at 0.04 N.
TEST(SoftSilicone, LooseKnotsSlideAndTightOnesStretch) {
  const Results loose = pulled("0.215"), tight = pulled("1.7");  // 0.5 and 3.95 k_b/h^2
  EXPECT_EQ(loose.motion_pattern, MotionPattern::kSliding);
  EXPECT_EQ(tight.motion_pattern, MotionPattern::kStretching);
  EXPECT_GT(tight.true_peak_force.value_or(0.0), 5.0 * loose.true_peak_force.value_or(1.0));
  EXPECT_LT(loose.energy_balance_error.value_or(1.0), 3e-4);  // of little energy, by the residual
  EXPECT_LT(tight.energy_balance_error.value_or(1.0), 1e-5);
}

}  // namespace
}  // namespace knot_utm
