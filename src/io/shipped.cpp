#include "knot_utm/io/shipped.hpp"

#include <filesystem>
#include <set>
#include <system_error>

#include "knot_utm/numeric/invalid_input.hpp"
#include "knot_utm/numeric/known_names.hpp"

namespace knot_utm {
namespace {

namespace fs = std::filesystem;

/// Where methods lie in each of the shipped folders. What else lies there, such as materials, is no method.
std::vector<std::string> folders_of_methods(const std::vector<std::string>& shipped) {
  std::vector<std::string> folders;
  for (const std::string& folder : shipped) {
    folders.push_back(folder);
    folders.push_back(folder + "/standards");
  }
  return folders;
}

std::vector<std::string> names_of_methods(const std::vector<std::string>& shipped) {
  std::set<std::string> names;
  for (const std::string& folder : folders_of_methods(shipped)) {
    std::error_code error;
    for (fs::directory_iterator file(folder, error), end; !error && file != end; file.increment(error))
      if (file->path().extension() == ".yaml") names.insert(file->path().stem().string());
  }
  return {names.begin(), names.end()};
}

}  // namespace

std::vector<std::string> shipped_folders() {
  std::vector<std::string> folders;
  std::error_code error;
  const fs::path executable = fs::read_symlink("/proc/self/exe", error);
  if (!error)
    folders.push_back((executable.parent_path() / ".." / ".." / "share" / "knot_utm" / "config").lexically_normal());
  folders.emplace_back(KNOT_UTM_CONFIG_DIR);
  return folders;
}

std::string find_method(const std::string& method, const std::string& base, const std::vector<std::string>& shipped) {
  const fs::path given = fs::path(base) / method;
  std::error_code error;
  const auto is_file = [&](const fs::path& file) { return fs::is_regular_file(file, error); };
  if (is_file(given)) return given.string();
  const bool has_folder = method.find('/') != std::string::npos;
  for (const std::string& folder : has_folder ? shipped : folders_of_methods(shipped)) {
    for (const std::string& name : {method, method + ".yaml"})
      if (const fs::path place = fs::path(folder) / name; is_file(place)) return place.string();
  }
  const bool is_name = !method.empty() && !has_folder && !fs::path(method).has_extension();
  if (is_name && !fs::exists(given, error)) {
    const std::vector<std::string> names = names_of_methods(shipped);
    throw InvalidInput::unknown_name("the method", method,
                                     "a file, or one of those that come with the package (" + listed(names, ", ") + ")",
                                     names);
  }
  return given.string();
}

}  // namespace knot_utm
