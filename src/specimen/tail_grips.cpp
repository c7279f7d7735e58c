#include "knot_utm/specimen/tail_grips.hpp"

#include <algorithm>

namespace knot_utm {

namespace {

constexpr double kSlips = 0.999;  // of the force at which a grip slips: it counts as slipping [-]

}  // namespace

void TailGrips::add(int node, const Vec3& direction, double stiffness, double slip_force) {
  SlippingGrip grip;
  grip.node = node;
  grip.direction = direction;
  grip.stiffness = stiffness;
  grip.slip_force = slip_force;
  grips_.push_back(grip);
}

void TailGrips::begin_at(const Points& position, std::size_t first) {
  for (std::size_t i = first; i < grips_.size(); ++i)
    grips_[i].place = grips_[i].direction.dot(position.col(grips_[i].node));
}

void TailGrips::add_to(Boundary& boundary, double way) const {
  for (SlippingGrip grip : grips_) {
    grip.place += way;
    boundary.grips.push_back(grip);
  }
}

void TailGrips::move(const Points& position, double way) {
  for (SlippingGrip& grip : grips_) {
    grip.place += way;
    const double slipped = grip.direction.dot(position.col(grip.node)) + grip.slip_force / grip.stiffness;
    grip.place = std::min(grip.place, slipped);
  }
}

double TailGrips::force(std::size_t grip, const Points& position) const {
  return grips_[grip].force(position.col(grips_[grip].node));
}

bool TailGrips::all_slip(const Points& position) const {
  for (std::size_t i = 0; i < grips_.size(); ++i)
    if (force(i, position) < kSlips * grips_[i].slip_force) return false;
  return true;
}

void TailGrips::state(Archive& archive) {
  for (SlippingGrip& grip : grips_) archive(grip.place);
}

}  // namespace knot_utm
