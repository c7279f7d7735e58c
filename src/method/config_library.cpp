#include "config_library.hpp"

#include <algorithm>
#include <set>
#include <system_error>

#include "knot_utm/method/shipped.hpp"
#include "knot_utm/words/invalid_input.hpp"
#include "knot_utm/words/known_names.hpp"
#include "yaml_text.hpp"

namespace knot_utm {

namespace fs = std::filesystem;

namespace {

bool comes_with_the_package(const fs::path& folder) {
  const std::vector<std::string> shipped = shipped_folders();
  return std::any_of(shipped.begin(), shipped.end(), [&](const std::string& one) {
    std::error_code error;
    return fs::equivalent(folder, one, error);
  });
}

}  // namespace

ConfigLibrary::ConfigLibrary(const fs::path& method_folder) {
  add(method_folder);
  add(method_folder / "config");
  add(method_folder / ".." / "config");
  add(fs::current_path());
  for (const std::string& folder : shipped_folders()) add(folder);
}

std::vector<std::string> ConfigLibrary::names(const std::string& kind) const {
  std::error_code error;
  std::set<std::string> known;
  for (const fs::path& folder : folders_) {
    for (fs::directory_iterator file(folder / kind, error), end; !error && file != end; file.increment(error)) {
      if (file->path().extension() == ".yaml") known.insert(file->path().stem().string());
    }
  }
  return {known.begin(), known.end()};
}

std::string ConfigLibrary::allowed(const std::string& kind) const {
  return "a name (" + listed(names(kind), ", ") + ") or a map";
}

fs::path ConfigLibrary::find(const std::string& kind, const std::string& name, const std::string& key,
                             const std::vector<std::string>& others) const {
  std::error_code error;
  const fs::path file(name);
  for (const fs::path& folder : folders_) {
    // What lies directly in the folders that come with the package are methods.
    const bool methods = comes_with_the_package(folder) && !file.has_parent_path();
    for (const fs::path& candidate : {folder / kind / (name + ".yaml"), (methods ? folder / kind : folder) / file})
      if (!name.empty() && fs::is_regular_file(candidate, error)) return candidate;
  }
  if (file.has_parent_path() || file.extension() == ".yaml") throw InvalidInput::cannot_read(name, key);
  if (others.empty()) throw InvalidInput::unknown_name(key, name, allowed(kind), names(kind));
  std::vector<std::string> all = others;
  for (const std::string& file_name : names(kind)) all.push_back(file_name);
  throw InvalidInput::unknown_name(key, name, kAllowedKnot, all);
}

void ConfigLibrary::add(const fs::path& folder) {
  std::error_code error;
  if (fs::is_directory(folder, error)) folders_.push_back(folder.lexically_normal());
}

bool is_shipped(const std::string& kind, const fs::path& file) {
  return file.parent_path().filename() == kind && comes_with_the_package(file.parent_path().parent_path());
}

YAML::Node named_map(YAML::Node map, const fs::path& file) {
  if (map.IsMap() && !map["name"].IsDefined()) map["name"] = file.stem().string();
  return map;
}

std::string material_name(const YAML::Node& method, const std::string& key) {
  const YAML::Node node = method[key];
  return node.IsDefined() && node.IsScalar() ? node.Scalar() : "";
}

std::optional<std::string> load_cell_name(const YAML::Node& node, const std::string& of_material) {
  std::string given = node.IsDefined() && node.IsScalar() ? node.Scalar() : "auto";
  if (given != "auto") return given;
  return of_material.empty() ? std::nullopt : std::optional<std::string>(of_material);
}

}  // namespace knot_utm
