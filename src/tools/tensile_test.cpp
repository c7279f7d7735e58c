// One whole test without ROS: read the method, run it, write what came out.
#include <CLI/CLI.hpp>
#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "knot_utm/method/knot_file.hpp"
#include "knot_utm/method/method_keys.hpp"
#include "knot_utm/method/shipped.hpp"
#include "knot_utm/program/phases.hpp"
#include "knot_utm/record/sample_fields.hpp"
#include "knot_utm/run/load_test.hpp"
#include "knot_utm/run/run_folder.hpp"
#include "knot_utm/run/summary.hpp"
#include "knot_utm/study/batch.hpp"
#include "knot_utm/study/headless_run.hpp"
#include "knot_utm/verdict/result_keys.hpp"
#include "knot_utm/verdict/run_warnings.hpp"
#include "knot_utm/words/invalid_input.hpp"
#include "run_python.hpp"
#include "tool.hpp"

namespace knot_utm {
namespace {

constexpr const char* kTool = "tensile_test";

void tell(const std::string& line) { std::fprintf(stderr, "%s: %s\n", kTool, line.c_str()); }

volatile std::sig_atomic_t stop_asked = 0;

void ask_to_stop(int /*signal*/) { stop_asked = 1; }

/// The first Ctrl-C interrupts the test; the second one ends the program.
void set_signals() {
  struct sigaction action {};
  action.sa_handler = ask_to_stop;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  // A file as large as is allowed is an error like a full disk, which says what was being written.
  std::signal(SIGXFSZ, SIG_IGN);
}

/// Prints what is known of a knot before it is pulled, and has Python write its picture, KNOT.png, into a folder.
/// `option`: what names the knot, for messages.
int draw_knot(const std::string& knot, const char* option, const std::string& folder, bool overwrite) {
  const KnotSheet sheet = knot_sheet(knot, option);
  const std::string file = (std::filesystem::path(folder) / (sheet.name + ".png")).string();
  require_new_file(option, file, {knot}, overwrite, "\x89PNG");
  if (!folder.empty()) make_folder(folder, "--out");
  const std::string shape = file + ".json";
  write_whole(shape, sheet.shape);
  const bool drawn = run_python("knot_utm.knot_picture", {shape, file}) == 0;
  std::filesystem::remove(shape);
  if (!drawn) return kFailed;
  std::printf("%spicture: %s\n", sheet.facts.c_str(), file.c_str());
  return kDone;
}

struct Arguments {
  std::string method;
  std::vector<std::string> overrides;
  std::string out;
  std::string resume;        // the folder of a batch; empty: a new test
  std::string from_samples;  // the folder of a run, whose results are made anew; no test
  std::string show;          // a folder, of which the main readings are printed; no test
  std::string draw;          // a knot that is drawn; no test
  std::string readings;      // the word of --readings; empty: all
  int specimens = 0;         // 0: as many as the method says
  int jobs = 0;              // 0: as many as there are processors
  bool overwrite = false;
  bool quiet = false;
  bool report = false;
  bool shapes = false;
  bool bag = false;
  bool no_cache = false;
  bool check = false;      // no test
  bool list_keys = false;  // no test
  std::string program;     // as it was called
  std::string command;     // the whole line
};

#ifdef KNOT_UTM_HAS_ROS
constexpr bool kHasBags = true;
#else
constexpr bool kHasBags = false;
#endif

std::string folder_of(const Arguments& arguments, const Method& method) {
  return arguments.out.empty() ? "out/" + method.name : arguments.out;
}

/// The main readings, and where all of them are.
void tell_summary(const std::string& folder, const char* file, const std::string& latest) {
  std::printf("%sall results are in %s/%s%s\n", run_summary(folder).c_str(), folder.c_str(), file,
              latest.empty() ? "" : (", and the folder is also " + latest).c_str());
}

/// "12.3 s".
std::string seconds(double time) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.1f s", time);
  return text.data();
}

void tell_end(const HeadlessOutcome& outcome, const Method& method, const std::string& latest, bool quiet) {
  const Results& results = outcome.results;
  if (!outcome.ended)
    return tell("the test was interrupted after " + seconds(results.simulated_time) + "; what was measured is in " +
                outcome.folder);
  if (*outcome.ended == EndedBy::kSolver)
    tell("the physics gave up: " + outcome.reason + "; what was measured until then is in " + outcome.folder);
  if (*outcome.ended == EndedBy::kBreak && outcome.failed)
    tell("the test failed: " + outcome.reason + "; its results are in " + outcome.folder);
  if (!quiet) tell_summary(outcome.folder, "result.yaml", latest);
  if (*outcome.ended == EndedBy::kUntangled)
    tell("the knot came undone: " + what_keeps_a_knot(method));
  else if (results.untangled_at && results.knot_type != KnotType::kCrossed)
    tell("the knot came undone at " + seconds(*results.untangled_at) +
         ", while it was pulled: " + what_keeps_a_knot(method));
}

/// A batch goes on with the readings that it began with.
Readings readings_of(const Arguments& arguments) {
  if (!arguments.readings.empty()) return readings_named(arguments.readings);
  const bool began_so = !arguments.resume.empty() && options_of_run(arguments.resume) == words_of(Readings::kPlateau);
  return began_so ? Readings::kPlateau : Readings::kAll;
}

template <class Options>
Options options_in(const std::string& folder, const Arguments& arguments, ProgressLine& progress) {
  Options options;
  options.folder = folder;
  options.overwrite = arguments.overwrite;
  options.shapes = arguments.shapes;
  options.cache = !arguments.no_cache;
  options.readings = readings_of(arguments);
  options.interrupted = [] { return stop_asked != 0; };
  options.notice = [&](const std::string& line) {
    progress.end();
    tell(line);
  };
  if (!arguments.quiet) options.remark = options.notice;
  return options;
}

HeadlessOutcome run_and_tell(const Arguments& arguments, const Method& method) {
  ProgressLine progress(arguments.quiet ? nullptr : stderr);
  auto options = options_in<HeadlessOptions>(folder_of(arguments, method), arguments, progress);
  options.shapes |= arguments.report;
  options.keep_shapes = arguments.bag;
  options.progress = [&](const Sample& sample, const ProgramRunner& program, double wall_time) {
    progress.show(sample, program, wall_time);
  };
  return run_headless(method, options);
}

/// Makes the bag of a test where one is asked for. Returns whether that, or nothing, was made. The libraries of ROS
/// take longer to load than a short test takes, so that another program has them.
bool write_bag(const Arguments& arguments, const std::string& folder) {
  if (!arguments.bag && !(kHasBags && arguments.report && readings_of(arguments) == Readings::kAll)) return true;
  const std::string writer = std::filesystem::absolute(program_beside("write_curve_bag")).string();
  return std::system(command_line({writer, folder, folder + "/test.bag"}).c_str()) == 0;
}

/// Makes the report where one is asked for. Returns whether that, or nothing, was made.
bool report(const Arguments& arguments, const std::string& folder) {
  if (!arguments.report) return true;
  if (!make_report(folder, arguments.command)) return false;
  if (!arguments.quiet)
    std::printf("the report is in %s/report.html and %s/report.pdf\n", folder.c_str(), folder.c_str());
  return true;
}

void tell_end(const Arguments& arguments, const BatchOutcome& outcome, int ended) {
  if (outcome.interrupted)
    return tell("the batch was interrupted when " + std::to_string(ended) + " of its " +
                std::to_string(outcome.specimens) + " specimens had been tested; what was measured is in " +
                outcome.folder + "; go on with: " + command_line({arguments.program, "--resume", outcome.folder}));
  const std::string latest = point_latest_to(outcome.folder);
  for (const Rejected& one : outcome.rejected)
    tell("specimen " + std::to_string(one.specimen) + " is rejected: " + one.reason);
  if (!arguments.quiet) tell_summary(outcome.folder, "statistics.yaml and specimens.csv", latest);
}

int run_all_specimens(const Arguments& arguments, const Method& method) {
  ProgressLine progress(arguments.quiet ? nullptr : stderr);
  auto options = options_in<BatchOptions>(folder_of(arguments, method), arguments, progress);
  options.jobs = arguments.jobs > 0 ? arguments.jobs : static_cast<int>(std::thread::hardware_concurrency());
  options.resume = !arguments.resume.empty();
  int tested = 0;
  options.progress = [&](int ended, int count) {
    tested = ended;
    progress.show(ended, count);
  };
  const BatchOutcome outcome = run_batch(method, options);
  progress.end();
  tell_end(arguments, outcome, tested);
  const bool none_counts = static_cast<int>(outcome.rejected.size()) == outcome.specimens;
  const bool done = !outcome.interrupted && report(arguments, outcome.folder) && !none_counts;
  return done ? kDone : kFailed;
}

/// All that a test is refused for, and the method with every value. One specimen alone does not scatter.
int check(const Method& method, Readings readings) {
  require_readings(method, readings);
  if (method.specimens.count == 1)
    check_fits(method);
  else
    draw_specimens(method);
  for (const std::string& warning : foreseen_warnings(method)) tell(warning);
  tell("the rod: " + rod_in_words(method.material));
  if (method.material.other) tell("the other ropes: " + rod_in_words(*method.material.other));
  std::fputs(method_yaml(method).c_str(), stdout);
  return kDone;
}

int list_keys(const Method& method) {
  std::puts("key,unit,experimental");
  for (const MethodKey& one : numbers_of(method))
    std::printf("%s,%s,%s\n", one.key.c_str(), one.unit.c_str(), one.experimental ? "yes" : "");
  return kDone;
}

int make_anew(const Arguments& arguments) {
  ProgressLine progress(nullptr);
  auto options = options_in<HeadlessOptions>(arguments.from_samples, arguments, progress);
  const HeadlessOutcome outcome = results_from_samples(options);
  if (!arguments.quiet) tell_summary(outcome.folder, "result.yaml", "");
  return write_bag(arguments, outcome.folder) && report(arguments, outcome.folder) ? kDone : kFailed;
}

/// Refuses `--resume` for a single test, as only a batch goes on where it stopped, and `--bag` for a batch.
void require_options_of(const Arguments& arguments, const Method& method) {
  const bool batch = method.specimens.count > 1;
  if (arguments.bag && batch)
    throw InvalidInput::sentence("--bag", "--bag is for one specimen, and the method has more");
  if (arguments.resume.empty() || batch) return;
  throw InvalidInput::sentence("--resume",
                               "--resume goes on with a batch, but " + shown(arguments.resume) +
                                   " holds a single test: run it anew, or make the results of what was measured by "
                                   "--from-samples");
}

int run(const Arguments& arguments) {
  if (!arguments.draw.empty()) return draw_knot(arguments.draw, "--draw", arguments.out, arguments.overwrite);
  if (!arguments.show.empty()) {
    std::fputs(run_summary(arguments.show).c_str(), stdout);
    return kDone;
  }
  if (!arguments.from_samples.empty()) return make_anew(arguments);
  readings_of(arguments);  // refuses a wrong word before it reads a method
  const Method method = load_test(arguments.method, arguments.overrides, [&](const std::string& line) {
    if (!arguments.quiet) tell(line);
  });
  require_options_of(arguments, method);
  if (arguments.check) return check(method, readings_of(arguments));
  if (arguments.list_keys) return list_keys(method);
  if (arguments.overwrite) require_no_method_in(folder_of(arguments, method), arguments.method);
  if (method.specimens.count > 1) return run_all_specimens(arguments, method);
  const HeadlessOutcome outcome = run_and_tell(arguments, method);
  tell_end(outcome, method, point_latest_to(outcome.folder), arguments.quiet);
  const bool done =
      write_bag(arguments, outcome.folder) && report(arguments, outcome.folder) && outcome.ended && !outcome.failed;
  return done ? kDone : kFailed;
}

/// --list, which prints what comes with the package, and does no more.
void add_list(CLI::App& app) {
  const auto print = [](const CLI::results_t& words) {
    std::fputs(shipped_listing(words.front() == "all" ? "" : words.front()).c_str(), stdout);
    throw CLI::Success();
    return true;
  };
  app.add_option("--list", CLI::callback_t(print),
                 "say which methods, materials, knots, standards, validation and studies come with the package, or "
                 "only those of the word that follows, and do no more")
      ->expected(0, 1)
      ->default_str("all");
}

/// An option that prints a table, and does no more.
void add_listing(CLI::App& app, const char* name, std::string (*table)(), const std::string& what) {
  const auto print = [table] {
    std::fputs(table().c_str(), stdout);
    throw CLI::Success();
  };
  app.add_flag_callback(name, print, what + ", and do no more");
}

std::string phases_csv() {
  std::string text = "name,prepares,forms,pulls,ends\n";
  for (const Phase one : all_phases()) {
    const std::optional<ProgramStep> step = step_named(phase_name(one));
    text += std::string(phase_name(one)) + (prepares(one) ? ",1" : ",0") + (forms(one) ? ",1" : ",0") +
            (pulls(one) ? ",1,\"" : ",0,\"") + (step ? (*step)->ends_when() : "") + "\"\n";
  }
  return text;
}

/// Where the method stands and where the results go, once all words are read.
void settle(Arguments& arguments) {
  if (arguments.specimens > 0) arguments.overrides.push_back("specimens.count=" + std::to_string(arguments.specimens));
  if (!arguments.show.empty() || !arguments.from_samples.empty() || !arguments.draw.empty()) return;
  if (arguments.resume.empty()) {
    arguments.method = find_method(arguments.method);
    return;
  }
  arguments.method = arguments.resume + "/method.yaml";
  arguments.out = arguments.resume;
  // What stands there is of the interrupted test, and is made anew of the whole one.
  arguments.report |= std::filesystem::exists(arguments.resume + "/report.html");
}

/// --draw, which does no test, and so does not go with `others`.
const CLI::Option* add_draw(CLI::App& app, Arguments& arguments, const std::vector<CLI::Option*>& others) {
  CLI::Option* draw = app.add_option(
      "--draw", arguments.draw,
      "only show this knot, one that comes with the package or a file: its facts, and a picture, KNOT.png, in --out or "
      "the present folder");
  for (CLI::Option* one : others) draw->excludes(one);
  return draw;
}

/// Reads the command line; an exit code where that is all there is to do.
std::optional<int> read_arguments(int argc, char** argv, Arguments& arguments) {
  CLI::App app(
      "Runs the whole test that a method describes, as fast as the computer can. Writes the curves, the result, the "
      "final shape, the samples and the method; more with --shapes, --bag and --report.");
  CLI::Option* method = app.add_option("METHOD", arguments.method,
                                       "the method: a YAML file, or the name of one that comes with the package");
  // One value each, so that --set may stand before METHOD too.
  CLI::Option* set = app.add_option("--set", arguments.overrides,
                                    "dotted.key=YAML, instead of what the method says; may be given more than once")
                         ->allow_extra_args(false);
  CLI::Option* out =
      app.add_option("--out", arguments.out, "the folder to write to; unless given, out/ and the method's name");
  CLI::Option* resume = app.add_option("--resume", arguments.resume,
                                       "test those specimens of the batch in this folder that were not tested");
  CLI::Option* overwrite =
      app.add_flag("--overwrite", arguments.overwrite,
                   "replace the run that the folder holds; else the next free folder is taken, -2, -3, ...");
  CLI::Option* specimens = app.add_option("--specimens", arguments.specimens,
                                          "how many specimens are tested, instead of what the method says")
                               ->check(CLI::Range(1, kMostSpecimens));
  app.add_option("--jobs", arguments.jobs,
                 "how many specimens are tested side by side; unless given, one for each processor")
      ->check(CLI::Range(1, kMostSpecimens));
  app.add_flag("--no-cache", arguments.no_cache,
               "tie the specimen even where an earlier test in the same folder has tied the same one, and keep none")
      ->envname("KNOT_UTM_NO_CACHE");
  CLI::Option* readings = app.add_option("--readings", arguments.readings,
                                         "plateau: end the test of a tied loop as soon as its sliding force is known");
  resume->excludes(method)->excludes(set)->excludes(out)->excludes(overwrite)->excludes(specimens)->excludes(readings);
  CLI::Option* from_samples = app.add_option(
      "--from-samples", arguments.from_samples,
      "only make the results of the run in this folder anew from its samples.csv, also where it was cut off");
  app.add_flag("--quiet", arguments.quiet, "say only what went wrong");
  app.add_flag("--report", arguments.report, "also write report.html and report.pdf");
  app.add_flag(
         "--shapes", arguments.shapes,
         "also write shapes.csv, the rod at 60 to 120 readings of the load cell; a single test with --report does")
      ->excludes(readings);
  if (kHasBags)
    app.add_flag("--bag", arguments.bag, "also write test.bag, the topics of a single test; --report does")
        ->excludes(readings);
  CLI::Option* check = app.add_flag("--check", arguments.check,
                                    "only say whether the test could be made, and print the method with every value");
  CLI::Option* list_keys = app.add_flag("--list-keys", arguments.list_keys,
                                        "only say which keys of the method are numbers, with their units");
  CLI::Option* show =
      app.add_option("--show", arguments.show, "only print the main readings of the test or batch in this folder");
  const CLI::Option* draw =
      add_draw(app, arguments, {method, set, resume, specimens, readings, from_samples, check, list_keys, show});
  for (CLI::Option* one : {check, list_keys}) one->excludes(resume);
  for (CLI::Option* one : {show, from_samples}) one->excludes(method)->excludes(resume)->excludes(readings);
  from_samples->excludes(show)->excludes(out);
  add_list(app);
  add_listing(app, "--list-results", result_keys_csv, "say which keys result.yaml has, with unit, kind and meaning");
  add_listing(app, "--list-limits", trust_limits_csv, "say up to which limits a result is trusted");
  add_listing(app, "--list-fields", sample_fields_csv, "say which fields a sample has, with type, unit and meaning");
  add_listing(app, "--list-method-keys", method_keys_csv, "say which keys methods may have, with label and unit");
  add_listing(app, "--list-knots", knots_csv, "say which knots there are, and their keys");
  add_listing(app, "--list-phases", phases_csv,
              "say which phases a test has: which prepare it, form a knot, and pull, and when they end");
  const std::optional<int> code = parse(app, kTool, argc, argv, [&] {
    if (method->empty() && resume->empty() && show->empty() && from_samples->empty() && draw->empty())
      throw CLI::RequiredError("METHOD");
  });
  if (code) return code;
  settle(arguments);
  return std::nullopt;
}

}  // namespace
}  // namespace knot_utm

int main(int argc, char** argv) {
  return knot_utm::run_tool(knot_utm::kTool, [&] {
    knot_utm::Arguments arguments;
    arguments.program = argv[0];
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
