#include "knot_utm/verdict/foreseen.hpp"

#include "knot_utm/machine/before_tying.hpp"
#include "knot_utm/machine/grips.hpp"
#include "knot_utm/method/method_keys.hpp"
#include "knot_utm/numeric/number.hpp"
#include "knot_utm/record/test_steps.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/verdict/plausible_rod.hpp"

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

/// Warns of a loop with knots of opposite handedness: of shipped nylon three of four specimens slid, and one jumped
/// open.
std::string scatters(const Method& method) {
  const SpecimenOptions& specimen = method.specimen;
  if (!knot_of(specimen).has("handedness") || specimen.handedness != Handedness::kOpposite) return "";
  return "specimen.handedness is opposite: whether such knots hold or jump open, and at which force they slide, is one "
         "of a distribution, and small changes of the specimen or its mesh decide it; judge by several specimens "
         "(specimens.count)";
}

std::string seconds(double time) { return short_number(time) + " s"; }
std::string metres(double extension) { return short_number(extension) + " m"; }
std::string newtons(double load) { return short_number(load) + " N"; }

/// What a step of the program waits for, and what ends the test before.
class NeverReached {
 public:
  NeverReached(const Method& method, std::vector<std::string>& all) : m_(method), all_(all) {}

  void number(const KeyUnit& asked) {
    const double value = asked.value.value_or(0.0);
    if (asked.unit == "m" && value > m_.machine.travel)
      say(asked.key, metres(value), "the crosshead is at the end of machine.travel, " + metres(m_.machine.travel));
    if (asked.unit == "N" && m_.ends.load && value > *m_.ends.load)
      say(asked.key, newtons(value), "the load is at ends.load, " + newtons(*m_.ends.load));
    if (asked.unit == "s" && m_.ends.time && value > *m_.ends.time)
      say(asked.key, seconds(value), "the test's time is over by ends.time, " + seconds(*m_.ends.time));
  }
  /// Warns of a pull at a constant speed that lasts longer than the crosshead can travel.
  void time_of_travel(const std::string& key, const PullStep& step) {
    const std::optional<double>& asked = step.until.time;
    const double longest = m_.machine.travel / step.speed;
    if (asked && *asked > longest && !step.load_rate && !step.until.load && !step.until.extension)
      say(key, seconds(*asked),
          "the crosshead is at the end of machine.travel after " + seconds(longest) + " at " +
              short_number(step.speed) + " m/s");
  }
  void fracture(const std::string& key, const Until& until) {
    const bool parts = m_.material.breaking_force || m_.material.breaking_strain || m_.ends.break_at_fraction_of_peak;
    if (!until.broken || until.extension || until.load || until.time || parts) return;
    all_.push_back(key +
                   ".break is the only end of the pull, but nothing breaks this rod, so that the pull goes on to "
                   "machine.travel, " +
                   metres(m_.machine.travel) +
                   ": give material.breaking_force, material.breaking_strain, a fall of the load in ends, or "
                   "until.extension");
  }

 private:
  void say(const std::string& key, const std::string& asked, const std::string& first) {
    all_.push_back(key + " is " + asked + ", which is never reached: before it " + first + ", and the test ends there");
  }

  const Method& m_;
  std::vector<std::string>& all_;
};

void add_never_reached(const Method& method, std::vector<std::string>& all) {
  NeverReached never(method, all);
  for (std::size_t i = 0; i < method.program.size(); ++i) {
    const ProgramStep& step = method.program[i];
    const std::string key = "program." + std::to_string(i) + "." + step->name();
    if (!loads(step->phase())) continue;
    for (const KeyUnit& number : step_numbers(step, key)) never.number(number);
    if (const PullStep* pull = step.as<PullStep>()) {
      never.time_of_travel(key + ".until.time", *pull);
      never.fracture(key + ".until", pull->until);
    }
  }
}

}  // namespace

std::vector<std::string> foreseen_warnings(const Method& method) {
  std::vector<std::string> all;
  if (method.specimen.to_be_tied) all = tying_warnings(method.specimen, method.material, method.physics);
  for (const std::string& found :
       {longer_than_usual(method), near_the_rollers(method), between_nodes(method), scatters(method)})
    if (!found.empty()) all.push_back(found);
  add_never_reached(method, all);
  for (const std::string& question : questions_about(method.material)) all.push_back(question);
  return all;
}

}  // namespace knot_utm
