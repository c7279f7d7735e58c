// One whole test without ROS: read the method, run it, write what came out.
#include <fcntl.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "knot_utm/io/checkpoint.hpp"
#include "knot_utm/io/claimed_folder.hpp"
#include "knot_utm/io/journal.hpp"
#include "knot_utm/io/knot_advice.hpp"
#include "knot_utm/io/locked_file.hpp"
#include "knot_utm/io/method.hpp"
#include "knot_utm/io/recovery.hpp"
#include "knot_utm/io/report.hpp"
#include "knot_utm/io/result_yaml.hpp"
#include "knot_utm/io/run_folder.hpp"
#include "knot_utm/io/run_warnings.hpp"
#include "knot_utm/io/run_writer.hpp"
#include "knot_utm/io/shipped.hpp"
#include "knot_utm/machine/before_tying.hpp"
#include "knot_utm/machine/program_runner.hpp"
#include "knot_utm/machine/run_test.hpp"
#include "knot_utm/machine/testing_machine.hpp"
#include "knot_utm/study/find_margin.hpp"
#ifdef KNOT_UTM_HAS_ROS
#include "knot_utm/ros/run_bag.hpp"
#endif
#include "tool.hpp"

namespace knot_utm {
namespace {

constexpr const char* kTool = "tensile_test";

volatile std::sig_atomic_t stop_asked = 0;

void ask_to_stop(int /*signal*/) { stop_asked = 1; }

/// The first Ctrl-C interrupts the test, which `--resume` takes up again; the second one ends the program.
void set_signals() {
  struct sigaction action {};
  action.sa_handler = ask_to_stop;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  // A file as large as is allowed is an error like a full disk, which says what was being written.
  std::signal(SIGXFSZ, SIG_IGN);
}

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

/// One line that is written over a few times a second, on a terminal only.
class ProgressLine {
 public:
  explicit ProgressLine(bool quiet) : on_(!quiet && isatty(STDERR_FILENO) != 0) {}
  ~ProgressLine() {
    if (shown_) std::fputc('\n', stderr);
  }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void show(const Sample& sample, const ProgramRunner& program, double wall_time) {
    if (!on_ || wall_time < next_) return;
    next_ = wall_time + 0.2;
    shown_ = true;
    const double factor = sample.time / wall_time;
    const double left = factor > 0.0 ? program.time_left() / factor : 0.0;
    std::fprintf(stderr, "\r%-8s %5.1f %%  s %8.2f mm  F %10.4g N  %6.1f x real time  %5.0f s left ",
                 phase_name(sample.phase), 100.0 * program.progress(), 1e3 * sample.extension, sample.load, factor,
                 left);
    std::fflush(stderr);
  }

 private:
  bool on_;
  bool shown_ = false;
  double next_ = 0.0;  ///< [s]
};

struct Arguments {
  std::string method;
  std::vector<std::string> overrides;
  std::string out;
  std::string resume;       // a folder; empty: a new test
  double checkpoint = 5.0;  // wall time between two [s]; 0: none
  bool overwrite = false;
  bool quiet = false;
  bool report = false;
  std::string command;  // the whole line
};

/// What a run leaves in its folder, written as it goes.
class Writers {
 public:
  Writers(const std::string& out, const Method& method)
      : run(out, method)
#ifdef KNOT_UTM_HAS_ROS
        ,
        bag_(out + "/test.bag", method)
#endif
  {
  }

  void add(const Record& record) {
    run.add(record);
#ifdef KNOT_UTM_HAS_ROS
    bag_.add(record);
#endif
  }
  void close() {
#ifdef KNOT_UTM_HAS_ROS
    bag_.close();
#endif
  }

  RunWriter run;

 private:
#ifdef KNOT_UTM_HAS_ROS
  RunBag bag_;
#endif
};

/// The records of a run that is taken up again, as far as its checkpoint goes.
class Past {
 public:
  /// Loads bench and program as the checkpoint has them; without one they stay at the beginning.
  Past(const std::string& folder, const Method& method, const Checkpoint& checkpoint, TestingMachine& bench,
       ProgramRunner& program)
      : folder_(folder) {
    JournalReader journal = reader();
    if (!(journal.header() == journal_header(method)))
      throw InvalidInput::sentence("method", folder, "the journal belongs to another method than method.yaml beside it")
          .in_file(journal_file(folder));
    bytes_ = journal.good_bytes();
    if (!checkpoint.is_there()) return;
    bytes_ = checkpoint.load(bench, program);
    Record record;
    while (journal.good_bytes() < bytes_ && journal.next(record)) continue;
    if (journal.good_bytes() != bytes_ || journal.records() != program.last().sequence)
      throw InvalidInput::sentence("journal", folder,
                                   "the checkpoint needs " + std::to_string(bytes_) +
                                       " bytes of the journal, of which only " + std::to_string(journal.good_bytes()) +
                                       " are whole")
          .in_file(checkpoint.file());
  }

  /// Writes everything anew; the wall time that had passed [s].
  double write(Writers& writers, JournalWriter& journal) const {
    JournalReader records = reader();
    Record record;
    while (records.good_bytes() < bytes_ && records.next(record)) writers.add(record);
    journal.truncate_to(bytes_);
    return record.wall_time;
  }

 private:
  JournalReader reader() const {
    try {
      return JournalReader(folder_);
    } catch (const InvalidInput& invalid) {
      throw invalid.in_file(journal_file(folder_));
    }
  }

  std::string folder_;
  std::uint64_t bytes_ = 0;
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
void take(const Command& command, const Sample& answer, const TestingMachine& bench, double wall_time, Record& record) {
  const bool shape = shape_is_due(command);
  record.command = command;
  record.answer = answer;
  record.steps = bench.substeps();
  record.shape = shape ? bench.state().position : Points();
  record.tension = shape ? bench.tension() : Eigen::VectorXd();
  record.wall_time = wall_time;
}

/// A test, and where it stands.
struct Test {
  const Method& method;
  std::string out;
  TestingMachine& bench;
  ProgramRunner& program;
  const Checkpoint& checkpoint;
  std::optional<Past> past;  ///< none: it is new
};

/// Where the method asks for it, of knots that slide.
Margin margin_of(const Test& test, const Results& results) {
  const Method& method = test.method;
  Margin none;
  if (!method.analysis.margin) return none;
  none.reason = "the knots did not slide";
  if (results.motion_pattern != MotionPattern::kSliding) return none;
  return find_margin({method.specimen, method.material, method.machine, method.physics, method.program},
                     [] { return stop_asked != 0; });
}

/// What becomes of a test that has ended, or was interrupted.
Results write_results(const Test& test, Writers& writers, const WallClock& clock, bool interrupted) {
  writers.close();
  if (!test.bench.failed_step().empty()) write_whole(failed_step_file(test.out), test.bench.failed_step());
  RunFacts facts = writers.run.facts();
  facts.reason = interrupted ? kInterrupted : test.program.reason();
  facts.wall_time = clock.seconds();
  const Results results = writers.run.results(test.program.ended_by());
  facts.margin = margin_of(test, results);
  writers.run.finish(results, facts, test.bench.state().position);
  for (const std::string& warning : told(results, facts)) std::fprintf(stderr, "%s: %s\n", kTool, warning.c_str());
  return results;
}

/// Says how the test ended; the exit code.
int tell_end(const Test& test, const Results& results, double wall_time, bool quiet) {
  const ProgramRunner& program = test.program;
  const char* out = test.out.c_str();
  if (program.ended_by() == EndedBy::kSolver) {
    std::fprintf(stderr, "%s: the physics gave up: %s; what was measured until then is in %s\n", kTool,
                 program.reason().c_str(), out);
    if (!test.bench.failed_step().empty())
      std::fprintf(stderr, "%s: the time step that failed can be looked at by: scripts/replay-step %s\n", kTool,
                   failed_step_file(test.out).c_str());
  } else if (!quiet) {
    std::printf("the test ended by %s after %.1f s, at %.1f times real time; its results are in %s\n",
                ended_by_name(program.ended_by()), results.simulated_time, results.simulated_time / wall_time, out);
  }
  if (program.ended_by() == EndedBy::kUntangled)
    std::fprintf(stderr, "%s: the knot came undone: %s\n", kTool, what_keeps_a_knot(test.method).c_str());
  else if (results.untangled_at)
    std::fprintf(stderr, "%s: the knot came undone at %.1f s, while it was pulled: %s\n", kTool, *results.untangled_at,
                 what_keeps_a_knot(test.method).c_str());
  return program.failed() ? kFailed : kDone;
}

/// Leaves what `--resume` needs beside what was measured; the exit code.
int leave_for_resume(const Test& test, Writers& writers, const WallClock& clock) {
  test.program.stop();
  const Results results = write_results(test, writers, clock, true);
  const std::array<const char*, 3> go_on{kTool, "--resume", test.out.c_str()};
  std::fprintf(stderr, "%s: the test was interrupted after %.1f s; what was measured is in %s; go on with: %s\n", kTool,
               results.simulated_time, test.out.c_str(), command_line(go_on.size(), go_on.data()).c_str());
  return kFailed;
}

int run_to_end(const Test& test, JournalWriter& journal, double checkpoint_period, bool quiet) {
  TestingMachine& bench = test.bench;
  ProgramRunner& program = test.program;
  if (!test.past) test.checkpoint.remove();
  Writers writers(test.out, test.method);
  const WallClock clock(test.past ? test.past->write(writers, journal) : 0.0);
  {
    ProgressLine progress(quiet);
    Record record;
    CheckedBench checked{bench, program, journal, test.checkpoint, clock, checkpoint_period};
    run_test(
        checked, program,
        [&](const Command& command, const Sample& sample) {
          take(command, sample, bench, clock.seconds(), record);
          journal.append(record);
          writers.add(record);
          progress.show(sample, program, clock.seconds());
        },
        [] { return stop_asked != 0; });
  }
  if (!program.ended()) {
    // Before anything that takes long: a second Ctrl-C ends the program.
    if (checkpoint_period > 0.0) test.checkpoint.write(bench, program, journal.bytes());
    return leave_for_resume(test, writers, clock);
  }
  const Results results = write_results(test, writers, clock, false);
  test.checkpoint.remove();
  journal.remove();
  return tell_end(test, results, clock.seconds(), quiet);
}

/// Throws InvalidInput where there is nothing to take up. Reads nothing of a run that goes on.
void require_cut_off(const std::string& folder) {
  if (is_settled(folder))
    throw InvalidInput::sentence("--resume", folder,
                                 "cannot resume " + shown(folder) + ": its test has ended, and was not cut off");
  const LockedFile journal(journal_file(folder), O_RDONLY, 0.0);
  if (!journal.is_open() && errno == EWOULDBLOCK)
    throw InvalidInput::sentence("--resume", folder, "cannot resume " + shown(folder) + ": its test is still running");
}

/// Says where the run goes to where it goes elsewhere than asked.
ClaimedFolder folder_of_run(const Arguments& arguments, const std::string& asked, const Method& method) {
  if (!arguments.resume.empty()) return {asked, JournalWriter::go_on(asked, 0.0)};
  if (arguments.overwrite) return {asked, JournalWriter(asked, journal_header(method))};
  ClaimedFolder claimed = claim_folder(asked, journal_header(method));
  if (claimed.folder != asked)
    std::fprintf(stderr, "%s: %s (%s)\n", kTool, moved_notice(asked, claimed.folder).c_str(),
                 holds_unfinished_run(asked) ? "--resume goes on with that one" : "--overwrite writes over that one");
  return claimed;
}

int run(const Arguments& arguments) {
  const bool resumes = !arguments.resume.empty();
  if (resumes) require_cut_off(arguments.resume);
  const Method method = load_method(arguments.method, arguments.overrides);
  TestingMachine bench(method.specimen, method.material, method.machine, method.physics);
  ProgramRunner program = make_program(method, bench.longest_step());
  const std::string asked = arguments.out.empty() ? "out/" + method.name : arguments.out;
  require_no_record_in(asked, method);  // before anything is written
  std::optional<Past> past;
  if (resumes) past.emplace(asked, method, Checkpoint(asked, method_file_text(method)), bench, program);
  ClaimedFolder claimed = folder_of_run(arguments, asked, method);
  const std::string& out = claimed.folder;
  const Checkpoint checkpoint(out, method_file_text(method));
  const Test test{method, out, bench, program, checkpoint, past};
  int code = kDone;
  if (method.specimen.to_be_tied)
    for (const std::string& warning : tying_warnings(method.specimen, method.material, method.physics))
      std::fprintf(stderr, "%s: %s\n", kTool, warning.c_str());
  try {
    code = run_to_end(test, claimed.journal, arguments.checkpoint, arguments.quiet);
  } catch (const InvalidInput&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(error.what() + how_to_recover(out));
  }
  if (arguments.report) {
    write_report(out, arguments.command);
    if (!arguments.quiet) std::printf("the report is in %s/report.html and %s/report.pdf\n", out.c_str(), out.c_str());
  }
  return code;
}

/// Reads the command line; an exit code where that is all there is to do.
std::optional<int> read_arguments(int argc, char** argv, Arguments& arguments) {
  CLI::App app("Runs the whole test that a method describes, as fast as the computer can.");
  CLI::Option* method = app.add_option("METHOD", arguments.method,
                                       "the method: a YAML file, or the name of one that comes with the package");
  // One value each, so that --set may stand before METHOD too.
  CLI::Option* set = app.add_option("--set", arguments.overrides,
                                    "dotted.key=YAML, instead of what the method says; may be given more than once")
                         ->allow_extra_args(false);
  CLI::Option* out =
      app.add_option("--out", arguments.out, "the folder to write to; unless given, out/ and the method's name");
  CLI::Option* resume =
      app.add_option("--resume", arguments.resume, "the folder of a test that was cut off, which goes on");
  CLI::Option* overwrite =
      app.add_flag("--overwrite", arguments.overwrite,
                   "write over what the folder holds, instead of to the next free one, -2, -3, ...");
  resume->excludes(method)->excludes(set)->excludes(out)->excludes(overwrite);
  app.add_option("--checkpoint", arguments.checkpoint,
                 "the time between two checkpoints, of the clock on the wall [s]; 0 for none")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_flag("--quiet", arguments.quiet, "say only what went wrong");
  app.add_flag("--report", arguments.report, "also write report.html and report.pdf");
  app.add_flag_callback(
      "--list-results",
      [] {
        std::fputs(result_keys_csv().c_str(), stdout);
        throw CLI::Success();
      },
      "say which keys result.yaml has, with unit, kind and meaning, and do no more");
  const std::optional<int> code = parse(app, kTool, argc, argv, [&] {
    if (method->empty() && resume->empty()) throw CLI::RequiredError("METHOD");
  });
  if (code) return code;
  if (resume->empty()) {
    arguments.method = find_method(arguments.method);
    return std::nullopt;
  }
  arguments.method = arguments.resume + "/method.yaml";
  arguments.out = arguments.resume;
  // What stands there is of the interrupted test, and is made anew of the whole one.
  arguments.report |= std::filesystem::exists(arguments.resume + "/report.html");
  return std::nullopt;
}

}  // namespace
}  // namespace knot_utm

int main(int argc, char** argv) {
  return knot_utm::run_tool(knot_utm::kTool, [&] {
    knot_utm::Arguments arguments;
    arguments.command = knot_utm::command_line(argc, argv);
    if (const std::optional<int> code = knot_utm::read_arguments(argc, argv, arguments)) return *code;
    knot_utm::set_signals();
    try {
      return knot_utm::run(arguments);
    } catch (const knot_utm::InvalidInput& invalid) {
      throw invalid.in_file(arguments.method);
    }
  });
}
