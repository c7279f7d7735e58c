#include "knot_utm/tying/take_up.hpp"

#include <algorithm>
#include <cmath>

namespace knot_utm {

namespace {

constexpr double kMet = 0.2;         // nearer to the load it is met [of it]
constexpr double kMuch = 0.5;        // there is a load [of the one to meet]
constexpr double kSlow = 0.25;       // of the speed, once there is a load; and of that before at each turn
constexpr double kMostBack = 3.0;    // behind where it began [h]
constexpr double kKnotsMoved = 0.3;  // by which knots slide [h]

}  // namespace

void TakeUp::begin(double load, double displacement, double knot_distance) {
  *this = TakeUp(taut_, radius_);
  begin_ = displacement;
  knot_distance_ = knot_distance;
  follow(load, displacement, knot_distance);
  moved_ = false;
}

void TakeUp::follow(double load, double displacement, double knot_distance) {
  if (done_) return;
  const double sense = load < taut_ ? 1.0 : -1.0;
  const bool slid = sense > 0.0 && std::abs(knot_distance - knot_distance_) > kKnotsMoved * radius_;
  const bool in_vain = sense < 0.0 && displacement < begin_ - kMostBack * radius_;
  done_ = std::abs(load - taut_) <= kMet * taut_ || slid || in_vain;
  if (sense < 0.0) knot_distance_ = knot_distance;
  if (moved_ && sense != sense_) finest_ *= kSlow;
  moved_ = true;
  sense_ = sense;
  fraction_ = std::min(finest_, sense > 0.0 && load > kMuch * taut_ ? kSlow : 1.0);
}

void TakeUp::state(Archive& archive) { archive(sense_, fraction_, finest_, begin_, knot_distance_, moved_, done_); }

}  // namespace knot_utm
