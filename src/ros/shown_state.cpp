#include "knot_utm/ros/shown_state.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace knot_utm {
namespace {

constexpr double kLongest = 1.0;  // that the way between two states takes, such as after a pause [s]

double seconds(ShownState::Clock::duration duration) { return std::chrono::duration<double>(duration).count(); }

}  // namespace

void ShownState::begin() {
  states_ = 0;
  interval_ = 0.0;
}

void ShownState::add(Moment moment, Clock::time_point now) {
  // From a whole rod to one that has parted there is no way: the gap is there at once.
  const bool parts = std::isfinite(latest_.sample.break_arclength) != std::isfinite(moment.sample.break_arclength);
  const bool goes_on = states_ > 0 && latest_.points.cols() == moment.points.cols() && !parts;
  interval_ = goes_on ? std::clamp(seconds(now - arrived_), 0.0, kLongest) : 0.0;
  states_ = goes_on ? 2 : 1;
  before_ = std::move(latest_);
  latest_ = std::move(moment);
  arrived_ = now;
}

double ShownState::fraction(Clock::time_point now) const {
  if (states_ < 2 || !(interval_ > 0.0)) return 1.0;
  return std::clamp(seconds(now - arrived_) / interval_, 0.0, 1.0);
}

Moment ShownState::at(Clock::time_point now) const {
  const double x = fraction(now);
  if (x >= 1.0) return latest_;
  Moment shown = before_;
  shown.stamp += (latest_.stamp - before_.stamp) * x;
  shown.points += x * (latest_.points - before_.points);
  shown.upper_grip += x * (latest_.upper_grip - before_.upper_grip);
  shown.sample.displacement += x * (latest_.sample.displacement - before_.sample.displacement);
  if (before_.tension.size() == latest_.tension.size()) shown.tension += x * (latest_.tension - before_.tension);
  return shown;
}

}  // namespace knot_utm
