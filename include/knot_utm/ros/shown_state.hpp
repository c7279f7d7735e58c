#pragma once

#include <ros/time.h>

#include <chrono>
#include <string>

#include "knot_utm/numeric/points.hpp"
#include "knot_utm/record/sample.hpp"

namespace knot_utm {

/// The state of the specimen at one time, as far as a picture shows it.
struct Moment {
  ros::Time stamp;
  Points points;            ///< nodes of the rod [m]
  Eigen::VectorXd tension;  ///< of each edge [N]
  Vec3 upper_grip;          ///< [m]
  Sample sample;
  std::string motion_pattern;
};

/// Interpolates states for display. States arrive a few times a second, and pictures are drawn more often. A picture
/// shows the linear interpolation between the last state but one and the last state. The interpolation takes as long as
/// the interval between their arrivals, so a picture lags behind by at most that interval. It never extrapolates.
class ShownState {
 public:
  using Clock = std::chrono::steady_clock;

  void begin();  ///< begins a new specimen
  void add(Moment moment, Clock::time_point now);
  void settle() { interval_ = 0.0; }  ///< shows the last state from now on, without interpolation

  bool empty() const { return states_ == 0; }
  bool settled(Clock::time_point now) const { return fraction(now) >= 1.0; }
  const Moment& latest() const { return latest_; }

  /// The state to be shown. The values of its sample are those of the last state that was passed, except for the
  /// displacement, which is interpolated as the grip is.
  Moment at(Clock::time_point now) const;

 private:
  double fraction(Clock::time_point now) const;  ///< fraction of the interpolation that has passed, 0 to 1

  int states_ = 0;  ///< number of states that are known: 0, 1 or 2
  Moment before_, latest_;
  Clock::time_point arrived_;
  double interval_ = 0.0;  ///< wall time between the arrivals of the two [s]
};

}  // namespace knot_utm
