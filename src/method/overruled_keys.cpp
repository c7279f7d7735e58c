#include "overruled_keys.hpp"

#include <algorithm>
#include <functional>
#include <optional>

#include "knot_utm/breaking/breaking_laws.hpp"
#include "knot_utm/contact/friction.hpp"
#include "knot_utm/rod/bending_laws.hpp"
#include "knot_utm/rod/stretching_laws.hpp"
#include "knot_utm/settings/step_settings.hpp"
#include "knot_utm/words/number.hpp"
#include "method_overrides.hpp"

namespace knot_utm {
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
