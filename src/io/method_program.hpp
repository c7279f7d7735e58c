#pragma once

#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <string>

#include "knot_utm/record/program.hpp"
#include "method_defaults.hpp"

namespace knot_utm {

/// The steps of `program`. Throws InvalidInput.
Program read_program(const YAML::Node& node, const std::string& file, const fields::Defaults& defaults);

/// Reads the course of the crosshead in the record of another test, curve.csv or raw data, which a step follows.
/// `folder` is that of the method, `follow` the step's key. Throws InvalidInput.
void read_record(const std::filesystem::path& folder, const std::string& follow, ProgramStep& step);

}  // namespace knot_utm
