#pragma once

#include <yaml-cpp/yaml.h>

#include <string>
#include <vector>

#include "config_library.hpp"

namespace knot_utm {

/// Puts values of `--set`, each "dotted.key=YAML", into the map of a method. A key inside a material or load cell that
/// is given by name changes a copy of it. Short paths are applied before long ones, else in the order given. Throws
/// InvalidInput where one has no place in the map.
void apply_overrides(YAML::Node root, const std::vector<std::string>& overrides, const ConfigLibrary& library);

/// What stands at the dotted key of an override; undefined where nothing does.
YAML::Node value_at(const YAML::Node& root, const std::string& key);

}  // namespace knot_utm
