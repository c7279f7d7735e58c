#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>

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
  const char* name;
  double min, max;  ///< both allowed
  const char* unit;
  LawDefault otherwise;
  double plain;  ///< value that may stand although the law does not have the key, as in older methods; NaN: none
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

}  // namespace knot_utm
