#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "knot_utm/grips/grips.hpp"
#include "knot_utm/method/method_keys.hpp"
#include "knot_utm/program/loading_steps.hpp"
#include "knot_utm/program/phases.hpp"
#include "knot_utm/rod/bending_laws.hpp"
#include "knot_utm/settings/step_settings.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/tying/before_tying.hpp"
#include "knot_utm/words/number.hpp"
#include "method_parts.hpp"

namespace knot_utm {
namespace {

[[noreturn]] void reject(const std::string& key, double value, const std::string& allowed) {
  throw InvalidInput(key, format_number(value), allowed);
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
    for (const MethodKey& number : step_keys(step, place.key()))
      if (number.unit == "N") check_load(number.key, number.value.value_or(0.0), m.machine.load_cell.capacity);
    if (const PullStep* pull = step.as<PullStep>()) check_pull(m, *pull, place.key());
  }
}

}  // namespace

void check_method(const Method& method) {
  check_other_material(method);
  check_specimen(method);
  check_machine(method);
  remembers_bends(method.material);  // throws where its law misses a value
  check_twist(method);
  check_program(method);
  if (method.ends.load) check_load("ends.load", *method.ends.load, method.machine.load_cell.capacity);
  check_effects(method);
  check_rest_shape(method);
  check_scatter(method);
  const auto pulls_it = [](const ProgramStep& step) { return pulls(step->phase()); };
  if (method.specimen.to_be_tied && std::any_of(method.program.begin(), method.program.end(), pulls_it))
    check_tying(method.specimen, method.material);
}

}  // namespace knot_utm
