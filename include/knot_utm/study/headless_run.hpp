#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "knot_utm/analysis/plateau_watch.hpp"
#include "knot_utm/analysis/results.hpp"
#include "knot_utm/machine/testing_machine.hpp"
#include "knot_utm/method/method.hpp"
#include "knot_utm/program/program_runner.hpp"
#include "knot_utm/run/run_folder.hpp"
#include "knot_utm/run/run_writer.hpp"
#include "knot_utm/run/samples.hpp"

namespace knot_utm {

/// Which readings a test is made for.
enum class Readings {
  kAll,     ///< those of the whole program
  kPlateau  ///< the sliding force alone: the test ends once its plateau is settled (PlateauWatch)
};

/// The option and its value as the command line has them, "--readings plateau"; empty for kAll.
std::string words_of(Readings readings);
Readings readings_named(const std::string& word);  ///< of "plateau"
/// Throws InvalidInput where the test of this method has no such readings.
void require_readings(const Method& method, Readings readings);

/// Ends a test whose readings are complete before its program ends.
class EarlyEnd {
 public:
  EarlyEnd(const Method& method, Readings readings);

  /// Takes every record of the test in order, also of a part that an earlier run has made.
  void add(const Record& record);
  /// Ends the program where the readings are complete.
  void end(ProgramRunner& program) const;

 private:
  std::optional<PlateauWatch> watch_;  ///< empty: the program ends by itself
  std::string reason_;                 ///< empty: the test goes on
};

/// How a test, or a batch of tests, is run without ROS. Only `interrupted` must not be empty.
struct RunOptions {
  std::string folder;      ///< folder to write to
  bool overwrite = false;  ///< overwrites the contents of `folder`, instead of using the next free folder
  bool shapes = false;     ///< also writes shapes.csv, and shapes.bin
  bool cache = false;      ///< keeps and restores tied specimens (TiedSpecimen); else each test ties its own
  /// Other readings than all end the test early, and leave no shapes.csv.
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
  bool keep_shapes = false;  ///< also writes shapes.bin
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

/// Runs the test of a method and writes all files of its folder.
HeadlessOutcome run_headless(const Method& method, const HeadlessOptions& options);

/// Makes the files of the run in `options.folder` anew from its samples.
HeadlessOutcome results_from_samples(const HeadlessOptions& options);

/// The first step of a program that does something else than to tie, release or mount the specimen or to let it rest;
/// empty where there is none, or no tying before it. What comes before does not depend on what follows.
std::optional<int> step_after_tying(const Program& program);

/// All that a tied specimen depends on, as text: the program that computes it, the values of specimen, material,
/// machine and physics, and the steps of the method before `step`. `shapes`: its records have the readings of the rod.
std::string tied_from(const Method& method, int step, bool shapes);

/// A specimen that is tied once and restored by every later test beside it that ties the same one. A file keeps the
/// state of the machine before the step after tying, and all records up to there. A test that restores it has the same
/// bytes as one that ties it, but for wall times.
///
/// The file is one of kFiles in the hidden folder `.tied` beside the folder of the run, so in that of its sweep or
/// batch. What a specimen is tied from says which, and the last one that was kept there replaces the one before.
/// Several processes may share them, since a file appears as a whole. One that does not suit is as good as none.
class TiedSpecimen {
 public:
  static constexpr std::size_t kFiles = 32;

  /// That of this method, for a run in this folder; empty where it is not tied. `shapes`: as above.
  static std::optional<TiedSpecimen> of(const Method& method, bool shapes, const std::string& folder);

  int step() const { return step_; }  ///< the step after tying
  const std::string& file() const { return file_; }

  /// Brings machine and program, which have just been made from the method, to the step after tying, and gives the
  /// records up to there, all of which its program has asked for. Empty, and machine and program are as they were,
  /// where the file does not have the specimen, or has it damaged.
  std::optional<std::vector<Record>> restore(const Method& method, TestingMachine& bench, ProgramRunner& program) const;

  /// Of a test that ties it: to be called with every record until it is kept.
  void add(const Record& record);
  /// To be called between all commands: keeps it once the program has come to the step after tying. `folder`: that of
  /// the run, in which it is written before it is moved to its place.
  void keep(TestingMachine& bench, const ProgramRunner& program, const std::string& folder);

 private:
  TiedSpecimen(std::string file, int step, std::string made_from)
      : file_(std::move(file)), step_(step), made_from_(std::move(made_from)) {}

  std::string file_;
  int step_;
  std::string made_from_;
  std::vector<Record> records_;
  bool kept_ = false;
};

}  // namespace knot_utm
