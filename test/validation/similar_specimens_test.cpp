// Similar specimens from a thread to a hawser, tied and pulled as by default, are one specimen in its own units.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
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

struct Size {
  double diameter, force;  ///< F_0 [N]
};

struct Ended {
  Method method;
  Sample last;
  Results results;
};

std::string entry(const char* key, double value) {
  char text[64];
  std::snprintf(text, sizeof text, "%s: %.17g, ", key, value);
  return text;
}

/// The shipped test on a rod with polypropylene's groups, with a short pull.
Ended run(const Size& size) {
  const double h = 0.5 * size.diameter, bending = size.force * h * h;
  const std::string material =
      "material={" + entry("radius", h) + entry("stretching_stiffness", 3.33e3 * size.force) +
      entry("bending_stiffness", bending) + entry("twisting_stiffness", bending) +
      entry("tying_preload", 4.3 * size.force) +
      "density: 900, friction_coefficient: 0.63, bending_law: frictional, friction_moment: 0.06, "
      "compaction: 0.002}";
  // A cell of the same rate: commands come as often.
  const std::string cell = "machine.load_cell={" + entry("capacity", 4e3 * size.force) + "sampling_rate: 3}";
  Ended out;
  out.method = load_method(std::string(KNOT_UTM_SOURCE_DIR) + "/config/tighten.yaml",
                           {material, cell, "physics.accuracy=draft", "program.pull.until={time: 4}"});
  TestingMachine bench(out.method.specimen, out.method.material, out.method.machine, out.method.physics);
  ProgramRunner program = make_program(out.method, bench.longest_step());
  std::vector<Sample> samples;
  run_test(bench, program, [&](const Command&, const Sample& sample) {
    samples.insert(samples.end(), bench.substeps().begin(), bench.substeps().end());
    out.last = sample;
  });
  out.results = analyse(samples, samples, program.ended_by(), rollers_hold(out.method.specimen, out.method.machine));
  return out;
}

TEST(SimilarSpecimens, PullAlike) {
  const Size paper{0.00635, 11.7};
  const Ended reference = run(paper);
  ASSERT_EQ(reference.last.status, BenchStatus::kRunning) << reference.last.message;
  const double force = reference.last.force_upper / paper.force;
  ASSERT_GT(force, 0.1);
  for (const Size& size : {Size{0.00025, 1e-5}, Size{0.00025, 1e4}, Size{0.04, 1e-5}, Size{0.04, 1e4}}) {
    const Ended other = run(size);
    ASSERT_EQ(other.last.status, BenchStatus::kRunning) << other.last.message;
    // Rounding differs, and with it what Newton's method leaves unbalanced, up to the residual of k_b/h^2 a node.
    EXPECT_NEAR(other.last.force_upper / size.force, force, 0.01 * force);
    // Knots that are nearer to their marks than half a percent stay there.
    const double distance = reference.last.knot_distance / paper.diameter;
    EXPECT_NEAR(other.last.knot_distance / size.diameter, distance, 0.005 * distance);
    EXPECT_EQ(other.last.time, reference.last.time);
    EXPECT_NEAR(static_cast<double>(other.last.newton_iterations),
                static_cast<double>(reference.last.newton_iterations),
                0.2 * static_cast<double>(reference.last.newton_iterations));
    EXPECT_LT(*other.results.rate.drag, 1e-3);
  }
}

}  // namespace
}  // namespace knot_utm
