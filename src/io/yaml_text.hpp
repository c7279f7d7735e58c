#pragma once

#include <yaml-cpp/yaml.h>

#include <cstddef>
#include <filesystem>
#include <string>

namespace knot_utm {

/// Methods, materials and load cells are a few thousand characters long.
constexpr std::size_t kLongestText = 65536;

/// What is wrong with a text that is not YAML, where the parser's own words need knowledge of YAML's grammar.
std::string yaml_fault(const YAML::Exception& fault);

/// `file` is where the text stands. Throws InvalidInput where it is longer than kLongestText or not YAML.
YAML::Node parse_yaml(const std::string& text, const std::string& file);

/// At most one character more than kLongestText. Throws InvalidInput where the file cannot be read.
std::string read_text(const std::filesystem::path& file);

YAML::Node read_yaml(const std::filesystem::path& file);

}  // namespace knot_utm
