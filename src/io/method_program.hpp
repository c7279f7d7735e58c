#pragma once

#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <string>
#include <vector>

#include "knot_utm/record/program.hpp"
#include "method_defaults.hpp"

namespace knot_utm {

/// Reads the steps of `program`, and notes the keys that are `automatic`. Throws InvalidInput.
Program read_program(const YAML::Node& node, const std::string& file, const fields::Defaults& defaults,
                     std::vector<std::string>& automatic);

/// Reads the motion of the crosshead that a step follows, from the record of another test (curve.csv or raw data).
/// `folder`: that of the method. `follow`: the key of the step. Throws InvalidInput.
void read_record(const std::filesystem::path& folder, const std::string& follow, ProgramStep& step);

}  // namespace knot_utm
