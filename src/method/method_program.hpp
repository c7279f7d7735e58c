#pragma once

#include <yaml-cpp/yaml.h>

#include <string>
#include <vector>

#include "knot_utm/record/program.hpp"
#include "method_defaults.hpp"

namespace knot_utm {

/// Reads the steps of `program`, and notes the keys that are `automatic`. Throws InvalidInput.
Program read_program(const YAML::Node& node, const std::string& file, const fields::Defaults& defaults,
                     std::vector<std::string>& automatic);

}  // namespace knot_utm
