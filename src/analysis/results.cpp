#include "knot_utm/analysis/results.hpp"

#include <algorithm>
#include <cmath>

#include "knot_utm/analysis/curve_row.hpp"
#include "knot_utm/analysis/pull_readings.hpp"
#include "knot_utm/program/phases.hpp"
#include "knot_utm/record/sample.hpp"

namespace knot_utm {
namespace {

std::optional<double> known(double value) { return std::isfinite(value) ? std::optional<double>(value) : std::nullopt; }

/// The fastest node of the pull until the knots lock, or to its end where they never do [m/s].
double fastest_node_while_sliding(const std::vector<Sample>& samples, std::optional<double> lock_extension) {
  double fastest = 0.0;
  for (const Sample& sample : samples)
    if (pulls(sample.phase) && sample.status != BenchStatus::kBroken &&
        !(lock_extension && sample.extension > *lock_extension))
      fastest = std::max(fastest, sample.fastest_node);
  return fastest;
}

std::string failure_mode(const Results& results) {
  if (results.untangled_at) return "untangling";
  if (results.ended_by != EndedBy::kBreak) return "";
  switch (results.motion_pattern) {
    case MotionPattern::kUntangling:
      return "untangling then fracture";
    case MotionPattern::kSliding:
      return "sliding then fracture";
    case MotionPattern::kStretching:
      return "stretching then fracture";
    default:
      return "fracture";
  }
}

PullPoint pull_point(const Sample& sample) {
  return {sample.time, sample.extension, sample.knot_distance, sample.force_upper, sample.normal_force};
}

/// Adds the origin in front and, if the rod parted further out in a hold, the point of the break behind.
Pull with_ends(const Pull& pull, const std::optional<Sample>& origin, const std::optional<Sample>& at_break) {
  Pull whole = pull;
  if (origin && origin->extension < pull.front().extension) whole.insert(whole.begin(), pull_point(*origin));
  if (at_break && at_break->extension > pull.back().extension) whole.push_back(pull_point(*at_break));
  return whole;
}

void read_pull(const Pull& pull, Results& results) {
  if (!results.break_extension) results.steady_force = steady_force(pull);
  if (!results.never_in_tension) results.energy_to_peak = energy_to_peak(pull);
  if (results.break_extension) results.energy_to_break = energy(pull);
  results.chord_stiffness = chord_stiffness(pull);
  results.secant_stiffness = secant_stiffness(pull);
  results.tangent_stiffness = tangent_stiffness(pull);
}

/// Rows of curve.csv, up to the break.
std::vector<CurveRow> rows_of(const std::vector<Sample>& readings) {
  std::vector<CurveRow> rows;
  for (const Sample& reading : readings) {
    rows.push_back(curve_row(reading));
    if (reading.status == BenchStatus::kBroken) break;
  }
  return rows;
}

/// The pull with true forces in place of loads. `rows`: of `readings`.
Pull true_pull_of(std::vector<CurveRow> rows, const std::vector<Sample>& readings) {
  const auto first = std::find_if(readings.begin(), readings.end(), [](const Sample& r) { return pulls(r.phase); });
  const double offset = first == readings.end() ? 0.0 : first->balance_offset;
  // Balanced like loads, so that pull_of() sets the origin to zero where a balance did.
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i].load = readings[i].force_upper - offset;
  Pull pull = pull_of(rows);
  for (PullPoint& point : pull) {
    point.force += offset;
    point.borne = point.force;
  }
  return pull;
}

/// What the motion of the knots says about their sliding force. There is none if the knot came undone or opened before
/// the pull, and a level force is a sliding force only if the knots slide.
KnotsOfPull knots_of(const Results& results) {
  KnotsOfPull knots;
  knots.ended_in_plateau = results.ended_by == EndedBy::kPlateau;
  switch (results.motion_pattern) {
    case MotionPattern::kSliding:
      knots.slid_to_end = !results.lock_extension;
      break;
    case MotionPattern::kStretching:
      knots.not_sliding = "the load is level, but the knots do not slide: they stretch";
      break;
    case MotionPattern::kNone:
      knots.not_sliding = "the load is level, but only two knots that slide towards each other have a plateau";
      break;
    case MotionPattern::kUntangling:
      knots.untangled = true;
      if (results.knot_type == KnotType::kCrossed)
        knots.lost = "the rod ran through itself";
      else if (results.untangled_at)
        knots.lost = "the knot came undone";
      else if (results.opened_when_mounted)
        knots.lost = "a knot opened as the loop was mounted";
      break;
  }
  return knots;
}

// A roller touches a knot from this force on; a tail that brushes along it causes less [of the true force].
constexpr double kTouch = 0.05;

/// Keeps the first extension at which a force on the knots exceeds `least` [m].
void keep_first(const Sample& sample, double force, double least, std::optional<double>& first) {
  if (!first && force > least) first = sample.extension;
}

/// Forces up to this fraction of the largest one of a compression are residuals of a state of rest [-].
constexpr double kTensile = 1e-3;

/// Readings of the curve, given the motion of the knots.
void read_curve(const std::vector<Sample>& readings, const std::optional<Sample>& at_break, bool on_rollers,
                Results& results) {
  const std::vector<CurveRow> rows = rows_of(readings);
  const Pull pull = pull_of(rows), true_pull = true_pull_of(rows, readings);
  results.curve = curve_readings(pull, on_rollers, hidden_rod_of(rows), knots_of(results));
  if (const std::optional<Drop>& jumped = results.curve.jumped) {
    results.true_jump_force = true_pull[jumped->from].force;
    results.true_force_after_jump = true_pull[jumped->to].force;
  }
  double largest = 0.0;
  for (const PullPoint& point : true_pull) largest = std::max(largest, std::abs(point.force));
  const auto tensile = [&](double force) {
    return force > kTensile * largest ? std::optional<double>(force) : std::nullopt;
  };
  if (!pull.empty()) {
    results.true_peak_force = tensile(peak_force(true_pull));
    results.peak_extension = peak_extension(pull);
  }
  if (at_break) {  // An empty optional compares below any number: this also sets a peak that was never read.
    if (tensile(at_break->load) > results.curve.peak_force) {
      results.curve.peak_force = tensile(at_break->load);
      results.peak_extension = at_break->extension;
    }
    results.true_peak_force = std::max(results.true_peak_force, tensile(at_break->force_upper));
  }
  results.never_in_tension = !pull.empty() && !results.true_peak_force;
  if (results.never_in_tension) results.curve.peak_force = results.peak_extension = std::nullopt;
  if (!results.curve.plateau_force) return;
  const double end = results.curve.slides_to;
  results.true_plateau_force = plateau(true_pull, end)->force;
  results.true_breakaway_force = breakaway_force(true_pull, end);
  results.plateau_slope = known(plateau(pull, end)->slope);
}

}  // namespace

EnergyParts energy_between(const Sample& from, const Sample& to) {
  EnergyParts parts;
  parts.work = to.grip_work - from.grip_work;
  parts.stored = stored_energy(to) - stored_energy(from);
  parts.kinetic = to.kinetic_energy - from.kinetic_energy;
  parts.friction = to.friction_loss - from.friction_loss;
  parts.plastic = to.plastic_loss - from.plastic_loss;
  parts.drag = to.dissipation - from.dissipation - parts.friction - parts.plastic;
  parts.numerical = to.numerical_dissipation - from.numerical_dissipation;
  parts.reweighting = to.reweighting_loss - from.reweighting_loss;
  return parts;
}

namespace {

// Next to no load: below this fraction of the median force of a pull, or, if most of a pull has none, of the largest.
constexpr double kBears = 0.5, kLeast = 1e-4;

/// One pass over all samples in order, which collects what several readings need.
class SamplePass {
 public:
  SamplePass(const std::vector<Sample>& samples, bool on_rollers, double hung, double marks, Results& results)
      : motion(on_rollers, hung, marks), samples_(samples), results_(results) {
    for (const Sample& sample : samples) add(sample);
  }

  MotionPatternTracker motion;
  std::optional<Sample> at_break;       ///< the first one of a parted rod
  const Sample* before_pull = nullptr;  ///< the last one before the pull
  const Sample* pull_begin = nullptr;   ///< the first one of the pull

  /// The sample once the knot is tied and released; the first one of the pull if nothing is tied.
  const Sample* tied() const { return tied_ ? tied_ : pull_begin; }

  void read_balances() const {
    if (pull_begin) {
      // The recoil of parted ends is no part of the test, so the balance ends at the break.
      const Sample& end = at_break ? *at_break : samples_.back();
      results_.energy = energy_between(before_pull ? *before_pull : *pull_begin, end);
      results_.kinetic_energy = end.kinetic_energy;
    }
    if (energy_scale_ > 0.0) results_.energy_balance_error = energy_error_ / energy_scale_;
    if (motion.pull().empty()) return;
    const double peak = std::max(peak_force(motion.pull()), at_break ? at_break->force_upper : 0.0);
    if (!(peak > 0.0)) return;
    results_.force_balance_error = imbalance_ / peak;
    results_.moment_arm = largest_moment_arm();
  }

 private:
  double largest_moment_arm() const {
    std::vector<double> forces;
    for (const Load& load : loads_) forces.push_back(load.force);
    const auto middle = forces.begin() + static_cast<std::ptrdiff_t>(forces.size() / 2);
    std::nth_element(forces.begin(), middle, forces.end());
    const double least = std::max(kBears * *middle, kLeast * *std::max_element(forces.begin(), forces.end()));
    double largest = 0.0;
    for (const Load& load : loads_)
      if (load.force > least && load.force > 0.0) largest = std::max(largest, load.moment / load.force);
    return largest;
  }

  void add(const Sample& sample) {
    const bool recoils = at_break.has_value();  // samples after a break say nothing about the test
    if (sample.status == BenchStatus::kBroken && !recoils) {
      if (loaded_ || loads(sample)) results_.break_extension = sample.extension;
      at_break = sample;
    }
    loaded_ |= loads(sample);
    before_ = &sample;
    motion.add(sample);
    if (!recoils) results_.max_penetration = std::max(results_.max_penetration, sample.max_penetration);
    if (sample.status == BenchStatus::kNotEquilibrated) results_.not_equilibrated = sample.message;
    add_energies(sample);
    if (sample.turn != 0.0 && std::abs(sample.torque) > results_.peak_torque.value_or(0.0)) {
      results_.peak_torque = std::abs(sample.torque);
      results_.tension_at_peak_torque = sample.force_upper;
      results_.span_at_peak_torque = sample.end_to_end;
    }
    if (!recoils) add_thrust(sample);
    if (forms(sample.phase)) tied_ = &sample;
    if (pulls(sample.phase))
      add_pull(sample, recoils);
    else if (!pull_begin)
      before_pull = &sample;
  }

  /// In a rod that has buckled, bending stores nearly all energy; it does not count.
  void add_thrust(const Sample& sample) {
    if (-sample.force_upper <= results_.largest_thrust || sample.bending_energy > sample.stretching_energy) return;
    results_.largest_thrust = -sample.force_upper;
    results_.span_at_largest_thrust = sample.end_to_end;
  }

  /// Whether the crosshead puts a load on the specimen. In a hold it moves only where a load is kept.
  bool loads(const Sample& sample) const {
    return knot_utm::loads(sample.phase) ||
           (sample.phase == Phase::kHold && before_ && sample.displacement != before_->displacement);
  }

  void add_energies(const Sample& sample) {
    const EnergyParts parts = energy_between(samples_.front(), sample);
    energy_error_ = std::max(energy_error_, std::abs(parts.gap()));
    energy_scale_ = std::max(
        {energy_scale_, std::abs(parts.stored + parts.kinetic), std::abs(parts.losses()), std::abs(parts.work)});
  }

  void add_pull(const Sample& sample, bool recoils) {
    if (!pull_begin) pull_begin = &sample;
    if (recoils) return;
    keep_first(sample, sample.knots_force, 0.0, results_.first_contact_extension);
    keep_first(sample, sample.knot_on_roller, kTouch * std::abs(sample.force_upper), results_.roller_touched_at);
    imbalance_ = std::max(imbalance_, std::abs(sample.force_upper - sample.force_lower));
    loads_.push_back({sample.force_upper, sample.moment_imbalance});
  }

  const std::vector<Sample>& samples_;
  Results& results_;
  double imbalance_ = 0.0;
  struct Load {
    double force, moment;  // [N], sum of all moments [N m]
  };
  std::vector<Load> loads_;  // of the pull
  double energy_error_ = 0.0, energy_scale_ = 0.0;
  bool loaded_ = false;  // something has put a load on the specimen
  const Sample* before_ = nullptr;
  const Sample* tied_ = nullptr;
};

void read_motion(const std::vector<Sample>& samples, const std::vector<Sample>& readings, bool on_rollers,
                 MotionPatternTracker& motion, Results& results) {
  const std::vector<CurveRow> rows = rows_of(readings);
  motion.set_jumped(jump(borne_of(pull_of(rows)), on_rollers, hidden_rod_of(rows)).has_value());
  results.opened_when_mounted = motion.opened_when_mounted();
  results.motion_pattern = motion.pattern();
  results.motion_pattern_confidence = motion.confidence();
  results.lock_extension = motion.lock_extension();
  results.fastest_node = fastest_node_while_sliding(samples, results.lock_extension);
  results.untangled_at = motion.untangled_at();
  results.rate = rate_shares(samples, results.lock_extension, results.untangled_at);
  results.failure_mode = failure_mode(results);
}

void read_snap(const std::vector<Sample>& samples, Results& results) {
  if (std::isfinite(samples.back().knot_distance)) return;  // knots jump open, and do not snap
  const std::optional<Snap> found = snap(samples);
  if (!found) return;
  results.snap_extension = found->extension;
  results.snap_drop = found->drop;
}

void read_end(const Sample& last, Results& results) {
  results.knot_type = last.knot_type;
  results.break_arclength = known(last.break_arclength);
  results.break_place = last.break_place;
  results.steps = last.steps;
  results.rejected_steps = last.rejected_steps;
  results.newton_iterations = last.newton_iterations;
  if (last.newton_iterations > 0)
    results.solved_by_half = static_cast<double>(last.half_iterations) / static_cast<double>(last.newton_iterations);
  results.simulated_time = last.time;
  results.final_excess_length = last.excess_length;
}

void read_gauge_length(const SamplePass& pass, Results& results) {
  if (!pass.pull_begin) return;
  const double length = (pass.before_pull ? pass.before_pull : pass.pull_begin)->end_to_end;
  if (!(length > 0.0)) return;
  results.gauge_length = length;
  if (pass.at_break) results.elongation_at_break = (pass.at_break->end_to_end - length) / length;
}

void read_tied(const SamplePass& pass, Results& results) {
  const Sample *tied = pass.tied(), *pull_begin = pass.pull_begin;
  if (pull_begin) {
    results.balance_offset = pull_begin->balance_offset;
    results.knot_distance = known(pull_begin->knot_distance);
  }
  if (!tied) return;
  results.tied_excess_length = tied->excess_length;
  results.tied_knot_distance = known(tied->knot_distance);
}

constexpr double kRanOut = 0.1;  // length of a tail that has run out of its knot, over its first length

/// Slip of each tail from the first sample of the pull to the last one that counts. A rope that has come out of its
/// knot may touch others again, which says nothing about its tail: samples no longer count once it touches none after
/// the largest load, or once its tail had run out and is long again.
void read_tails(const std::vector<Sample>& samples, const Sample* pull_begin, Results& results) {
  if (pull_begin == nullptr) return;
  const PerKnot& begin = pull_begin->tail_length;
  results.tail_slip = PerKnot::unknown(begin.size());
  const auto first = std::find_if(samples.begin(), samples.end(),
                                  [&](const Sample& sample) { return sample.time >= pull_begin->time; });
  const auto largest = std::max_element(first, samples.end(),
                                        [](const Sample& a, const Sample& b) { return a.force_upper < b.force_upper; });
  for (std::size_t k = 0; k < begin.size(); ++k) {
    const double short_tail = kRanOut * begin[k];
    bool ran_out = false;
    for (auto sample = first; sample != samples.end(); ++sample) {
      const double length = sample->tail_length.at(k);
      if (std::isnan(length) ? sample > largest : ran_out && length > short_tail) break;
      if (std::isnan(length)) continue;
      results.tail_slip[k] = begin[k] - length;
      ran_out |= length < short_tail;
    }
  }
}

/// Only answers to commands have these readings. One that is unknown as the pull begins starts with its first known
/// value.
void read_knot(const std::vector<Sample>& samples, const Sample* pull_begin, Results& results) {
  if (pull_begin == nullptr) return;
  PerKnot &begin = results.knot_reading_begin, &end = results.knot_reading_end;
  for (const Sample& sample : samples) {
    const PerKnot& now = sample.knot_readings;
    if (begin.size() < now.size()) begin = end = PerKnot::unknown(now.size());
    for (std::size_t k = 0; k < now.size(); ++k) {
      if (sample.time <= pull_begin->time || !std::isfinite(begin[k])) begin[k] = now[k];
      if (sample.time >= pull_begin->time && std::isfinite(now[k])) end[k] = now[k];
    }
  }
}

void read_whole_pull(const SamplePass& pass, Results& results) {
  const Pull& pull = pass.motion.pull();
  if (pull.empty()) return;
  std::optional<Sample> origin, at_break = pass.at_break;
  if (pass.before_pull) origin = origin_at(*pass.pull_begin, *pass.before_pull);
  if (at_break && at_break->balance_offset != pass.pull_begin->balance_offset) at_break.reset();  // another s
  read_pull(with_ends(pull, origin, at_break), results);
}

/// Drops readings that need the whole pull, of one that ended within its plateau. The largest true force stays, as it
/// says that something was pulled.
void forget_rest_of_pull(Results& results) {
  CurveReadings& curve = results.curve;
  for (std::optional<double>* reading :
       {&curve.peak_force, &curve.largest_drop, &curve.largest_drop_at, &results.peak_extension,
        &results.energy_to_peak, &results.chord_stiffness, &results.secant_stiffness, &results.tangent_stiffness})
    reading->reset();
}

}  // namespace

Results analyse(const std::vector<Sample>& samples, const std::vector<Sample>& readings, EndedBy ended_by,
                bool on_rollers, double hung, double marks, const std::vector<int>& steps) {
  Results results;
  results.ended_by = ended_by;
  if (samples.empty()) return results;
  SamplePass pass(samples, on_rollers, hung, marks, results);
  read_end(samples.back(), results);
  read_motion(samples, readings, on_rollers, pass.motion, results);
  read_tied(pass, results);
  read_tails(samples, pass.pull_begin, results);
  read_knot(samples, pass.pull_begin, results);
  read_snap(samples, results);
  read_curve(readings, pass.at_break, on_rollers, results);
  pass.read_balances();
  results.at_start = forces_at_start(samples);
  read_gauge_length(pass, results);
  read_holds_and_cycles(samples, steps, results);
  read_whole_pull(pass, results);
  if (ended_by == EndedBy::kPlateau) forget_rest_of_pull(results);
  return results;
}

}  // namespace knot_utm
