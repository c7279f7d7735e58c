#pragma once

#include <functional>
#include <optional>
#include <string>

#include "knot_utm/analysis/results.hpp"
#include "knot_utm/method/method.hpp"
#include "knot_utm/program/program_runner.hpp"
#include "knot_utm/run/claimed_folder.hpp"
#include "knot_utm/run/run_writer.hpp"
#include "knot_utm/study/readings.hpp"

namespace knot_utm {

/// How a test, or a batch of tests, is run without ROS. Functions may be empty, except `interrupted`.
struct RunOptions {
  std::string folder;      ///< folder to write to
  bool overwrite = false;  ///< overwrites the contents of `folder`, instead of using the next free folder
  bool shapes = false;     ///< also writes shapes.csv
  bool cache = false;      ///< keeps and restores tied specimens (tied_specimen.hpp); else each test ties its own
  /// Other readings than all end the test early, and leave neither shapes.csv nor a further file.
  Readings readings = Readings::kAll;

  std::function<bool()> interrupted;  ///< whether to stop; called between commands, and of a batch by several threads
  /// Receives warnings: of a test when they arise, of a batch once all its tests have ended.
  std::function<void(const std::string& line)> notice;
  /// Receives what is worth saying and no warning.
  std::function<void(const std::string& line)> remark;

  void tell(const std::string& line) const {
    if (notice) notice(line);
  }
  bool writes_shapes() const { return shapes && readings == Readings::kAll; }
  /// Claims the folder, and says where the run goes to where it goes elsewhere.
  ClaimedFolder claim() const;
};

struct HeadlessOptions : RunOptions {
  MakeFurther further;
  /// Receives each answer of the simulated machine; `wall_time` since the test began [s].
  std::function<void(const Sample& answer, const ProgramRunner& program, double wall_time)> progress;
};

/// How a headless run ended.
struct HeadlessOutcome {
  std::string folder;            ///< folder that holds what was measured
  std::optional<EndedBy> ended;  ///< empty: it was interrupted
  std::string reason;            ///< reason of the end, one line
  bool failed = false;           ///< the simulation gave up
  Results results;               ///< what was measured
  double wall_time = 0.0;        ///< wall time of the whole test, including that of a tying taken from the cache [s]
};

/// Runs the test of a method and writes all files of its folder. Throws InvalidInput, before anything is written, where
/// method and folder, or method and readings, do not go together. Throws std::runtime_error where a file cannot be
/// written; the message says what stands.
HeadlessOutcome run_headless(const Method& method, const HeadlessOptions& options);

/// Makes the files of the run in `options.folder` anew from its samples. Throws InvalidInput (key "--from-samples")
/// where it has none, and else as make_results does.
HeadlessOutcome results_from_samples(const HeadlessOptions& options);

}  // namespace knot_utm
