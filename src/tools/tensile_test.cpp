// One whole test without ROS: read the method, run it, write what came out.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <exception>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "knot_utm/io/journal.hpp"
#include "knot_utm/io/method.hpp"
#include "knot_utm/io/recovery.hpp"
#include "knot_utm/io/run_writer.hpp"
#include "knot_utm/machine/run_test.hpp"
#include "knot_utm/machine/test_bench.hpp"
#include "knot_utm/machine/test_program.hpp"
#ifdef KNOT_UTM_HAS_ROS
#include "knot_utm/ros/test_bag.hpp"
#endif

namespace knot_utm {
namespace {

enum ExitCode { kEnded = 0, kGaveUp = 1, kWrongInput = 2 };

volatile std::sig_atomic_t stop_asked = 0;

void ask_to_stop(int /*signal*/) { stop_asked = 1; }

/// The first Ctrl-C stops the test as the operator does, the second one the program.
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
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count(); }

 private:
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

  void show(const Sample& sample, const TestProgram& program, double wall_time) {
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
  bool quiet = false;
};

/// All that is kept of the bench's last answer.
void take(const Command& command, const Sample& answer, const TestBench& bench, double wall_time, Record& record) {
  const bool shape = shape_is_due(command);
  record.command = command;
  record.answer = answer;
  record.steps = bench.substeps();
  record.shape = shape ? bench.state().position : Points();
  record.tension = shape ? bench.tension() : Eigen::VectorXd();
  record.wall_time = wall_time;
}

int run_in(const std::string& out, const Method& method, TestBench& bench, JournalWriter& journal, bool quiet) {
  TestProgram program = make_program(method, bench.longest_step());
  RunWriter writer(out, method);
#ifdef KNOT_UTM_HAS_ROS
  TestBag bag(out + "/test.bag", method);
#endif
  const WallClock clock;
  {
    ProgressLine progress(quiet);
    Record record;
    run_test(bench, program, [&](const Command& command, const Sample& sample) {
      take(command, sample, bench, clock.seconds(), record);
      journal.append(record);
      writer.add(record);
#ifdef KNOT_UTM_HAS_ROS
      bag.add(record);
#endif
      if (stop_asked != 0) program.stop();
      progress.show(sample, program, clock.seconds());
    });
  }
#ifdef KNOT_UTM_HAS_ROS
  bag.close();
#endif
  RunFacts facts = writer.facts();
  facts.reason = program.reason();
  facts.wall_time = clock.seconds();
  const Results results = writer.results(program.ended_by());
  writer.finish(results, facts, bench.state().position);
  journal.remove();

  const std::string unsure = accuracy_warning(results, facts.errors);
  if (!unsure.empty()) std::fprintf(stderr, "tensile_test: %s\n", unsure.c_str());
  const bool gave_up = program.ended_by() == EndedBy::kSolver;
  if (gave_up) {
    std::fprintf(stderr, "tensile_test: the physics gave up: %s; what was measured is in %s\n",
                 program.reason().c_str(), out.c_str());
  } else if (!quiet) {
    std::printf("ended by %s after %.1f s, %.1f times real time; written to %s\n", ended_by_name(program.ended_by()),
                results.simulated_time, results.simulated_time / facts.wall_time, out.c_str());
  }
  return gave_up ? kGaveUp : kEnded;
}

int run(const Arguments& arguments) {
  const Method method = load_method(arguments.method, arguments.overrides);
  TestBench bench(method.specimen, method.material, method.machine, method.physics);
  const std::string out = arguments.out.empty() ? "out/" + method.name : arguments.out;
  JournalWriter journal(out, journal_header(method));
  try {
    return run_in(out, method, bench, journal, arguments.quiet);
  } catch (const InvalidInput&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(error.what() + how_to_recover(out));
  }
}

/// Reads the command line; an exit code where that is all there is to do.
std::optional<int> parse(int argc, char** argv, Arguments& arguments) {
  CLI::App app("Runs one whole test of a method, as fast as it goes.");
  app.set_version_flag("--version", version());
  app.add_option("METHOD", arguments.method, "the method, a YAML file")->required();
  // One value each, so that --set may stand before METHOD too.
  app.add_option("--set", arguments.overrides, "dotted.key=YAML, over what the method says; may be repeated")
      ->allow_extra_args(false);
  app.add_option("--out", arguments.out, "the folder to write to; out/ and the method's name unless given");
  app.add_flag("--quiet", arguments.quiet, "say nothing but what went wrong");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);
    std::fprintf(stderr, "tensile_test: %s\n", error.what());
    return kWrongInput;
  }
  return std::nullopt;
}

}  // namespace
}  // namespace knot_utm

int main(int argc, char** argv) {
  knot_utm::Arguments arguments;
  try {
    if (const std::optional<int> code = knot_utm::parse(argc, argv, arguments)) return *code;
    knot_utm::set_signals();
    return knot_utm::run(arguments);
  } catch (const knot_utm::InvalidInput& invalid) {
    const bool of_method = invalid.key.rfind("--", 0) != 0;
    std::fprintf(stderr, "tensile_test: %s\n", (of_method ? invalid.in_file(arguments.method) : invalid).what());
    return knot_utm::kWrongInput;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "tensile_test: %s\n", error.what());
    return knot_utm::kGaveUp;
  }
}
