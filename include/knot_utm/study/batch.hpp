#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "knot_utm/method/method.hpp"
#include "knot_utm/study/headless_run.hpp"

namespace knot_utm {

/// One of the specimens that a method describes, with its drawn values.
struct SampledSpecimen {
  int number = 0;                                     ///< from 1
  std::vector<std::pair<std::string, double>> drawn;  ///< keys that scatter, each with its value in its unit
  Method method;                                      ///< method of this specimen alone
};

/// Throws InvalidInput where the specimen cannot be made, or the machine cannot hold it. The test itself would say so,
/// too, but only once it begins.
void check_fits(const Method& method);

/// Draws the values of one specimen of a method, as `Method::specimens` says. They depend only on the seed, the number
/// of the specimen (from 1) and the key, so neither a larger count nor a further key changes them. All specimens are
/// tested with one load cell, whose noise is different for each. Throws InvalidInput where the drawn method would be
/// refused.
SampledSpecimen draw_specimen(const Method& method, int number);

/// Draws all specimens of a method.
std::vector<SampledSpecimen> draw_specimens(const Method& method);

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
