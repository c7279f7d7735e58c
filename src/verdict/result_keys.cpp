#include "knot_utm/verdict/result_keys.hpp"

#include <algorithm>
#include <iterator>
#include <tuple>

#include "knot_utm/breaking/breaking_laws.hpp"
#include "knot_utm/machine/load_cell.hpp"
#include "knot_utm/record/sample.hpp"
#include "knot_utm/verdict/run_warnings.hpp"
#include "knot_utm/words/invalid_input.hpp"
#include "knot_utm/words/number.hpp"
#include "knot_utm/words/yaml_lines.hpp"

namespace knot_utm {

namespace {

using Source = ResultSource;
using Number = std::optional<double>;
using Count = std::optional<std::uint64_t>;
using Flag = std::optional<bool>;

/// Where a member is read from, by the struct that it is a member of; null: the test has none.
template <class Struct, class Value>
const Struct* part(const Source& of, Value Struct::*) {
  const Results& results = of.results;
  const SpecimenFacts& specimen = of.facts;
  const auto if_any = [](const auto& optional) { return optional ? &*optional : nullptr; };
  return std::get<const Struct*>(std::tuple{&results, &results.curve, &results.rate, if_any(results.energy),
                                            if_any(results.elongations), if_any(results.relaxation), &specimen,
                                            &of.facts, &of.errors});
}

/// What is a member of something is read by its name.
template <auto Member>
Number read(const Source& of) {
  const auto* const from = part(of, Member);
  return from ? Number(from->*Member) : std::nullopt;
}
template <auto Member>
Count counted(const Source& of) {
  return of.results.*Member;
}
template <auto Member>
std::vector<double> of_knots(const Source& of) {
  const PerKnot& values = of.results.*Member;
  return {values.begin(), values.end()};
}

/// The error of the load cell's class at a true force [N].
template <auto Force>
Number class_error_at(const Source& of) {
  const Number& force = of.results.*Force;
  return force ? class_error(of.facts.load_cell, *force) : std::nullopt;
}

// Why a key is null, where the reason depends on the test. Only asked for keys that have no value.

constexpr const char* kNoClass = "the load cell has neither accuracy nor floor";
constexpr const char* kFewForDrops = "the load was read fewer than 20 times before the lock";

bool ended_in_plateau(const Results& results) { return results.ended_by == EndedBy::kPlateau; }

/// Empty: something was pulled.
std::string why_not_pulled(const Source& of) {
  if (of.results.true_peak_force) return "";
  return of.results.never_in_tension ? "the specimen was never in tension" : "nothing was pulled";
}

/// `reason` of a reading that any pull has.
std::string if_pulled(const Source& of, const std::string& reason) {
  const std::string not_pulled = why_not_pulled(of);
  return not_pulled.empty() ? reason : not_pulled;
}

/// Empty: something was pulled, to the end of the pull.
std::string why_no_whole_pull(const Source& of) {
  return if_pulled(of, ended_in_plateau(of.results) ? kEndedInPlateau : "");
}

/// `reason` of a reading that any whole pull has.
std::string of_the_pull(const Source& of, const std::string& reason) {
  const std::string not_pulled = why_no_whole_pull(of);
  return not_pulled.empty() ? reason : not_pulled;
}

std::string why_no_break(const Source& of) {
  if (of.results.break_extension) return "it did not break in a pull";
  return of.results.break_place == BreakPlace::kNone ? "the rod did not break"
                                                     : "the rod parted before anything pulled it";
}

std::string why_no_peak(const Source& of) {
  return of_the_pull(of, of.results.curve.peak_force ? "" : "the load never rose above its balanced zero");
}

std::string why_they_did_not_lock(const Results& results) {
  if (results.knot_type == KnotType::kCrossed) return "the rod ran through itself";
  if (results.untangled_at) return "the knot came undone";
  if (results.curve.jump_force)
    return "a knot jumped open at " + short_number(*results.curve.jump_force) +
           " N, and the load-extension curve after it is that of another knot";
  switch (results.motion_pattern) {
    case MotionPattern::kSliding:
      return ended_in_plateau(results) ? kEndedInPlateau : "the knots still slid at the end of the pull";
    case MotionPattern::kStretching:
      return "the motion pattern is stretching";
    case MotionPattern::kUntangling:
      return "a knot opened as the loop was mounted";
    case MotionPattern::kNone:
      break;
  }
  return "only two knots that slide towards each other lock, and there are none";
}

std::string why_the_load_has_no_stiffness(const Results& results) {
  if (results.motion_pattern == MotionPattern::kNone && !results.curve.jump_force)
    return "the load has no rise with three readings or more";
  if (results.curve.jump_force || results.motion_pattern != MotionPattern::kSliding)
    return why_they_did_not_lock(results);
  if (results.curve.rises_at) return "the load was read fewer than three times between the lock and the peak";
  return results.lock_extension ? "the lock does not show in the load" : why_they_did_not_lock(results);
}

/// `no_reading`: why there is no reading that could be off; empty: there is one. `error`: that of mesh and tolerances,
/// or none; where it is known, it is larger than half of the reading if a reading has no error all the same.
std::string why_no_error(const Source& of, const std::string& no_reading,
                         std::optional<double> RelativeErrors::*error) {
  const Results& results = of.results;
  const bool hardly_closed = knots_hardly_closed(results, of.facts);
  const RelativeErrors errors = hardly_closed ? errors_of_hardly_closed(of.facts.errors) : of.facts.errors;
  const bool studied = error && errors.*error;
  if (!why_not_at_rest(results, of.facts).empty()) return "unknown: the specimen was not at rest as its pull began";
  if (results.curve.jump_force) return "unknown: a knot jumped open, which no convergence study covers";
  if (results.opened_when_mounted)
    return "unknown: the knots moved as the loop was mounted, which no convergence study covers";
  if (hardly_closed && !studied) return "unknown: the knots were hardly closed, which no convergence study covers";
  if (!no_reading.empty()) return no_reading;
  return studied ? "unknown: the estimate is more than half of the reading"
                 : "unknown: no convergence study covers this case";
}

std::string why_no_plateau(const Source& of) {
  return of.results.curve.no_plateau.empty() ? "" : "see no_plateau_because";
}

std::string why_no_plateau_error(const Source& of) {
  return why_no_error(of, why_no_plateau(of), &RelativeErrors::plateau_force);
}

std::string why_no_place_of_drop(const Source& of) {
  return of.results.curve.largest_drop ? of_the_pull(of, "the load only rose before the lock")
                                       : of_the_pull(of, kFewForDrops);
}

std::string why_no_lock(const Source& of) {
  return of_the_pull(of, of.results.lock_extension ? "" : why_they_did_not_lock(of.results));
}

std::string why_no_lock_error(const Source& of) {
  return why_no_error(of, why_no_lock(of), &RelativeErrors::lock_extension);
}

std::string why_no_lock_by_load(const Source& of) { return of_the_pull(of, of.results.curve.no_lock_by_load); }

std::string why_no_stiffness(const Source& of) {
  const Results& results = of.results;
  return of_the_pull(of, results.curve.locked_stiffness ? "" : why_the_load_has_no_stiffness(results));
}

std::string why_no_stiffness_error(const Source& of) {
  const std::string no_reading = why_no_stiffness(of);
  const bool slides = no_reading.empty() && slid_to_the_end(of.results);
  return why_no_error(of, slides ? why_they_did_not_lock(of.results) : no_reading, &RelativeErrors::locked_stiffness);
}

std::string why_no_peak_error(const Source& of) { return why_no_error(of, why_no_peak(of), nullptr); }

std::string why_no_snap(const Source& of) {
  return if_pulled(of, of.results.tied_knot_distance ? "a loop of two knots has jump_force" : "nothing snapped");
}

std::string why_no_efficiency(const Source& of) {
  if (!of.facts.may_hold_a_knot) return "there is no knot";
  if (!of.results.break_extension) return why_no_break(of);
  if (!all_part_by_bending(of.facts.material))
    return "not predicted: the rod parts where its tension is material.breaking_force, which was given";
  return of_the_pull(of, "the load fell before the rod parted");
}

std::string why_no_hole(const Source& of) {
  if (!of.facts.one_knot_in_a_strand) return "the specimen is no strand with one knot";
  if (of.results.break_place != BreakPlace::kNone) return "the rod broke";
  if (!of.facts.ends_with_hold) return "the test does not end with a hold, in which a knot is measured";
  return of.results.knot_type == KnotType::kKept ? "no shape of the rod is known" : "the knot is another one";
}

std::string why_no_cell_error_in_plateau(const Source& of) {
  return of.results.true_plateau_force ? kNoClass : why_no_plateau(of);
}

/// Readings at the largest load. A pull that ended within its plateau does not have one.
bool has_peak(const Source& of) { return !ended_in_plateau(of.results); }
Number true_peak_force(const Source& of) { return has_peak(of) ? of.results.true_peak_force : std::nullopt; }
Number peak_force_error(const Source& of) { return has_peak(of) ? of.errors.peak_force : std::nullopt; }
Number load_cell_error(const Source& of) {
  return has_peak(of) ? class_error_at<&Results::true_peak_force>(of) : std::nullopt;
}

Number moment_balance_error(const Source& of) {
  const Number& arm = of.results.moment_arm;
  return arm ? Number(*arm / of.facts.material.radius) : std::nullopt;
}

// Without friction the ratio is 1, but for what the solver leaves.
constexpr double kBearsItsLoad = 0.99;

/// The force that pulls a strand over the load at its other end, where the strand slides all along its posts.
Number force_ratio(const Source& of) {
  const Number& force = of.results.steady_force;
  const double load = of.facts.dead_load;
  if (!of.results.true_peak_force || !force || !(load > 0.0) || *force < kBearsItsLoad * load) return std::nullopt;
  return *force / load;
}
std::string why_no_force_ratio(const Source& of) {
  if (!(of.facts.dead_load > 0.0)) return "no dead load pulls the specimen's other end";
  if (!of.results.true_peak_force) return why_not_pulled(of);
  if (of.results.break_extension) return "the rod broke";
  return of.results.steady_force ? "the strand does not slide: it bears less than its tail load"
                                 : "the force is not steady: the strand does not slide all along the post yet";
}

/// The largest load over what as many straight rods would bear. Where tension alone parts the rod, it parts at the
/// tension of a straight one, which predicts nothing.
Number over_straight_strands(const Source& of, const Number& force) {
  const Material& material = of.facts.material;
  const bool predicted = all_part_by_bending(material);
  if (!force || !of.facts.may_hold_a_knot || !of.results.break_extension || !predicted) return std::nullopt;
  return *force / (of.facts.strands * *weakest(material));
}
Number knot_efficiency(const Source& of) { return over_straight_strands(of, of.results.true_peak_force); }
Number knot_efficiency_error(const Source& of) { return over_straight_strands(of, of.errors.peak_force); }
std::string why_no_efficiency_error(const Source& of) {
  return knot_efficiency(of) ? why_no_peak_error(of) : why_no_efficiency(of);
}

Number knotability(const Source& of) {
  return of.facts.knot_hole ? Number(*of.facts.knot_hole / (2.0 * of.facts.material.radius)) : std::nullopt;
}

Number relaxation(const Source& of) {
  return of.results.relaxation ? Number(of.results.relaxation->lost()) : std::nullopt;
}

Number real_time_factor(const Source& of) {
  const double wall = of.facts.wall_time;
  return wall > 0.0 ? of.results.simulated_time / wall : 0.0;
}

const char* motion_pattern(const Source& of) { return motion_pattern_name(of.results.motion_pattern); }
const char* ended_by(const Source& of) { return ended_by_name(of.results.ended_by); }
const char* break_place(const Source& of) { return break_place_name(of.results.break_place); }
const char* version_of(const Source& of) { return of.facts.version.c_str(); }
std::string reason(const Source& of) { return of.facts.reason; }
std::string failure_mode(const Source& of) { return of.results.failure_mode; }
std::string no_plateau_because(const Source& of) { return of.results.curve.no_plateau; }
std::vector<std::string> warnings(const Source& of) { return all_warnings(of.results, of.facts); }
std::vector<std::string> specification_failed(const Source& of) { return of.verdict.failed; }
std::vector<std::string> knot_readings(const Source& of) { return of.facts.knot_readings; }
std::string why_no_reading(const Source& of) {
  if (of.facts.knot_readings.empty()) return "the knot's file reads nothing";
  return if_pulled(of, "its ropes touch nowhere that ends a loop");
}
std::string why_no_tail_slip(const Source& of) {
  if (of.facts.free_ends == 0) return "no end of a rope is free that a file describes";
  return if_pulled(of, "no rope with a free end touched another one as the pull began");
}
Flag specification_passed(const Source& of) { return of.verdict.passed; }
Flag not_equilibrated(const Source& of) { return !why_not_at_rest(of.results, of.facts).empty(); }
Flag knot_type_preserved(const Source& of) {
  return of.facts.follows_type ? Flag(of.results.knot_type == KnotType::kKept) : std::nullopt;
}
Count seed(const Source& of) { return of.facts.load_cell.seed; }
Count peak_memory_of(const Source& of) { return of.facts.peak_memory > 0 ? Count(of.facts.peak_memory) : std::nullopt; }

constexpr const char* kHappened = "What happened";
constexpr const char* kCurve = "Force and extension";
constexpr const char* kKnots = "The knots";
constexpr const char* kEnergy = "Energy of the pull";
constexpr const char* kComputation = "The computation";
constexpr const char* kHead = result_place::kHead;
constexpr const char* kBeside = result_place::kBeside;
constexpr const char* kCertificate = result_place::kCertificate;

/// The tables of the report, in their order.
constexpr const char* kTables[] = {kHappened, kCurve, kKnots, kEnergy, kComputation};
constexpr const char* kOfGauge = "of the gauge length";

constexpr const char* kNoReason = "";  // never null, or that goes without saying
constexpr const char* kNoJump = "no knot jumped open";
constexpr const char* kNoHold = "the crosshead was not held under a load";
constexpr const char* kNoCycle = "no cycle was closed";
constexpr const char* kNoKnots = "there are no two knots";
constexpr const char* kNoExcess = "known of loops, and of one knot drawn in one rope from grip to grip";
constexpr NullReason kNoDrop = NullReason::of_a_pull(kFewForDrops);
constexpr NullReason kNoContact = NullReason::of_a_pull("no two knots touched each other while pulled");
constexpr NullReason kNoTouch = NullReason::of_a_pull("no roller bore on a knot or its tail while pulled");
constexpr NullReason kNoChord = NullReason::of_a_pull("the true force was never below a tenth of the peak");
constexpr NullReason kNoCellError = NullReason::of_a_pull(kNoClass);

using R = Results;
using C = CurveReadings;
using F = RunFacts;
using E = EnergyParts;
using L = Elongations;

constexpr ResultKey kKeys[] = {
    // How the test went.
    {"motion_pattern", "-", kHappened, "Motion pattern", motion_pattern, kNoReason},
    {"motion_pattern_confidence", "0 to 1", kHappened, "Confidence in the motion pattern, from 0 to 1",
     read<&R::motion_pattern_confidence>, kNoReason},
    {"ended_by", "-", kHappened, "What ended the test", ended_by, kNoReason},
    {"reason", "-", kHead, "Why the test ended", reason, kNoReason},
    {"warnings", "-", kHead, "Warnings", warnings, kNoReason},
    {"not_equilibrated", "-", kCertificate, "Whether the specimen was not at rest as its pull began", not_equilibrated,
     kNoReason},

    // The knots as they were tied.
    {"preload", "N", kKnots, "Pre-load by which the knots were tied", read<&F::preload>, "nothing was tied"},
    {"tied_knot_distance", "m", kKnots, "Knot distance once tied", read<&R::tied_knot_distance>, kNoKnots},
    {"knot_distance", "m", kKnots, "Knot distance as the pull begins", read<&R::knot_distance>, kNoKnots},
    {"excess_length", "m", kKnots, "Length of rod within each knot once tied", of_knots<&R::tied_excess_length>,
     kNoExcess},
    {"final_excess_length", "m", kKnots, "Length of rod within each knot at the end", of_knots<&R::final_excess_length>,
     kNoExcess},
    {"tail_slip", "m", kKnots, "Length of each free end that ran into the knot in the pull", of_knots<&R::tail_slip>,
     why_no_tail_slip},
    {"knot_readings", "-", kKnots, "Names of what the knot's file reads of it", knot_readings, kNoReason},
    {"knot_reading_begin", "m", kKnots, "What they are as the pull begins", of_knots<&R::knot_reading_begin>,
     why_no_reading},
    {"knot_reading_end", "m", kKnots, "What they are at the end of the pull", of_knots<&R::knot_reading_end>,
     why_no_reading},
    {"opened_when_mounted", "m", kKnots,
     "How much nearer the knots came as the loop was mounted, where one of them opened or slid",
     read<&R::opened_when_mounted>, "the knots stayed where they were as the loop was mounted"},

    // While the knots slide.
    {"plateau_force", "N", kCurve, "Plateau force, the mean while the knots slide", read<&C::plateau_force>,
     why_no_plateau},
    {"plateau_force_sd", "N", kCurve, "Standard deviation of the plateau force", read<&C::plateau_force_sd>,
     why_no_plateau},
    {"plateau_force_low", "N", kCurve, "Smallest force within the plateau", read<&C::plateau_force_low>,
     why_no_plateau},
    {"plateau_force_high", "N", kCurve, "Largest force within the plateau", read<&C::plateau_force_high>,
     why_no_plateau},
    {"plateau_force_slope", "N/m", kCurve, "Slope of the force over the extension within the plateau",
     read<&C::plateau_force_slope>, why_no_plateau},
    {"plateau_force_error", "N", kBeside, "Estimated numerical error of the plateau force",
     read<&ReadingErrors::plateau_force>, why_no_plateau_error},
    {"plateau_slope", "-", kCurve,
     "Slope de/ds of the knot distance within the plateau; \u2013\u20602 is rigid sliding on rollers",
     read<&R::plateau_slope>, why_no_plateau},
    {"breakaway_force", "N", kCurve, "Breakaway force, the largest before the plateau", read<&C::breakaway_force>,
     why_no_plateau},
    {"force_ratio", "-", kCurve, "Mean true force over the second half of a pull that slides, over the tail load",
     force_ratio, why_no_force_ratio},
    {"no_plateau_because", "-", kCurve, "Why there is no plateau", no_plateau_because, "there is a plateau"},
    {"largest_drop", "N", kCurve, "Largest sudden fall of the force before the lock", read<&C::largest_drop>, kNoDrop},
    {"largest_drop_at", "m", kCurve, "Extension at which it began", read<&C::largest_drop_at>, why_no_place_of_drop},
    {"jump_force", "N", kCurve, "Force at which a knot jumped open", read<&C::jump_force>, kNoJump},
    {"jump_extension", "m", kCurve, "Extension at which it jumped open", read<&C::jump_extension>, kNoJump},
    {"force_after_jump", "N", kCurve, "Force that was left when it had jumped", read<&C::force_after_jump>, kNoJump},
    {"snap_extension", "m", kCurve, "Extension at which the knot snapped into another shape", read<&R::snap_extension>,
     why_no_snap},
    {"snap_drop", "N", kCurve, "Force by which the load fell as it snapped", read<&R::snap_drop>, why_no_snap},

    // Where the knots lock, and what the loop is like then.
    {"first_contact_extension", "m", kCurve, "Extension at which the two knots first touch each other",
     read<&R::first_contact_extension>, kNoContact},
    {"lock_extension", "m", kCurve, "Lock extension, where the motion of the knots shows that they lock",
     read<&R::lock_extension>, why_no_lock},
    {"lock_extension_error", "m", kBeside, "Estimated numerical error of the lock extension",
     read<&ReadingErrors::lock_extension>, why_no_lock_error},
    {"lock_extension_by_load", "m", kCurve,
     "Lock extension by the load alone, where it last rises through twice the plateau",
     read<&C::lock_extension_by_load>, why_no_lock_by_load},
    {"locked_stiffness", "N/m", kCurve, "Locked stiffness", read<&C::locked_stiffness>, why_no_stiffness},
    {"locked_stiffness_error", "N/m", kBeside, "Estimated numerical error of the locked stiffness",
     read<&ReadingErrors::locked_stiffness>, why_no_stiffness_error},
    {"peak_force", "N", kCurve, "Peak force", read<&C::peak_force>, why_no_peak},
    {"peak_force_error", "N", kBeside, "Estimated numerical error of the peak force", peak_force_error,
     why_no_peak_error},

    // Without what the balance has set to zero.
    {"peak_extension", "m", kCurve, "Extension at the largest load", read<&R::peak_extension>, why_no_whole_pull},
    {"true_plateau_force", "N", kBeside, "Plateau force, the true one", read<&R::true_plateau_force>, why_no_plateau},
    {"true_breakaway_force", "N", kBeside, "Breakaway force, the true one", read<&R::true_breakaway_force>,
     why_no_plateau},
    {"true_peak_force", "N", kBeside, "Peak force, the true one", true_peak_force, why_no_whole_pull},
    {"true_jump_force", "N", kBeside, "True force at which a knot jumped open", read<&R::true_jump_force>, kNoJump},
    {"true_force_after_jump", "N", kBeside, "True force that was left when it had jumped",
     read<&R::true_force_after_jump>, kNoJump},
    {"balance_offset", "N", kCurve, "Balance offset, by which the true force is larger than the load",
     read<&R::balance_offset>, why_not_pulled},

    // Where the rod parted or the knot came undone.
    {"break_extension", "m", kCurve, "Extension at break", read<&R::break_extension>, why_no_break},
    {"break_arclength", "m", kCurve, "Place of the break, measured along the rod", read<&R::break_arclength>,
     why_no_break},
    {"break_place", "-", kCurve, "What touched the rod at the place of the break", break_place, kNoReason},
    {"knot_efficiency", "of the strength without a knot", kCurve,
     "Knot efficiency, the strength with the knot over that of as many straight strands", knot_efficiency,
     why_no_efficiency},
    {"knot_efficiency_error", "of the strength without a knot", kBeside,
     "Estimated numerical error of the knot efficiency", knot_efficiency_error, why_no_efficiency_error},
    {"knot_inner_diameter", "m", kKnots, "Inner diameter of the knot at the end, that of the thickest straight pin",
     read<&F::knot_hole>, why_no_hole},
    {"knotability", "-", kKnots, "Knotability, the inner diameter of the knot over the diameter of the rod",
     knotability, why_no_hole},
    {"failure_mode", "-", kHappened, "Failure mode", failure_mode, "the specimen did not fail"},
    {"roller_touched_at", "m", kHappened, "Extension from which a roller bore on a knot or its tail",
     read<&R::roller_touched_at>, kNoTouch},
    {"untangled_at", "s", kHappened, "Time at which the knot came undone", read<&R::untangled_at>,
     "the knot did not come undone"},
    {"knot_type_preserved", "-", kCertificate, "Whether the knot remained the same knot", knot_type_preserved,
     "how its free ends lie would decide which knot it is"},

    // What the run should be judged by.
    {"max_penetration", "of the radius", kCertificate, "Deepest contact", read<&R::max_penetration>, kNoReason},
    {"fastest_node", "m/s", kKnots, "Largest speed of a node until the knots lock", read<&R::fastest_node>, kNoReason},
    {"drag_share", "-", kEnergy, "Share of drag in the force", read<&RateShares::drag>, why_not_pulled},
    {"inertia_share", "-", kEnergy, "Share of inertia in the force", read<&RateShares::inertia>, why_not_pulled},
    {"numerical_share", "-", kEnergy, "Share of numerical dissipation in the force", read<&RateShares::numerical>,
     why_not_pulled},
    {"force_balance_error", "-", kCertificate,
     "Difference of the forces at both grips, as a share of the largest force", read<&R::force_balance_error>,
     why_not_pulled},
    {"moment_balance_error", "-", kComputation,
     "Moment of friction at the surfaces of strands that acts on their centrelines, over force times radius",
     moment_balance_error, why_not_pulled},

    // Where the work went.
    {"work", "J", kEnergy, "Work of the grips", read<&E::work>, why_not_pulled},
    {"stored_energy", "J", kEnergy, "Energy stored in rod and contacts", read<&E::stored>, why_not_pulled},
    {"kinetic_energy", "J", kEnergy, "Kinetic energy at the end", read<&R::kinetic_energy>, why_not_pulled},
    {"friction_loss", "J", kEnergy, "Energy lost to friction", read<&E::friction>, why_not_pulled},
    {"plastic_loss", "J", kEnergy, "Energy lost in the rod", read<&E::plastic>, why_not_pulled},
    {"drag_loss", "J", kEnergy, "Energy lost to drag", read<&E::drag>, why_not_pulled},
    {"numerical_dissipation", "J", kEnergy, "Energy lost in the time steps (numerical dissipation)",
     read<&E::numerical>, why_not_pulled},
    {"reweighting_loss", "J", kEnergy, "Energy lost as the weights of contacts change", read<&E::reweighting>,
     why_not_pulled},
    {"energy_balance_error", "-", kCertificate, "Error of the energy balance, as a share of the largest energy",
     read<&R::energy_balance_error>, why_not_pulled},

    // More of the curve, as standards ask for it.
    {"load_cell_error", "N", kCurve, "Error of the load cell at the largest load, by its class", load_cell_error,
     kNoCellError},
    {"plateau_load_cell_error", "N", kCurve, "Error of the load cell within the plateau, by its class",
     class_error_at<&R::true_plateau_force>, why_no_cell_error_in_plateau},
    {"energy_to_peak", "J", kCurve, "Energy up to the largest load", read<&R::energy_to_peak>, why_no_whole_pull},
    {"energy_to_break", "J", kCurve, "Energy up to the break", read<&R::energy_to_break>, why_no_break},
    {"chord_stiffness", "N/m", kCurve, "Chord stiffness", read<&R::chord_stiffness>, kNoChord},
    {"secant_stiffness", "N/m", kCurve, "Secant stiffness", read<&R::secant_stiffness>, why_no_whole_pull},
    {"tangent_stiffness", "N/m", kCurve, "Tangent stiffness", read<&R::tangent_stiffness>, why_no_whole_pull},
    {"hold_force_begin", "N", kCurve, "Force at the beginning of the last hold", read<&Relaxation::from>, kNoHold},
    {"hold_force_end", "N", kCurve, "Force at the end of the last hold", read<&Relaxation::to>, kNoHold},
    {"relaxation", "-", kCurve, "Relaxation, the share of the force that the last hold lost", relaxation, kNoHold},
    {"cycles", "-", kCurve, "Cycles that were completed", counted<&R::cycles>, kNoReason},
    {"peak_torque", "N m", kCurve, "Largest torque of the upper clamp once it was turned", read<&R::peak_torque>,
     "the program turns no clamp"},
    {"hysteresis", "J", kCurve, "Energy lost in one cycle (hysteresis)", read<&R::hysteresis>, kNoCycle},
    {"gauge_length", "m", kCurve, "Gauge length, between the grips where the pull begins", read<&R::gauge_length>,
     why_not_pulled},
    {"elongation_total", kOfGauge, kCurve, "Total elongation, at the outermost place of the last cycle",
     read<&L::total>, kNoCycle},
    {"elongation_elastic", kOfGauge, kCurve, "Elastic elongation, which the last cycle gives back", read<&L::elastic>,
     kNoCycle},
    {"elongation_residual", kOfGauge, kCurve, "Residual elongation, at the end of the last cycle", read<&L::residual>,
     kNoCycle},
    {"elongation_working", kOfGauge, kCurve, "Working elongation in the last cycle, over the length where it ends",
     read<&L::working>, kNoCycle},
    {"elongation_at_break", kOfGauge, kCurve, "Elongation at break", read<&R::elongation_at_break>, why_no_break},

    // What the run cost.
    {"steps", "-", kComputation, "Time steps", counted<&R::steps>, kNoReason},
    {"rejected_steps", "-", kComputation, "Time steps that were made again, shorter", counted<&R::rejected_steps>,
     kNoReason},
    {"newton_iterations", "-", kComputation, "Iterations of Newton's method", counted<&R::newton_iterations>,
     kNoReason},
    {"solved_by_half", "-", kComputation, "Share of these that solved one half of a symmetric rod",
     read<&R::solved_by_half>, kNoReason},
    {"simulated_time", "s", kComputation, "Duration of the test", read<&R::simulated_time>, kNoReason},
    {"wall_time", "s", kComputation, "Duration of the computation", read<&F::wall_time>, kNoReason},
    {"real_time_factor", "-", kComputation, "Duration of the test over that of the computation", real_time_factor,
     kNoReason},
    {"peak_memory", "bytes", kComputation, "Largest memory in use", peak_memory_of, "not known"},
    {"seed", "-", kComputation, "Seed of the load cell's noise", seed, kNoReason},
    {"version", "-", kComputation, "Version of knot_utm", version_of, kNoReason},

    // Whether it is what was asked for.
    {"specification_passed", "-", kHead, "Whether the test meets its specification", specification_passed,
     "the method has no specification"},
    {"specification_failed", "-", kHead, "Requirements that are not met", specification_failed, kNoReason},
};

void add(const char* key, const std::optional<double>& value, YamlLines& lines) { lines.number(key, value); }
void add(const char* key, const std::optional<std::uint64_t>& value, YamlLines& lines) { lines.count(key, value); }
void add(const char* key, const std::optional<bool>& value, YamlLines& lines) { lines.flag(key, value); }
void add(const char* key, const char* value, YamlLines& lines) { lines.word(key, value); }
void add(const char* key, const std::string& value, YamlLines& lines) { lines.text(key, value); }
void add(const char* key, const std::vector<double>& value, YamlLines& lines) { lines.numbers(key, value); }
void add(const char* key, const std::vector<std::string>& value, YamlLines& lines) { lines.list(key, value); }

/// The whole file, or of it the keys that are numbers.
YamlLines lines_of(const ResultSource& source, bool only_numbers) {
  YamlLines lines;
  for (const ResultKey& key : result_keys()) {
    if (only_numbers && !key.is_number()) continue;
    std::visit([&](const auto read) { add(key.name, read(source), lines); }, key.read);
  }
  return lines;
}

}  // namespace

std::string NullReason::operator()(const ResultSource& source) const {
  return of_a_pull_ ? of_the_pull(source, always_) : find_ ? find_(source) : always_;
}

const char* ResultKey::kind() const {
  constexpr std::array kKinds{"number", "count", "flag", "word", "text", "numbers", "list"};
  static_assert(kKinds.size() == std::variant_size_v<ReadResult>);
  return kKinds[read.index()];
}

int ResultKey::table() const {
  const auto found = std::find_if(std::begin(kTables), std::end(kTables),
                                  [this](const char* title) { return std::string(title) == group; });
  return found == std::end(kTables) ? 0 : static_cast<int>(found - std::begin(kTables)) + 1;
}

bool ResultKey::is_number() const {
  return std::holds_alternative<ReadNumber>(read) || std::holds_alternative<ReadCount>(read);
}

const std::vector<ResultKey>& result_keys() {
  static const std::vector<ResultKey> keys(std::begin(kKeys), std::end(kKeys));
  return keys;
}

const ResultKey* result_key(const std::string& name) {
  const auto found =
      std::find_if(result_keys().begin(), result_keys().end(), [&](const ResultKey& one) { return one.name == name; });
  return found == result_keys().end() ? nullptr : &*found;
}

std::string result_keys_csv() {
  std::string all = "key,unit,kind,group,table,meaning\n";
  for (const ResultKey& key : result_keys())
    all += std::string(key.name) + ',' + key.unit + ',' + key.kind() + ',' + key.group + ',' +
           std::to_string(key.table()) + ",\"" + key.meaning + "\"\n";
  return all;
}

std::string result_yaml(const Results& results, const RunFacts& facts) {
  ResultSource source{results, facts, known_errors(results, facts), {}};
  source.verdict = verdict(facts.specification, lines_of(source, true));
  YamlLines lines = lines_of(source, false);
  lines.explain_nulls([&](const std::string& name) {
    const ResultKey* key = result_key(name);
    return key ? key->why_null(source) : "";
  });
  return lines.all();
}

void check_specification(const Specification& specification) {
  std::vector<std::string> known;
  for (const ResultKey& key : result_keys())
    if (key.is_number()) known.emplace_back(key.name);
  for (const Requirement& required : specification)
    if (std::find(known.begin(), known.end(), required.key) == known.end())
      throw InvalidInput::unknown_key("specification", required.key, known, "a specification");
}

Verdict verdict(const Specification& specification, const YamlLines& results) {
  Verdict verdict;
  for (const Requirement& required : specification) {
    const std::optional<double> value = results.value(required.key);
    const std::string is = required.key + " is " + (value ? format_number(*value) : "");
    if (!value)
      verdict.failed.push_back(required.key + " has no value in this test");
    else if (required.min && !(*value >= *required.min))
      verdict.failed.push_back(is + ", less than the least that is allowed, " + format_number(*required.min));
    else if (required.max && !(*value <= *required.max))
      verdict.failed.push_back(is + ", more than the most that is allowed, " + format_number(*required.max));
  }
  if (!specification.empty()) verdict.passed = verdict.failed.empty();
  return verdict;
}

}  // namespace knot_utm
