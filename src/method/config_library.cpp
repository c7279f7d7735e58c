#include "config_library.hpp"

#include <yaml-cpp/depthguard.h>

#include <algorithm>
#include <boost/locale/utf.hpp>
#include <cctype>
#include <fstream>
#include <set>
#include <sstream>
#include <system_error>

#include "knot_utm/method/shipped.hpp"
#include "knot_utm/words/invalid_input.hpp"

namespace knot_utm {
namespace {

namespace fs = std::filesystem;

/// The first line, from 1 on, that is no UTF-8; 0: all are, or a byte order mark says that it is another encoding of
/// Unicode, which yaml-cpp reads.
int line_of_other_encoding(const std::string& text) {
  if (text.rfind("\xFF\xFE", 0) == 0 || text.rfind("\xFE\xFF", 0) == 0 || text.find('\0') != std::string::npos)
    return 0;
  using utf = boost::locale::utf::utf_traits<char>;
  std::istringstream lines(text);
  int number = 1;
  for (std::string line; std::getline(lines, line); ++number)
    for (auto at = line.cbegin(); at != line.cend();)
      if (utf::decode(at, line.cend()) >= boost::locale::utf::incomplete) return number;
  return 0;
}

/// Whether a document follows the first one, of which alone YAML::Load would tell. (LoadAll never ends on some faulty
/// texts.) A line that begins with --- or ... is a mark between documents wherever it stands.
bool holds_another_document(const std::string& text) {
  std::istringstream lines(text);
  bool begun = false, ended = false;
  for (std::string line; std::getline(lines, line);) {
    const auto marks = [&](const char* mark) {
      return line.rfind(mark, 0) == 0 && (line.size() == 3 || std::isspace(static_cast<unsigned char>(line[3])) != 0);
    };
    const std::size_t first = line.find_first_not_of(" \t\r");
    if (marks("...")) {
      ended = begun;
    } else if (marks("---")) {
      if (begun) return true;
      begun = true;
    } else if (first != std::string::npos && line[first] != '#' && line[0] != '%') {
      if (ended) return true;
      begun = true;
    }
  }
  return false;
}

bool comes_with_the_package(const fs::path& folder) {
  const std::vector<std::string> shipped = shipped_folders();
  return std::any_of(shipped.begin(), shipped.end(), [&](const std::string& one) {
    std::error_code error;
    return fs::equivalent(folder, one, error);
  });
}

}  // namespace

std::string yaml_fault(const YAML::Exception& fault) {
  if (dynamic_cast<const YAML::DeepRecursion*>(&fault) != nullptr) return "maps and lists are nested too deeply";
  return shown(fault.msg);
}

YAML::Node parse_yaml(const std::string& text, const std::string& file) {
  const auto refuse = [&](const std::string& why) { throw InvalidInput::sentence("file", why).in_file(file); };
  if (text.size() > kLongestText)
    refuse("the file is longer than " + std::to_string(kLongestText) +
           " characters, and no method, knot, material or load cell is");
  if (const int line = line_of_other_encoding(text); line > 0)
    refuse("line " + std::to_string(line) + ": a letter is not in UTF-8; save the file as UTF-8");
  if (holds_another_document(text))
    refuse("the file holds several YAML documents, but must be one: take away its lines \"---\"");
  try {
    return YAML::Load(text);
  } catch (const YAML::ParserException& parser) {
    const std::string place =
        "line " + std::to_string(parser.mark.line + 1) + ", column " + std::to_string(parser.mark.column + 1);
    throw InvalidInput::sentence(place, place + ": " + yaml_fault(parser)).in_file(file);
  }
}

std::string read_text(const fs::path& file) {
  std::error_code error;
  std::ifstream in;
  if (fs::is_regular_file(file, error)) in.open(file, std::ios::binary);
  if (!in.is_open()) throw InvalidInput::cannot_read(file.string());
  std::string text(kLongestText + 1, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(in.gcount()));
  return text;
}

std::vector<fs::path> yaml_files(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code error;
  for (fs::directory_iterator file(folder, error), end; !error && file != end; file.increment(error))
    if (file->path().extension() == ".yaml") found.push_back(file->path());
  return found;
}

YAML::Node read_yaml(const fs::path& file) { return parse_yaml(read_text(file), file.string()); }

ConfigLibrary::ConfigLibrary(const fs::path& method_folder) {
  std::vector<fs::path> folders{method_folder, method_folder / "config", method_folder / ".." / "config",
                                fs::current_path()};
  for (const std::string& folder : shipped_folders()) folders.emplace_back(folder);
  std::error_code error;
  for (const fs::path& folder : folders)
    if (fs::is_directory(folder, error)) folders_.push_back(folder.lexically_normal());
}

std::vector<std::string> ConfigLibrary::names(const std::string& kind) const {
  std::set<std::string> known;
  for (const fs::path& folder : folders_)
    for (const fs::path& file : yaml_files(folder / kind)) known.insert(file.stem().string());
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
