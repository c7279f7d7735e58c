#include "knot_utm/study/batch.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <map>
#include <mutex>
#include <regex>
#include <set>
#include <stdexcept>
#include <thread>

#include "knot_utm/analysis/statistics.hpp"
#include "knot_utm/machine/testing_machine.hpp"
#include "knot_utm/method/method_keys.hpp"
#include "knot_utm/numeric/random.hpp"
#include "knot_utm/program/program_runner.hpp"
#include "knot_utm/run/load_test.hpp"
#include "knot_utm/run/run_folder.hpp"
#include "knot_utm/verdict/result_keys.hpp"
#include "knot_utm/verdict/run_warnings.hpp"
#include "knot_utm/words/invalid_input.hpp"
#include "knot_utm/words/number.hpp"

namespace knot_utm {
namespace {

constexpr double kFurthest = 3.0;  // standard deviations
constexpr const char* kNoise = "machine.load_cell.noise_run";

double drawn(double x0, const Scatter& scatter, std::mt19937_64 random) {
  if (scatter.law == ScatterLaw::kUniform) return x0 * (1.0 + scatter.spread * (2.0 * uniform(random) - 1.0));
  double z = standard_normal(random);
  while (std::abs(z) > kFurthest) z = standard_normal(random);
  return scatter.law == ScatterLaw::kNormal ? x0 * (1.0 + scatter.spread * z) : x0 * std::exp(scatter.spread * z);
}

/// From 1 on: 0 is the run of a method that says none.
std::uint32_t noise_run(unsigned seed, int number) {
  return static_cast<std::uint32_t>(sequence_of(seed, static_cast<std::uint64_t>(number), kNoise)() >> 33) + 1;
}

namespace fs = std::filesystem;
using Specimens = std::vector<SampledSpecimen>;

std::string file_in(const std::string& folder, const char* name) { return (fs::path(folder) / name).string(); }

std::string without_numbers(const std::string& line) {
  static const std::regex number("[-+]?[0-9][0-9.]*(e[-+]?[0-9]+)?");
  return std::regex_replace(line, number, "#");
}

/// Tests the specimens, each by the next thread that is free.
class SideBySide {
 public:
  SideBySide(const std::string& folder, const Specimens& specimens, const BatchOptions& options)
      : folder_(folder), specimens_(specimens), options_(options) {}

  void run() {
    std::vector<std::thread> threads;
    const std::size_t jobs = std::clamp<std::size_t>(static_cast<std::size_t>(options_.jobs), 1, specimens_.size());
    for (std::size_t i = 1; i < jobs; ++i) threads.emplace_back([this] { work(); });
    work();
    for (std::thread& thread : threads) thread.join();
  }

  bool interrupted() const { return ended_ < static_cast<int>(specimens_.size()); }
  /// What kept a test from being run, such as a full disk; empty: nothing did.
  const std::string& fault() const { return fault_; }

  /// What the tests said, but for what all have heard before, each line once with the specimens that it is about:
  /// "specimens 1, 2 and 5: ...". Lines that differ by their numbers alone are one.
  void tell(const std::vector<std::string>& told_before) const {
    std::set<std::string> told;
    for (const std::string& line : told_before) told.insert(without_numbers(line));
    for (const auto& [words, lines] : said_) {
      if (told.count(words) > 0) continue;
      std::vector<std::string> who;
      bool same = true;
      const auto& [first, line] = *lines.begin();
      for (const auto& [number, its_own] : lines) {
        who.push_back(std::to_string(number));
        same &= its_own == line;
      }
      const std::string of_first = same ? "" : ", with the numbers of specimen " + std::to_string(first);
      options_.tell((who.size() > 1 ? "specimens " : "specimen ") + listed(who, " and ") + of_first + ": " + line);
    }
  }

 private:
  bool stops() const { return stops_ || options_.interrupted(); }

  void work() {
    for (std::size_t i = next_++; i < specimens_.size() && !stops(); i = next_++) test(specimens_[i]);
  }

  void test(const SampledSpecimen& specimen) {
    const std::string folder = specimen_folder(folder_, specimen.number);
    std::string fault;
    bool ended = true;
    try {
      if (!has_complete_result(folder))
        ended = run_headless(specimen.method, options_of(specimen.number, folder)).ended.has_value();
    } catch (const std::exception& error) {
      fault = "specimen " + std::to_string(specimen.number) + ": " + error.what();
      stops_ = true;
    }
    const std::lock_guard<std::mutex> lock(telling_);
    if (fault_.empty()) fault_ = fault;
    if (!ended || !fault.empty()) return;
    ++ended_;
    if (options_.progress) options_.progress(ended_, static_cast<int>(specimens_.size()));
  }

  HeadlessOptions options_of(int number, const std::string& folder) {
    HeadlessOptions out;
    static_cast<RunOptions&>(out) = options_;
    out.folder = folder;
    out.overwrite = true;  // what stands there was cut off, or is an earlier batch's, which the whole one writes over
    out.interrupted = [this] { return stops(); };
    out.notice = [this, number](const std::string& line) {
      const std::lock_guard<std::mutex> lock(telling_);
      said_[without_numbers(line)].emplace(number, line);
    };
    if (options_.remark) out.remark = out.notice;
    return out;
  }

  const std::string& folder_;
  const Specimens& specimens_;
  const BatchOptions& options_;
  std::atomic<std::size_t> next_{0};
  std::atomic<bool> stops_{false};  // a test could not be run
  std::mutex telling_;
  std::map<std::string, std::map<int, std::string>> said_;  // by its words, what each specimen said
  int ended_ = 0;
  std::string fault_;
};

/// The numbers of a result that are of the specimen, and not of the computer, which differ from run to run.
std::vector<const ResultKey*> keys_of_table() {
  const std::set<std::string> of_the_computer{"wall_time", "real_time_factor", "peak_memory", "seed"};
  std::vector<const ResultKey*> out;
  for (const ResultKey& key : result_keys())
    if (key.is_number() && of_the_computer.count(key.name) == 0) out.push_back(&key);
  return out;
}

/// A specimen whose test has ended, as its result.yaml says.
struct Row {
  std::string ended_by, motion_pattern, rejected;  ///< rejected: empty where it counts
  std::vector<std::optional<double>> numbers;      ///< in the order of the table's keys
};

Row row_of(const std::string& folder, const std::vector<const ResultKey*>& keys) {
  const std::string file = file_in(folder, "result.yaml");
  YAML::Node results;
  try {
    results = YAML::Load(read_whole(file));
  } catch (const YAML::Exception& error) {
    throw std::runtime_error("cannot read " + file + ": " + error.what());
  }
  const auto word = [&](const char* key) {
    const YAML::Node value = results[key];
    return value.IsDefined() && value.IsScalar() ? value.Scalar() : std::string();
  };
  Row row{word("ended_by"), word("motion_pattern"), "", {}};
  for (const ResultKey* key : keys) row.numbers.push_back(parse_number(word(key->name)));
  const std::string reason = word("reason"), too_early = ProgramRunner::kTooEarly;
  if (row.ended_by == ended_by_name(EndedBy::kSolver))
    row.rejected = "the physics gave up: " + reason;
  else if (row.ended_by == ended_by_name(EndedBy::kUntangled))
    row.rejected = "the knot came undone before it was pulled";
  else if (row.ended_by == ended_by_name(EndedBy::kOperator))
    row.rejected = "the operator stopped the test";
  else if (reason.size() >= too_early.size() && reason.substr(reason.size() - too_early.size()) == too_early)
    row.rejected = reason;
  return row;
}

/// Row 1 holds names and row 2 units; then follows one row for each specimen.
std::string specimens_csv(const Specimens& specimens, const std::vector<Row>& rows,
                          const std::vector<const ResultKey*>& keys) {
  std::string names = "specimen", units = "-", all;
  for (const auto& [key, value] : specimens.front().drawn) {
    names += "," + key;
    units += "," + unit_of_key(specimens.front().method, key);
  }
  names += ",rejected,ended_by,motion_pattern";
  units += ",-,-,-";
  for (const ResultKey* key : keys) {
    names += std::string(",") + key->name;
    units += std::string(",") + key->unit;
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    all += std::to_string(specimens[i].number);
    for (const auto& [key, value] : specimens[i].drawn) all += "," + format_number(value);
    all += (rows[i].rejected.empty() ? ",false," : ",true,") + rows[i].ended_by + "," + rows[i].motion_pattern;
    for (const std::optional<double>& number : rows[i].numbers) all += "," + (number ? format_number(*number) : "nan");
    all += "\n";
  }
  return names + "\n" + units + "\n" + all;
}

std::string statistics_yaml(const std::vector<Row>& rows, const std::vector<Rejected>& rejected,
                            const std::vector<const ResultKey*>& keys) {
  const auto number = [](const std::optional<double>& value) { return value ? format_yaml_number(*value) : "null"; };
  std::string out = "specimens: " + std::to_string(rows.size()) + "\n";
  out += rejected.empty() ? "rejected: []\n" : "rejected:\n";
  for (const Rejected& one : rejected) {
    YAML::Emitter reason;
    reason << YAML::DoubleQuoted << one.reason;
    out += "  - {specimen: " + std::to_string(one.specimen) + ", reason: " + reason.c_str() + "}\n";
  }
  std::map<std::string, int> patterns;
  for (const Row& row : rows)
    if (row.rejected.empty()) ++patterns[row.motion_pattern];
  out += "motion_pattern: {";
  const char* comma = "";
  for (const auto& [pattern, count] : patterns) {
    out += comma + pattern + ": " + std::to_string(count);
    comma = ", ";
  }
  out += "}\n";
  for (std::size_t k = 0; k < keys.size(); ++k) {
    std::vector<double> readings;
    for (const Row& row : rows)
      if (row.rejected.empty() && row.numbers[k]) readings.push_back(*row.numbers[k]);
    const Statistics s = statistics_of(readings);
    out += std::string(keys[k]->name) + ": {mean: " + number(s.mean) + ", sd: " + number(s.sd) +
           ", cv: " + number(s.cv) + ", low: " + number(s.low) + ", high: " + number(s.high) +
           ", minimum: " + number(s.minimum) + ", maximum: " + number(s.maximum) + ", n: " + std::to_string(s.n) +
           "}\n";
  }
  return out;
}

bool is_complete(const std::string& folder, const Specimens& specimens) {
  return fs::exists(file_in(folder, "statistics.yaml")) &&
         std::all_of(specimens.begin(), specimens.end(), [&](const SampledSpecimen& specimen) {
           return has_complete_result(specimen_folder(folder, specimen.number));
         });
}

}  // namespace

void check_fits(const Method& method) {
  const TestingMachine machine(method.specimen, method.material, method.machine, method.physics);
  make_program(method, machine.longest_step());
}

SampledSpecimen draw_specimen(const Method& method, int number) {
  const SpecimensOptions& specimens = method.specimens;
  Method one = method;
  one.specimens = {};
  one.specimens.scatter.clear();
  SampledSpecimen specimen;
  specimen.number = number;
  std::vector<std::string> overrides;
  for (const Scatter& scatter : specimens.scatter) {
    const double nominal = number_at(method, scatter.key).value();
    const double value =
        drawn(nominal, scatter, sequence_of(specimens.seed, static_cast<std::uint64_t>(number), scatter.key));
    specimen.drawn.emplace_back(scatter.key, value);
    overrides.push_back(scatter.key + "=" + format_yaml_number(value));
  }
  overrides.push_back(kNoise + ("=" + std::to_string(noise_run(specimens.seed, number))));
  try {
    specimen.method = parse_method(method_yaml(one), method.name + ".yaml", overrides);
    check_fits(specimen.method);
  } catch (const InvalidInput& invalid) {
    throw InvalidInput::sentence("specimens", "specimen " + std::to_string(number) + " of " +
                                                  std::to_string(specimens.count) +
                                                  " cannot be made: " + invalid.what());
  }
  return specimen;
}

std::vector<SampledSpecimen> draw_specimens(const Method& method) {
  std::vector<SampledSpecimen> out;
  for (int number = 1; number <= method.specimens.count; ++number) out.push_back(draw_specimen(method, number));
  return out;
}

BatchOutcome run_batch(const Method& method, const BatchOptions& options) {
  const Specimens specimens = draw_specimens(method);
  if (options.resume && is_complete(options.folder, specimens))
    throw InvalidInput::sentence("--resume",
                                 "cannot resume " + shown(options.folder) + ": all of its specimens have been tested");
  require_readings(method, options.readings);
  require_no_record_in(options.folder, method);
  const ClaimedFolder claimed = options.resume ? ClaimedFolder(options.folder) : options.claim();
  std::error_code ignored;
  if (options.overwrite && !options.resume)
    for (const std::string& specimen : specimen_folders(claimed.path())) fs::remove_all(specimen, ignored);
  if (!options.resume) begin_run_folder(claimed.path(), method, words_of(options.readings));
  const std::vector<std::string> foreseen = foreseen_warnings(method);
  for (const std::string& warning : foreseen) options.tell(warning);
  SideBySide tests(claimed.path(), specimens, options);
  tests.run();
  tests.tell(foreseen);
  BatchOutcome out{claimed.path(), tests.interrupted(), static_cast<int>(specimens.size()), {}};
  if (!tests.fault().empty()) throw std::runtime_error(tests.fault());
  if (out.interrupted) return out;
  const std::vector<const ResultKey*> keys = keys_of_table();
  std::vector<Row> rows;
  for (const SampledSpecimen& specimen : specimens) {
    rows.push_back(row_of(specimen_folder(out.folder, specimen.number), keys));
    if (!rows.back().rejected.empty()) out.rejected.push_back({specimen.number, rows.back().rejected});
  }
  write_whole(file_in(out.folder, "specimens.csv"), specimens_csv(specimens, rows, keys));
  write_whole(file_in(out.folder, "statistics.yaml"), statistics_yaml(rows, out.rejected, keys));
  return out;
}

}  // namespace knot_utm
