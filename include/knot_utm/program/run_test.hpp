#pragma once

#include "knot_utm/program/program_runner.hpp"

namespace knot_utm {

struct Command;
struct Sample;

/// Runs a whole test, or the rest of one: the program's commands go to the bench and its samples back until the test
/// has ended. `observe(command, sample)` sees each answer before the program does and may call `program.stop()`.
/// `interrupted()` may end the run between commands, where bench and program can be saved and continued later. A Bench
/// has `Sample respond(const Command&)`.
template <class Bench, class Observer, class Interrupted>
void run_test(Bench& bench, ProgramRunner& program, Observer observe, Interrupted interrupted) {
  Command command = program.last();
  while (!program.ended() && !interrupted()) {
    const Sample sample = bench.respond(command);
    observe(command, sample);
    command = program.next(sample);
  }
}
template <class Bench, class Observer>
void run_test(Bench& bench, ProgramRunner& program, Observer observe) {
  run_test(bench, program, observe, [] { return false; });
}

}  // namespace knot_utm
