#pragma once

#include <yaml-cpp/yaml.h>

#include <string>
#include <vector>

#include "config_library.hpp"

namespace knot_utm {

/// Writes overrides, each "dotted.key=YAML", into the map of a method. `option`: what messages call them. A key inside
/// a material or load cell that is given by name changes a copy of it. Overrides whose keys have fewer parts are
/// applied first; others keep the order given. Throws InvalidInput where a key has no place in the map.
void apply_overrides(YAML::Node root, const std::vector<std::string>& overrides, const std::string& option,
                     const ConfigLibrary& library);

/// Who gave the value that a key has, the nearest to the user last: a material's file or nobody, the method, an
/// override of a whole section, an override of the key.
enum class GivenBy { kOther, kMethod, kSection, kOverride };

/// `method`: the map before the overrides.
GivenBy given_by(const std::string& key, const YAML::Node& method, const std::vector<std::string>& overrides);

/// The value at a dotted key; undefined where there is none.
YAML::Node value_at(const YAML::Node& root, const std::string& key);

}  // namespace knot_utm
