#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "knot_utm/breaking/breaking_laws.hpp"
#include "knot_utm/contact/friction.hpp"
#include "knot_utm/rod/bending_laws.hpp"
#include "knot_utm/rod/stretching_laws.hpp"
#include "knot_utm/settings/step_settings.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/specimen/knot_drawing.hpp"
#include "knot_utm/tying/before_tying.hpp"
#include "knot_utm/words/number.hpp"
#include "method_parts.hpp"
#include "method_reader.hpp"

// Keys that another choice leaves without effect. Who gives both in one place has them refused; where the choice is
// nearer to the user, they are taken away.
namespace knot_utm {
namespace {

/// Calls `visit` for each kind of law of a material, with its registry, the law, the section of its keys with a dot,
/// and the key that chooses it. `section`: that of the material, with a dot.
template <class AnyMaterial, class Visit>
void visit_laws(AnyMaterial& material, const std::string& section, const Visit& visit) {
  visit(StretchingRegistry(), material.stretching, section, "stretching_law");
  visit(BendingRegistry(), material.bending, section, "bending_law");
  visit(BreakingRegistry(), material.breaking, section + "breaking.", "law");
}

/// A key without effect may stand in a method only with the value that it has anyway.
template <class Value>
void has_effect(bool has, const std::string& key, const Value& value, const Value& unset, const std::string& where) {
  if (has || value == unset) return;
  std::string given;
  if constexpr (std::is_arithmetic_v<Value>) {
    given = format_number(value);
  } else {
    given = value;
  }
  throw InvalidInput::sentence(key,
                               key + " is " + shown(given) + ", but has an effect only " + where + "; leave it out");
}

/// A law has all keys that it needs, and none of another law.
template <class Registry, class Number>
void check_law(Registry, const LawOptions<Number>& given, const std::string& section, const std::string& chosen_by) {
  const LawEntry& law = Registry::entry(given.law);
  for (const LawKey& key : Registry::keys()) {
    const std::string name = section + key.name;
    const std::optional<double> value = given.value(key.name);
    const bool own = law.has(key.name);
    if (own && !value && key.otherwise == LawDefault::kNone)
      throw InvalidInput::missing(name, fields::number_text({key.min, key.max, key.unit}) + ", which " + chosen_by +
                                            ": " + law.name + " needs");
    if (value) has_effect(own, name, *value, key.plain, "with " + chosen_by + ": " + Registry::with(key.name));
  }
}

/// Softer in twist than any rod or rope: a slip of a unit, with which strands would spin in steps without end.
constexpr double kSoftestInTwist = 0.01 * (1.0 - 1e-12);  // k_t over k_b, less what rounds

/// The laws of a material have their keys, and no others. A law of breaking needs the strength of a straight rod.
void check_laws(const Material& material, const std::string& section) {
  if (const double least = kSoftestInTwist * material.bending_stiffness; material.twisting_stiffness < least)
    throw InvalidInput(section + "twisting_stiffness", format_number(material.twisting_stiffness),
                       "at least a hundredth of bending_stiffness, " + least_text(least) + " N m2");
  visit_laws(material, section, [](auto registry, const auto& law, const std::string& keys, const char* chosen_by) {
    check_law(registry, law, keys, chosen_by);
  });
  const std::string law = BreakingRegistry::entry(material.breaking.law).name;
  if (law != TensionBreaking::kName && !material.breaking_force)
    throw InvalidInput::missing(section + "breaking_force",
                                "a number of newtons, which " + section + "breaking.law: " + law + " needs");
}

/// What `rolling_resistance` of this material takes to have an effect, and lacks.
std::string what_rolling_takes(const Material& material, const PhysicsOptions& physics, const std::string& section) {
  return friction_couple(material, physics) > 0.0
             ? "with a " + section + "friction_coefficient above 0"
             : "with " + section + "friction_couple above 0 and friction.at: surface";
}

/// What resists rolling needs surfaces that rub and roll.
void check_rolling(const Method& m, const Material& material, const std::string& section) {
  const bool rolls = friction_rolls(m.material, m.machine, m.physics);
  const std::string hysteresis = section + "rolling_hysteresis",
                    where = what_rolling_takes(material, m.physics, section);
  has_effect(rolls, section + "rolling_resistance", material.rolling_resistance, 0.0, where);
  has_effect(rolls, hysteresis, material.rolling_hysteresis, 0.0, where);
  has_effect(is_solid(material), hysteresis, material.rolling_hysteresis, 0.0,
             "in a solid rod, whose stretching_stiffness says how wide its contacts are");
}

/// What a soft section of this material does not go with, and the keys that say so.
struct NeedsRound {
  std::string where;
  std::vector<std::string> keys;
};

/// A section gives where the material says how: one elastic solid, whose surfaces meet.
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

void check_section(const Method& m, const Material& material, const std::string& section) {
  if (!material.is_soft()) return;
  if (const std::optional<NeedsRound> needs = needs_round(material, m.physics, section))
    throw InvalidInput(section + "section", "soft", "round " + needs->where);
}

/// A key of `specimen` that its knot does not have is without effect. Values are compared as a message shows them.
void check_keys_of_knot(const SpecimenOptions& specimen) {
  const auto keys_of = [](SpecimenOptions of) {
    fields::Writer writer;
    fields::specimen(writer, of);
    return writer.map();
  };
  const YAML::Node given = keys_of(specimen), unset = keys_of(SpecimenOptions());
  for (const auto& item : given) {
    const std::string key = item.first.Scalar(), value = item.second.Scalar();
    const YAML::Node plain = unset[key];
    has_effect(knot_of(specimen).has(key), "specimen." + key, value, plain.IsDefined() ? plain.Scalar() : std::string(),
               "for knot: " + knots_with(key));
  }
}

using Source = std::function<GivenBy(const std::string& key)>;

/// `section`: where the keys of the law stand, with a dot; `chosen_by`: the key that chooses it.
template <class Registry, class Number>
void drop_keys_of_former_law(Registry, LawOptions<Number>& law, const std::string& section, const char* chosen_by,
                             const Source& by) {
  for (const LawKey& key : Registry::keys())
    if (!Registry::entry(law.law).has(key.name) && by(section + key.name) < by(section + chosen_by))
      law.set(key.name, std::nullopt);
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
  if (!material.other || material.is_soft() == material.other->is_soft()) return;
  const std::string key = material.is_soft() ? "material.section" : "other_material.section";
  if (by(key) != GivenBy::kOther) return;
  const auto drop = [&](Material& soft) { take_as_round(key, "beside a rope that is round", soft, method); };
  if (material.is_soft()) return drop(material);
  change_other(material, drop);
}

void drop_rolling(const std::string& section, const Source& by, Material& material, Method& method) {
  const GivenBy rolls = std::max({by(section + "friction_couple"), by(section + "friction_coefficient"),
                                  by("physics.friction.at"), by("machine.roller_friction")});
  for (const auto& [name, value] : {std::pair{"rolling_resistance", &material.rolling_resistance},
                                    std::pair{"rolling_hysteresis", &material.rolling_hysteresis}}) {
    const std::string key = section + name;
    if (*value == 0.0 || !(by(key) < rolls)) continue;
    method.overruled.push_back(key + " is " + format_number(*value) + ", but has an effect only " +
                               what_rolling_takes(material, method.physics, section) + ": it is taken as 0");
    *value = 0.0;
  }
}

}  // namespace

void check_other_material(const Method& m) {
  const bool two = m.material.other != nullptr;
  const auto rule = [](PairRule which) { return std::string(kPairRules[static_cast<std::size_t>(which)]); };
  has_effect(two, "physics.friction.pair", m.physics.pair_friction.value_or(-1.0), -1.0, "with other_material");
  has_effect(two, "physics.friction.pair", rule(m.physics.pair_rule), rule(PairRule::kSmaller), "with other_material");
  if (!two) return;
  const Material &own = m.material, &other = *m.material.other;
  has_effect(m.specimen.drawing && m.specimen.drawing->strands.size() > 1, "other_material", other.name, std::string(),
             "for a knot of two ropes or more, such as sheet_bend");
  const auto same = [](const std::string& key, const std::string& of_other, const std::string& of_own) {
    if (of_other != of_own) throw InvalidInput("other_material." + key, of_other, "that of material, " + of_own);
  };
  same("stretching_law", StretchingRegistry::entry(other.stretching.law).name,
       StretchingRegistry::entry(own.stretching.law).name);
  same("bending_law", BendingRegistry::entry(other.bending.law).name, BendingRegistry::entry(own.bending.law).name);
  same("friction_couple", format_number(default_friction_couple(other)), format_number(default_friction_couple(own)));
  const auto section_of = [](const Material& of) { return fields::kSections[static_cast<std::size_t>(of.section)]; };
  same("section", section_of(other), section_of(own));
  check_rolling(m, other, "other_material.");
  check_section(m, other, "other_material.");
  check_laws(other, "other_material.");
}

void check_effects(const Method& m) {
  const SpecimenOptions& s = m.specimen;
  check_keys_of_knot(s);
  const double automatic = default_preload(m.material);
  has_effect(preload_acts(s), "specimen.preload", s.preload.value_or(automatic), automatic,
             "on a knot whose file says by which ends it is tied (tie) or what hangs on it (weights)");

  const MachineOptions& machine = m.machine;
  const MachineOptions bare;
  const bool loop = knot_of(s).about().loop, rollers = machine.grips == GripKind::kRollers;
  has_effect(loop, "machine.roller_diameter", machine.roller_diameter, bare.roller_diameter, "for knot: " + loops());
  const Supports supports = knot_of(s).supports(s, m.material);
  has_effect(rollers || !supports.posts.empty() || !supports.pins.empty(), "machine.roller_friction",
             machine.roller_friction, bare.roller_friction,
             "with grips: rollers or knot: " + knots_with("post_diameter"));
  const bool held = machine.far_side == FarSide::kHeld;
  has_effect(rollers_hold(s, machine), "machine.far_side", std::string(held ? "held" : "free"), std::string("held"),
             "for knot: " + loops() + ", with grips: rollers");

  check_rolling(m, m.material, "material.");
  check_section(m, m.material, "material.");
  check_law(FrictionRegistry(), m.physics.friction, "physics.friction.", "law");
  check_laws(m.material, "material.");
}

void drop_overruled_keys(const YAML::Node& given, const std::vector<std::string>& overrides, Method& method) {
  const Source by = [&](const std::string& key) { return given_by(key, given, overrides); };
  const auto of_both = [&](const auto& drop) {
    drop("material.", method.material);
    change_other(method.material, [&](Material& other) { drop("other_material.", other); });
  };
  of_both([&](const std::string& section, Material& of) {
    visit_laws(of, section, [&](auto registry, auto& law, const std::string& keys, const char* chosen_by) {
      drop_keys_of_former_law(registry, law, keys, chosen_by, by);
    });
  });
  drop_keys_of_former_law(FrictionRegistry(), method.physics.friction, "physics.friction.", "law", by);
  of_both([&](const std::string& section, Material& of) { drop_soft_section(section, by, of, method); });
  drop_soft_beside_round(by, method.material, method);
  if (friction_rolls(method.material, method.machine, method.physics)) return;
  of_both([&](const std::string& section, Material& of) { drop_rolling(section, by, of, method); });
}

void keep_own_keys(Method& method) {
  const auto keep = [](auto registry, auto& law, const std::string&, const char*) {
    const LawEntry& chosen = registry.entry(law.law);
    for (const LawKey& key : registry.keys()) {
      if (!chosen.has(key.name)) law.set(key.name, std::nullopt);
      if (chosen.has(key.name) && key.otherwise == LawDefault::kPlain) law.set(key.name, law.number(key));
    }
  };
  keep(FrictionRegistry(), method.physics.friction, "", "");
  visit_laws(method.material, "", keep);
  change_other(method.material, [&](Material& other) { visit_laws(other, "", keep); });
}

}  // namespace knot_utm
