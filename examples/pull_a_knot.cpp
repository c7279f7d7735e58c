// Ties the knot of a method, pulls it, and prints the force against the extension: pull_a_knot [METHOD [KEY=VALUE...]].
// The package is installed in ~/knot_utm (doc/install.md).
// Run:  cmake -S examples -B build-example -DCMAKE_PREFIX_PATH="$HOME/knot_utm" && cmake --build build-example &&
//       build-example/pull_a_knot tighten material=polypropylene
// Test: test/package_test.py
#include <cstdio>
#include <string>
#include <vector>

#include "knot_utm/analysis/results.hpp"
#include "knot_utm/machine/testing_machine.hpp"
#include "knot_utm/method/shipped.hpp"
#include "knot_utm/program/phases.hpp"
#include "knot_utm/program/program_runner.hpp"
#include "knot_utm/record/sample.hpp"
#include "knot_utm/run/load_test.hpp"
#include "knot_utm/specimen/machine_options.hpp"

int main(int argc, char** argv) try {
  const std::string file = knot_utm::find_method(argc > 1 ? argv[1] : "tighten", "", {KNOT_UTM_METHODS});
  const std::vector<std::string> settings(argv + (argc > 2 ? 2 : argc), argv + argc);
  const knot_utm::Method method = knot_utm::load_test(file, settings);
  knot_utm::TestingMachine bench(method.specimen, method.material, method.machine, method.physics);
  knot_utm::ProgramRunner program = knot_utm::make_program(method, bench.longest_step());

  std::vector<knot_utm::Sample> steps, readings;  // every time step; what the load cell records
  std::printf("extension [mm]  force [N]\n");
  knot_utm::run_test(bench, program, [&](const knot_utm::Command& command, const knot_utm::Sample& sample) {
    steps.insert(steps.end(), bench.substeps().begin(), bench.substeps().end());
    if (!command.read_cell && !command.balance) return;
    readings.push_back(sample);
    if (knot_utm::pulls(sample.phase) && readings.size() % 10 == 0)
      std::printf("%14.2f  %9.4g\n", 1e3 * sample.extension, sample.load);
  });

  const knot_utm::Results results =
      knot_utm::analyse(steps, readings, program.ended_by(), knot_utm::rollers_hold(method.specimen, method.machine));
  std::printf("the test ended by %s\n", knot_utm::ended_by_name(program.ended_by()));
  if (results.curve.plateau_force)
    std::printf("plateau force: %.4g N\n", *results.curve.plateau_force);
  else
    std::printf("no plateau: %s\n", results.curve.no_plateau.c_str());
  return program.failed() ? 1 : 0;
} catch (const knot_utm::InvalidInput& invalid) {
  std::fprintf(stderr, "pull_a_knot: %s\n", invalid.what());
  return 2;
}
