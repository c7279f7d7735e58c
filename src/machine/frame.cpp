#include "knot_utm/machine/frame.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "knot_utm/numeric/archive.hpp"
#include "knot_utm/specimen/material.hpp"
#include "knot_utm/words/invalid_input.hpp"

namespace knot_utm {
namespace {

constexpr double kFrameTime = 3e-3;  // tau: of 100 kg on 1e7 N/m [s]

constexpr double kInertia = 3.0;  // m/m_a

}  // namespace

Frame::Frame(double stiffness, const Material& material, int strands, double moved)
    : stiffness_(stiffness), specimen_(std::numeric_limits<double>::max()), number_(strands), moved_(moved) {
  if (!(stiffness > 0.0)) throw InvalidInput("machine.stiffness", std::to_string(stiffness), "more than 0 N/m");
  // Either rope may be in the upper grip.
  for (const Material* rope : {&material, material.other.get()}) {
    if (!rope) continue;
    line_density_ = std::max(line_density_, rope->density * M_PI * rope->radius * rope->radius);
    strands_ = std::max(strands_, strands * rope->stretching_stiffness);
  }
}

bool Frame::rigid() const { return std::isinf(stiffness_); }

double Frame::resistance(double dt, double drag) const {
  const double inert = line_density_ + drag * dt;
  return (std::sqrt(number_ * strands_ * inert) + stiffness_ * kFrameTime + kInertia * inert * moved_ / dt) / dt;
}

double Frame::grip_after(double grip, double displacement, double force, double length, double dt, double drag) const {
  if (rigid()) return displacement;
  const double resists = std::min(specimen_, strands_ / length) + resistance(dt, drag);
  return grip + (stiffness_ * (displacement - grip) - force) / (stiffness_ + resists);
}

bool Frame::passed_balance(double moved, double grip, double displacement, double force, double length, double dt,
                           double drag, double least) const {
  constexpr double kMuch = 0.1;
  if (rigid() || resistance(dt, drag) >= strands_ / length) return false;
  const double too_much = force - stiffness_ * (displacement - grip);
  return std::copysign(1.0, moved) * too_much > kMuch * std::abs(force) + least;
}

double Frame::still_to_come(double grip, double displacement, double force, double length) const {
  if (rigid()) return 0.0;
  const double specimen = std::min(specimen_, strands_ / length);
  return (stiffness_ * (displacement - grip) - force) * specimen / (stiffness_ + specimen);
}

void Frame::follow(double moved, double gained, double length) {
  constexpr double kForgets = 0.5;
  if (moved == 0.0) return;
  const double taut = strands_ / length;
  specimen_ = std::min(taut, std::max(gained / moved, kForgets * std::min(specimen_, taut)));
}

void Frame::state(Archive& archive) { archive(specimen_); }

}  // namespace knot_utm
