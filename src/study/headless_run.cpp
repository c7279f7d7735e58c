#include "knot_utm/study/headless_run.hpp"

#include <chrono>
#include <filesystem>
#include <stdexcept>
#include <utility>
#include <vector>

#include "knot_utm/machine/testing_machine.hpp"
#include "knot_utm/program/run_test.hpp"
#include "knot_utm/rod/twisting.hpp"
#include "knot_utm/run/load_test.hpp"
#include "knot_utm/run/run_folder.hpp"
#include "knot_utm/run/run_writer.hpp"
#include "knot_utm/run/samples.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/study/tied_specimen.hpp"
#include "knot_utm/verdict/foreseen.hpp"
#include "knot_utm/verdict/run_warnings.hpp"
#include "knot_utm/words/invalid_input.hpp"

namespace knot_utm {
namespace {

class WallClock {
 public:
  explicit WallClock(double passed) : passed_(passed) {}  ///< before [s]
  double seconds() const {
    return passed_ + std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  }

 private:
  double passed_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

/// All that is kept of the bench's last answer.
void take(const Command& command, const Sample& answer, const TestingMachine& bench, bool shapes, double wall_time,
          Record& record) {
  const bool shape = shape_is_due(command, answer);
  record.command = command;
  record.answer = answer;
  record.steps = bench.substeps();
  record.shape = shape ? bench.state().position : Points();
  record.tension = shape ? bench.tension() : Eigen::VectorXd();
  record.readings.reset();
  if (shape && shapes) record.readings = RodReadings{twist_rates(bench.rod(), bench.state()), bench.contact_load()};
  record.wall_time = wall_time;
}

/// A test, and where it stands.
struct Test {
  const Method& method;
  const HeadlessOptions& options;
  std::string folder;
  TestingMachine& bench;
  ProgramRunner& program;
  const std::vector<Record>& before;  ///< of the specimen that an earlier test has tied
  std::optional<TiedSpecimen>& ties;  ///< what it ties, where that is to be kept
};

void tell_warnings(const MadeResults& made, const HeadlessOptions& options) {
  for (const std::string& warning : printed_warnings(made.results, made.facts)) options.tell(warning);
}

HeadlessOutcome run_to_end(const Test& test) {
  const HeadlessOptions& options = test.options;
  SamplesWriter samples(test.folder);
  RunWriter files(test.folder, test.method, options.readings == Readings::kAll ? options.further : nullptr);
  EarlyEnd early(test.method, options.readings);
  const auto keep = [&](const Record& record) {
    samples.append(record);
    files.add(record);
    early.add(record);
  };
  for (const Record& record : test.before) keep(record);
  const WallClock clock(test.before.empty() ? 0.0 : test.before.back().wall_time);
  early.end(test.program);  // what comes before may have the whole plateau
  Record record;
  run_test(
      test.bench, test.program,
      [&](const Command& command, const Sample& sample) {
        take(command, sample, test.bench, options.writes_shapes(), clock.seconds(), record);
        keep(record);
        if (test.ties) test.ties->add(record);
        early.end(test.program);
        if (options.progress) options.progress(sample, test.program, clock.seconds());
      },
      [&] {
        if (test.ties) test.ties->keep(test.bench, test.program, test.folder);
        return options.interrupted();
      });
  HeadlessOutcome out;
  out.folder = test.folder;
  if (test.program.ended()) out.ended = test.program.ended_by();
  if (!out.ended) test.program.stop();
  out.reason = test.program.reason();
  out.failed = test.program.failed();
  const TestEnd end{test.program.ended_by(), out.ended ? out.reason : kInterrupted};
  samples.end(end, test.bench.state().position);
  const MadeResults made = files.finish(end, test.bench.state().position);
  tell_warnings(made, options);
  out.results = made.results;
  out.wall_time = clock.seconds();
  return out;
}

}  // namespace

ClaimedFolder RunOptions::claim() const {
  if (overwrite) return ClaimedFolder(folder);
  ClaimedFolder claimed = ClaimedFolder::first_free(folder);
  if (claimed.path() != folder) tell(moved_notice(folder, claimed.path()) + " (--overwrite writes over that one)");
  return claimed;
}

namespace {

/// The specimen that the test ties, where a cache may have it.
std::optional<TiedSpecimen> tied_by(const Method& method, const HeadlessOptions& options) {
  if (!options.cache) return std::nullopt;
  return TiedSpecimen::of(method, options.writes_shapes(), options.folder);
}

}  // namespace

HeadlessOutcome run_headless(const Method& given, const HeadlessOptions& options) {
  Method method = given;
  TestingMachine bench(method.specimen, method.material, method.machine, method.physics);
  ProgramRunner program = make_program(method, bench.longest_step());
  require_readings(method, options.readings);
  require_no_record_in(options.folder, method);  // before anything is written
  std::optional<TiedSpecimen> ties = tied_by(method, options);
  std::vector<Record> before;
  if (std::optional<std::vector<Record>> restored = ties ? ties->restore(method, bench, program) : std::nullopt) {
    before = std::move(*restored);
    ties.reset();
  }
  const ClaimedFolder claimed = options.claim();
  begin_run_folder(claimed.path(), method, words_of(options.readings));
  // The shape that the last run left in this folder is there no longer, but for its copy.
  if (knot_of(method.specimen).has("file") && !std::filesystem::exists(method.specimen.file))
    method.specimen.file = (std::filesystem::path(claimed.path()) / "specimen.csv").string();
  const Test test{method, options, claimed.path(), bench, program, before, ties};
  for (const std::string& warning : foreseen_warnings(method)) options.tell(warning);
  if (!before.empty() && options.remark)
    options.remark("the tied specimen was taken from the cache (--no-cache ties it anew)");
  try {
    return run_to_end(test);
  } catch (const InvalidInput&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(error.what() + what_stands(claimed.path()));
  }
}

HeadlessOutcome results_from_samples(const HeadlessOptions& options) {
  const std::string& folder = options.folder;
  if (!std::filesystem::exists(samples_file(folder)))
    throw InvalidInput::sentence("--from-samples", folder,
                                 "there is no samples.csv in " + shown(folder) + " from which results can be made");
  const ClaimedFolder claimed(folder);
  const Method method = load_method((std::filesystem::path(folder) / "method.yaml").string());
  ResultsOptions more;
  if (options.readings == Readings::kAll) more.further = options.further;
  more.ran_here = false;
  more.without_end.reason = "the test was cut off";
  const MadeResults made = make_results(folder, method, more);
  tell_warnings(made, options);
  HeadlessOutcome out;
  out.folder = folder;
  out.results = made.results;
  return out;
}

}  // namespace knot_utm
