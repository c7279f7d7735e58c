#pragma once

#include <yaml-cpp/yaml.h>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace knot_utm {

/// Longest text that is read [bytes]. Methods, materials and load cells have a few thousand characters.
constexpr std::size_t kLongestText = 65536;

/// What is wrong with a text that is not YAML.
std::string yaml_fault(const YAML::Exception& fault);

/// Parses a text; `file` is the file that contains it.
YAML::Node parse_yaml(const std::string& text, const std::string& file);

/// Reads at most one character more than kLongestText.
std::string read_text(const std::filesystem::path& file);

YAML::Node read_yaml(const std::filesystem::path& file);

/// The files of a folder whose names end in .yaml; none where there is no folder.
std::vector<std::filesystem::path> yaml_files(const std::filesystem::path& folder);

/// What specimen.knot may be, for a message.
constexpr const char* kAllowedKnot = "one of the knots that tensile_test --list knots shows, or the file of one";

/// The folders in which files of materials, load cells and knots are looked for, in order. A kind is the name of a
/// subfolder, "materials", "load_cells" or "knots".
class ConfigLibrary {
 public:
  explicit ConfigLibrary(const std::filesystem::path& method_folder);

  /// The names of all files of a kind, each once and in alphabetical order.
  std::vector<std::string> names(const std::string& kind) const;

  /// What is allowed, for a message: "a name (20N, 50kN) or a map".
  std::string allowed(const std::string& kind) const;

  /// The file with this name. `key`: the key that named it, and `others`: what else it may name, for the message.
  std::filesystem::path find(const std::string& kind, const std::string& name, const std::string& key,
                             const std::vector<std::string>& others = {}) const;

 private:
  std::vector<std::filesystem::path> folders_;
};

/// Whether a file of this kind comes with the package.
bool is_shipped(const std::string& kind, const std::filesystem::path& file);

/// The map of a file, with the file's name added, so that it can be put into the method.
YAML::Node named_map(YAML::Node map, const std::filesystem::path& file);

/// The name of the method's `material`, or `other_material`; empty where the method gives none, or a map.
std::string material_name(const YAML::Node& method, const std::string& key = "material");

/// The name of the load cell that `auto`, or a missing entry, stands for: that of the material. Empty where the
/// material names no load cell.
std::optional<std::string> load_cell_name(const YAML::Node& node, const std::string& of_material);

}  // namespace knot_utm
