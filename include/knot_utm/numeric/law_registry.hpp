#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace knot_utm {

/// Where the value of a law's key comes from that a method does not give.
enum class LawDefault {
  kNone,      ///< a method must give it
  kPlain,     ///< LawKey::plain
  kAccuracy,  ///< from physics.accuracy
  kCreep,     ///< from the slowest pull, beside which a creep must be small
};

/// A number that a law takes from a method. A method gives it only with a law that has it.
struct LawKey {
  static constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

  const char* name;
  double min, max;  ///< both allowed
  const char* unit;
  LawDefault otherwise;
  double plain;  ///< value that may stand although the law does not have the key, as in older methods; kNoValue: none
  const char* meaning = "";  ///< in words, for a report and doc/method.md (Fields::says)
};

/// The keys of a law that has none.
using NoKeys = std::array<LawKey, 0>;

/// A law of one kind as a method gives it: which, and its keys. `Number`: an enumeration that counts the laws of that
/// kind in their registry (law_registry.hpp).
template <typename Number>
struct LawOptions {
  Number law{};
  std::map<std::string, double> values;  ///< of the keys that are set, in the method's units

  std::optional<double> value(const std::string& key) const {
    const auto found = values.find(key);
    return found == values.end() ? std::nullopt : std::optional<double>(found->second);
  }
  /// Where a method does not give it, its plain value.
  double number(const LawKey& key) const { return value(std::string(key.name)).value_or(key.plain); }
  void set(const std::string& key, const std::optional<double>& value) {
    if (value)
      values[key] = *value;
    else
      values.erase(key);
  }
};

/// What is known of a law by its type alone.
struct LawEntry {
  const char* name;
  const LawKey* keys;
  std::size_t key_count;
  bool studied;

  bool has(const std::string& key) const;
};

/// The keys of some laws, each once.
std::vector<LawKey> keys_of(const LawEntry* laws, std::size_t count);
/// Those of them that have a key, as a message lists them: "memory or smoothed".
std::string laws_with(const std::string& key, const LawEntry* laws, std::size_t count);

/// The laws of one kind: plain structs in a variant, numbered by their place in it. Each has
///
///     static constexpr const char* kName    is what a method calls it
///     static constexpr std::array kKeys     its own keys (LawKey), or NoKeys
///     static constexpr bool kStudied        whether the errors beside readings were studied with it
///                                           (settings/accuracy.hpp)
///     static Law of(...)                    from a method
template <typename Laws>
struct LawRegistry;

template <typename... Law>
struct LawRegistry<std::variant<Law...>> {
  using Laws = std::variant<Law...>;

  static constexpr std::size_t kCount = sizeof...(Law);
  static constexpr std::array<const char*, kCount> kNames{Law::kName...};
  static constexpr std::array<LawEntry, kCount> kEntries{
      LawEntry{Law::kName, Law::kKeys.data(), Law::kKeys.size(), Law::kStudied}...};

  /// `Number`: that of LawOptions.
  template <typename Number>
  static constexpr const LawEntry& entry(Number number) {
    return kEntries[static_cast<std::size_t>(number)];
  }
  /// The keys of all laws, each once.
  static const std::vector<LawKey>& keys() {
    static const std::vector<LawKey> all = keys_of(kEntries.data(), kCount);
    return all;
  }
  static std::string with(const std::string& key) { return laws_with(key, kEntries.data(), kCount); }

  /// The law of that number, with its parameters from `method`.
  template <typename Number, typename... Method>
  static Laws of(Number number, const Method&... method) {
    Laws out;
    std::size_t next = 0;
    static_cast<void>(((next++ == static_cast<std::size_t>(number) && (out = Law::of(method...), true)) || ...));
    return out;
  }
};

}  // namespace knot_utm
