#pragma once

#include "knot_utm/machine/program_runner.hpp"
#include "knot_utm/record/sample.hpp"

namespace knot_utm {

/// A whole test, or what is left of it: the program's commands to the bench and its samples back, until it has ended.
/// `observe(command, sample)` sees each answer before the program does; it may call `program.stop()`. Between commands,
/// where bench and program can be saved and go on, `interrupted()` may end it before the test has ended.
/// A Bench has `Sample respond(const Command&)`.
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
