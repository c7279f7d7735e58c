#pragma once

#include <functional>
#include <string>
#include <vector>

#include "knot_utm/method/method.hpp"
#include "knot_utm/study/headless_run.hpp"

namespace knot_utm {

/// How a batch is run. A batch is a test of all specimens of a method.
struct BatchOptions : RunOptions {
  int jobs = 1;         ///< number of specimens that are tested at the same time
  bool resume = false;  ///< continues the interrupted batch in `folder`
  /// Called after each test that has ended, with the number of tests that have ended and that of all tests.
  std::function<void(int ended, int count)> progress;
};

/// A specimen whose readings do not count, and the reason, such as "the knot came undone before it was pulled".
struct Rejected {
  int specimen = 0;
  std::string reason;
};

struct BatchOutcome {
  std::string folder;
  bool interrupted = false;  ///< the batch can be resumed, and has no statistics yet
  int specimens = 0;
  std::vector<Rejected> rejected;
};

/// Tests all specimens of a method, or those that an interrupted batch has not tested to their end. For each it writes
/// the files of a single test into a folder of its own. Then it writes specimens.csv, a row for each specimen with what
/// was drawn and the numbers of its result.yaml, and statistics.yaml, the statistics of each number over the specimens
/// that were not rejected: a test is rejected if the simulation gave up, if the knot came undone before it was pulled,
/// or if an operator stopped it. These have the same bytes however many specimens were tested at the same time. Throws
/// InvalidInput, before anything is written, where a specimen would be refused. Throws std::runtime_error where a file
/// cannot be written; the batch can then be resumed.
BatchOutcome run_batch(const Method& method, const BatchOptions& options);

}  // namespace knot_utm
