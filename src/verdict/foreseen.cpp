#include "knot_utm/verdict/foreseen.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "knot_utm/contact/friction.hpp"
#include "knot_utm/machine/before_tying.hpp"
#include "knot_utm/machine/breaking_laws.hpp"
#include "knot_utm/machine/grips.hpp"
#include "knot_utm/machine/step_settings.hpp"
#include "knot_utm/method/method_keys.hpp"
#include "knot_utm/numeric/number.hpp"
#include "knot_utm/record/loading_steps.hpp"
#include "knot_utm/record/preparing_steps.hpp"
#include "knot_utm/rod/bending_laws.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/specimen/knot_drawing.hpp"

namespace knot_utm {
namespace {

/// Warns of a rod that `auto` makes longer than usual.
std::string longer_than_usual(const Method& method) {
  const Knot& knot = knot_of(method.specimen);
  const double h = method.material.radius, length = method.specimen.length;
  const SpecimenOptions usual = knot.defaults(h);
  const bool automatic = method.automatic.count("specimen.length") > 0;
  if (!knot.has("length") || length <= usual.length || !automatic) return "";
  const double end_to_end = method.specimen.end_to_end;
  return "specimen.length: auto is " + short_number(length) + " m, more than its usual " + short_number(usual.length) +
         " m, because specimen.end_to_end is " + short_number(end_to_end) + " m: the length of rod in the knot, " +
         short_number(length - end_to_end) +
         " m, is the same for all larger values of end_to_end; set specimen.length where it should not be";
}

/// From here on L has no effect on a sliding force: with F_p = 50 N, e = 0.2 m and L = 0.25 m, which is 15.7 h more,
/// polypropylene slides at 5.06 N, and with a longer loop at 6.60 N.
constexpr double kClearOfRollers = 19.0;  // L - e [h]

/// Warns of a loop whose knots are tied near its rollers.
std::string near_the_rollers(const Method& method) {
  const SpecimenOptions& specimen = method.specimen;
  if (!specimen.to_be_tied || !rollers_hold(specimen, method.machine)) return "";
  const double h = method.material.radius, clear = specimen.knot_distance + kClearOfRollers * h;
  if (specimen.end_to_end >= clear) return "";
  return "specimen.end_to_end is " + short_number(specimen.end_to_end) + " m, only " +
         short_number((specimen.end_to_end - specimen.knot_distance) / h) +
         " radii more than specimen.knot_distance, so the rollers are near the knots and change the sliding force, by "
         "up to a quarter; it does not depend on the rollers from " +
         short_number(kClearOfRollers) + " radii more on, which is a specimen.end_to_end of " + short_number(clear) +
         " m";
}

/// Warns of a loop whose ends two held nodes take.
std::string between_nodes(const Method& method) {
  if (!knot_of(method.specimen).about().loop || method.machine.grips != GripKind::kNodes) return "";
  return "machine.grips is nodes: no rod passes two held nodes, so the side of the loop without knots bears the load "
         "as "
         "soon as it is straight; machine.grips: rollers pulls at both sides alike";
}

constexpr double kTakenUp = 0.5;  // of the slack, by choice: a loop such as a butterfly keeps the rest of it

/// Warns of a knot that is drawn so wide that its pull does not tighten it.
std::string drawn_wide(const Method& method) {
  const KnotDrawing* drawing = method.specimen.drawing.get();
  if (!drawing) return "";
  const double h = thickest(method.material), slack = slack_between_grips(*drawing) * h;
  double pulled = 0.0;
  for (const ProgramStep& step : method.program)
    if (const PullStep* pull = step.as<PullStep>()) {
      if (!pull->until.extension) return "";
      pulled = std::max(pulled, *pull->until.extension);
    }
  if (pulled == 0.0 || pulled >= kTakenUp * slack) return "";
  return "the pull takes up " + short_number(pulled / h) + " radii of a rope that is drawn with " +
         short_number(slack / h) +
         " radii of slack, so its knot is not tight by then; until.extension: " + short_number(slack) +
         " would take it up";
}

/// Warns of a loop with knots of opposite handedness: of shipped nylon three of four specimens slid, and one jumped
/// open.
std::string scatters(const Method& method) {
  const SpecimenOptions& specimen = method.specimen;
  if (!knot_of(specimen).has("handedness") || specimen.handedness != Handedness::kOpposite) return "";
  return "specimen.handedness is opposite: whether such knots hold or jump open, and at which force they slide, is one "
         "of a distribution, and small changes of the specimen or its mesh decide it; judge by several specimens "
         "(specimens.count)";
}

/// A coefficient of friction that nobody measured between dry strands. With more, 4 of 13 loops with `power` friction
/// were given up by the solver, with less none of 16 (ropes, exponents of 0.5 to 0.8, draft).
constexpr double kMostFriction = 1.5;

/// Warns of a law of friction that makes strands of a knot much rougher than the method says.
std::string too_rough(const Method& method) {
  const Material& rod = method.material;
  if (!knot_of(method.specimen).about().may_hold_a_knot() || rod.friction_coefficient <= 0.0) return "";
  const double pressure = rod.bending_stiffness / std::pow(rod.radius, 3);
  const Friction friction = Friction::of(method.physics.friction, {rod.friction_coefficient, rod.radius, 1.0});
  const double there = friction.visit([&](const auto& law) {
    FrictionInput<Vec3> input{pressure, Vec3::UnitX(), Vec3::Zero(), Vec3::UnitX(), 0.0, 1.0};
    return law.traction(input).coefficient;
  });
  if (there <= std::max(kMostFriction, rod.friction_coefficient)) return "";
  return "physics.friction.law: " + std::string(FrictionRegistry::entry(method.physics.friction.law).name) +
         " makes the friction coefficient " + short_number(there) + " at " + short_number(pressure) +
         " N/m, which is how strands of a knot press on each other (k_b/h3); material.friction_coefficient, " +
         short_number(rod.friction_coefficient) + ", holds at physics.friction.reference_pressure: is that in N/m?";
}

/// What steps of the program wait for, and what ends the test before.
void add_never_reached(const Method& method, std::vector<std::string>& all) {
  const auto never = [&](const std::string& key, const std::optional<double>& asked, const std::optional<double>& limit,
                         const char* unit, const std::string& first) {
    if (asked && limit && *asked > *limit)
      all.push_back(key + " is " + short_number(*asked) + unit + ", which is never reached: before it " + first +
                    ", and the test ends there");
  };
  const double travel = method.machine.travel;
  const EndOptions& ends = method.ends;
  for (std::size_t i = 0; i < method.program.size(); ++i) {
    const ProgramStep& step = method.program[i];
    if (!loads(step->phase())) continue;
    std::string key = "program." + std::to_string(i) + "." + step->name();
    for (const KeyUnit& number : step_numbers(step, key)) {
      if (number.unit == "m")
        never(number.key, number.value, travel, " m",
              "the crosshead is at the end of machine.travel, " + short_number(travel) + " m");
      if (number.unit == "N")
        never(number.key, number.value, ends.load, " N",
              "the load is at ends.load, " + short_number(ends.load.value_or(0.0)) + " N");
      if (number.unit == "s")
        never(number.key, number.value, ends.time, " s",
              "the test's time is over by ends.time, " + short_number(ends.time.value_or(0.0)) + " s");
    }
    const PullStep* pull = step.as<PullStep>();
    if (!pull) continue;
    const Until& until = pull->until;
    key += ".until";
    const double longest = travel / pull->speed;
    if (!pull->load_rate && !until.load && !until.extension)
      never(key + ".time", until.time, longest, " s",
            "the crosshead is at the end of machine.travel after " + short_number(longest) + " s at " +
                short_number(pull->speed) + " m/s");
    const Material& rod = method.material;
    if (until.broken && !until.extension && !until.load && !until.time && !can_part(rod) &&
        !ends.break_at_fraction_of_peak)
      all.push_back(key +
                    ".break is the only end of the pull, but nothing breaks this rod, so that the pull goes on to "
                    "machine.travel, " +
                    short_number(travel) +
                    " m: give material.breaking_force, a fall of the load in ends, or "
                    "until.extension");
  }
}

constexpr double kLightest = 150.0, kHeaviest = 12000.0;    // [kg/m3]
constexpr double kSoftest = 1e4, kStiffest = 1.5e12;        // modulus [Pa]
constexpr double kLeastBending = 1e-6, kMostBending = 4.0;  // over that of a solid rod that stretches alike
constexpr double kLeastStrain = 1e-4;                       // at break

double area(const Material& material) { return M_PI * material.radius * material.radius; }
double modulus(const Material& material) { return material.stretching_stiffness / area(material); }

/// Bending stiffness over that of a solid rod of the same stretching stiffness, k_s h^2/4.
double bending(const Material& material) {
  return 4.0 * material.bending_stiffness / (material.stretching_stiffness * material.radius * material.radius);
}

/// "2.3 GPa".
std::string pascals(double value) {
  for (const auto& [size, name] : {std::pair<double, const char*>{1e9, " GPa"}, {1e6, " MPa"}, {1e3, " kPa"}})
    if (value >= size) return short_number(value / size) + name;
  return short_number(value) + " Pa";
}

/// `section`: that of the material, with a dot.
void ask_about(const Material& material, const std::string& section, std::vector<std::string>& all) {
  const double density = material.density, stretched = modulus(material), bent = bending(material);
  if (density < kLightest || density > kHeaviest)
    all.push_back(section + "density is " + short_number(density) +
                  " kg/m3, where cork has 200, water 1000 and steel 7850: is it in kg/m3, and " + section + "radius, " +
                  short_number(material.radius) + ", in m?");
  if (stretched < kSoftest || stretched > kStiffest)
    all.push_back(
        section + "stretching_stiffness is " + short_number(material.stretching_stiffness) +
        " N, which is E = " + pascals(stretched) +
        ", where rubber has 1 MPa, nylon 2 GPa and steel 200 GPa: is it E times the cross-section, in Pa times "
        "m2, and " +
        section + "radius in m?");
  else if (bent < kLeastBending || bent > kMostBending)
    all.push_back(section + "bending_stiffness is " + short_number(material.bending_stiffness) + " N m2, which is " +
                  short_number(bent) +
                  " of that of a solid rod that stretches alike, where ropes have 0.0001 to 1: is it in N m2?");
  if (material.breaking_force && *material.breaking_force < kLeastStrain * material.stretching_stiffness)
    all.push_back(section + "breaking_force is " + short_number(*material.breaking_force) +
                  " N, with which the rod breaks at a strain of " +
                  short_number(*material.breaking_force / material.stretching_stiffness) + ": is it in N?");
}

constexpr double kTiedByDefault = 3.15;  // `program.tie.speed: auto` of src/method/method.cpp [radii/s]
/// Here the plateaus of nylon and polypropylene are 1.1 and 0.3 % lower: config/tighten.yaml with
/// program.tie.speed=0.029 [radii/s].
constexpr double kTiedSlow = 3.0 * kTiedByDefault;
/// Ten times the default moved the plateau of nylon by -8 %, of polypropylene by -7 %
/// (config/tighten.yaml with program.tie.speed=0.1).
constexpr const char* kTiedFast =
    "; ten times the default changes a sliding force by up to 8 %, so choose a lower program.tie.speed";

constexpr double kPulledAsShipped = 1.04;  // [radii/s]
/// At three times that the plateaus of nylon and polypropylene are the same to 0.4 % (five starts).
constexpr double kPulledSlow = 5.0 * kPulledAsShipped;
/// Ten times moved the plateau of nylon by 2.9 %, of polypropylene by 1.2 %.
constexpr const char* kPulledFast =
    "; ten times that changes a sliding force by up to 3 %, so choose a lower program.pull.speed";

/// Advises longer tails where those of a loop are shorter than by default: an end that slips out of its coil unties the
/// knot, however hard it was tied. It is empty where they are not.
std::string longer_tail(const Method& method) {
  const Knot& knot = knot_of(method.specimen);
  if (!knot.about().loop || !knot.has("tail")) return "";
  const double h = method.material.radius;
  SpecimenOptions usual = knot.defaults(h);
  knot.suit(method.specimen, method.machine.roller_diameter, h, usual);
  constexpr double kShorter = 0.99;
  if (!(method.specimen.tail < kShorter * usual.tail)) return "";
  return "a longer specimen.tail (now " + short_number(method.specimen.tail) + " m; auto is " +
         short_number(usual.tail) + " m)";
}

std::string higher_preload(const Method& method) {
  const double usual = default_preload(method.material), preload = method.specimen.preload.value_or(usual);
  std::string now = short_number(preload) + " N";
  if (preload < usual) now += "; auto is " + short_number(usual) + " N";
  return "a higher specimen.preload (now " + now + ")";
}

}  // namespace

std::vector<std::string> foreseen_warnings(const Method& method) {
  std::vector<std::string> all;
  if (method.specimen.to_be_tied) all = tying_warnings(method.specimen, method.material, method.physics);
  all.insert(all.end(), method.overruled.begin(), method.overruled.end());
  for (const std::string& found : {longer_than_usual(method), near_the_rollers(method), between_nodes(method),
                                   drawn_wide(method), scatters(method), too_rough(method)})
    if (!found.empty()) all.push_back(found);
  add_never_reached(method, all);
  ask_about(method.material, "material.", all);
  if (method.material.other) ask_about(*method.material.other, "other_material.", all);
  return all;
}

std::vector<std::string> speed_warnings(const Method& method) {
  std::vector<std::string> all;
  for (const ProgramStep& step : method.program) {
    const double speed = step->speed / thickest(method.material);
    const std::string told = format_number(std::round(10.0 * speed) / 10.0);
    if (step.as<TieStep>() && speed > kTiedSlow)
      all.push_back("the knots are tied at " + told + " radii a second, by default at " +
                    format_number(kTiedByDefault) + kTiedFast);
    if (pulls(step->phase()) && speed > kPulledSlow && knot_of(method.specimen).about().loop)
      all.push_back("the loop is pulled at " + told + " radii a second, as shipped at " +
                    format_number(kPulledAsShipped) + kPulledFast);
  }
  return all;
}

std::string rod_in_words(const Material& material) {
  return short_number(1e3 * material.density * area(material)) + " g/m at a diameter of " +
         short_number(2e3 * material.radius) + " mm, E = " + pascals(modulus(material)) +
         " stretched, bending stiffness " + short_number(bending(material)) +
         " of that of a solid rod of this E, friction coefficient " + short_number(material.friction_coefficient);
}

std::string what_keeps_a_knot(const Method& method) {
  const Material& material = method.material;
  const bool rolls = method.specimen.to_be_tied && friction_rolls(material, method.machine, method.physics);
  std::vector<std::string> remedies{longer_tail(method)};
  if (rolls) {
    if (const std::optional<double> moment = material.bending.value("friction_moment")) {
      if (tied_by_preload(method.specimen)) remedies.push_back(higher_preload(method));
      remedies.push_back("a larger material.friction_moment (now " + short_number(*moment) + ")");
    } else if (!remembers_bends(material)) {
      remedies.emplace_back("material.bending_law: frictional, if it is a rope,");
    }
    remedies.push_back("a larger material.rolling_resistance (now " + short_number(material.rolling_resistance) + ")");
  } else {
    if (method.specimen.to_be_tied && tied_by_preload(method.specimen)) remedies.push_back(higher_preload(method));
    remedies.push_back("a higher material.friction_coefficient (now " + short_number(material.friction_coefficient) +
                       ")");
    remedies.push_back(knot_of(method.specimen).what_keeps_it());
  }
  std::string all;
  for (const std::string& remedy : remedies)
    if (!remedy.empty()) all += (all.empty() ? "" : " or ") + remedy;
  return (rolls ? "the couple of friction rolls its strands: " : "") + all + " may keep it";
}

}  // namespace knot_utm
