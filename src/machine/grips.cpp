#include "knot_utm/machine/grips.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

namespace knot_utm {

namespace {

constexpr double kSlack = 0.6;  // by which the rollers stand closer than taut, until mounting [h]
// Of the crosshead's way, while a loop that was drawn narrower than the rollers is put over pins that widen to them: of
// what the loop's far side gives way.
constexpr double kWayOfPuttingOn = 0.1;
constexpr double kClearance = 1.5;  // of a pin in the loop that is put over it [h]

}  // namespace

Grips::Grips(const SpecimenOptions& specimen, const MachineOptions& machine, const Centreline& centreline,
             double radius) {
  const int nodes = static_cast<int>(centreline.points.cols());
  if (specimen.knot == KnotKind::kFisherman && machine.grips == GripKind::kRollers) {
    Roller roller;
    roller.axis = Vec3::UnitY();
    roller.radius = 0.5 * machine.roller_diameter;
    roller.centre = Vec3::Zero();
    rollers_.push_back(roller);
    narrower_ = roller.radius + radius - centreline.loop.radius;
    clearance_ = kClearance * radius;
    way_on_ = 2.0 * kWayOfPuttingOn * (narrower_ + clearance_);
    roller.centre = Vec3(0.0, 0.0, specimen.end_to_end - kSlack * radius - way_on_);
    rollers_.push_back(roller);
    return;
  }
  auto hold = [&](std::vector<FixedNode>& held, int node) { held.push_back({node, centreline.points.col(node)}); };
  if (specimen.knot == KnotKind::kFisherman) {
    const int lower = centreline.nearest_node(centreline.lower_apex);
    const int upper = centreline.nearest_node(centreline.upper_apex);
    hold(lower_nodes_, lower);
    hold(upper_nodes_, upper);
    if (machine.grips == GripKind::kClamps) {
      hold(lower_nodes_, lower + 1);
      hold(upper_nodes_, upper + 1);
      held_frames_ = {{lower, 0.0}, {upper, 0.0}};
    }
    return;
  }
  hold(lower_nodes_, 0);
  hold(upper_nodes_, nodes - 1);
  if (machine.grips != GripKind::kNodes) {
    hold(lower_nodes_, 1);
    hold(upper_nodes_, nodes - 2);
    held_frames_ = {{0, 0.0}, {nodes - 2, 0.0}};
    if (specimen.knot == KnotKind::kStraight) {  // its length is that between the clamps
      std::swap(lower_nodes_[0], lower_nodes_[1]);
      std::swap(upper_nodes_[0], upper_nodes_[1]);
    }
  }
}

bool Grips::hold(double displacement, const Vec3& point, double radius) const {
  Boundary boundary;
  set(displacement, boundary);
  for (const Roller& roller : boundary.rollers) {
    const Vec3 away = point - roller.centre;
    if ((away - roller.axis * roller.axis.dot(away)).norm() < roller.radius + 2.0 * radius) return true;
  }
  return std::any_of(boundary.fixed_nodes.begin(), boundary.fixed_nodes.end(),
                     [&](const FixedNode& node) { return (node.position - point).norm() < 2.0 * radius; });
}

void Grips::set(double displacement, Boundary& boundary) const {
  boundary.rollers = rollers_;
  if (on_rollers()) {
    boundary.rollers[1].centre[2] += displacement;
    if (displacement < way_on_) widen(1.0 - displacement / way_on_, boundary.rollers);
  }
  boundary.fixed_twists = held_frames_;
  boundary.fixed_nodes = lower_nodes_;
  for (FixedNode node : upper_nodes_) {
    node.position[2] += displacement;
    boundary.fixed_nodes.push_back(node);
  }
}

/// The near side stays where it is: a pin is narrower by a share of what the loop was drawn, set off to that side, and
/// further out by as much as keeps the loop's length.
void Grips::widen(double left, std::vector<Roller>& rollers) const {
  const double narrower = std::min(left, 1.0) * narrower_, further = 0.5 * M_PI * narrower;
  for (Roller& roller : rollers) {
    roller.radius -= narrower + std::min(left, 1.0) * clearance_;
    roller.centre[0] += narrower;
  }
  rollers[0].centre[2] -= further;
  rollers[1].centre[2] += further;
}

Vec3 Grips::lower() const { return on_rollers() ? rollers_[0].centre : lower_nodes_.front().position; }

Vec3 Grips::upper(double displacement) const {
  const Vec3 start = on_rollers() ? rollers_[1].centre : upper_nodes_.front().position;
  return start + Vec3(0.0, 0.0, displacement);
}

double Grips::end_to_end(double displacement) const {
  if (on_rollers()) return rollers_[1].centre[2] + displacement - rollers_[0].centre[2];
  return (upper(displacement) - lower()).norm();
}

double Grips::length_around(double radius) const { return on_rollers() ? M_PI * (rollers_[1].radius + radius) : 0.0; }

double Grips::force_upper(const TimeStep& step) const {
  if (on_rollers()) return -step.roller_force(1)[2];
  double sum = 0.0;
  for (const FixedNode& node : upper_nodes_) sum += step.reaction(node.node)[2];
  return sum;
}

double Grips::force_lower(const TimeStep& step) const {
  if (on_rollers()) return step.roller_force(0)[2];
  double sum = 0.0;
  for (const FixedNode& node : lower_nodes_) sum -= step.reaction(node.node)[2];
  return sum;
}

double Grips::moment_imbalance(double displacement, const TimeStep& step) const {
  const Points& x = step.state().position;
  Vec3 sum = Vec3::Zero();
  if (on_rollers())
    sum -= step.roller_moment(0) + step.roller_moment(1) + (upper(displacement) - lower()).cross(step.roller_force(1));
  for (const std::vector<FixedNode>* grip : {&lower_nodes_, &upper_nodes_})
    for (const FixedNode& held : *grip)
      sum += (x.col(held.node) - lower_nodes_.front().position).cross(step.reaction(held.node));
  for (const FixedTwist& held : held_frames_)
    sum += step.reaction_torque(held.edge) * (x.col(held.edge + 1) - x.col(held.edge)).normalized();
  return sum.norm();
}

}  // namespace knot_utm
