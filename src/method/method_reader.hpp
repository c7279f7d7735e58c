#pragma once

#include <yaml-cpp/yaml.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <locale>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "knot_utm/specimen/material.hpp"
#include "knot_utm/words/invalid_input.hpp"
#include "knot_utm/words/number.hpp"
#include "method_fields.hpp"

namespace knot_utm::fields {

/// A method may give a load of its program in terms that suit every material, instead of a number of newtons: "50 %" of
/// the breaking force, or "reference_tension". Empty: the text is no such term [N]. Throws std::invalid_argument, whose
/// text says why, for a percentage where the material has no breaking force.
inline std::optional<double> load_in_terms(const std::string& text, const Material& material) {
  // The tension under which a rope is measured, d^2/8 in decanewtons for a rope of d millimetres: doc/standards.md.
  const double d = 2e3 * material.radius;
  if (text == "reference_tension") return 10.0 * d * d / 8.0;
  if (text.empty() || text.back() != '%') return std::nullopt;
  const std::string before = text.substr(0, text.size() - 1);
  const std::optional<double> percent = parse_number(before.substr(0, before.find_last_not_of(' ') + 1));
  if (!percent) return std::nullopt;
  if (!material.breaking_force)
    throw std::invalid_argument("material has no breaking_force, of which this is a percentage");
  return *percent * *material.breaking_force / 100.0;
}

/// What is allowed beside a number, for messages.
inline constexpr const char* kOrLoadTerm =
    ", a percentage of material.breaking_force, such as \"50 %\", or reference_tension";

/// Appends a YAML value to a line. Only as much is appended as a message shows, because aliases can make a value
/// endless.
inline void add_one_line(const YAML::Node& node, std::string& line) {
  constexpr std::size_t kEnough = 600;
  if (line.size() > kEnough) return;
  if (!node.IsDefined() || node.IsNull()) {
    line += "nothing";
  } else if (node.IsScalar()) {
    line += node.Scalar().empty() ? "\"\"" : shown(node.Scalar());
  } else {
    line += node.IsMap() ? "{" : "[";
    const char* comma = "";
    for (const auto& item : node) {
      if (line.size() > kEnough) return;
      line += comma;
      if (node.IsMap()) {
        add_one_line(item.first, line);
        line += ": ";
      }
      add_one_line(node.IsMap() ? item.second : item, line);
      comma = ", ";
    }
    line += node.IsMap() ? "}" : "]";
  }
}

/// A YAML value on one line, as an error message shows it.
inline std::string one_line(const YAML::Node& node) {
  std::string line;
  add_one_line(node, line);
  return line;
}

/// The same for a message about the value of a key. A text is put in quotes, so that its beginning and end can be seen.
inline std::string as_given(const YAML::Node& node) {
  if (!node.IsDefined() || node.IsNull()) return "empty";
  const bool text = node.IsScalar() && !node.Scalar().empty() && !parse_number(node.Scalar());
  return text ? "\"" + shown(node.Scalar()) + "\"" : one_line(node);
}

/// What a whole file holds. A message does not repeat the content of one that is no method.
inline std::string kind_of(const YAML::Node& node) {
  if (!node.IsDefined() || node.IsNull()) return "empty";
  return node.IsSequence() ? "a list" : node.IsMap() ? "a map" : "a text";
}

/// A bound of a range in its usual form: 100000 and 1e8, not 1e+05 and 1e+08.
inline std::string plain_number(double value) {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out << value;
  std::string text = out.str();
  const std::size_t exponent = text.find('e');
  if (exponent == std::string::npos) return text;
  return text.substr(0, exponent) + "e" + std::to_string(std::stoi(text.substr(exponent + 1)));
}

inline std::string whole_text(double value) { return std::to_string(static_cast<long long>(value)); }

/// "0.0001 to 100000".
inline std::string range_without_unit(const Range& range) {
  const std::string min = plain_number(range.min), max = plain_number(range.max);
  if (range.only_ends) return min + ", " + max;
  if (std::isinf(range.max)) return "at least " + min;
  return range.min == range.max ? min : min + " to " + max;
}

/// "0.0001 to 100000 N".
inline std::string range_text(const Range& range) {
  const bool has_unit = std::string(range.unit) != "-" && !range.only_ends;
  return range_without_unit(range) + (has_unit ? std::string(" ") + range.unit : "");
}

/// "a number from 0.0001 to 100000 (in N)".
inline std::string number_text(const Range& range) {
  if (range.min == range.max || range.only_ends) return range_text(range);
  const std::string name = range.unit, in = name.rfind("of ", 0) == 0 ? "" : "in ";
  const std::string unit = name == "-" ? "" : " (" + in + name + ")";
  if (std::isinf(range.max)) return "a number of at least " + plain_number(range.min) + unit;
  return "a number from " + plain_number(range.min) + " to " + plain_number(range.max) + unit;
}

/// Reads one map of a method. A key that the map does not have keeps its value. `finish` throws InvalidInput for keys
/// of the map that nobody has asked for.
class Reader : public Fields {
 public:
  /// `path`: dotted path of the map, empty for the top of a file. `of`: what the file describes, for messages.
  Reader(const YAML::Node& map, std::string file, std::string path, std::string of = "a method")
      : map_(map), file_(std::move(file)), path_(std::move(path)), of_(std::move(of)) {
    if (map_.IsDefined() && !map_.IsNull() && !map_.IsMap())
      throw InvalidInput(file_, path_.empty() ? "the file" : path_, path_.empty() ? kind_of(map_) : as_given(map_),
                         "a map of keys and values");
  }

  /// From now on numbers in newtons may be given in these terms.
  void understand(const Material& material) { loads_ = &material; }

  /// Notes the dotted keys of the numbers that are left to `auto`.
  void note_automatic(std::vector<std::string>& keys) { automatic_ = &keys; }

  void optional_number(const char* key, std::optional<double>& value, const Range& range, const char* word,
                       std::optional<double> automatic = {}) override {
    const YAML::Node node = take(key);
    if (!node.IsDefined()) return;
    if (automatic && is_auto(node)) {
      value = automatic;
      note(key);
    } else if (node.IsNull() || (node.IsScalar() && node.Scalar() == word)) {
      value.reset();
    } else {
      value = checked(key, node, range, word);
    }
  }

  /// The limit counts characters, not bytes.
  void text(const char* key, std::string& value, std::size_t most = kAnyLength) override {
    const YAML::Node node = take(key);
    if (!node.IsDefined()) return;
    if (!node.IsNull() && !node.IsScalar()) fail(key, node, "a text");
    value = node.IsNull() ? "" : node.Scalar();
    const auto begins = [](char c) { return (static_cast<unsigned char>(c) & 0xC0u) != 0x80u; };
    const auto characters = static_cast<std::size_t>(std::count_if(value.begin(), value.end(), begins));
    if (characters > most) fail(key, YAML::Node(value), "a text of at most " + std::to_string(most) + " characters");
  }

  void file(const char* key, std::string& value) override {
    text(key, value);
    namespace fs = std::filesystem;
    if (!value.empty()) value = fs::absolute(fs::path(file_).parent_path() / value).lexically_normal().string();
  }

  void flag(const char* key, bool& value) override {
    const YAML::Node node = take(key);
    if (!node.IsDefined()) return;
    const std::string given = node.IsScalar() ? node.Scalar() : "";
    if (given != "true" && given != "false") fail(key, node, "true or false");
    value = given == "true";
  }

  void vector(const char* key, Eigen::Vector3d& value, const Range& range) override {
    if (const auto found = list<3>(key, range, "[x, y, z]")) value = {(*found)[0], (*found)[1], (*found)[2]};
  }

  void low_high(const char* key, std::optional<LowHigh>& value, const Range& range) override {
    if (const auto found = list<2>(key, range, "[low, high] with low below high"))
      value = LowHigh{(*found)[0], (*found)[1]};
  }

  void section(const char* key, const std::function<void(Fields&)>& body) override {
    Reader inner = in(key);
    body(inner);
    inner.finish();
  }

  /// The reader of a section.
  Reader in(const char* key) {
    const YAML::Node node = take(key);
    Reader inner(node.IsDefined() ? node : YAML::Node(), file_, path_of(key), of_);
    inner.loads_ = loads_;
    inner.automatic_ = automatic_;
    return inner;
  }

  /// The YAML value of a key, for keys that need more than the functions above. Undefined where the map does not have
  /// it.
  YAML::Node take(const char* key) {
    if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.emplace_back(key);
    YAML::Node found(YAML::NodeType::Undefined);
    if (!map_.IsDefined() || !map_.IsMap()) return found;
    for (const auto& item : map_) {
      if (!item.first.IsScalar() || item.first.Scalar() != key) continue;
      if (found.IsDefined())
        throw InvalidInput::sentence(path_of(key), path_of(key) + " stands twice; give it once").in_file(file_);
      found.reset(item.second);
    }
    return found;
  }

  void finish() const {
    if (!map_.IsDefined() || !map_.IsMap()) return;
    for (const auto& item : map_) {
      const std::string key = one_line(item.first);
      if (std::find(known_.begin(), known_.end(), key) == known_.end())
        throw InvalidInput::unknown_key(path_, key, known_, of_).in_file(file_);
    }
  }

  [[noreturn]] void fail(const std::string& key, const YAML::Node& value, const std::string& allowed) const {
    throw InvalidInput(file_, path_of(key), as_given(value), allowed);
  }

 private:
  void visit_number(const char* key, double& value, const Range& range, Unset unset) override {
    const YAML::Node node = take(key);
    const bool left_out = unset == Unset::kAuto && (!node.IsDefined() || node.IsNull() || is_auto(node));
    if (left_out) return note(key);  // it stays as it is
    if (!node.IsDefined() && unset == Unset::kRefused)
      throw InvalidInput::missing(path_of(key), number_text(range)).in_file(file_);
    if (node.IsDefined()) value = checked(key, node, range, unset == Unset::kAuto ? "auto" : "");
  }

  void visit_number_or_word(const char* key, std::optional<double>& value, const Range& range, std::size_t& index,
                            const std::vector<std::string>& words) override {
    const YAML::Node node = take(key);
    if (!node.IsDefined()) return;
    const auto word = std::find(words.begin(), words.end(), node.IsScalar() ? node.Scalar() : words.front());
    const bool named = node.IsNull() || (node.IsScalar() && word != words.end());
    value = named ? std::nullopt : std::optional(checked(key, node, range, listed(words)));
    index = named ? static_cast<std::size_t>(word - words.begin()) : 0;
  }

  void visit_whole_number(const char* key, double& value, double min, double max) override {
    const YAML::Node node = take(key);
    if (!node.IsDefined()) return;
    const std::optional<double> number = number_in(node);
    if (!number || !(*number >= min && *number <= max) || *number != std::floor(*number))
      fail(key, node, "a whole number from " + whole_text(min) + " to " + whole_text(max));
    value = *number;
  }

  void visit_name(const char* key, std::size_t& index, const std::vector<std::string>& names) override {
    const YAML::Node node = take(key);
    if (!node.IsDefined()) return;
    if (!node.IsScalar()) fail(key, node, listed(names));
    const auto found = std::find(names.begin(), names.end(), node.Scalar());
    if (found == names.end())
      throw InvalidInput::unknown_name(path_of(key), node.Scalar(), listed(names), names).in_file(file_);
    index = static_cast<std::size_t>(found - names.begin());
  }

  /// The numbers of a list, of which two ascend; empty: the key is left out.
  template <std::size_t N>
  std::optional<std::array<double, N>> list(const char* key, const Range& range, const std::string& form) {
    const YAML::Node node = take(key);
    if (!node.IsDefined()) return std::nullopt;
    std::array<double, N> out{};
    bool fits = node.IsSequence() && node.size() == N;
    for (std::size_t i = 0; fits && i < N; ++i) {
      const std::optional<double> number = number_in(key, node[i], range);
      fits = number && *number >= range.min && *number <= range.max;
      if (fits) out[i] = *number;
    }
    if (!fits || (N == 2 && out[0] >= out[N - 1]))
      fail(key, node, "a list " + form + ", each " + number_text(range) + or_term(range));
    return out;
  }

  static bool is_auto(const YAML::Node& node) { return node.IsScalar() && node.Scalar() == "auto"; }

  void note(const char* key) {
    if (automatic_) automatic_->push_back(path_of(key));
  }

  std::string path_of(const std::string& key) const { return path_.empty() ? key : path_ + "." + key; }

  static std::optional<double> number_in(const YAML::Node& node) {
    return node.IsScalar() ? parse_number(node.Scalar()) : std::nullopt;
  }

  bool takes_terms(const Range& range) const { return loads_ && range.unit == std::string("N"); }

  std::string or_term(const Range& range) const { return takes_terms(range) ? kOrLoadTerm : ""; }

  std::optional<double> number_in(const char* key, const YAML::Node& node, const Range& range) const {
    if (const std::optional<double> number = number_in(node)) return number;
    if (!takes_terms(range) || !node.IsScalar()) return std::nullopt;
    try {
      return load_in_terms(node.Scalar(), *loads_);
    } catch (const std::invalid_argument& why) {
      throw InvalidInput::sentence(path_of(key), path_of(key) + ": cannot take " + as_given(node) + ": " + why.what())
          .in_file(file_);
    }
  }

  double checked(const char* key, const YAML::Node& node, const Range& range, const std::string& word) const {
    const std::optional<double> number = number_in(key, node, range);
    const std::string or_word = or_term(range) + (word.empty() ? "" : ", or " + word);
    if (!number) fail(key, node, number_text(range) + or_word);
    // Written so that not-a-number fails.
    const bool between = range.only_ends && *number != range.min && *number != range.max;
    if (between || !(*number >= range.min && *number <= range.max)) fail(key, node, range_text(range) + or_word);
    return *number;
  }

  YAML::Node map_;
  std::string file_;
  std::string path_;
  std::string of_;
  std::vector<std::string> known_;
  const Material* loads_ = nullptr;
  std::vector<std::string>* automatic_ = nullptr;
};

/// Writes the same keys, in the same order, into a map. Values that are not set are left out.
class Writer : public Fields {
 public:
  void optional_number(const char* key, std::optional<double>& value, const Range&, const char*,
                       std::optional<double> = {}) override {
    if (value) map_[key] = format_yaml_number(*value);
  }
  void text(const char* key, std::string& value, std::size_t = kAnyLength) override {
    if (!value.empty()) map_[key] = value;
  }
  void flag(const char* key, bool& value) override { map_[key] = value ? "true" : "false"; }
  void vector(const char* key, Eigen::Vector3d& value, const Range&) override {
    list(key, {value.begin(), value.end()});
  }
  void low_high(const char* key, std::optional<LowHigh>& value, const Range&) override {
    if (value) list(key, {value->low, value->high});
  }
  void section(const char* key, const std::function<void(Fields&)>& body) override {
    Writer inner;
    body(inner);
    map_[key] = inner.map();
  }

  YAML::Node map() const { return map_; }

 private:
  void visit_number(const char* key, double& value, const Range&, Unset) override {
    map_[key] = format_yaml_number(value);
  }
  void visit_number_or_word(const char* key, std::optional<double>& value, const Range&, std::size_t& index,
                            const std::vector<std::string>& words) override {
    if (value)
      map_[key] = format_yaml_number(*value);
    else if (index > 0)
      map_[key] = words[index];
  }
  void visit_whole_number(const char* key, double& value, double, double) override { map_[key] = whole_text(value); }
  void visit_name(const char* key, std::size_t& index, const std::vector<std::string>& names) override {
    map_[key] = names[index];
  }
  void list(const char* key, const std::vector<double>& values) {
    YAML::Node list;
    for (const double x : values) list.push_back(format_yaml_number(x));
    list.SetStyle(YAML::EmitterStyle::Flow);
    map_[key] = list;
  }

  YAML::Node map_{YAML::NodeType::Map};
};

}  // namespace knot_utm::fields
