#include "knot_utm/machine/frame.hpp"

#include <cmath>
#include <string>

#include "knot_utm/rod/invalid_input.hpp"

namespace knot_utm {

namespace {

constexpr double kFrameTime = 3e-3;  // tau: of 100 kg on 1e7 N/m [s]

}  // namespace

Frame::Frame(double stiffness, const Material& material, int strands, double length) : stiffness_(stiffness) {
  if (!(stiffness > 0.0)) throw InvalidInput("machine.stiffness", std::to_string(stiffness), "more than 0 N/m");
  const double line_density = material.density * M_PI * material.radius * material.radius;
  specimen_ = strands * material.stretching_stiffness / length;
  damping_ = strands * std::sqrt(material.stretching_stiffness * line_density) + stiffness * kFrameTime;
}

bool Frame::rigid() const { return std::isinf(stiffness_); }

double Frame::grip_after(double grip, double displacement, double force, double dt) const {
  if (rigid()) return displacement;
  return grip + (stiffness_ * (displacement - grip) - force) / (stiffness_ + specimen_ + damping_ / dt);
}

}  // namespace knot_utm
