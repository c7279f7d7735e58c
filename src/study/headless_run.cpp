#include "knot_utm/study/headless_run.hpp"

#include <fcntl.h>

#include <cerrno>
#include <chrono>
#include <stdexcept>

#include "earlier_run.hpp"
#include "knot_utm/io/claimed_folder.hpp"
#include "knot_utm/io/foreseen.hpp"
#include "knot_utm/io/load_test.hpp"
#include "knot_utm/io/locked_file.hpp"
#include "knot_utm/io/recovery.hpp"
#include "knot_utm/io/run_folder.hpp"
#include "knot_utm/io/run_warnings.hpp"
#include "knot_utm/io/run_writer.hpp"
#include "knot_utm/machine/run_test.hpp"
#include "knot_utm/machine/testing_machine.hpp"
#include "knot_utm/rod/twisting.hpp"
#include "knot_utm/study/find_margin.hpp"
#include "past_records.hpp"

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

/// What a run leaves in its folder, written as it goes.
class Writers {
 public:
  Writers(const std::string& folder, const Method& method, const HeadlessOptions& options) : run(folder, method) {
    if (options.further) further_ = options.further(folder, method);
  }

  void add(const Record& record) {
    run.add(record);
    if (further_.add) further_.add(record);
  }
  void close() const {
    if (further_.close) further_.close();
  }

  RunWriter run;

 private:
  FurtherWriter further_;
};

/// The bench, and a checkpoint before a command where it is time for one.
struct CheckedBench {
  TestingMachine& bench;
  ProgramRunner& program;
  const JournalWriter& journal;
  const Checkpoint& checkpoint;
  const WallClock& clock;
  double period;                           // [s]
  double next = clock.seconds() + period;  // [s]

  Sample respond(const Command& command) {
    if (period > 0.0 && clock.seconds() >= next) {
      checkpoint.write(bench, program, journal.bytes());
      next = clock.seconds() + period;
    }
    return bench.respond(command);
  }
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

void tell(const HeadlessOptions& options, const std::string& line) {
  if (options.notice) options.notice(line);
}

/// A test, and where it stands.
struct Test {
  const Method& method;
  const HeadlessOptions& options;
  std::string folder;
  TestingMachine& bench;
  ProgramRunner& program;
  const Checkpoint& checkpoint;
  std::optional<PastRecords> past;    ///< none: it is new
  std::optional<EarlierRun> earlier;  ///< what comes before is that one's
};

/// Before this command the test is to stop.
bool stops_here(const Test& test) {
  return test.options.stop_before && test.program.last().step >= *test.options.stop_before;
}

/// Where the method asks for it, of knots that slide.
Margin margin_of(const Test& test, const Results& results) {
  const Method& method = test.method;
  Margin none;
  if (!method.analysis.margin) return none;
  none.reason = "the knots did not slide";
  if (results.motion_pattern != MotionPattern::kSliding) return none;
  return find_margin({method.specimen, method.material, method.machine, method.physics, method.program},
                     test.options.interrupted);
}

/// What becomes of a test that has ended, or was interrupted.
Results write_results(const Test& test, Writers& writers, const WallClock& clock, bool interrupted) {
  writers.close();
  if (!test.bench.failed_step().empty()) write_whole(failed_step_file(test.folder), test.bench.failed_step());
  RunFacts facts = writers.run.facts();
  facts.reason = interrupted ? kInterrupted : test.program.reason();
  facts.wall_time = clock.seconds();
  const Results results = writers.run.results(test.program.ended_by());
  facts.margin = margin_of(test, results);
  writers.run.finish(results, facts, test.bench.state().position);
  for (const std::string& warning : printed_warnings(results, facts)) tell(test.options, warning);
  return results;
}

HeadlessOutcome outcome_of(const Test& test, const Results& results, const WallClock& clock) {
  HeadlessOutcome out;
  out.folder = test.folder;
  out.reason = test.program.reason();
  out.failed = test.program.failed();
  if (!test.bench.failed_step().empty()) out.failed_step = failed_step_file(test.folder);
  out.results = results;
  out.wall_time = clock.seconds();
  return out;
}

void pull(const Test& test, bool shapes, Writers& writers, JournalWriter& journal, const WallClock& clock) {
  Record record;
  CheckedBench checked{test.bench, test.program, journal, test.checkpoint, clock, test.options.checkpoint_period};
  run_test(
      checked, test.program,
      [&](const Command& command, const Sample& sample) {
        take(command, sample, test.bench, shapes, clock.seconds(), record);
        journal.append(record);
        writers.add(record);
        if (test.options.progress) test.options.progress(sample, test.program, clock.seconds());
      },
      [&] { return stops_here(test) || test.options.interrupted(); });
}

/// All records that there are before anything is stepped, and whether they have `shapes`; the wall time that had passed
/// [s].
double replay(const Test& test, bool& shapes, Writers& writers, JournalWriter& journal) {
  const auto add = [&](const Record& record) {
    writers.add(record);
    shapes |= record.readings.has_value();
  };
  if (test.past) return test.past->replay(add, journal);
  return test.earlier ? test.earlier->replay(add, journal) : 0.0;
}

HeadlessOutcome run_to_end(const Test& test, JournalWriter& journal) {
  if (!test.past) test.checkpoint.remove();
  Writers writers(test.folder, test.method, test.options);
  bool shapes = test.options.shapes;
  const WallClock clock(replay(test, shapes, writers, journal));
  pull(test, shapes, writers, journal, clock);
  if (!test.program.ended()) {
    // Before anything that takes long: a second Ctrl-C ends the program.
    if (test.options.checkpoint_period > 0.0 || stops_here(test))
      test.checkpoint.write(test.bench, test.program, journal.bytes());
    test.program.stop();
    return outcome_of(test, write_results(test, writers, clock, true), clock);
  }
  HeadlessOutcome out = outcome_of(test, write_results(test, writers, clock, false), clock);
  out.ended = test.program.ended_by();
  test.checkpoint.remove();
  journal.remove();
  return out;
}

/// Says where the run goes to where it goes elsewhere than asked.
ClaimedFolder folder_of_run(const HeadlessOptions& options, const Method& method) {
  const std::string& asked = options.folder;
  if (options.resume) return {asked, JournalWriter::go_on(asked, 0.0)};
  if (options.overwrite) return {asked, JournalWriter(asked, journal_header(method))};
  ClaimedFolder claimed = claim_folder(asked, journal_header(method));
  if (claimed.folder != asked)
    tell(options,
         moved_notice(asked, claimed.folder) + " (" +
             (holds_unfinished_run(asked) ? "--resume goes on with that one" : "--overwrite writes over that one") +
             ")");
  return claimed;
}

}  // namespace

void require_resumable(const std::string& folder) {
  if (is_settled(folder))
    throw InvalidInput::sentence("--resume", folder,
                                 "cannot resume " + shown(folder) + ": its test has ended, and was not cut off");
  const LockedFile journal(journal_file(folder), O_RDONLY, 0.0);
  if (!journal.is_open() && errno == EWOULDBLOCK)
    throw InvalidInput::sentence("--resume", folder, "cannot resume " + shown(folder) + ": its test is still running");
}

HeadlessOutcome run_headless(const Method& method, const HeadlessOptions& options) {
  TestingMachine bench(method.specimen, method.material, method.machine, method.physics);
  ProgramRunner program = make_program(method, bench.longest_step());
  require_no_record_in(options.folder, method);  // before anything is written
  std::optional<PastRecords> past;
  if (options.resume)
    past.emplace(options.folder, method, Checkpoint(options.folder, method_file_text(method)), bench, program);
  std::optional<EarlierRun> earlier;
  if (!options.begin_with.empty()) earlier.emplace(options.begin_with, method, bench, program);
  ClaimedFolder claimed = folder_of_run(options, method);
  const Checkpoint checkpoint(claimed.folder, method_file_text(method));
  const Test test{method, options, claimed.folder, bench, program, checkpoint, past, earlier};
  for (const std::string& warning : foreseen_warnings(method)) tell(options, warning);
  try {
    return run_to_end(test, claimed.journal);
  } catch (const InvalidInput&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(error.what() + how_to_recover(claimed.folder));
  }
}

}  // namespace knot_utm
