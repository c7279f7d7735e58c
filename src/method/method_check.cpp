#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <type_traits>

#include "knot_utm/breaking/breaking_laws.hpp"
#include "knot_utm/grips/grips.hpp"
#include "knot_utm/method/method.hpp"
#include "knot_utm/method/method_keys.hpp"
#include "knot_utm/program/loading_steps.hpp"
#include "knot_utm/program/phases.hpp"
#include "knot_utm/rod/bending_laws.hpp"
#include "knot_utm/rod/stretching_laws.hpp"
#include "knot_utm/settings/step_settings.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/specimen/knot_drawing.hpp"
#include "knot_utm/tying/before_tying.hpp"
#include "knot_utm/words/number.hpp"
#include "method_reader.hpp"
#include "overruled_keys.hpp"
#include "specimens_section.hpp"

namespace knot_utm {
namespace {

[[noreturn]] void reject(const std::string& key, double value, const std::string& allowed) {
  throw InvalidInput(key, format_number(value), allowed);
}

/// A key that another choice leaves without effect may stand in a method only with the value that it has anyway.
template <class Value>
void has_effect(bool has, const char* key, const Value& value, const Value& unset, const std::string& where) {
  if (has || value == unset) return;
  std::string given;
  if constexpr (std::is_arithmetic_v<Value>) {
    given = format_number(value);
  } else {
    given = value;
  }
  throw InvalidInput::sentence(
      key, std::string(key) + " is " + shown(given) + ", but has an effect only " + where + "; leave it out");
}

/// A law has all keys that it needs, and none of another law.
/// `section`: where its keys stand, with a dot; `chosen_by`: the key that names it.
template <class Registry, class Number>
void check_law(const LawOptions<Number>& given, const std::string& section, const std::string& chosen_by) {
  const LawEntry& law = Registry::entry(given.law);
  for (const LawKey& key : Registry::keys()) {
    const std::string name = section + key.name;
    const std::optional<double> value = given.value(key.name);
    const bool own = law.has(key.name);
    if (own && !value && key.otherwise == LawDefault::kNone)
      throw InvalidInput::missing(name, fields::number_text({key.min, key.max, key.unit}) + ", which " + chosen_by +
                                            ": " + law.name + " needs");
    if (value) has_effect(own, name.c_str(), *value, key.plain, "with " + chosen_by + ": " + Registry::with(key.name));
  }
}

/// A breaking law needs the strength of a straight rod. `section`: that of the material, with a dot.
void check_breaking(const Material& material, const std::string& section) {
  check_law<BreakingRegistry>(material.breaking, section + "breaking.", "law");
  const std::string law = BreakingRegistry::entry(material.breaking.law).name;
  if (law != TensionBreaking::kName && !material.breaking_force)
    throw InvalidInput::missing(section + "breaking_force",
                                "a number of newtons, which " + section + "breaking.law: " + law + " needs");
}

/// What resists rolling needs surfaces that rub and roll. `section`: as for check_breaking.
void check_rolling(const Method& m, const Material& material, const std::string& section) {
  const bool rolls = friction_rolls(m.material, m.machine, m.physics);
  const std::string resistance = section + "rolling_resistance", hysteresis = section + "rolling_hysteresis",
                    where = what_rolling_takes(material, m.physics, section);
  has_effect(rolls, resistance.c_str(), material.rolling_resistance, 0.0, where);
  has_effect(rolls, hysteresis.c_str(), material.rolling_hysteresis, 0.0, where);
  has_effect(is_solid(material), hysteresis.c_str(), material.rolling_hysteresis, 0.0,
             "in a solid rod, whose stretching_stiffness says how wide its contacts are");
}

/// A section gives where the material says how: one elastic solid, whose surfaces meet and whose twist is solved for.
void check_section(const Method& m, const Material& material, const std::string& section) {
  if (!material.is_soft()) return;
  if (const std::optional<NeedsRound> needs = needs_round(material, m.physics, section))
    throw InvalidInput(section + "section", "soft", "round " + needs->where);
}

/// Softer in twist than any rod or rope: a slip of a unit, with which strands would spin in steps without end.
constexpr double kSoftestInTwist = 0.01 * (1.0 - 1e-12);  // k_t over k_b, less what rounds

/// The laws of a material have their keys, and no others.
void check_laws(const Material& material, const std::string& section) {
  if (const double least = kSoftestInTwist * material.bending_stiffness; material.twisting_stiffness < least)
    reject(section + "twisting_stiffness", material.twisting_stiffness,
           "at least a hundredth of bending_stiffness, " + least_text(least) + " N m2");
  check_law<StretchingRegistry>(material.stretching, section, "stretching_law");
  check_law<BendingRegistry>(material.bending, section, "bending_law");
  check_breaking(material, section);
}

/// What ropes of two materials have in common, as nothing in a time step tells them apart by it.
void check_other_material(const Method& m) {
  const bool several = m.specimen.drawing && m.specimen.drawing->strands.size() > 1;
  has_effect(m.material.other != nullptr, "physics.friction.pair", m.physics.pair_friction.value_or(-1.0), -1.0,
             "with other_material");
  const auto rule = [](PairRule which) { return std::string(kPairRules[static_cast<std::size_t>(which)]); };
  has_effect(m.material.other != nullptr, "physics.friction.pair", rule(m.physics.pair_rule), rule(PairRule::kSmaller),
             "with other_material");
  if (!m.material.other) return;
  const Material &own = m.material, &other = *m.material.other;
  has_effect(several, "other_material", other.name, std::string(),
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

/// The keys of a specimen, each with its value as a message shows it.
YAML::Node keys_of(SpecimenOptions specimen) {
  fields::Writer writer;
  fields::specimen(writer, specimen);
  return writer.map();
}

/// A key of `specimen` that its knot does not have is without effect.
void check_keys_of_knot(const SpecimenOptions& specimen) {
  const YAML::Node given = keys_of(specimen), unset = keys_of(SpecimenOptions());
  for (const auto& item : given) {
    const std::string key = item.first.Scalar(), value = item.second.Scalar();
    const YAML::Node plain = unset[key];
    has_effect(knot_of(specimen).has(key), ("specimen." + key).c_str(), value,
               plain.IsDefined() ? plain.Scalar() : std::string(), "for knot: " + knots_with(key));
  }
}

void check_effects(const Method& m) {
  const SpecimenOptions& s = m.specimen;
  check_keys_of_knot(s);
  const double automatic = default_preload(m.material);
  has_effect(preload_acts(s), "specimen.preload", s.preload.value_or(automatic), automatic,
             "on a knot whose file says by which ends it is tied (tie) or what hangs on it (weights)");

  const MachineOptions& machine = m.machine;
  const MachineOptions bare;
  const bool loop = knot_of(s).about().loop;
  has_effect(loop, "machine.roller_diameter", machine.roller_diameter, bare.roller_diameter, "for knot: " + loops());
  const bool rollers = machine.grips == GripKind::kRollers;
  const Supports supports = knot_of(s).supports(s, m.material);
  const bool on_posts = !supports.posts.empty() || !supports.pins.empty();
  has_effect(rollers || on_posts, "machine.roller_friction", machine.roller_friction, bare.roller_friction,
             "with grips: rollers or knot: " + knots_with("post_diameter"));
  const bool held = machine.far_side == FarSide::kHeld;
  has_effect(rollers_hold(s, machine), "machine.far_side", std::string(held ? "held" : "free"), std::string("held"),
             "for knot: " + loops() + ", with grips: rollers");

  check_rolling(m, m.material, "material.");
  check_section(m, m.material, "material.");
  check_law<FrictionRegistry>(m.physics.friction, "physics.friction.", "law");
  check_laws(m.material, "material.");
}

void check_specimen(const Method& m) {
  const SpecimenOptions& s = m.specimen;
  const double h = thickest(m.material);
  if (knot_of(s).about().knots > 0 && s.edge_length > 2.0 * h)
    reject("specimen.edge_length", s.edge_length, "at most twice the radius, " + most_text(2.0 * h) + " m");
  knot_of(s).check(s, h);
  const double apart = s.end_to_end - 2.0 * h;
  if (m.machine.grips == GripKind::kRollers && !(m.machine.roller_diameter < apart))
    reject("machine.roller_diameter", m.machine.roller_diameter,
           "less than " + most_text(apart) + " m, specimen.end_to_end less the diameter of the rod");
  const std::optional<double> breaking = weakest(m.material);
  if (s.to_be_tied && s.preload && breaking && *breaking <= *s.preload)
    reject("material.breaking_force", *breaking,
           "more than specimen.preload, " + format_number(*s.preload) + " N, the force that ties the knots");
}

/// What takes part in a rod's twist needs a rod that has it. Friction at the surface, for one, turns strands about
/// themselves.
void check_twist(const Method& m) {
  if (m.physics.twist != TwistMode::kOff) return;
  std::string needs, without;
  const auto need = [&](bool is_so, const char* what, const char* instead) {
    if (!is_so) return;
    needs += (needs.empty() ? "" : ", and ") + std::string(what);
    without += (without.empty() ? "" : " and ") + std::string(instead);
  };
  const bool knotted = !knot_of(m.specimen).about().straight;
  need(has_step<TwistStep>(m.program), "a step of the program twists the rod", "no twist step");
  need(knotted && friction_rolls(m.material, m.machine, m.physics), "friction at the surface twists the rod",
       "physics.friction.at: centreline");
  need(m.specimen.natural_curvature != 0.0, "a rod that is curved at rest takes part in its twist",
       "specimen.natural_curvature: 0");
  need(bends_on_frames(m.material), "a rod of this material.bending_law bends on frames, which take part in its twist",
       "material.bending_law: elastic");
  if (!needs.empty())
    throw InvalidInput::sentence("physics.twist",
                                 "physics.twist is off, but " + needs + ": set " + without + " to go without");
}

void check_bending(const Method& m) {
  remembers_bends(m.material);  // throws where its law misses a value
}

/// A natural curvature stays only where the bending law does not change it.
void check_rest_shape(const Method& m) {
  const SpecimenOptions& s = m.specimen;
  const bool curved = s.natural_curvature != 0.0;
  if (curved && remembers_bends(m.material))
    throw InvalidInput::sentence("material.bending_law", "specimen.natural_curvature is " +
                                                             format_number(s.natural_curvature) +
                                                             ", but material.bending_law is " +
                                                             BendingRegistry::entry(m.material.bending.law).name +
                                                             ": a rod keeps its natural curvature with elastic only");
  if (const double h = thickest(m.material); std::abs(s.natural_curvature) * h >= 1.0) {
    const std::string most = most_text(1.0 / h);
    reject("specimen.natural_curvature", s.natural_curvature,
           "more than -" + most + " and less than " + most + " 1/m, one over the radius");
  }
}

void check_machine(const Method& m) {
  const LoadCellOptions& cell = m.machine.load_cell;
  if (cell.resolution >= cell.capacity)
    reject("machine.load_cell.resolution", cell.resolution,
           "less than capacity, " + format_number(cell.capacity) + " N");
  if (m.machine.grips == GripKind::kRollers && !knot_of(m.specimen).about().loop)
    throw InvalidInput("machine.grips", "rollers", "nodes or clamps: rollers hold only a loop, knot: " + loops());
}

void check_load(const std::string& key, double load, double capacity) {
  if (std::abs(load) > capacity)
    reject(key, load, "at most the load cell's capacity, " + format_number(capacity) + " N");
}

void check_ends(const Method& m) {
  if (m.ends.load) check_load("ends.load", *m.ends.load, m.machine.load_cell.capacity);
}

void check_pull(const Method& m, const PullStep& step, const std::string& key) {
  const std::optional<double> longest = knot_of(m.specimen).longest_pull(m.specimen, m.material.radius);
  if (!longest || !step.until.extension || *step.until.extension <= *longest) return;
  if (*longest <= 0.0)
    reject("specimen.tail", m.specimen.tail,
           "more than " + least_text(m.specimen.tail - *longest) +
               " m, so that the rod's lower end does not lie on the post");
  reject(key + ".until.extension", *step.until.extension,
         "at most " + most_text(*longest) + " m, where the rod's lower end comes to the post: a longer " +
             "specimen.tail allows more");
}

void check_program(const Method& m) {
  const KnotDescription& knot = knot_of(m.specimen).about();
  StepPlace place{m.program, 0, knot.loop ? "" : loops(), knot.can_be_tied() ? "" : knots_that_can_be_tied(),
                  clamp_turns(m.specimen, m.machine)};
  for (; place.index < m.program.size(); ++place.index) {
    const ProgramStep& step = m.program[place.index];
    step->check(place);
    for (const KeyUnit& number : step_numbers(step, place.key()))
      if (number.unit == "N") check_load(number.key, number.value.value_or(0.0), m.machine.load_cell.capacity);
    if (const PullStep* pull = step.as<PullStep>()) check_pull(m, *pull, place.key());
  }
}

bool pulls_anything(const Method& m) {
  return std::any_of(m.program.begin(), m.program.end(), [](const ProgramStep& step) { return pulls(step->phase()); });
}

}  // namespace

void check_method(const Method& method) {
  check_other_material(method);
  check_specimen(method);
  check_machine(method);
  check_bending(method);
  check_twist(method);
  check_program(method);
  check_ends(method);
  check_effects(method);
  check_rest_shape(method);
  check_scatter(method);
  if (method.specimen.to_be_tied && pulls_anything(method)) check_tying(method.specimen, method.material);
}

}  // namespace knot_utm
