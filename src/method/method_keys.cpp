#include "knot_utm/method/method_keys.hpp"

#include <algorithm>
#include <cmath>
#include <regex>
#include <utility>

#include "method_reader.hpp"

namespace knot_utm {
namespace {

using fields::Fields;
using fields::LowHigh;
using fields::Range;
using fields::range_without_unit;
using fields::Unset;

/// The name of a key in words: "contact stiffness" of "material.contact_stiffness".
std::string words_of(const std::string& key) {
  std::string words = key.substr(key.rfind('.') + 1);
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

/// As it stands in a method, for the page of the keys.
std::string code(const std::string& text) { return "`" + text + "`"; }

std::string listed_code(std::vector<std::string> names) {
  for (std::string& name : names) name = code(name);
  return listed(names, ", ");
}

/// Keeps the keys.
class KeyWalk : public Fields {
 public:
  KeyWalk(std::string path, std::vector<MethodKey>& found) : path_(std::move(path)), found_(found) {}

  Fields& says(std::string_view meaning, std::string_view otherwise, std::string_view with) override {
    constexpr std::string_view kMark = "; experimental";
    const std::size_t end = meaning.size() - std::min(kMark.size(), meaning.size());
    said_.experimental = meaning.substr(end) == kMark;
    if (said_.experimental) meaning.remove_suffix(kMark.size());
    const std::size_t label = std::min(meaning.find("; "), meaning.size());
    said_.label = meaning.substr(0, label);
    said_.note = meaning.substr(std::min(label + 2, meaning.size()));
    said_.otherwise = otherwise;
    said_.with = with;
    return *this;
  }
  void optional_number(const char* key, std::optional<double>& value, const Range& range, const char* word,
                       std::optional<double> = {}) override {
    add_number(key, range.unit, value, code(word), range_without_unit(range));
  }
  void text(const char* key, std::string&, std::size_t most = kAnyLength) override {
    add(key, "–", most == kAnyLength ? "text" : "text, at most " + std::to_string(most) + " characters");
  }
  void file(const char* key, std::string&) override { add(key, "–", "file"); }
  void flag(const char* key, bool& value) override { add(key, code(value ? "true" : "false"), "`true`, `false`"); }
  void vector(const char* key, Eigen::Vector3d& value, const Range& range) override {
    add_list(key, {value.begin(), value.end()}, range, "[0, 0, 0]", "[x, y, z], ");
  }
  void low_high(const char* key, std::optional<LowHigh>& value, const Range& range) override {
    add_list(key, value ? Numbers{value->low, value->high} : Numbers(2), range, "`none`", "[low, high], ");
  }
  void section(const char* key, const std::function<void(Fields&)>& body) override {
    if (!said_.otherwise.empty()) add(key, "", "name or map");
    KeyWalk inner(path_ + key + ".", found_);
    body(inner);
  }
  bool lists_all() const override { return true; }

 private:
  void visit_number(const char* key, double& value, const Range& range, Unset unset) override {
    const std::string known = unset == Unset::kAuto ? code("auto") : code(format_yaml_number(value));
    add_number(key, range.unit, value, unset == Unset::kRefused ? "required" : known, range_without_unit(range));
  }
  void visit_number_or_word(const char* key, std::optional<double>& value, const Range& range, std::size_t& index,
                            const std::vector<std::string>& words) override {
    add_number(key, range.unit, value, code(words[index]), range_without_unit(range) + ", " + listed_code(words));
  }
  void visit_whole_number(const char* key, double& value, double min, double max) override {
    add_number(key, "-", value, code(format_number(value)),
               "whole, " + fields::whole_text(min) + " to " + fields::whole_text(max));
  }
  void visit_name(const char* key, std::size_t& index, const std::vector<std::string>& names) override {
    add(key, code(names[index]), listed_code(names));
  }

  using Numbers = std::vector<std::optional<double>>;
  void add_list(const std::string& key, const Numbers& values, const Range& range, const std::string& otherwise,
                const std::string& form) {
    add_number(key, range.unit, std::nullopt, otherwise, form + range_without_unit(range));
    for (std::size_t i = 0; i < values.size(); ++i)
      add_number(key + "." + std::to_string(i), range.unit, values[i], "", "");
  }
  void add_number(const std::string& key, const char* unit, std::optional<double> value, const std::string& otherwise,
                  const std::string& allowed) {
    add(key, otherwise, allowed);
    found_.back().number = true;
    found_.back().unit = unit;
    found_.back().value = value;
  }
  /// `otherwise`: what the key is where a method does not give it, unless more is said of that.
  void add(const std::string& key, const std::string& otherwise, const std::string& allowed) {
    MethodKey& row = found_.emplace_back(std::exchange(said_, {}));
    row.key = path_ + key;
    if (row.label.empty()) row.label = words_of(row.key);
    if (row.otherwise.empty())
      row.otherwise = otherwise;
    else if (otherwise == "`auto`")
      row.otherwise = otherwise + ": " + row.otherwise;
    row.allowed = allowed;
  }

  std::string path_;
  std::vector<MethodKey>& found_;
  MethodKey said_;  // of the key that comes next
};

std::vector<MethodKey> walked_keys(const Method& method) {
  Method m = method;
  std::vector<MethodKey> found;
  KeyWalk top("", found);
  fields::before_program(top, m);
  for (std::size_t i = 0; i < m.program.size(); ++i) {
    const std::string name = m.program[i]->name();
    std::vector<std::string> names{std::to_string(i) + "." + name};
    if (step_called(m.program, name)) names.push_back(name);
    for (const std::string& entry : names) {
      KeyWalk step("program." + entry + ".", found);
      m.program[i]->keys(step, 0.0);
    }
  }
  fields::behind_program(top, m);
  return found;
}

}  // namespace

std::vector<MethodKey> numbers_of(const Method& method) {
  std::vector<MethodKey> found = walked_keys(method);
  found.erase(std::remove_if(found.begin(), found.end(), [](const MethodKey& one) { return !one.number; }),
              found.end());
  return found;
}

std::vector<MethodKey> step_keys(ProgramStep step, const std::string& path) {
  std::vector<MethodKey> found;
  KeyWalk walk(path + ".", found);
  step->keys(walk, 0.0);
  return found;
}

std::string unit_of_key(const Method& method, const std::string& key) {
  for (const MethodKey& one : numbers_of(method))
    if (one.key == key) return one.unit;
  return "";
}

std::vector<MethodKey> method_keys() {
  Method any;
  any.program = all_steps();
  std::vector<MethodKey> keys = walked_keys(any);
  const std::regex number(R"((^|\.)[0-9]+(\.|$))");  // of an entry of a list, or a step
  const auto numbered = [&](const MethodKey& one) { return std::regex_search(one.key, number); };
  keys.erase(std::remove_if(keys.begin(), keys.end(), numbered), keys.end());
  const std::string specimen = "specimen.";
  for (MethodKey& one : keys) {
    if (one.key.rfind("other_", 0) == 0) one.label += " of the other ropes";
    if (one.key.rfind(specimen, 0) != 0) continue;
    const std::string name = one.key.substr(specimen.size());
    const auto has = [&](const Knot* knot) { return knot->has(name); };
    if (!std::all_of(knots().begin(), knots().end(), has)) one.with = knots_with(name);
  }
  return keys;
}

std::string method_keys_csv() {
  std::string all = "key,label,unit,experimental,note,otherwise,allowed,with\n";
  for (const MethodKey& one : method_keys())
    all += one.key + ",\"" + one.label + "\"," + one.unit + (one.experimental ? ",yes,\"" : ",,\"") + one.note +
           "\",\"" + one.otherwise + "\",\"" + one.allowed + "\",\"" + one.with + "\"\n";
  return all;
}

std::string knots_csv() {
  std::string all = "knot,title,keys\n";
  for (const Knot* knot : knots()) {
    const KnotDescription& about = knot->about();
    all += std::string(about.name) + ",\"" + about.title + "\",";
    for (const std::string& key : about.keys) all += key + " ";
    all += "edge_length\n";
  }
  return all;
}

}  // namespace knot_utm
