#include "knot_utm/verdict/run_warnings.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "knot_utm/grips/grips.hpp"
#include "knot_utm/machine/load_cell.hpp"
#include "knot_utm/program/phases.hpp"
#include "knot_utm/program/preparing_steps.hpp"
#include "knot_utm/record/sample.hpp"
#include "knot_utm/settings/step_settings.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/tying/before_tying.hpp"
#include "knot_utm/words/number.hpp"

namespace knot_utm {
namespace {

constexpr double kHardlyAny = 1e-6;  // accelerated mass, by choice: a smaller one helps no more [own mass]

/// A node that is so many times as fast as the pull snaps.
constexpr double kSnaps = 100.0;

std::string in_per_cent(double share) { return format_number(std::round(1000.0 * share) / 10.0) + " %"; }

std::string two_digits(double value) {
  std::ostringstream out;
  out.precision(2);
  out << value;
  return out.str();
}

/// The warnings of one run. Each function adds those of one kind.
class Warnings {
 public:
  Warnings(const Results& results, const RunFacts& facts) : results_(results), facts_(facts) {}

  /// What became of the knot. Where it came undone, the console has a line of its own.
  void of_the_knot() {
    if (results_.untangled_at && results_.knot_type != KnotType::kCrossed && results_.ended_by != EndedBy::kUntangled)
      say("the knot came undone at " + short_number(*results_.untangled_at) +
          " s, while it was pulled, so there is no sliding force");
    if (results_.knot_type == KnotType::kChanged && !results_.untangled_at)
      say("with its two ends joined, the rod is another knot than at the start; as it still bears the load, nothing "
          "came undone");
  }

  /// What the cell cannot tell: forces below its floor.
  void of_the_cell() {
    const LoadCellOptions& cell = facts_.load_cell;
    const std::string floor = "the load cell's floor of " + format_number(cell.floor * cell.capacity) + " N";
    const bool has_peak = results_.true_peak_force && !ended_in_plateau();
    if (has_peak && is_below_floor(cell, *results_.true_peak_force))
      say("the peak force lies below " + floor);
    else if (results_.true_plateau_force && is_below_floor(cell, *results_.true_plateau_force))
      say("the plateau force lies below " + floor);
  }

  /// Where the simulated rod is not the one that was meant.
  void of_the_physics() {
    if (results_.knot_type == KnotType::kCrossed)
      say("the rod ran through itself at " + short_number(results_.untangled_at.value_or(Sample::kNone)) + " s");
    const double most = deepest_contact(facts_.material);
    if (results_.max_penetration > most)
      say("strands are pressed into each other by up to " + short_number(results_.max_penetration) +
          " radii, where a contact is right up to " + short_number(most));
    if (results_.energy_balance_error > kEnergiesDiffer.limit)
      say("the energies and the work differ by " + short_number(*results_.energy_balance_error) +
          " of the largest of them: choose a smaller physics.residual");
  }

  /// Says what happened in the pull: a knot opened, the rod snapped, knots still slid, a roller bore on a knot.
  void of_events() {
    const CurveReadings& curve = results_.curve;
    if (results_.opened_when_mounted) {
      const bool opened = results_.motion_pattern == MotionPattern::kUntangling;
      say(std::string(opened ? "a knot opened" : "the knots slid") +
          " as the loop was mounted: before the pull the knots had come nearer to each other by " +
          short_number(*results_.opened_when_mounted) + " m" + (opened ? "" : ", and then bore more than before"));
    }
    if (curve.jump_force)
      say("a knot jumped open at an extension of " + short_number(*curve.jump_extension) + " m: the load went from " +
          short_number(*curve.jump_force) + " N to " + short_number(*curve.force_after_jump) +
          " N, and later readings belong to a looser knot");
    if (results_.snap_extension)
      say("the specimen snapped into another shape at an extension of " + short_number(*results_.snap_extension) +
          " m, where the load fell by " + short_number(*results_.snap_drop) + " N at once");
    if (slid_to_the_end(results_) && results_.true_plateau_force && !ended_in_plateau())
      say("the pull ended while the knots still slid. The plateau force is the mean of what was pulled; a longer pull "
          "may give a larger one");
    constexpr double kMuchBalanced = 0.1;
    const double balanced = results_.balance_offset.value_or(0.0), plateau = results_.true_plateau_force.value_or(0.0);
    if (plateau > 0.0 && std::abs(balanced) > kMuchBalanced * plateau)
      say("the balance set " + short_number(balanced) + " N to zero, of a sliding force that is in truth " +
          short_number(plateau) + " N: see true_plateau_force");
  }

  /// An overhand whose pull left it a loose loop, as its force tells where nothing measured its hole: a loop of the
  /// radius R under the tension T has 2 T R^2 = k_b, and is wider with friction and fibres that rub.
  void of_a_loose_knot() {
    constexpr double kClosed = 2.0;  // radius of a loop that lies on the strands in it [h]
    const double force = results_.true_peak_force.value_or(0.0), h = facts_.material.radius;
    const bool whole = results_.knot_type == KnotType::kKept && results_.break_place == BreakPlace::kNone;
    if (!facts_.one_knot_in_a_strand || facts_.knot_hole || !whole || !(force > 0.0)) return;
    const double radius = std::sqrt(facts_.material.bending_stiffness / (2.0 * force)) / h;
    if (radius > kClosed)
      say("the knot was still loose as the test ended: the largest force, " + short_number(force) +
          " N, leaves its loop a radius of at least " + short_number(radius) +
          " radii of the rod; a longer pull brings it tight");
  }

  /// Where speed affects the forces of a test, which is meant to be quasi-static.
  void of_speed() {
    const double by_drag = results_.rate.drag.value_or(0.0), by_inertia = results_.rate.inertia.value_or(0.0);
    const double mass = facts_.inertia;
    if (by_drag > 1.0)
      say("drag takes " + two_digits(by_drag) +
          " times the work of the pull: the specimen moves by something else than the pull");
    else if (by_drag > kMuchDrag.limit)
      say("drag makes up " + in_per_cent(by_drag) +
          " of the force until the knots lock: choose a smaller physics.drag or pull more slowly");
    if (by_inertia > kMuchInertia.limit)
      say("inertia changes the force by " + in_per_cent(by_inertia) + " until the knots lock: " +
          (mass > kHardlyAny ? "choose a physics.inertia much smaller than " + two_digits(mass) : "pull more slowly"));
  }

  /// One straight strand of the length L between clamps, under the tension T, writhes at the torque M of
  ///
  ///     M^2 = 4 k_b T + (2 q k_b/L)^2,
  ///
  /// where q is between pi, of long strands, and 4.493, of those without tension. The least of these is told.
  ///
  /// Implicit steps that are longer than that takes may keep it straight.
  ///
  /// Source: Greenhill 1883.
  void of_twist() {
    if (!results_.peak_torque || facts_.strands > 1) return;
    const Material& material = facts_.material;
    const double k_b = material.other ? std::min(material.bending_stiffness, material.other->bending_stiffness)
                                      : material.bending_stiffness;
    const double tension = std::max(0.0, results_.tension_at_peak_torque);
    const double least = 2.0 * std::hypot(std::sqrt(k_b * tension), M_PI * k_b / results_.span_at_peak_torque);
    if (*results_.peak_torque > least)
      say("the torque reached " + short_number(*results_.peak_torque) +
          " N m, but a straight strand between clamps may writhe from " + short_number(least) +
          " N m on under its tension; time steps as long as these may keep it straight");
  }

  /// A straight strand of the length L buckles at Euler's load, 4 pi^2 k_b/L^2 between clamps and pi^2 k_b/L^2 between
  /// ends that may turn. It is drawn without a bend from which that could grow, and implicit steps that are longer than
  /// it takes to grow damp it.
  void of_thrust() {
    constexpr double kAtRest = 1e-3;  // of the largest force: what rest leaves
    const double thrust = results_.largest_thrust, span = results_.span_at_largest_thrust;
    if (!(facts_.buckling_factor > 0.0) || !(thrust > kAtRest * results_.true_peak_force.value_or(0.0))) return;
    const double least = facts_.buckling_factor * facts_.material.bending_stiffness / (span * span);
    if (thrust > least)
      say("the strand bore a thrust of " + short_number(thrust) + " N, but a straight one buckles at " +
          short_number(least) +
          " N (Euler's load): it was kept straight by nothing but its perfect shape; draw it slightly bent "
          "(specimen.knot: file) and compress it from there");
  }

  /// Elastic energy of stretchy strands or of a compliant frame that was released suddenly, although no knot jumped
  /// open. Where strands slide over sharp bends, each node that passes one lets go a little.
  void of_snaps() {
    const double speed = facts_.pull_speed;
    if (!results_.curve.jump_force && !results_.snap_extension && speed > 0.0 && results_.fastest_node > kSnaps * speed)
      say("something let go at once: a node moved at " + short_number(results_.fastest_node) + " m/s, " +
          short_number(results_.fastest_node / speed) +
          " times as fast as the pull; how far the load falls then depends on inertia and on the frame, and, where it "
          "does so again with each edge that slides, on specimen.edge_length");
  }

  /// What the specimen cannot have of what it was to have.
  void of_missed_marks() {
    constexpr double kFar = 0.01;  // of the length, by choice: what a tester reads off a ruler
    const auto say_of = [&](const std::string& what, std::optional<double> is, double wanted, const char* key) {
      if (is && std::abs(*is / wanted - 1.0) > kFar)
        say(what + short_number(*is) + " m apart as the pull begins, instead of " + short_number(wanted) + " m (" +
            key + ")");
    };
    if (!(facts_.knot_distance > 0.0) || !results_.knot_distance) return;
    say_of("the knots are ", results_.knot_distance, facts_.knot_distance, "specimen.knot_distance");
    say_of("the grips are ", results_.gauge_length, facts_.end_to_end, "specimen.end_to_end");
  }

  /// What moves while it is pulled, where it moves enough to be felt.
  void of_what_moves() {
    const std::string moved = why_not_at_rest(results_, facts_);
    say(moved);
    if (!moved.empty() || !results_.force_balance_error || !results_.true_peak_force) return;
    if (*results_.force_balance_error >
        kForcesDiffer.limit + kDifferByWeight * facts_.weight / *results_.true_peak_force)
      say("the forces on the two grips differ by up to " + short_number(100.0 * *results_.force_balance_error) +
          " % of the largest one, more than at rest: pull more slowly");
  }

  bool ended_in_plateau() const { return results_.ended_by == EndedBy::kPlateau; }

  void say(const std::string& line) {
    if (!line.empty()) all.push_back(line);
  }
  void say(const std::vector<std::string>& lines) { all.insert(all.end(), lines.begin(), lines.end()); }

  std::vector<std::string> all;

 private:
  const Results& results_;
  const RunFacts& facts_;
};

/// From here on L has no effect on a sliding force.
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

}  // namespace

std::string trust_limits_csv() {
  std::string all = "name,key,limit,unit,sentence\n";
  for (const TrustLimit& of :
       {kDeepContact, kDeepSoftContact, kEnergiesDiffer, kForcesDiffer, kPlateauUnsure, kMuchDrag, kMuchInertia})
    all += std::string(of.name) + ',' + of.key + ',' + format_number(of.limit) + ',' + of.unit + ",\"" + of.sentence +
           "\"\n";
  return all;
}

std::string accuracy_warning(const Results& results, const ReadingErrors& errors) {
  if (!errors.plateau_force) return {};
  const double share = *errors.plateau_force / std::abs(*results.true_plateau_force);
  if (!(share > kPlateauUnsure.limit)) return {};
  return "the plateau force may be off by " + format_number(std::round(100.0 * share)) +
         " %; a finer physics.accuracy, a higher specimen.refinement or several specimens tell more";
}

std::vector<std::string> printed_warnings(const Results& results, const RunFacts& facts) {
  Warnings found(results, facts);
  found.of_the_physics();
  found.of_events();
  found.of_a_loose_knot();
  found.of_twist();
  found.of_thrust();
  found.of_speed();
  found.of_snaps();
  found.say(facts.warnings);
  found.of_missed_marks();
  found.of_what_moves();
  found.say(accuracy_warning(results, known_errors(results, facts)));
  return found.all;
}

std::vector<std::string> all_warnings(const Results& results, const RunFacts& facts) {
  Warnings found(results, facts);
  found.of_the_knot();
  found.of_the_cell();
  found.say(facts.foreseen);
  found.say(printed_warnings(results, facts));
  return found.all;
}

std::vector<std::string> foreseen_warnings(const Method& method) {
  std::vector<std::string> all;
  if (method.specimen.to_be_tied) all = tying_warnings(method.specimen, method.material, method.physics);
  all.insert(all.end(), method.overruled.begin(), method.overruled.end());
  if (const std::string found = near_the_rollers(method); !found.empty()) all.push_back(found);
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
  if (method.specimen.to_be_tied && friction_rolls(material, method.machine, method.physics))
    return "the couple of friction rolls its strands: a larger material.rolling_resistance (now " +
           short_number(material.rolling_resistance) + ") may keep it";
  const double preload = method.specimen.preload.value_or(default_preload(material));
  return (method.specimen.to_be_tied ? "a higher specimen.preload (now " + short_number(preload) + " N) or " : "") +
         "a higher material.friction_coefficient (now " + short_number(material.friction_coefficient) + ") may keep it";
}

}  // namespace knot_utm
