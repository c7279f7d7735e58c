#pragma once

#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace knot_utm {

/// Materials and load cells as files: where they are looked for, in order. A kind is a folder, "materials" or
/// "load_cells".
class ConfigLibrary {
 public:
  explicit ConfigLibrary(const std::filesystem::path& method_folder);

  /// The names of the files of this kind, each once and in alphabetical order.
  std::vector<std::string> names(const std::string& kind) const;

  /// "a name (20N, 50kN) or a map".
  std::string allowed(const std::string& kind) const;

  /// The file of this name. `key` is what named it, for the message. Throws InvalidInput where there is none.
  std::filesystem::path find(const std::string& kind, const std::string& name, const std::string& key) const;

 private:
  void add(const std::filesystem::path& folder);

  std::vector<std::filesystem::path> folders_;
};

/// A map read from a file with the file's name in it, so that it can stand in the method.
YAML::Node named_map(const std::filesystem::path& file);

/// The material's name; empty where the method gives none or a map.
std::string material_name(const YAML::Node& method);

/// The cell's name behind `auto`, or behind no entry at all; none where the material names no cell.
std::optional<std::string> load_cell_name(const YAML::Node& node, const std::string& of_material);

}  // namespace knot_utm
