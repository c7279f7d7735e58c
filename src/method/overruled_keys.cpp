#include "overruled_keys.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>

#include "config_library.hpp"
#include "knot_utm/breaking/breaking_laws.hpp"
#include "knot_utm/contact/friction.hpp"
#include "knot_utm/rod/bending_laws.hpp"
#include "knot_utm/rod/stretching_laws.hpp"
#include "knot_utm/settings/step_settings.hpp"
#include "knot_utm/words/invalid_input.hpp"
#include "knot_utm/words/number.hpp"
#include "method_reader.hpp"

namespace knot_utm {
namespace {

namespace fs = std::filesystem;
using fields::one_line;

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

/// One of them.
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
  if (set.path.size() > kLongestPath) {
    const std::string most = std::to_string(kLongestPath) + " parts";
    throw InvalidInput::sentence(option, option + " " + shown(set.key) + ": no key of a method has more than " + most);
  }
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

namespace {

using Source = std::function<GivenBy(const std::string& key)>;

/// `section`: where the keys of the law stand, with a dot; `name`: the key that chooses it.
template <class Registry, class Number>
void drop_keys_of_former_law(const std::string& section, const std::string& name, const Source& by,
                             LawOptions<Number>& law) {
  for (const LawKey& key : Registry::keys())
    if (!Registry::entry(law.law).has(key.name) && by(section + key.name) < by(section + name))
      law.set(key.name, std::nullopt);
}

template <class Registry, class Number>
void keep_own_keys(LawOptions<Number>& law) {
  const LawEntry& chosen = Registry::entry(law.law);
  for (const LawKey& key : Registry::keys()) {
    if (!chosen.has(key.name)) law.set(key.name, std::nullopt);
    if (chosen.has(key.name) && key.otherwise == LawDefault::kPlain) law.set(key.name, law.number(key));
  }
}

void keep_own_keys(Material& material) {
  keep_own_keys<StretchingRegistry>(material.stretching);
  keep_own_keys<BendingRegistry>(material.bending);
  keep_own_keys<BreakingRegistry>(material.breaking);
}

void drop_keys_of_former_laws(const std::string& section, const Source& by, Material& material) {
  drop_keys_of_former_law<StretchingRegistry>(section, "stretching_law", by, material.stretching);
  drop_keys_of_former_law<BendingRegistry>(section, "bending_law", by, material.bending);
  drop_keys_of_former_law<BreakingRegistry>(section + "breaking.", "law", by, material.breaking);
}

void take_as_round(const std::string& key, const std::string& where, Material& material, Method& method) {
  method.overruled.push_back(key + " is soft, but must be round " + where + ": it is taken as round");
  material.section = CrossSection::kRound;
}

/// Makes a section round where a choice nearer to the user needs that.
void drop_soft_section(const std::string& section, const Source& by, Material& material, Method& method) {
  if (!material.is_soft()) return;
  const std::string key = section + "section";
  const auto nearer = [&](const std::string& other) { return by(key) < by(other); };
  const std::optional<NeedsRound> needs = needs_round(material, method.physics, section);
  if (needs && std::any_of(needs->keys.begin(), needs->keys.end(), nearer))
    take_as_round(key, needs->where, material, method);
}

/// Two ropes have sections of one kind: a soft one that only its material's file asks for is round beside a round one.
void drop_soft_beside_round(const Source& by, Material& material, Method& method) {
  if (material.is_soft() == material.other->is_soft()) return;
  const std::string key = material.is_soft() ? "material.section" : "other_material.section";
  if (by(key) != GivenBy::kOther) return;
  const auto drop = [&](Material& soft) { take_as_round(key, "beside a rope that is round", soft, method); };
  if (material.is_soft()) return drop(material);
  change_other(material, drop);
}

}  // namespace

std::optional<NeedsRound> needs_round(const Material& material, const PhysicsOptions& physics,
                                      const std::string& section) {
  const double h = material.radius,
               ratio = material.stretching_stiffness * h * h / material.bending_stiffness;  // 4 of a solid rod
  constexpr double kLeast = 2.0, kMost = 8.0;
  if (!(ratio >= kLeast && ratio <= kMost))
    return NeedsRound{"where stretching_stiffness radius^2/bending_stiffness is " + short_number(ratio) + ", not " +
                          short_number(kLeast) + " to " + short_number(kMost) + ", near the 4 of a solid rod",
                      {section + "stretching_stiffness", section + "bending_stiffness", section + "radius"}};
  if (friction_couple(material, physics) == 0.0)
    return NeedsRound{"where " + section + "friction_couple is 0 or friction.at is centreline",
                      {section + "friction_couple", "physics.friction.at"}};
  return std::nullopt;
}

std::string what_rolling_takes(const Material& material, const PhysicsOptions& physics, const std::string& section) {
  return friction_couple(material, physics) > 0.0
             ? "with a " + section + "friction_coefficient above 0"
             : "with " + section + "friction_couple above 0 and friction.at: surface";
}

void keep_own_keys(Method& method) {
  keep_own_keys<FrictionRegistry>(method.physics.friction);
  keep_own_keys(method.material);
  if (method.material.other) change_other(method.material, [](Material& other) { keep_own_keys(other); });
}

void drop_overruled_keys(const YAML::Node& given, const std::vector<std::string>& overrides, Method& method) {
  const Source by = [&](const std::string& key) { return given_by(key, given, overrides); };
  Material& material = method.material;
  drop_keys_of_former_laws("material.", by, material);
  if (material.other)
    change_other(material, [&](Material& other) { drop_keys_of_former_laws("other_material.", by, other); });
  drop_keys_of_former_law<FrictionRegistry>("physics.friction.", "law", by, method.physics.friction);
  drop_soft_section("material.", by, material, method);
  if (material.other) {
    change_other(material, [&](Material& other) { drop_soft_section("other_material.", by, other, method); });
    drop_soft_beside_round(by, material, method);
  }
  if (friction_rolls(material, method.machine, method.physics)) return;
  const auto drop_rolling = [&](const std::string& section, Material& of) {
    const GivenBy rolls = std::max({by(section + "friction_couple"), by(section + "friction_coefficient"),
                                    by("physics.friction.at"), by("machine.roller_friction")});
    for (const auto& [name, value] : {std::pair{"rolling_resistance", &of.rolling_resistance},
                                      std::pair{"rolling_hysteresis", &of.rolling_hysteresis}}) {
      const std::string key = section + name;
      if (*value == 0.0 || !(by(key) < rolls)) continue;
      method.overruled.push_back(key + " is " + format_number(*value) + ", but has an effect only " +
                                 what_rolling_takes(of, method.physics, section) + ": it is taken as 0");
      *value = 0.0;
    }
  };
  drop_rolling("material.", material);
  if (material.other) change_other(material, [&](Material& other) { drop_rolling("other_material.", other); });
}

}  // namespace knot_utm
