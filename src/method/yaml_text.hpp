#pragma once

#include <yaml-cpp/yaml.h>

#include <cstddef>
#include <filesystem>
#include <string>

namespace knot_utm {

/// Longest text that is read [bytes]. Methods, materials and load cells have a few thousand characters.
constexpr std::size_t kLongestText = 65536;

/// A message for a text that is not YAML, for faults that the parser describes in terms of YAML's grammar.
std::string yaml_fault(const YAML::Exception& fault);

/// Parses a text; `file` is the file that contains it. Throws InvalidInput where the text is longer than kLongestText
/// or not YAML.
YAML::Node parse_yaml(const std::string& text, const std::string& file);

/// Reads at most one character more than kLongestText. Throws InvalidInput where the file cannot be read.
std::string read_text(const std::filesystem::path& file);

YAML::Node read_yaml(const std::filesystem::path& file);

}  // namespace knot_utm
