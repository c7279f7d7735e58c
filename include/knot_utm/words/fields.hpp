#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace knot_utm::fields {

/// The range of a number, both ends included. It is so narrow that a value given in millimetres or gigapascals is
/// noticed.
struct Range {
  double min;
  double max;
  const char* unit;        ///< "-": none
  bool only_ends = false;  ///< nothing between the two is allowed
};

/// Two numbers, the lower one first.
struct LowHigh {
  double low = 0.0, high = 0.0;
};

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// What a file says where a number may be left out.
enum class Unset { kKept, kAuto, kRefused };

/// A walk over the keys of one section of a method. To read, to write and to list keys are three walks over the same
/// list, which is a function that calls these for one key after the other.
class Fields {
 public:
  virtual ~Fields() = default;

  /// What is said of the key that comes next, on the page of the keys (doc/method.md) and in a report. `meaning`: in
  /// words, by which a report calls it; what follows a semicolon stands on the page alone; "; experimental" ends it
  /// where no shipped method uses it. `otherwise`: what it is where a method does not give it, if that is more than a
  /// value. `with`: what alone has it, knots or laws; empty: all.
  virtual Fields& says(std::string_view /*meaning*/, std::string_view /*otherwise*/ = {},
                       std::string_view /*with*/ = {}) {
    return *this;
  }

  void number(const char* key, double& value, const Range& range) { visit_number(key, value, range, Unset::kKept); }
  /// A number that may be `auto`, which stands for its default.
  void scaled_number(const char* key, double& value, const Range& range) {
    visit_number(key, value, range, Unset::kAuto);
  }
  void required_number(const char* key, double& value, const Range& range) {
    visit_number(key, value, range, Unset::kRefused);
  }
  /// `word`: what a file has for a value that is not set. `automatic`: the value that `auto` stands for, if any.
  virtual void optional_number(const char* key, std::optional<double>& value, const Range& range, const char* word,
                               std::optional<double> automatic = {}) = 0;
  template <class Integer>
  void integer(const char* key, Integer& value, Integer min, Integer max) {
    double number = static_cast<double>(value);
    visit_whole_number(key, number, static_cast<double>(min), static_cast<double>(max));
    value = static_cast<Integer>(number);
  }
  /// A number, or one of some words in place of it, the first of which is the default: an enumeration's, in its order.
  template <class Enum, class Words>
  void number_or_word(const char* key, std::optional<double>& value, const Range& range, Enum& word,
                      const Words& words) {
    std::size_t index = static_cast<std::size_t>(word);
    visit_number_or_word(key, value, range, index, {words.begin(), words.end()});
    word = static_cast<Enum>(index);
  }
  virtual void text(const char* key, std::string& value, std::size_t most_characters = kAnyLength) = 0;
  /// The name of a file, which a method gives as seen from its own folder.
  virtual void file(const char* key, std::string& value) { text(key, value); }
  virtual void flag(const char* key, bool& value) = 0;
  /// `names`: those of the enumeration, in its order.
  template <class Enum, class Names>
  void choice(const char* key, Enum& value, const Names& names) {
    std::size_t index = static_cast<std::size_t>(value);
    visit_name(key, index, {names.begin(), names.end()});
    value = static_cast<Enum>(index);
  }
  virtual void vector(const char* key, Eigen::Vector3d& value, const Range& range) = 0;
  virtual void low_high(const char* key, std::optional<LowHigh>& value, const Range& range) = 0;
  virtual void section(const char* key, const std::function<void(Fields&)>& body) = 0;

  /// Whether keys that another choice leaves without effect are walked over, too.
  virtual bool lists_all() const { return false; }

 protected:
  static constexpr std::size_t kAnyLength = std::numeric_limits<std::size_t>::max();

  virtual void visit_number(const char* key, double& value, const Range& range, Unset unset) = 0;
  virtual void visit_number_or_word(const char* key, std::optional<double>& value, const Range& range,
                                    std::size_t& index, const std::vector<std::string>& words) = 0;
  virtual void visit_whole_number(const char* key, double& value, double min, double max) = 0;
  virtual void visit_name(const char* key, std::size_t& index, const std::vector<std::string>& names) = 0;
};

}  // namespace knot_utm::fields
