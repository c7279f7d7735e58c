#include "knot_utm/program/load_control.hpp"

#include <algorithm>
#include <cmath>

#include "knot_utm/record/sample.hpp"

namespace knot_utm {

namespace {

constexpr double kCreep = 0.01;  // of the highest speed
// A motion counts from this fraction of the longest one of a command on. The slope over less would be that of what
// Newton's method leaves unbalanced.
constexpr double kCounts = 1e-5;

}  // namespace

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
