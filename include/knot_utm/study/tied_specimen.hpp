#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "knot_utm/machine/program_runner.hpp"
#include "knot_utm/machine/testing_machine.hpp"
#include "knot_utm/method/method.hpp"
#include "knot_utm/run/cache_folder.hpp"
#include "knot_utm/run/record.hpp"
#include "knot_utm/study/beginning.hpp"

namespace knot_utm {

/// The first step of a program that does something else than to tie, release or mount the specimen or to let it rest.
/// What comes before it does not depend on what follows. Empty where the specimen is not tied before that step, or
/// where there is no such step.
std::optional<int> step_after_tying(const Program& program);

/// All that a tied specimen depends on, as text: the code that computes it, the values of specimen, material, machine
/// and physics, and the steps of the program before `step`. Empty where the code cannot be told (build_identity).
/// `shapes`: whether its records have the readings of the rod.
std::string tied_from(const Method& method, int step, bool shapes);

/// A specimen that is tied once and taken up by every later test that ties the same one. A cache keeps the state of the
/// machine before the step after tying, and all records up to there. A test that takes it up has the same bytes as one
/// that ties it, but for wall times.
class TiedSpecimen {
 public:
  /// That of this method; empty where it is not tied, or where nothing is known of the code. `shapes`: as above.
  static std::optional<TiedSpecimen> of(const Method& method, bool shapes, const CacheFolder& cache);

  int step() const { return step_; }  ///< the step after tying

  /// Brings machine and program, which have just been made from the method, to the step after tying. Empty, and they
  /// are as they were, where the cache does not have the specimen, or has it damaged.
  std::optional<Beginning> take_up(const Method& method, TestingMachine& bench, ProgramRunner& program) const;

  /// Of a test that ties it: to be called with every record until it is kept.
  void add(const Record& record);
  /// To be called between all commands: keeps it once the program has come to the step after tying.
  void keep(TestingMachine& bench, const ProgramRunner& program);

 private:
  TiedSpecimen(const CacheFolder& cache, int step, std::string made_from)
      : cache_(cache), step_(step), made_from_(std::move(made_from)) {}

  CacheFolder cache_;
  int step_;
  std::string made_from_;
  std::vector<Record> records_;
  bool kept_ = false;
};

}  // namespace knot_utm
