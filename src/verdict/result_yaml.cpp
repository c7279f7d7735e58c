#include "knot_utm/verdict/result_yaml.hpp"

#include <algorithm>

#include "knot_utm/numeric/yaml_lines.hpp"
#include "knot_utm/verdict/known_errors.hpp"
#include "knot_utm/verdict/result_keys.hpp"

namespace knot_utm {
namespace {

void add(const char* key, const std::optional<double>& value, YamlLines& lines) { lines.number(key, value); }
void add(const char* key, const std::optional<std::uint64_t>& value, YamlLines& lines) { lines.count(key, value); }
void add(const char* key, const std::optional<bool>& value, YamlLines& lines) { lines.flag(key, value); }
void add(const char* key, const char* value, YamlLines& lines) { lines.word(key, value); }
void add(const char* key, const std::string& value, YamlLines& lines) { lines.text(key, value); }
void add(const char* key, const std::vector<double>& value, YamlLines& lines) { lines.numbers(key, value); }
void add(const char* key, const std::vector<std::string>& value, YamlLines& lines) { lines.list(key, value); }

/// The whole file, or of it the keys that are numbers.
YamlLines lines_of(const ResultSource& source, bool only_numbers) {
  YamlLines lines;
  for (const ResultKey& key : result_keys()) {
    if (only_numbers && !key.is_number()) continue;
    std::visit([&](const auto read) { add(key.name, read(source), lines); }, key.read);
  }
  return lines;
}

}  // namespace

std::string result_yaml(const Results& results, const RunFacts& facts) {
  ResultSource source{results, facts, known_errors(results, facts), {}};
  source.verdict = verdict(facts.specification, lines_of(source, true));
  YamlLines lines = lines_of(source, false);
  lines.explain_nulls([&](const std::string& name) {
    const std::vector<ResultKey>& keys = result_keys();
    const auto key = std::find_if(keys.begin(), keys.end(), [&](const ResultKey& one) { return one.name == name; });
    return key == keys.end() ? "" : key->why_null(source);
  });
  return lines.all();
}

}  // namespace knot_utm
