#include "knot_utm/study/batch_table.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <stdexcept>

#include "knot_utm/analysis/statistics.hpp"
#include "knot_utm/machine/program_runner.hpp"
#include "knot_utm/method/method_keys.hpp"
#include "knot_utm/numeric/number.hpp"
#include "knot_utm/run/run_folder.hpp"
#include "knot_utm/verdict/result_keys.hpp"

namespace knot_utm {

namespace {

/// What belongs to the computer and not to the specimen differs from run to run.
bool is_of_the_specimen(const ResultKey& key) {
  static const std::vector<std::string> of_the_computer{"wall_time", "real_time_factor", "peak_memory", "seed"};
  return key.is_number() &&
         std::find(of_the_computer.begin(), of_the_computer.end(), key.name) == of_the_computer.end();
}

std::vector<const ResultKey*> keys_of_table() {
  std::vector<const ResultKey*> out;
  for (const ResultKey& key : result_keys())
    if (is_of_the_specimen(key)) out.push_back(&key);
  return out;
}

YAML::Node results_in(const std::string& folder) {
  const std::string file = (std::filesystem::path(folder) / "result.yaml").string();
  try {
    return YAML::Load(read_whole(file));
  } catch (const YAML::Exception& error) {
    throw std::runtime_error("cannot read " + file + ": " + error.what());
  }
}

std::string word(const YAML::Node& results, const char* key) {
  const YAML::Node value = results[key];
  return value.IsDefined() && value.IsScalar() ? value.Scalar() : "";
}

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

std::string why_rejected(const YAML::Node& results) {
  const std::string ended_by = word(results, "ended_by"), reason = word(results, "reason");
  if (ended_by == ended_by_name(EndedBy::kSolver)) return "the physics gave up: " + reason;
  if (ended_by == ended_by_name(EndedBy::kUntangled)) return "the knot came undone before it was pulled";
  if (ended_by == ended_by_name(EndedBy::kOperator)) return "the operator stopped the test";
  return ends_with(reason, ProgramRunner::kTooEarly) ? reason : "";
}

std::string csv_number(const std::optional<double>& value) { return value ? format_number(*value) : "nan"; }

}  // namespace

void BatchTable::add(const DrawnSpecimen& specimen) {
  const YAML::Node results = results_in(specimen_folder(folder_, specimen.number));
  Row row{specimen.number, {}, true, word(results, "ended_by"), word(results, "motion_pattern"), {}};
  drawn_keys_.clear();
  for (const auto& [key, value] : specimen.drawn) {
    drawn_keys_.emplace_back(key, unit_of_key(specimen.method, key));
    row.drawn.push_back(value);
  }
  for (const ResultKey* key : keys_of_table()) row.numbers.push_back(parse_number(word(results, key->name)));
  const std::string why = why_rejected(results);
  row.counts = why.empty();
  if (!row.counts) rejected_.push_back({specimen.number, why});
  rows_.push_back(std::move(row));
}

void BatchTable::write() const {
  write_whole((std::filesystem::path(folder_) / "specimens.csv").string(), csv());
  write_whole(statistics_file(folder_), statistics());
}

std::string BatchTable::csv() const {
  std::string names = "specimen", units = "-", all;
  for (const auto& [key, unit] : drawn_keys_) {
    names += "," + key;
    units += "," + unit;
  }
  names += ",rejected,ended_by,motion_pattern";
  units += ",-,-,-";
  for (const ResultKey* key : keys_of_table()) {
    names += std::string(",") + key->name;
    units += std::string(",") + key->unit;
  }
  all = names + "\n" + units + "\n";
  for (const Row& row : rows_) {
    all += std::to_string(row.specimen);
    for (const double value : row.drawn) all += "," + format_number(value);
    all += std::string(row.counts ? ",false," : ",true,") + row.ended_by + "," + row.motion_pattern;
    for (const std::optional<double>& number : row.numbers) all += "," + csv_number(number);
    all += "\n";
  }
  return all;
}

std::string BatchTable::statistics() const {
  const auto number = [](const std::optional<double>& value) { return value ? format_yaml_number(*value) : "null"; };
  std::string out = "specimens: " + std::to_string(rows_.size()) + "\n";
  out += rejected_.empty() ? "rejected: []\n" : "rejected:\n";
  for (const Rejected& one : rejected_) {
    YAML::Emitter reason;
    reason << YAML::DoubleQuoted << one.reason;
    out += "  - {specimen: " + std::to_string(one.specimen) + ", reason: " + reason.c_str() + "}\n";
  }
  std::map<std::string, int> patterns;
  for (const Row& row : rows_)
    if (row.counts) ++patterns[row.motion_pattern];
  out += "motion_pattern: {";
  const char* comma = "";
  for (const auto& [pattern, count] : patterns) {
    out += comma + pattern + ": " + std::to_string(count);
    comma = ", ";
  }
  out += "}\n";
  const std::vector<const ResultKey*> keys = keys_of_table();
  for (std::size_t k = 0; k < keys.size(); ++k) {
    std::vector<double> readings;
    for (const Row& row : rows_)
      if (row.counts && row.numbers[k]) readings.push_back(*row.numbers[k]);
    const Statistics s = statistics_of(readings);
    out += std::string(keys[k]->name) + ": {mean: " + number(s.mean) + ", sd: " + number(s.sd) +
           ", cv: " + number(s.cv) + ", low: " + number(s.low) + ", high: " + number(s.high) +
           ", minimum: " + number(s.minimum) + ", maximum: " + number(s.maximum) + ", n: " + std::to_string(s.n) +
           "}\n";
  }
  return out;
}

std::string statistics_file(const std::string& folder) {
  return (std::filesystem::path(folder) / "statistics.yaml").string();
}

}  // namespace knot_utm
