#include "knot_utm/machine/break_watch.hpp"

#include <algorithm>
#include <limits>
#include <sstream>

namespace knot_utm {

namespace {

constexpr double kOvershoot = 1.001;  // fraction of the strength that a step may reach, unless it is a short one
constexpr double kAbsurd = 2.0;       // and that no step may reach
constexpr double kPressed = 0.01;     // of the tension that parts the rod: a smaller push is none

const char* name_of(BreakLimit limit) { return limit == BreakLimit::kForce ? "tension" : "strain"; }

}  // namespace

std::string BreakWatch::refuse(const Exposure& to, double dt) const {
  // A rod that begins beyond its strength, as a shape that was drawn with too sharp a bend, parts at once.
  if (before_ >= 1.0 || to.fraction <= (dt > shortest_ ? kOvershoot : kAbsurd)) return {};
  std::ostringstream text;
  text << "the " << name_of(to.limit) << " would jump from " << before_ << " to " << to.fraction
       << " times what the rod bears in one step";
  return text.str();
}

bool BreakWatch::judge(const Exposure& now, double dt) {
  next_ = std::numeric_limits<double>::infinity();
  const bool parted = now.fraction >= 1.0;
  if (!parted && now.fraction > before_)
    next_ = std::max((1.0 - now.fraction) / (now.fraction - before_) * dt, shortest_);
  before_ = now.fraction;
  return parted;
}

std::string not_by_tension(const Exposure& parted, double upper, double lower) {
  const double force = std::max(upper, lower);
  if (parted.limit != BreakLimit::kForce || force >= -kPressed * parted.value) return {};
  std::ostringstream text;
  text << "the rod would part at a tension of " << parted.value << " N while its grips are pressed together by "
       << -force << " N: the time step is wrong, and the rod did not part";
  return text.str();
}

}  // namespace knot_utm
