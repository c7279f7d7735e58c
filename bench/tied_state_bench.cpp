// One knot, tied once, pulled under other tolerances than those it was tied under.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "knot_utm/io/load_test.hpp"
#include "knot_utm/io/run_writer.hpp"
#include "knot_utm/machine/run_test.hpp"
#include "knot_utm/machine/testing_machine.hpp"
#include "knot_utm/numeric/archive.hpp"

namespace knot_utm {
namespace {

struct Arguments {
  std::string method, out;
  std::vector<std::string> ties, pulls;  // dotted.key=YAML
};

TestingMachine bench_of(const Method& method) {
  return {method.specimen, method.material, method.machine, method.physics};
}

/// Has the program's commands answered up to the first of a pull, or to the end; what is answered goes to `writer`.
void prepare(TestingMachine& bench, ProgramRunner& program, RunWriter& writer) {
  for (Command command = program.last(); !program.ended() && command.phase != Phase::kPull;) {
    const Sample sample = bench.respond(command);
    writer.add({command, sample, bench.substeps(), {}, {}, {}, 0.0});
    command = program.next(sample);
  }
}

/// The tied state as the archive has it; of the tolerances it knows nothing.
std::string saved(TestingMachine& bench, ProgramRunner& program) {
  Archive archive("tied state");
  archive(bench, program);
  return archive.bytes();
}

bool run(const Arguments& arguments) {
  std::vector<std::string> settings = arguments.ties;
  const Method tied = load_method(arguments.method, settings);
  settings.insert(settings.end(), arguments.pulls.begin(), arguments.pulls.end());
  const Method pulled = load_method(arguments.method, settings);
  RunWriter writer(arguments.out, pulled);

  TestingMachine bench = bench_of(tied);
  ProgramRunner program = make_program(tied, bench.longest_step());
  prepare(bench, program, writer);
  const std::string state = saved(bench, program);

  TestingMachine other = bench_of(pulled);
  // The commands come when they would have come: an archive of a program knows nothing of their rate.
  ProgramRunner rest = make_program(tied, bench.longest_step());
  Archive archive("tied state", state, "tied state");
  archive(other, rest);
  archive.end();
  run_test(other, rest, [&](const Command& command, const Sample& sample) {
    writer.add({command, sample, other.substeps(), {}, {}, {}, 0.0});
  });
  RunFacts facts = writer.facts();
  facts.reason = rest.reason();
  writer.finish(writer.results(rest.ended_by()), facts, other.state().position);
  return rest.ended_by() != EndedBy::kSolver;
}

}  // namespace
}  // namespace knot_utm

int main(int argc, char** argv) {
  CLI::App app("Ties a knot under one set of tolerances and pulls it under another; leaves what tensile_test leaves.");
  knot_utm::Arguments arguments;
  app.add_option("METHOD", arguments.method, "the method, a YAML file")->required();
  app.add_option("--set", arguments.ties, "dotted.key=YAML, of tying and pull")->allow_extra_args(false);
  app.add_option("--pull", arguments.pulls, "dotted.key=YAML, of the pull only")->allow_extra_args(false);
  app.add_option("--out", arguments.out, "the folder to write to")->required();
  CLI11_PARSE(app, argc, argv);
  try {
    return knot_utm::run(arguments) ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "tied_state_bench: %s\n", error.what());
    return 2;
  }
}
