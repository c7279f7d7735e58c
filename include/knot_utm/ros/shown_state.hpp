#pragma once

#include <ros/time.h>

#include <chrono>
#include <string>

#include "knot_utm/record/sample.hpp"
#include "knot_utm/rod/rod.hpp"

namespace knot_utm {

/// How the specimen stood at one moment, as far as a picture shows it.
struct Moment {
  ros::Time stamp;
  Points points;            ///< nodes of the rod [m]
  Eigen::VectorXd tension;  ///< of each edge [N]
  Vec3 upper_grip;          ///< [m]
  Sample sample;
  std::string motion_pattern;
};

/// What is shown at any wall time. States come a few times a second; pictures come more often and show the specimen
/// on the straight way from the last state but one to the last. That way takes as long as it took the last state to
/// come. A picture is late by that time at most, and shows nothing that was not, or lies between what was.
class ShownState {
 public:
  using Clock = std::chrono::steady_clock;

  void begin();  ///< a new specimen
  void add(Moment moment, Clock::time_point now);
  void settle() { interval_ = 0.0; }  ///< shows the last state from now on

  bool empty() const { return states_ == 0; }
  bool settled(Clock::time_point now) const { return fraction(now) >= 1.0; }
  const Moment& latest() const { return latest_; }

  /// Numbers of the sample are those of the state that was last passed, but for the displacement, which goes with the
  /// grip.
  Moment at(Clock::time_point now) const;

 private:
  double fraction(Clock::time_point now) const;  ///< of the way from the one to the other

  int states_ = 0;  ///< that are known: 0, 1 or 2
  Moment before_, latest_;
  Clock::time_point arrived_;
  double interval_ = 0.0;  ///< wall time between the two [s]
};

}  // namespace knot_utm
