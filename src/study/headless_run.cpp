#include "knot_utm/study/headless_run.hpp"

#include <yaml-cpp/yaml.h>

#include <chrono>
#include <filesystem>
#include <set>
#include <stdexcept>

#include "knot_utm/machine/run_test.hpp"
#include "knot_utm/machine/testing_machine.hpp"
#include "knot_utm/numeric/archive.hpp"
#include "knot_utm/numeric/invalid_input.hpp"
#include "knot_utm/numeric/number.hpp"
#include "knot_utm/rod/twisting.hpp"
#include "knot_utm/run/checkpoint.hpp"
#include "knot_utm/run/load_test.hpp"
#include "knot_utm/run/run_folder.hpp"
#include "knot_utm/run/samples.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/study/find_margin.hpp"
#include "knot_utm/verdict/foreseen.hpp"
#include "knot_utm/verdict/run_warnings.hpp"

namespace knot_utm {
namespace {

InvalidInput unsuited(const std::string& folder, const std::string& why) {
  return InvalidInput::sentence("--begin-with", folder, "cannot begin with " + shown(folder) + ": " + why);
}

/// All but names and notes, which change nothing.
YAML::Node values_of(const Method& method) {
  YAML::Node values = YAML::Load(method_file_text(method));
  for (const char* words : {"name", "notes"}) {
    values["material"].remove(words);
    values["machine"]["load_cell"].remove(words);
  }
  return values;
}

/// As a message shows it.
std::string value_of(const YAML::Node& map, const std::string& key) {
  const YAML::Node value = map[key];
  return value.IsDefined() ? shown(YAML::Dump(value)) : "not set";
}

std::string bytes_of(Command command) {
  Archive archive("command");
  command.state(archive);
  return archive.bytes();
}

/// A run that stopped before a step of its program, and from whose state runs of other methods begin. These must have
/// the same specimen, material, machine and physics, and their programs must give the same commands up to that step. A
/// run that begins here therefore has the same bytes as one from the beginning.
class EarlierRun {
 public:
  /// Brings machine and program, which have just been made from `method`, to the state in which the run in `folder`
  /// stopped. Throws InvalidInput (key "--begin-with") where there is no such run, where it does not suit the method,
  /// or where the new run would write over it in `out`.
  EarlierRun(const std::string& folder, const std::string& out, const Method& method, TestingMachine& bench,
             ProgramRunner& program)
      : folder_(folder) {
    std::error_code error;
    if (std::filesystem::equivalent(folder, out, error))
      throw unsuited(folder, "the run would write over it: choose another folder by --out");
    const std::string file = (std::filesystem::path(folder) / "method.yaml").string();
    if (!std::filesystem::exists(file)) throw unsuited(folder, "it holds no run");
    method_ = load_method(file);
    const Checkpoint checkpoint(folder, method_file_text(method_));
    if (!checkpoint.is_there())
      throw unsuited(folder,
                     "it has no checkpoint; make one by tensile_test --stop-before, such as --stop-before pull");
    check_method(method);
    ProgramRunner its_own = make_program(method_, bench.longest_step());
    checkpoint.load(bench, its_own);
    follow(program, its_own.last().sequence);
  }

  /// Appends every record to the samples of the new run. Returns the wall time of the earlier run [s].
  double replay(SamplesWriter& samples, EarlyEnd& early) const {
    SamplesReader earlier(folder_);
    Record record;
    while (earlier.next(record)) {
      samples.append(record);
      early.add(record);
    }
    return record.wall_time;
  }

 private:
  void check_method(const Method& method) const {
    const YAML::Node there = values_of(method_), here = values_of(method);
    for (const char* section : {"specimen", "material", "machine", "physics"}) {
      std::set<std::string> keys;
      for (const YAML::Node& map : {there[section], here[section]})
        for (const auto& item : map) keys.insert(item.first.Scalar());
      for (const std::string& key : keys) {
        const std::string its = value_of(there[section], key), own = value_of(here[section], key);
        if (its != own)
          throw unsuited(folder_, std::string(section) + "." + key + " is " + its + " there, and " + own + " here");
      }
    }
    if (knot_of(method.specimen).has("file") && read_whole(method_.specimen.file) != read_whole(method.specimen.file))
      throw unsuited(folder_, "the shape of its specimen is another one");
  }

  /// The program sees all answers once more, without any physics, and must have asked the same.
  void follow(ProgramRunner& program, std::uint64_t records) const {
    SamplesReader samples(folder_);
    Record record;
    while (samples.next(record)) {
      if (bytes_of(record.command) != bytes_of(program.last()))
        throw unsuited(folder_, "the programs differ from " + format_number(record.command.time) +
                                    " s on, before that run stopped");
      program.next(record.answer);
      if (program.ended()) throw unsuited(folder_, "this test ends before that run stopped");
    }
    if (samples.records() != records) throw unsuited(folder_, "its samples.csv is damaged");
  }

  std::string folder_;
  Method method_;
};

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
  const std::optional<EarlierRun>& earlier;  ///< what comes before is that one's
};

/// Before this command the test is to stop.
bool stops_here(const Test& test) {
  return test.options.stop_before && test.program.last().step >= *test.options.stop_before;
}

/// The files of the run in a folder, with the margin where the method asks for it and the knots slide.
MadeResults make_with_margin(const std::string& folder, const Method& method, const HeadlessOptions& options,
                             bool ran_here) {
  ResultsOptions more;
  if (options.readings == Readings::kAll) more.further = options.further;
  more.ran_here = ran_here;
  more.without_end.reason = "the test was cut off";
  if (method.analysis.margin)
    more.margin = [&](const Results& results) {
      Margin none;
      none.reason = "the knots did not slide";
      if (results.motion_pattern != MotionPattern::kSliding) return none;
      return find_margin(method, options.interrupted);
    };
  const MadeResults made = make_results(folder, method, more);
  for (const std::string& warning : printed_warnings(made.results, made.facts)) options.tell(warning);
  return made;
}

void pull(const Test& test, SamplesWriter& samples, EarlyEnd& early, const WallClock& clock) {
  Record record;
  const bool shapes = test.options.shapes && test.options.readings == Readings::kAll;
  run_test(
      test.bench, test.program,
      [&](const Command& command, const Sample& sample) {
        take(command, sample, test.bench, shapes, clock.seconds(), record);
        samples.append(record);
        early.add(record);
        early.end(test.program);
        if (test.options.progress) test.options.progress(sample, test.program, clock.seconds());
      },
      [&] { return stops_here(test) || test.options.interrupted(); });
}

HeadlessOutcome run_to_end(const Test& test) {
  SamplesWriter samples(test.folder);
  EarlyEnd early(test.method, test.options.readings);
  const WallClock clock(test.earlier ? test.earlier->replay(samples, early) : 0.0);
  pull(test, samples, early, clock);
  HeadlessOutcome out;
  out.folder = test.folder;
  if (test.program.ended()) out.ended = test.program.ended_by();
  // Before anything that takes long: a second Ctrl-C ends the program.
  if (!out.ended && stops_here(test))
    Checkpoint(test.folder, method_file_text(test.method)).write(test.bench, test.program);
  if (!out.ended) test.program.stop();
  out.reason = test.program.reason();
  out.failed = test.program.failed();
  samples.end({test.program.ended_by(), out.ended ? out.reason : kInterrupted}, test.bench.state().position);
  if (!test.bench.failed_step().empty()) {
    out.failed_step = failed_step_file(test.folder);
    write_whole(out.failed_step, test.bench.failed_step());
  }
  out.results = make_with_margin(test.folder, test.method, test.options, true).results;
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

HeadlessOutcome run_headless(const Method& given, const HeadlessOptions& options) {
  Method method = given;
  TestingMachine bench(method.specimen, method.material, method.machine, method.physics);
  ProgramRunner program = make_program(method, bench.longest_step());
  require_readings(method, options.readings);
  require_no_record_in(options.folder, method);  // before anything is written
  std::optional<EarlierRun> earlier;
  if (!options.begin_with.empty()) earlier.emplace(options.begin_with, options.folder, method, bench, program);
  const ClaimedFolder claimed = options.claim();
  begin_run_folder(claimed.path(), method, words_of(options.readings));
  // The shape that the last run left in this folder is there no longer, but for its copy.
  if (knot_of(method.specimen).has("file") && !std::filesystem::exists(method.specimen.file))
    method.specimen.file = (std::filesystem::path(claimed.path()) / "specimen.csv").string();
  const Test test{method, options, claimed.path(), bench, program, earlier};
  for (const std::string& warning : foreseen_warnings(method)) options.tell(warning);
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
  const MadeResults made = make_with_margin(folder, method, options, false);
  HeadlessOutcome out;
  out.folder = folder;
  out.results = made.results;
  return out;
}

}  // namespace knot_utm
