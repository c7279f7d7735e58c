#include "knot_utm/io/run_writer.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "knot_utm/io/gravity_warnings.hpp"
#include "knot_utm/io/null_reasons.hpp"
#include "knot_utm/io/run_folder.hpp"
#include "knot_utm/io/speed_warnings.hpp"
#include "knot_utm/io/verdict.hpp"
#include "knot_utm/io/yaml_lines.hpp"
#include "knot_utm/machine/before_tying.hpp"
#include "knot_utm/machine/fracture.hpp"
#include "knot_utm/machine/grips.hpp"
#include "knot_utm/machine/load_cell.hpp"
#include "knot_utm/numeric/number.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/specimen/scales.hpp"

namespace knot_utm {
namespace {

namespace fs = std::filesystem;

std::string begin(const std::string& folder, const Method& method) {
  make_run_folder(folder);
  begin_run_folder(folder, method);
  return folder;
}

/// Of a loop around its rollers, by choice: half of the diameter of the default roller [h].
constexpr double kLargestLoopTurn = 6.0;
/// A contact deeper than this is no longer that of the rod it stands for [fraction of radius].
constexpr double kDeep = 0.05;
/// Where energies miss the work by more, what Newton's method leaves unbalanced has a part in the forces too: seen
/// where a loose loop pulls with far less than k_b/h^2, of which `physics.residual` is a share.
constexpr double kUnbalanced = 0.01;

std::vector<std::string> warnings(const Results& results) {
  std::vector<std::string> all;
  if (results.knot_type == KnotType::kCrossed) {
    all.push_back("the rod ran through itself at " + short_number(results.untangled_at.value_or(Sample::kNone)) + " s");
  }
  if (results.untangled_at && results.knot_type != KnotType::kCrossed && results.ended_by != EndedBy::kUntangled) {
    all.push_back("the knot came undone at " + short_number(*results.untangled_at) +
                  " s, while it was pulled, so there is no sliding force");
  }
  if (results.knot_type == KnotType::kChanged && !results.untangled_at) {
    all.push_back(
        "with its two ends joined, the rod is another knot than at the start; as it still bears the load, nothing came "
        "undone");
  }
  if (results.max_penetration > kDeep) {
    all.push_back("strands are pressed into each other by up to " + format_number(results.max_penetration) + " radii");
  }
  if (results.energy_balance_error > kUnbalanced) {
    all.push_back("the energies and the work differ by " + format_number(*results.energy_balance_error) +
                  " of the work: choose a smaller physics.residual");
  }
  return all;
}

/// What the cell cannot tell: forces below its floor, or beyond its stop.
std::vector<std::string> warnings(const Results& results, const LoadCellOptions& cell) {
  std::vector<std::string> all;
  const std::string floor = "the load cell's floor of " + format_number(cell.floor * cell.capacity) + " N";
  if (results.true_peak_force && is_below_floor(cell, *results.true_peak_force)) {
    all.push_back("the peak force lies below " + floor);
  } else if (results.true_plateau_force && is_below_floor(cell, *results.true_plateau_force)) {
    all.push_back("the plateau force lies below " + floor);
  }
  const double stop = cell.overload * cell.capacity;
  if (results.true_peak_force > stop) {
    all.push_back("the load cell was overloaded: above " + format_number(stop) +
                  " N it reads the force at its mechanical stop");
  }
  return all;
}

std::optional<double> class_error(const LoadCellOptions& cell, const std::optional<double>& force) {
  return force ? class_error(cell, *force) : std::nullopt;
}

/// By how much a stiffness changes where the part that it is read from lies a little further along the curve: by twice
/// as much as the lock may be off, or where there is none by a share of the part [-].
double change_along_the_curve(const Results& results, const ReadingErrors& errors) {
  constexpr double kOfLock = 2.0, kFurther = 0.3;  // chosen with the constants of reading_errors (measured.hpp)
  const std::optional<LockedPart>& part = results.curve.locked;
  if (!part || !(part->width > 0.0) || part->stiffness == 0.0) return 0.0;
  const bool locks = results.lock_extension && errors.lock_extension;
  const double further = locks ? kOfLock * *errors.lock_extension * *results.lock_extension / part->width : kFurther;
  return std::abs(part->change / part->stiffness) * further;
}

/// What the cell's noise makes of a stiffness, at 95 % [-]. Each of its three slopes, from n/3 readings over a third of
/// the width w, has a standard deviation of (12/(n/3))^1/2 noise/(w/3), and the middle one of them 0.67 times that.
double noise_of_stiffness(const Results& results, double noise) {
  const std::optional<LockedPart>& part = results.curve.locked;
  if (!part || !(part->width > 0.0) || part->stiffness == 0.0) return 0.0;
  return std::abs(1.96 * 0.67 * std::sqrt(36.0 / part->points) * noise / (part->width / 3.0) / part->stiffness);
}

/// Of readings whose specimen had not come to rest, or whose knots opened, no study says how far off they are. What
/// drag and inertia take of the force is in forces and their slopes, beside what mesh and tolerances move.
ReadingErrors known_errors(const Results& results, const RunFacts& facts) {
  if (!results.not_equilibrated.empty() || results.curve.jump_force || results.opened_when_mounted) return {};
  ReadingErrors out = facts.errors;
  if (out.plateau_force && results.true_plateau_force)
    *out.plateau_force *= hardly_closed(*results.true_plateau_force, facts.material);
  // Studied are locks that the knots have come to, not loads that rise while they still slide.
  if (slid_to_the_end(results)) out.locked_stiffness.reset();
  if (out.locked_stiffness) *out.locked_stiffness += change_along_the_curve(results, out);
  const double speed = results.rate.drag.value_or(0.0) + results.rate.inertia.value_or(0.0);
  for (std::optional<double>* error : {&out.plateau_force, &out.locked_stiffness})
    if (*error) **error += speed;
  if (out.locked_stiffness) *out.locked_stiffness += noise_of_stiffness(results, facts.load_cell.noise);
  return out;
}

std::optional<double> share_of(const std::optional<double>& reading, const std::optional<double>& share) {
  return reading && share ? std::optional<double>(std::abs(*reading) * *share) : std::nullopt;
}

}  // namespace

std::vector<std::string> events(const Results& results) {
  std::vector<std::string> all;
  const CurveReadings& curve = results.curve;
  if (results.opened_when_mounted)
    all.push_back("a knot opened as the loop was mounted: before the pull the knots had come nearer to each other by " +
                  short_number(*results.opened_when_mounted) + " m");
  if (curve.jump_force)
    all.push_back("a knot jumped open at an extension of " + short_number(*curve.jump_extension) +
                  " m: the load went from " + short_number(*curve.jump_force) + " N to " +
                  short_number(*curve.force_after_jump) + " N, and later readings belong to a looser knot");
  if (slid_to_the_end(results) && results.true_plateau_force)
    all.push_back(
        "the pull ended while the knots still slid: the plateau force is the mean over the way that was pulled; where "
        "the load rises it is smaller than the mean up to the lock");
  if (results.roller_touched_at)
    all.push_back("a roller bore on a knot or its tail from an extension of " +
                  short_number(*results.roller_touched_at) + " m on");
  constexpr double kMuchBalanced = 0.1;
  const double balanced = results.balance_offset.value_or(0.0), plateau = results.true_plateau_force.value_or(0.0);
  if (plateau > 0.0 && std::abs(balanced) > kMuchBalanced * plateau)
    all.push_back("the balance set " + short_number(balanced) + " N to zero, of a sliding force that is in truth " +
                  short_number(plateau) + " N: see true_plateau_force");
  return all;
}

std::string accuracy_warning(const Results& results, const ReadingErrors& errors) {
  if (!results.not_equilibrated.empty()) return results.not_equilibrated;
  constexpr double kUnsure = 0.1;
  if (!results.true_plateau_force || results.curve.jump_force || errors.plateau_force.value_or(0.0) <= kUnsure)
    return {};
  return "the plateau force may be off by " + format_number(std::round(100.0 * *errors.plateau_force)) +
         " %; choose a finer physics.accuracy, a higher specimen.refinement or a lower specimen.preload to reduce the "
         "error";
}

namespace {

/// Knots that go on their way as they are let go are tied at another distance than was asked for.
std::string knots_travelled(const Results& results, const RunFacts& facts) {
  constexpr double kFar = 0.05;  // of the distance, by choice: shipped methods are within 1e-3
  if (!results.tied_knot_distance || !(facts.knot_distance > 0.0)) return {};
  if (std::abs(*results.tied_knot_distance / facts.knot_distance - 1.0) <= kFar) return {};
  return "the knots travelled as they were let go: they are " + short_number(*results.tied_knot_distance) +
         " m apart, where specimen.knot_distance is " + short_number(facts.knot_distance) + " m";
}

}  // namespace

std::vector<std::string> told(const Results& results, const RunFacts& facts) {
  std::vector<std::string> all = events(results);
  for (const std::vector<std::string>& more :
       {gravity_warnings(results, facts), speed_warnings(results.rate, facts.inertia),
        snap_warnings(results, facts.pull_speed), facts.warnings})
    all.insert(all.end(), more.begin(), more.end());
  if (const std::string travelled = knots_travelled(results, facts); !travelled.empty()) all.push_back(travelled);
  const std::string unsure = accuracy_warning(results, known_errors(results, facts));
  if (!unsure.empty()) all.push_back(unsure);
  if (!facts.margin.reason.empty()) all.push_back("no margin: " + facts.margin.reason);
  return all;
}

RunWriter::RunWriter(const std::string& folder, const Method& method)
    : folder_(begin(folder, method)),
      curve_((fs::path(folder) / "curve.csv").string(), std::isfinite(method.machine.stiffness)),
      full_curve_((fs::path(folder) / "curve_full.csv").string(), std::isfinite(method.machine.stiffness)) {
  known_.errors = reading_errors(method.specimen, method.material, method.machine, method.physics);
  known_.material = method.material;
  if (method.specimen.to_be_tied) known_.knot_distance = method.specimen.knot_distance;
  if (method.machine.roller_rotation == RollerRotation::kTurned)
    known_.warnings.push_back(
        "the rollers are driven: what holds the far side bears a part of the load, and the two grips read different "
        "forces");
  if (method.specimen.to_be_tied) {
    known_.preload = method.specimen.preload.value_or(Sample::kNone);
    known_.foreseen = tying_warnings(method.specimen, method.material, method.physics);
  }
  weight_per_length_ =
      method.physics.gravity.norm() * method.material.density * M_PI * method.material.radius * method.material.radius;
  if (rollers_hold(method.specimen, method.machine)) radius_on_rollers_ = method.material.radius;
  far_side_held_ = method.machine.far_side == FarSide::kHeld;
  if (method.analysis.margin)
    known_.margin.reason = "only tensile_test makes the runs for the margin: run method.yaml of this folder with it";
  known_.load_cell = method.machine.load_cell;
  known_.inertia = inertia_factor(method.material, method.physics);
  for (const std::string& warning : speed_warnings(method)) known_.warnings.push_back(warning);
  for (const ProgramStep& step : method.program)
    if (pulls(step.phase)) known_.pull_speed = std::max(known_.pull_speed, step.speed);
  known_.specification = method.specification;
  known_.version = version();
}

void RunWriter::add(const Record& record) {
  const Sample& sample = record.answer;
  for (const Sample& step : record.steps) {
    // A bench that has failed answers with the last good step again.
    if (!samples_.empty() && step.time <= samples_.back().time) continue;
    full_curve_.write(step);
    samples_.push_back(step);
  }
  if (sample.status == BenchStatus::kFailed) return;
  const bool mounted = sample.phase != Phase::kIdle && sample.phase != Phase::kTie && sample.phase != Phase::kRelease;
  if (mounted && record.shape.cols() > 0 && sample.status != BenchStatus::kBroken) turn_.add(record.shape);
  if (record.shape.cols() > 1)
    length_ = (record.shape.rightCols(record.shape.cols() - 1) - record.shape.leftCols(record.shape.cols() - 1))
                  .colwise()
                  .norm()
                  .sum();
  const Sample* reading = cell_reading(record);
  if (reading && (readings_.empty() || reading->time > readings_.back().time)) {
    curve_.write(*reading);
    readings_.push_back(*reading);
  }
  if (samples_.empty() || sample.time > samples_.back().time) {
    samples_.push_back(sample);
  } else {
    samples_.back() = sample;
  }
}

Results RunWriter::results(EndedBy ended_by) const { return analyse(samples_, readings_, ended_by); }

RunFacts RunWriter::facts() const {
  RunFacts facts = known_;
  facts.peak_memory = peak_memory();
  facts.weight = weight_per_length_ * length_;
  if (radius_on_rollers_) facts.slid_along = turn_.along();
  if (radius_on_rollers_ && turn_.largest() > kLargestLoopTurn * *radius_on_rollers_)
    facts.warnings.push_back(
        "the loop turned around its rollers by " + format_number(std::round(turn_.largest() / *radius_on_rollers_)) +
        " radii of the rod, which carries its knots along" + (facts.weight > 0.0 ? ": physics.gravity turns it" : "") +
        (far_side_held_
             ? ", though machine.far_side holds it: fixed rollers with machine.roller_friction would keep it in place"
             : "; machine.far_side: held or machine.roller_friction keeps it in place"));
  return facts;
}

void RunWriter::finish(const Results& results, const RunFacts& facts, const Points& final_shape) {
  if (final_shape.cols() > 0) write_centreline((fs::path(folder_) / "final_shape.csv").string(), final_shape);
  write_whole((fs::path(folder_) / "result.yaml").string(), result_yaml(results, facts));
}

namespace {

/// All that a reader should know before he believes a reading.
std::vector<std::string> all_warnings(const Results& r, const RunFacts& f) {
  std::vector<std::string> all = warnings(r);
  for (const std::vector<std::string>& more : {warnings(r, f.load_cell), f.foreseen, told(r, f)})
    all.insert(all.end(), more.begin(), more.end());
  return all;
}

/// How the test went.
void add_course(const Results& r, const RunFacts& f, YamlLines& lines) {
  lines.word("motion_pattern", motion_pattern_name(r.motion_pattern));
  lines.number("motion_pattern_confidence", r.motion_pattern_confidence);
  lines.word("ended_by", ended_by_name(r.ended_by));
  lines.text("reason", f.reason);
  lines.list("warnings", all_warnings(r, f));
  lines.flag("not_equilibrated", !r.not_equilibrated.empty());
}

/// The knots as they were tied.
void add_tying(const Results& r, const RunFacts& f, YamlLines& lines) {
  lines.number("preload", f.preload);
  lines.number("tied_knot_distance", r.tied_knot_distance);
  lines.pair("excess_length", r.tied_excess_length);
  lines.pair("final_excess_length", r.final_excess_length);
}

/// While the knots slide, errors included.
void add_sliding(const Results& r, const RunFacts& f, const ReadingErrors& errors, YamlLines& lines) {
  lines.number("plateau_force", r.curve.plateau_force);
  lines.number("plateau_force_sd", r.curve.plateau_force_sd);
  lines.number("plateau_force_low", r.curve.plateau_force_low);
  lines.number("plateau_force_high", r.curve.plateau_force_high);
  lines.number("plateau_force_slope", r.curve.plateau_force_slope);
  lines.number("plateau_force_error", share_of(r.true_plateau_force, errors.plateau_force));
  lines.number("plateau_slope", r.plateau_slope);
  lines.number("breakaway_force", r.curve.breakaway_force);
  lines.number("margin_friction", f.margin.friction);
  lines.number("margin_preload", f.margin.preload);
  lines.text("no_plateau_because", r.curve.no_plateau);
  lines.number("largest_drop", r.curve.largest_drop);
  lines.number("largest_drop_at", r.curve.largest_drop_at);
  lines.number("jump_force", r.curve.jump_force);
  lines.number("jump_extension", r.curve.jump_extension);
  lines.number("force_after_jump", r.curve.force_after_jump);
}

/// Where the knots lock, and what the loop is like then.
void add_locks(const Results& r, const ReadingErrors& errors, YamlLines& lines) {
  lines.number("first_contact_extension", r.first_contact_extension);
  lines.number("lock_extension", r.lock_extension);
  lines.number("lock_extension_error", share_of(r.lock_extension, errors.lock_extension));
  lines.number("lock_extension_by_load", r.curve.lock_extension_by_load);
  lines.number("locked_stiffness", r.curve.locked_stiffness);
  lines.number("locked_stiffness_error", share_of(r.curve.locked_stiffness, errors.locked_stiffness));
  lines.number("peak_force", r.curve.peak_force);
}

/// Without what the balance has set to zero.
void add_true_forces(const Results& r, YamlLines& lines) {
  lines.number("true_plateau_force", r.true_plateau_force);
  lines.number("true_breakaway_force", r.true_breakaway_force);
  lines.number("true_peak_force", r.true_peak_force);
  lines.number("true_jump_force", r.true_jump_force);
  lines.number("true_force_after_jump", r.true_force_after_jump);
  lines.number("balance_offset", r.balance_offset);
}

/// Where the rod parted or the knot came undone.
void add_failure(const Results& r, YamlLines& lines) {
  lines.number("break_extension", r.break_extension);
  lines.number("break_arclength", r.break_arclength);
  lines.word("break_place", break_place_name(r.break_place));
  lines.text("failure_mode", r.failure_mode);
  lines.number("roller_touched_at", r.roller_touched_at);
  lines.number("untangled_at", r.untangled_at);
  lines.flag("knot_type_preserved", r.knot_type == KnotType::kKept);
}

/// What the run should be judged by.
void add_checks(const Results& r, double radius, YamlLines& lines) {
  lines.number("max_penetration", r.max_penetration);
  lines.number("fastest_node", r.fastest_node);
  lines.number("drag_share", r.rate.drag);
  lines.number("inertia_share", r.rate.inertia);
  lines.number("numerical_share", r.rate.numerical);
  lines.number("force_balance_error", r.force_balance_error);
  lines.number("moment_balance_error",
               r.moment_arm ? std::optional<double>(*r.moment_arm / radius) : std::optional<double>());
}

/// Where the work went.
void add_energies(const Results& r, YamlLines& lines) {
  const auto part = [&](double EnergyParts::*of) { return r.energy ? (*r.energy).*of : Sample::kNone; };
  lines.number("work", part(&EnergyParts::work));
  lines.number("stored_energy", part(&EnergyParts::stored));
  lines.number("kinetic_energy", part(&EnergyParts::kinetic));
  lines.number("friction_loss", part(&EnergyParts::friction));
  lines.number("drag_loss", part(&EnergyParts::drag));
  lines.number("numerical_dissipation", part(&EnergyParts::numerical));
  lines.number("reweighting_loss", part(&EnergyParts::reweighting));
  lines.number("energy_balance_error", r.energy_balance_error);
}

/// More of the curve, as standards ask for it.
void add_curve(const Results& r, const RunFacts& f, YamlLines& lines) {
  lines.number("load_cell_error", class_error(f.load_cell, r.true_peak_force));
  lines.number("plateau_load_cell_error", class_error(f.load_cell, r.true_plateau_force));
  lines.number("energy_to_peak", r.energy_to_peak);
  lines.number("energy_to_break", r.energy_to_break);
  lines.number("chord_stiffness", r.chord_stiffness);
  lines.number("secant_stiffness", r.secant_stiffness);
  lines.number("tangent_stiffness", r.tangent_stiffness);
  lines.number("hold_force_begin", r.relaxation ? r.relaxation->from : Sample::kNone);
  lines.number("hold_force_end", r.relaxation ? r.relaxation->to : Sample::kNone);
  lines.number("relaxation", r.relaxation ? r.relaxation->lost() : Sample::kNone);
  lines.count("cycles", r.cycles);
  lines.number("hysteresis", r.hysteresis);
}

/// What the run cost.
void add_effort(const Results& r, const RunFacts& f, YamlLines& lines) {
  lines.count("steps", r.steps);
  lines.count("rejected_steps", r.rejected_steps);
  lines.count("newton_iterations", r.newton_iterations);
  lines.number("simulated_time", r.simulated_time);
  lines.number("wall_time", f.wall_time);
  lines.number("real_time_factor", f.wall_time > 0.0 ? r.simulated_time / f.wall_time : 0.0);
  if (f.peak_memory > 0) {
    lines.count("peak_memory", f.peak_memory);
  } else {
    lines.number("peak_memory", std::nullopt);
  }
  lines.count("seed", f.load_cell.seed);
  lines.word("version", f.version);
}

YamlLines result_lines(const Results& r, const RunFacts& f) {
  const ReadingErrors errors = known_errors(r, f);
  YamlLines lines;
  add_course(r, f, lines);
  add_tying(r, f, lines);
  add_sliding(r, f, errors, lines);
  add_locks(r, errors, lines);
  add_true_forces(r, lines);
  add_failure(r, lines);
  add_checks(r, f.material.radius, lines);
  add_energies(r, lines);
  add_curve(r, f, lines);
  add_effort(r, f, lines);
  return lines;
}

}  // namespace

std::string result_yaml(const Results& results, const RunFacts& facts) {
  YamlLines lines = result_lines(results, facts);
  const Verdict found = verdict(facts.specification, lines);
  if (found.passed)
    lines.flag("specification_passed", *found.passed);
  else
    lines.word("specification_passed", "null");
  lines.list("specification_failed", found.failed);
  lines.explain_nulls([&](const std::string& key) { return why_null(key, results, facts); });
  return lines.all();
}

std::vector<std::string> result_numbers() { return result_lines(Results{}, RunFacts{}).number_keys(); }

}  // namespace knot_utm
