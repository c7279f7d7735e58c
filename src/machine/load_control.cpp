#include "knot_utm/machine/load_control.hpp"

#include <algorithm>

namespace knot_utm {

namespace {

constexpr double kCreep = 0.01;  // of the highest speed

}  // namespace

void LoadControl::learn(const Sample& now) {
  const double way = now.displacement - last_displacement_;
  if (knows_last_ && way != 0.0) stiffness_ = std::max((now.load - last_load_) / way, 0.5 * stiffness_);
  knows_last_ = true;
  last_load_ = now.load;
  last_displacement_ = now.displacement;
}

double LoadControl::speed(const Sample& now, double wanted_load, double period, double fastest) {
  learn(now);
  const double missing = wanted_load - now.load;
  if (missing == 0.0) return 0.0;
  if (stiffness_ <= 0.0) return missing > 0.0 ? kCreep * fastest : -kCreep * fastest;
  return std::clamp(missing / (stiffness_ * period), -fastest, fastest);
}

}  // namespace knot_utm
