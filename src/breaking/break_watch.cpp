#include "knot_utm/breaking/break_watch.hpp"

#include <algorithm>
#include <limits>
#include <sstream>

#include "knot_utm/sim/time_step.hpp"

namespace knot_utm {

namespace {

constexpr double kOvershoot = 1.001;  // fraction of the strength that a step may reach, unless it is a short one
constexpr double kAbsurd = 2.0;       // and that no step may reach
constexpr double kPressed = 0.01;     // of the tension that parts the rod: a smaller push is none

const char* name_of(BreakLimit limit) { return limit == BreakLimit::kForce ? "tension" : "strain"; }

/// Ropes that follow each other count from 1, as their knot's file lists them.
std::string which_rope(const std::vector<int>& cuts, int edge) {
  if (cuts.empty()) return "";
  const auto before = std::count_if(cuts.begin(), cuts.end(), [&](int cut) { return cut < edge; });
  return ", in rope " + std::to_string(before + 1);
}

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

RodBreak::RodBreak(const Material& material, const TimeStep& stepper, double shortest)
    : strengths_(material, stepper.rod()), watch_(shortest, exposure(stepper, stepper.state().position)) {}

Exposure RodBreak::exposure(const TimeStep& stepper, const Points& position) const {
  // What presses is that of the step that is judged.
  return strengths_.most_exposed(stepper.rod(), position,
                                 strengths_.crush() ? stepper.readings().pressing() : Pressing());
}

std::string RodBreak::refuse(const TimeStep& stepper, const Points& end, double dt) const {
  return watch_.refuse(exposure(stepper, end), dt);
}

std::optional<Exposure> RodBreak::judge(const TimeStep& stepper, double dt) {
  const Exposure now = exposure(stepper, stepper.state().position);
  if (watch_.judge(now, dt)) return now;
  return std::nullopt;
}

std::string RodBreak::describe(const TimeStep& stepper, const Exposure& reached, BreakPlace place) const {
  std::ostringstream text;
  text << "the rod parted " << break_arclength(stepper, reached.edge) << " m along its length"
       << which_rope(stepper.rod().cuts, reached.edge) << " (" << break_place_name(place)
       << (reached.limit == BreakLimit::kForce ? ") at a tension of "
           : strengths_.crush()                ? ") where stretch, bend and crushing came to a strain of "
                                               : ") at a strain of its outermost fibre of ")
       << reached.value << (reached.limit == BreakLimit::kForce ? " N" : "");
  return text.str();
}

double break_arclength(const TimeStep& stepper, int edge) { return stepper.rod().place(edge, 0.5); }

}  // namespace knot_utm
