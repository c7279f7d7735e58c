#include "knot_utm/program/course.hpp"

#include <algorithm>
#include <cmath>

#include "knot_utm/program/phases.hpp"
#include "knot_utm/record/sample.hpp"

namespace knot_utm {
namespace {

constexpr double kTolerance = 1e-9;       // of an extension on a rigid frame [m]
constexpr double kFrameTolerance = 1e-3;  // of an extension on a compliant frame [of the motion in one period]
constexpr double kRigid = 1.0 - 1e-6;     // gain from which a frame counts as rigid
constexpr double kLeastGain = 1e-3;       // of a frame that is much softer than the specimen
constexpr double kCreep = 0.01;           // of the highest speed
// Least motion, over the longest one of a command, from which a slope is taken: over a shorter one, the residual of
// Newton's method would decide it.
constexpr double kCounts = 1e-5;

}  // namespace

bool CrossheadCourse::over(double time) const {
  // The slack is for times that are a multiple of the period.
  return static_cast<double>(last_.sequence - begin_) >= time * command_rate_ - 1e-6;
}

void CrossheadCourse::move(double velocity) { leg_ = {last_.sequence, last_.displacement, velocity}; }

double CrossheadCourse::velocity_to_extension(double left, double fastest) const {
  const double most = fastest * period();
  return std::clamp(left / gain_.value, -most, most) / period();
}

double CrossheadCourse::extension_tolerance(double fastest) const {
  return gain_.value > kRigid ? kTolerance : kFrameTolerance * fastest * period();
}

double CrossheadCourse::speed_to_load(const Sample& now, double load, double fastest, bool creeps) {
  end_load_ = load;
  return load_control_.meeting(now, load, period(), fastest, creeps);
}

double CrossheadCourse::velocity_at_load(const Sample& now, double fastest) {
  return load_control_.following(now, wanted_load_, period(), fastest);
}

double CrossheadCourse::velocity_at_load_rate(const Sample& now, double rate, double fastest, double end) {
  if (leg_.velocity >= fastest) wanted_load_ = balanced_load(now);
  wanted_load_ += rate * period();
  end_load_ = end;
  return load_control_.following(now, std::min(wanted_load_, end), period(), fastest);
}

void CrossheadCourse::begin_step(const Sample& now) {
  begin_ = last_.sequence;
  begin_load_ = wanted_load_ = balanced_load(now);
  begin_turn_ = last_.turn;
  end_load_ = kNoLoad;
  load_control_.begin();
  move(0.0);
  turn(0.0);
}

bool CrossheadCourse::take(const Sample& now) {
  const double moved = now.displacement - gain_.displacement, shift = now.balance_offset - balance_offset_;
  if (std::abs(moved) > kTolerance && !last_.balance)
    gain_.value = std::clamp((now.extension - gain_.extension) / moved, kLeastGain, 1.0);
  gain_.extension = now.extension;
  gain_.displacement = now.displacement;
  if (now.displacement != last_.displacement) {
    last_.displacement = now.displacement;
    move(leg_.velocity);
  }
  balance_offset_ = now.balance_offset;
  wanted_load_ -= shift;
  begin_load_ -= shift;
  load_control_.shift(shift);
  return shift != 0.0;
}

void CrossheadCourse::write_motion(Command& command) const {
  command.velocity = leg_.velocity;
  command.displacement = leg_.displacement + leg_.velocity * seconds(command.sequence - leg_.begin);
  command.turn = turn_leg_.turn + turn_leg_.rate * seconds(command.sequence - turn_leg_.begin);
  command.balance = balance_next_;
  command.stop_load = kNoLoad;
  if (leg_.velocity == 0.0 || ends_by_itself(command.phase)) return;
  // The most counts for the balanced load and for the true force. std::min passes over an end that is none.
  const double sense = leg_.velocity < 0.0 ? -1.0 : 1.0;
  const double most = most_load_ - std::max(0.0, sense * balance_offset_);
  command.stop_load = sense * std::min(most, sense * end_load_);
}

void CrossheadCourse::accept(const Command& command) {
  last_ = command;
  balance_next_ = false;
}

void LoadControl::learn(const Sample& now, double counting_distance) {
  const double load = balanced_load(now), moved = now.displacement - last_displacement_;
  if (knows_last_ && std::abs(moved) >= counting_distance) {
    slope_ = (load - last_load_) / moved;
    knows_slope_ = true;
    stiffness_ = std::max(slope_, 0.5 * stiffness_);
  } else {
    stiffness_ *= 0.5;
  }
  knows_last_ = true;
  last_load_ = load;
  last_displacement_ = now.displacement;
}

double LoadControl::following(const Sample& now, double wanted_load, double period, double fastest) {
  learn(now, kCounts * fastest * period);
  const double missing = wanted_load - balanced_load(now);
  if (missing == 0.0) return 0.0;
  if (!knows_slope_) return std::copysign(kCreep * fastest, missing);
  const double least_stiffness = std::abs(missing) / (fastest * period);
  return missing / (std::max(stiffness_, least_stiffness) * period);
}

double LoadControl::meeting(const Sample& now, double wanted_load, double period, double fastest, bool creeps) {
  learn(now, kCounts * fastest * period);
  if (!knows_slope_) return creeps ? kCreep * fastest : fastest;
  const double longest = fastest * period, missing = std::abs(wanted_load - balanced_load(now));
  return slope_ * longest > missing ? missing / (slope_ * period) : fastest;
}

}  // namespace knot_utm
