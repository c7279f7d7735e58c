#include "knot_utm/study/headless_run.hpp"

#include <yaml-cpp/yaml.h>

#include <chrono>
#include <exception>
#include <filesystem>
#include <stdexcept>
#include <system_error>

#include "knot_utm/numeric/archive.hpp"
#include "knot_utm/program/loading_steps.hpp"
#include "knot_utm/program/phases.hpp"
#include "knot_utm/program/preparing_steps.hpp"
#include "knot_utm/program/program_runner.hpp"
#include "knot_utm/rod/rod.hpp"
#include "knot_utm/rod/twisting.hpp"
#include "knot_utm/run/load_test.hpp"
#include "knot_utm/run/samples.hpp"
#include "knot_utm/settings/accuracy.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/specimen/knot_drawing.hpp"
#include "knot_utm/verdict/run_facts.hpp"
#include "knot_utm/verdict/run_warnings.hpp"
#include "knot_utm/words/invalid_input.hpp"
#include "knot_utm/words/number.hpp"

namespace knot_utm {
namespace {

namespace fs = std::filesystem;

constexpr const char* kKind = "tied specimen";

/// The sections of a method on which depends what the simulated machine answers.
constexpr const char* kPhysicalSections[] = {"specimen", "material", "other_material", "machine", "physics"};

/// The values of a method but its names and notes, which change nothing. A specimen's file is named as the copy in a
/// run's folder is.
YAML::Node physical_values(const Method& method) {
  YAML::Node values = YAML::Load(method_file_text(method));
  for (const char* words : {"name", "notes"}) {
    values["material"].remove(words);
    if (method.material.other) values["other_material"].remove(words);
    values["machine"]["load_cell"].remove(words);
  }
  // What a knot's file says, whatever it is called.
  if (method.specimen.drawing) values["specimen"]["knot"] = method.specimen.drawing->text;
  return values;
}

std::string bytes_of(Command command) {
  Archive archive("command");
  command.state(archive);
  return archive.bytes();
}

/// The program sees all answers without any physics. Whether it asks for them; one that does not is then unusable.
bool asks_for(const std::vector<Record>& records, ProgramRunner& program) {
  for (const Record& record : records) {
    if (bytes_of(record.command) != bytes_of(program.last())) return false;
    program.next(record.answer);
    if (program.ended()) return false;
  }
  return true;
}

/// The program that computes: its version and, for those who change it, when it was linked.
std::string code() {
  std::error_code error;
  const auto linked = fs::last_write_time("/proc/self/exe", error).time_since_epoch().count();
  return "version " + version() + " of " + std::to_string(linked) + '\n';
}

constexpr const char* kOption = "--readings";
constexpr const char* kPlateauWord = "plateau";

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
  SamplesWriter samples(test.folder, options.keep_shapes || options.writes_shapes());
  RunWriter files(test.folder, test.method, test.bench.drawn());
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

std::optional<int> step_after_tying(const Program& program) {
  bool tied = false;
  for (std::size_t i = 0; i < program.size(); ++i) {
    const Phase phase = program[i]->phase();
    if (!ends_by_itself(phase) && !rests(phase)) return tied ? std::optional<int>(static_cast<int>(i)) : std::nullopt;
    tied |= phase == Phase::kTie;
  }
  return std::nullopt;
}

std::string tied_from(const Method& method, int step, bool shapes) {
  const YAML::Node values = physical_values(method);
  std::string text = code() + (shapes ? "with shapes\n" : "without shapes\n");
  for (const char* section : kPhysicalSections)
    if (values[section]) text += std::string(section) + ":\n" + YAML::Dump(values[section]) + '\n';
  for (int i = 0; i < step; ++i) text += "step: " + YAML::Dump(values["program"][i]) + '\n';
  if (knot_of(method.specimen).has("file")) text += "shape:\n" + read_whole(method.specimen.file);
  return text;
}

std::optional<TiedSpecimen> TiedSpecimen::of(const Method& method, bool shapes, const std::string& folder) {
  const std::optional<int> step = step_after_tying(method.program);
  if (!step) return std::nullopt;
  std::string made_from = tied_from(method, *step, shapes);
  fs::path run = fs::absolute(folder).lexically_normal();
  if (!run.has_filename()) run = run.parent_path();
  const std::string name = std::to_string(std::hash<std::string>()(made_from) % kFiles);
  return TiedSpecimen((run.parent_path() / ".tied" / name).string(), *step, std::move(made_from));
}

std::optional<std::vector<Record>> TiedSpecimen::restore(const Method& method, TestingMachine& bench,
                                                         ProgramRunner& program) const {
  std::error_code error;
  // Opening anything else than a file could wait for ever.
  if (!fs::is_regular_file(file_, error)) return std::nullopt;
  bool begun = false;
  try {
    Archive archive(kKind, read_whole(file_), file_);
    std::string made_from;
    archive(made_from);
    archive.require(made_from == made_from_, "origin", "another specimen");
    std::vector<Record> records;
    archive.list(records);
    ProgramRunner followed = program;
    if (!asks_for(records, followed) || followed.last().step != step_) return std::nullopt;
    begun = true;
    archive(bench);
    archive.end();
    program = followed;
    return records;
  } catch (const std::exception&) {
    if (begun) bench = TestingMachine(method.specimen, method.material, method.machine, method.physics);
    return std::nullopt;
  }
}

void TiedSpecimen::add(const Record& record) {
  if (!kept_) records_.push_back(record);
}

void TiedSpecimen::keep(TestingMachine& bench, const ProgramRunner& program, const std::string& folder) {
  if (kept_ || program.last().step < step_) return;
  kept_ = true;
  const std::string part = (fs::path(folder) / "tied").string();
  std::error_code error;
  try {
    Archive archive(kKind);
    archive(made_from_);
    archive.list(records_);
    archive(bench);
    write_whole(part, archive.bytes());
    fs::create_directory(fs::path(file_).parent_path(), error);
    fs::rename(part, file_, error);
    if (error) fs::remove(part, error);
  } catch (const std::exception&) {  // no room for it: the test goes on without
  }
  records_ = {};
}

std::string words_of(Readings readings) {
  return readings == Readings::kPlateau ? std::string(kOption) + " " + kPlateauWord : "";
}

Readings readings_named(const std::string& word) {
  if (word != kPlateauWord) throw InvalidInput(kOption, word, kPlateauWord);
  return Readings::kPlateau;
}

void require_readings(const Method& method, Readings readings) {
  if (readings == Readings::kAll) return;
  if (method.specimen.to_be_tied && rollers_hold(method.specimen, method.machine) && has_step<PullStep>(method.program))
    return;
  throw InvalidInput::sentence(
      kOption,
      words_of(readings) +
          ": this test has no plateau, which only a loop has that is tied (step tie), held by rollers and pulled");
}

EarlyEnd::EarlyEnd(const Method& method, Readings readings) {
  if (readings == Readings::kPlateau)
    watch_.emplace(method.material.radius,
                   relative_errors(method.specimen, method.material, method.machine, method.physics).plateau_force);
}

void EarlyEnd::add(const Record& record) {
  if (!watch_ || !reason_.empty()) return;
  for (const Sample& step : record.steps) watch_->add(step);
  const Sample* reading = cell_reading(record);
  if (reading && watch_->settled_by(*reading))
    reason_ = "the plateau was settled at an extension of " + short_number(reading->extension) + " m";
}

void EarlyEnd::end(ProgramRunner& program) const {
  if (!reason_.empty()) program.plateau_settled(reason_);
}

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
  std::optional<TiedSpecimen> ties;
  if (options.cache) ties = TiedSpecimen::of(method, options.writes_shapes(), options.folder);
  std::vector<Record> before;
  if (std::optional<std::vector<Record>> restored = ties ? ties->restore(method, bench, program) : std::nullopt) {
    before = std::move(*restored);
    ties.reset();
  }
  const ClaimedFolder claimed = options.claim();
  begin_run_folder(claimed.path(), method, words_of(options.readings));
  // The shape that the last run left in this folder is there no longer, but for its copy.
  if (knot_of(method.specimen).has("file") && !fs::exists(method.specimen.file))
    method.specimen.file = (fs::path(claimed.path()) / "specimen.csv").string();
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
  if (!fs::exists(samples_file(folder)))
    throw InvalidInput::sentence("--from-samples",
                                 "there is no samples.csv in " + shown(folder) + " from which results can be made");
  const ClaimedFolder claimed(folder);
  const Method method = load_method((fs::path(folder) / "method.yaml").string());
  ResultsOptions more;
  more.ran_here = false;
  more.without_end.reason = "the test was cut off";
  if (!fs::exists(shapes_file(folder)))
    more.warnings.emplace_back("without shapes.bin (--bag, --shapes, --report) nothing is read from the rod's shape");
  const MadeResults made = make_results(folder, method, more);
  tell_warnings(made, options);
  return {folder, std::nullopt, "", false, made.results, 0.0};
}

}  // namespace knot_utm
