// The source paper's ropes break: nylon at an extension of about 0.10 m, polypropylene at 0.13 m.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "knot_utm/analysis/results.hpp"
#include "knot_utm/machine/grips.hpp"
#include "knot_utm/machine/run_test.hpp"
#include "knot_utm/machine/testing_machine.hpp"
#include "knot_utm/record/sample.hpp"
#include "knot_utm/run/load_test.hpp"

namespace knot_utm {
namespace {

Results pulled_to_the_break(const std::string& material, std::vector<std::string> overrides) {
  overrides.insert(overrides.end(), {"material=" + material, "program.pull.until={extension: 0.2, break: true}"});
  const Method method = load_method(KNOT_UTM_SOURCE_DIR "/config/tighten.yaml", overrides);
  TestingMachine bench(method.specimen, method.material, method.machine, method.physics);
  ProgramRunner program = make_program(method, bench.longest_step());
  std::vector<Sample> samples;
  run_test(bench, program, [&](const Command&, const Sample&) {
    samples.insert(samples.end(), bench.substeps().begin(), bench.substeps().end());
  });
  EXPECT_EQ(program.ended_by(), EndedBy::kBreak) << program.reason();
  return analyse(samples, samples, program.ended_by(), rollers_hold(method.specimen, method.machine));
}

/// The shipped breaking forces are inferred from these very extensions: this holds the files to them, to the two digits
/// that the paper gives.
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
  RecordProperty("nylon", std::to_string(nylon.break_extension.value_or(0.0)));
  RecordProperty("polypropylene", std::to_string(polypropylene.break_extension.value_or(0.0)));
}

}  // namespace
}  // namespace knot_utm
