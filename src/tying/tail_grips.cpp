#include "knot_utm/tying/tail_grips.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "knot_utm/rod/material.hpp"
#include "knot_utm/specimen/scales.hpp"

namespace knot_utm {

Settling::Settling(const RodMaterial& material) : drag_(settling_drag(material, kWave * material.radius, kTime)) {}

void RestWatch::follow(const Points& velocity, double dt) {
  fastest_ = std::sqrt(velocity.colwise().squaredNorm().maxCoeff());
  rested_ = fastest_ > options_.speed ? 0.0 : rested_ + dt;
}

bool RestWatch::waited(double time, double begin, const char* since) {
  if (rested_ >= options_.duration) return true;
  if (time - begin <= options_.patience) return false;
  std::ostringstream message;
  message << "not equilibrated: " << options_.patience << " s after " << since << ", the fastest node still moved at "
          << fastest_ << " m/s; at rest it moves at less than " << options_.speed << " m/s";
  not_equilibrated_ = message.str();
  return true;
}

namespace {

constexpr double kSlips = 0.999;  // a grip counts as slipping from this share of its slip force on [-]

}  // namespace

void TailGrips::add(int node, const Vec3& direction, double stiffness, double slip_force) {
  SlippingGrip grip;
  grip.node = node;
  grip.direction = direction;
  grip.stiffness = stiffness;
  grip.slip_force = slip_force;
  const auto there = at(node);
  if (there == grips_.end())
    grips_.push_back(grip);
  else
    *there = grip;
}

std::vector<SlippingGrip>::iterator TailGrips::at(int node) {
  return std::find_if(grips_.begin(), grips_.end(), [&](const SlippingGrip& grip) { return grip.node == node; });
}

void TailGrips::begin_at(const Points& position) {
  for (SlippingGrip& grip : grips_) grip.place = grip.direction.dot(position.col(grip.node));
}

void TailGrips::begin_with(int node, double force, const Points& position) {
  SlippingGrip& grip = *at(node);
  grip.place = grip.direction.dot(position.col(node)) + std::min(force, grip.slip_force) / grip.stiffness;
}

void TailGrips::add_to(Boundary& boundary, double travel) const {
  for (SlippingGrip grip : grips_) {
    grip.place += travel;
    boundary.grips.push_back(grip);
  }
}

void TailGrips::move(const Points& position, double travel) {
  for (SlippingGrip& grip : grips_) {
    grip.place += travel;
    const double slipped = grip.direction.dot(position.col(grip.node)) + grip.slip_force / grip.stiffness;
    grip.place = std::min(grip.place, slipped);
  }
}

double TailGrips::force(std::size_t grip, const Points& position) const {
  return grips_[grip].force(position.col(grips_[grip].node));
}

double TailGrips::force_at(int node, const Points& position) const {
  for (const SlippingGrip& grip : grips_)
    if (grip.node == node) return grip.force(position.col(node));
  return 0.0;
}

bool TailGrips::all_slip(const Points& position) const {
  for (std::size_t i = 0; i < grips_.size(); ++i)
    if (force(i, position) < kSlips * grips_[i].slip_force) return false;
  return true;
}

bool TailGrips::pull_is_over(const Points& position, double time, RestWatch& rest) {
  const bool all = all_slip(position);
  if (all && reached_ < 0.0) reached_ = time;
  if (reached_ < 0.0 || (!all && time - reached_ <= rest.patience())) return false;
  return rest.waited(time, reached_, "the ends that tie it reached their loads");
}

std::string TailGrips::lost_patience(const Patience& patience, const Points& position, double elapsed,
                                     double travel_in_radii) const {
  if (reached_ >= 0.0 || elapsed <= patience.time || travel_in_radii <= patience.travel) return "";
  std::ostringstream message;
  message << "not tied: after " << elapsed << " s the ends that tie it are pulled with";
  for (std::size_t i = 0; i < grips_.size(); ++i)
    message << (i == 0 ? " " : " and ") << force(i, position) << " of " << grips_[i].slip_force << " N";
  return message.str();
}

void TailGrips::state(Archive& archive) {
  archive(reached_);
  for (SlippingGrip& grip : grips_) archive(grip.place);
}

}  // namespace knot_utm
