#include <algorithm>
#include <cstddef>

#include "knot_utm/words/invalid_input.hpp"
#include "method_parts.hpp"

namespace knot_utm {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> split(const std::string& path) {
  std::vector<std::string> parts(1);
  for (const char c : path) {
    if (c == '.') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

/// No key of a method has more parts.
constexpr std::size_t kLongestPath = 8;

struct Override {
  std::string key;
  std::vector<std::string> path;
  std::string text;

  /// Parsed anew each time: assigning a YAML::Node, as sorting would, changes the node behind it.
  YAML::Node value() const { return YAML::Load(text); }
};

Override parse_override(const std::string& text, const std::string& option) {
  const std::size_t equals = text.find('=');
  if (equals == 0 || equals == std::string::npos)
    throw InvalidInput::sentence(
        option, option + " \"" + shown(text) + "\" sets no key: write key=value, such as specimen.preload=20");
  Override set;
  set.key = text.substr(0, equals);
  set.path = split(set.key);
  set.text = text.substr(equals + 1);
  if (set.path.size() > kLongestPath)
    throw InvalidInput::sentence(option, option + " " + shown(set.key) + ": no key of a method has more than " +
                                             std::to_string(kLongestPath) + " parts");
  try {
    set.value();
  } catch (const YAML::Exception& yaml) {
    throw InvalidInput::sentence(option, option + " " + shown(text) + ": the value is not YAML: " + yaml_fault(yaml));
  }
  return set;
}

/// In the order in which they are applied: a whole section is put in place before single keys inside it.
std::vector<Override> in_order(const std::vector<std::string>& overrides, const std::string& option) {
  std::vector<Override> sets;
  sets.reserve(overrides.size());
  for (const std::string& text : overrides) sets.push_back(parse_override(text, option));
  std::stable_sort(sets.begin(), sets.end(),
                   [](const Override& a, const Override& b) { return a.path.size() < b.path.size(); });
  return sets;
}

/// Puts the files behind `material`, `other_material` and `machine.load_cell` in place of their names when a key inside
/// is to change.
void expand(YAML::Node root, const Override& set, const ConfigLibrary& library) {
  const std::string& key = set.path[0];
  if (set.path.size() >= 2 && (key == "material" || key == "other_material") && !material_name(root, key).empty()) {
    const fs::path file = library.find("materials", material_name(root, key), key);
    root[key] = named_map(read_yaml(file), file);
  }
  if (set.path.size() >= 3 && set.path[0] == "machine" && set.path[1] == "load_cell") {
    const YAML::Node machine = root["machine"];
    const YAML::Node cell = machine.IsDefined() && machine.IsMap() ? machine["load_cell"] : YAML::Node();
    if (cell.IsDefined() && cell.IsMap()) return;
    YAML::Node material = root["material"];
    if (!material_name(root).empty()) material = read_yaml(library.find("materials", material_name(root), "material"));
    const YAML::Node of_material = material.IsDefined() && material.IsMap() ? material["load_cell"] : YAML::Node();
    const std::optional<std::string> name =
        load_cell_name(cell, of_material.IsDefined() && of_material.IsScalar() ? of_material.Scalar() : "");
    root["machine"]["load_cell"] = YAML::Node(YAML::NodeType::Map);
    if (name) {
      const fs::path file = library.find("load_cells", *name, "machine.load_cell");
      root["machine"]["load_cell"] = named_map(read_yaml(file), file);
    }
  }
}

/// The entry of a list that a part of a path means: its number, or the name of its only step of that name.
std::optional<std::size_t> entry(const YAML::Node& list, const std::string& part) {
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (part == std::to_string(i)) return i;
    if (list[i].IsMap() && list[i][part].IsDefined()) {
      if (found) return std::nullopt;
      found = i;
    }
  }
  return found;
}

void put(YAML::Node parent, const Override& set, std::size_t depth) {
  const std::string& part = set.path[depth];
  const bool last = depth + 1 == set.path.size();
  if (parent.IsSequence()) {
    const std::optional<std::size_t> index = entry(parent, part);
    if (!index) {
      const std::string last_entry = std::to_string(parent.size() == 0 ? 0 : parent.size() - 1);
      throw InvalidInput::sentence(set.key, shown(set.key) + ": \"" + shown(part) + "\" is no single entry of " +
                                                (depth == 0 ? "the list" : shown(set.path[depth - 1])) +
                                                ": give a number from 0 to " + last_entry +
                                                ", or the name of a step that stands there once");
    }
    if (part != std::to_string(*index)) {
      put(parent[*index], set, depth);
    } else if (last) {
      parent[*index] = set.value();
    } else {
      put(parent[*index], set, depth + 1);
    }
    return;
  }
  if (!parent.IsMap() && !parent.IsNull())
    throw InvalidInput::sentence(set.key, shown(set.key) + " is no key of a method: " + shown(set.path[depth - 1]) +
                                              " is a single value and has no keys");
  if (last) {
    parent[part] = set.value();
  } else {
    if (!parent[part].IsDefined() || parent[part].IsNull()) parent[part] = YAML::Node(YAML::NodeType::Map);
    put(parent[part], set, depth + 1);
  }
}

}  // namespace

YAML::Node value_at(const YAML::Node& root, const std::string& key) {
  // Nodes are handles: assigning one would change what it stands for.
  std::vector<YAML::Node> way{root};
  const std::vector<std::string> path = split(key);
  for (std::size_t depth = 0; depth < path.size();) {
    const YAML::Node& here = way.back();
    if (here.IsSequence()) {
      const std::optional<std::size_t> index = entry(here, path[depth]);
      if (!index) return YAML::Node(YAML::NodeType::Undefined);
      if (path[depth] == std::to_string(*index)) ++depth;
      way.push_back(here[*index]);
    } else if (here.IsMap() && here[path[depth]].IsDefined()) {
      way.push_back(here[path[depth++]]);
    } else {
      return YAML::Node(YAML::NodeType::Undefined);
    }
  }
  return way.back();
}

GivenBy given_by(const std::string& key, const YAML::Node& method, const std::vector<std::string>& overrides) {
  GivenBy found = value_at(method, key).IsDefined() ? GivenBy::kMethod : GivenBy::kOther;
  for (const Override& set : in_order(overrides, "")) {
    if (set.key == key) found = GivenBy::kOverride;
    const std::string section = set.key + ".";
    if (key.rfind(section, 0) == 0)
      found = value_at(set.value(), key.substr(section.size())).IsDefined() ? GivenBy::kSection : GivenBy::kOther;
  }
  return found;
}

void apply_overrides(YAML::Node root, const std::vector<std::string>& overrides, const std::string& option,
                     const ConfigLibrary& library) {
  for (const Override& set : in_order(overrides, option)) {
    expand(root, set, library);
    put(root, set, 0);
  }
}

}  // namespace knot_utm
