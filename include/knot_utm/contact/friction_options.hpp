#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>

namespace knot_utm {

/// Number of a friction law in the registry (friction.hpp).
enum class FrictionLaw : std::size_t {};

/// By its name as in a method, which must be one of kFrictionLawNames (friction.hpp).
FrictionLaw law_named(const std::string& name);

/// `physics.friction` of a method.
struct FrictionOptions {
  FrictionLaw law{};
  std::map<std::string, double> values;  ///< of the keys that are set, in the method's units

  std::optional<double> value(const std::string& key) const {
    const auto found = values.find(key);
    return found == values.end() ? std::nullopt : std::optional<double>(found->second);
  }
  void set(const std::string& key, const std::optional<double>& value) {
    if (value)
      values[key] = *value;
    else
      values.erase(key);
  }
};

}  // namespace knot_utm
