#include "knot_utm/method/shipped.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <system_error>

#include "config_library.hpp"
#include "knot_utm/method/knot_file.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/specimen/knot_drawing.hpp"
#include "knot_utm/words/invalid_input.hpp"

namespace knot_utm {
namespace {

namespace fs = std::filesystem;

/// Where methods lie in each of the shipped folders. What else lies there, such as materials, is no method.
std::vector<std::string> folders_of_methods(const std::vector<std::string>& shipped) {
  std::vector<std::string> folders;
  for (const std::string& folder : shipped) {
    folders.push_back(folder);
    folders.push_back(folder + "/standards");
    folders.push_back(folder + "/validation");
  }
  return folders;
}

std::vector<std::string> names_of_methods(const std::vector<std::string>& shipped) {
  std::set<std::string> names;
  for (const std::string& folder : folders_of_methods(shipped))
    for (const fs::path& file : yaml_files(folder)) names.insert(file.stem().string());
  return {names.begin(), names.end()};
}

/// The first sentence of the comment at the head of a file.
std::string head_of(const fs::path& file) {
  std::ifstream lines(file);
  std::string comment;
  for (std::string line; std::getline(lines, line) && line.rfind("# ", 0) == 0;)
    comment += (comment.empty() ? "" : " ") + line.substr(2);
  // A figure behind the point, as in "Figs. 8", ends no sentence.
  for (std::size_t stop = comment.find(". "); stop != std::string::npos; stop = comment.find(". ", stop + 1))
    if (std::isupper(static_cast<unsigned char>(comment[stop + 2])) != 0) return comment.substr(0, stop + 1);
  return comment;
}

/// What lies in a subfolder of the shipped folders: names and what the files say of themselves.
std::map<std::string, std::string> shipped_in(const std::string& subfolder, const std::vector<std::string>& shipped) {
  std::map<std::string, std::string> found;
  for (const std::string& folder : shipped)
    for (const fs::path& file : yaml_files(fs::path(folder) / subfolder))
      found.emplace(file.stem().string(), head_of(file));
  return found;
}

/// Knots that the program draws itself, and those that have a file.
std::map<std::string, std::string> titles_of_knots(const std::vector<std::string>& shipped) {
  std::map<std::string, std::string> found;
  const std::vector<std::string> coded = knot_names(nullptr);
  for (std::size_t i = 0; i < coded.size(); ++i) found.emplace(coded[i], knots()[i]->about().title);
  for (const std::string& folder : shipped)
    for (const fs::path& file : yaml_files(fs::path(folder) / "knots"))
      found.emplace(file.stem().string(), read_knot_file(file, "")->title);
  return found;
}

/// What can be listed.
const std::vector<std::string> kKinds{"methods", "materials", "knots", "standards", "validation", "studies"};

std::string listing_of(const std::string& kind, const std::vector<std::string>& shipped) {
  const std::map<std::string, std::string> found =
      kind == "knots" ? titles_of_knots(shipped) : shipped_in(kind == "methods" ? "" : kind, shipped);
  std::size_t width = 0;
  for (const auto& [name, about] : found) width = std::max(width, name.size());
  std::string out;
  for (const auto& [name, about] : found) out += name + std::string(width + 2 - name.size(), ' ') + about + "\n";
  return out;
}

}  // namespace

std::string shipped_listing(const std::string& kind, const std::vector<std::string>& shipped) {
  if (std::find(kKinds.begin(), kKinds.end(), kind) != kKinds.end()) return listing_of(kind, shipped);
  if (!kind.empty()) throw InvalidInput::unknown_name("--list", kind, listed(kKinds), kKinds);
  std::string all;
  for (const std::string& one : kKinds) all += (all.empty() ? "" : "\n") + one + ":\n" + listing_of(one, shipped);
  return all;
}

std::vector<std::string> shipped_folders() {
  std::vector<std::string> folders;
  std::error_code error;
  const fs::path executable = fs::read_symlink("/proc/self/exe", error);
  if (!error)
    folders.push_back(
        fs::weakly_canonical(executable.parent_path() / ".." / ".." / "share" / "knot_utm" / "config", error));
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
