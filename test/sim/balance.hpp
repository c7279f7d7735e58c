#pragma once

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <utility>

#include "knot_utm/numeric/points.hpp"
#include "knot_utm/rod/rod.hpp"
#include "knot_utm/sim/step_control.hpp"

namespace knot_utm {

/// Runs a scene and keeps its books: of energy over all steps, of forces and moments at the last one.
class Balance {
 public:
  /// Steps of at most `longest` [s].
  Balance(std::unique_ptr<TimeStep> stepper, const StepSettings& settings, double longest)
      : stepper_(std::move(stepper)),
        settings_(settings),
        control_(options(longest, settings.motion_limit)),
        begin_(stepper_->readings().energies()),
        before_(stepper_->state()) {}

  /// `boundary(to)` as it stands at the end of a step, `each()` after every accepted one.
  void run(
      double duration, const std::function<const Boundary&(double to)>& boundary,
      const std::function<void()>& each = [] {}) {
    const Boundary* last = nullptr;
    const std::string gave_up = control_.advance(
        *stepper_, time_, time_ + duration,
        [&](double, double to) -> const Boundary& { return *(last = &boundary(to)); },
        [&](double, double dt, const StepSummary& summary) {
          follow(*last, dt, summary);
          each();
        });
    ASSERT_EQ(gave_up, "");
  }

  const TimeStep& stepper() const { return *stepper_; }
  const StepWork& sum() const { return sum_; }

  /// What StepWork's identity leaves, and what rounding may leave of it [J].
  double gap() const {
    return sum_.boundary - (stepper_->readings().energies().total() - begin_.total()) - sum_.friction - sum_.drag -
           sum_.plastic - sum_.numerical - sum_.reweighting - sum_.residual;
  }
  double rounding() const { return 1e-12 * gross_; }
  /// Newton's residual at every node times the nodes' ways [J].
  double residual_bound() const { return residual_bound_; }

  /// Sums of everything that acts on the rod in the last step, inertia included, moments about the origin; and what
  /// Newton's residual at every node, and rounding, may leave of them.
  Vec3 force() const { return force_; }
  Vec3 moment() const { return moment_; }
  /// The same as the step itself reads it, with the inertia and drag of spin.
  Vec3 read_force() const { return read_force_; }
  Vec3 read_moment() const { return read_moment_; }
  double force_bound() const {
    return residual_ * static_cast<double>(stepper_->rod().nodes()) + 1e-12 * largest_load_;
  }
  double moment_bound() const { return force_bound() * stepper_->state().position.colwise().norm().maxCoeff(); }
  /// Of the grips alone.
  double largest_load() const { return largest_load_; }
  double largest_moment() const { return largest_moment_; }

 private:
  static StepControl::Options options(double longest, double motion) {
    StepControl::Options out;
    out.longest = out.first = longest;
    out.motion = 0.5 * motion;
    return out;
  }

  void follow(const Boundary& boundary, double dt, const StepSummary& summary) {
    const RodState before = std::exchange(before_, stepper_->state());
    const StepWork work = stepper_->readings().work();
    sum_ += work;
    for (const double part : {work.boundary, work.friction, work.drag, work.numerical, work.reweighting,
                              stepper_->readings().energies().total()})
      gross_ += std::abs(part);
    const RodState& now = stepper_->state();
    residual_ = summary.newton.residual;
    residual_bound_ += residual_ * (now.position - before.position).colwise().norm().sum();
    if (now.twist.size() > 0)
      residual_bound_ += residual_ * stepper_->rod().material.radius * (now.twist - before.twist).lpNorm<1>();
    add_up_loads(boundary, before, dt);
  }

  void load(const Vec3& at, const Vec3& force, const Vec3& couple = Vec3::Zero()) {
    force_ += force;
    moment_ += at.cross(force) + couple;
  }

  void add_up_loads(const Boundary& boundary, const RodState& before, double dt) {
    const RodProperties& rod = stepper_->rod();
    const RodState& now = stepper_->state();
    const Points& x = now.position;
    force_.setZero();
    moment_.setZero();
    for (const FixedNode& held : boundary.fixed_nodes) load(x.col(held.node), stepper_->readings().reaction(held.node));
    for (const FixedTwist& held : boundary.fixed_twists) {
      const Vec3 tangent = (x.col(held.edge + 1) - x.col(held.edge)).normalized();
      load(Vec3::Zero(), Vec3::Zero(), stepper_->readings().reaction_torque(held.edge) * tangent);
    }
    for (std::size_t r = 0; r < boundary.rollers.size(); ++r) {
      const int number = static_cast<int>(r);
      load(boundary.rollers[r].centre, -stepper_->readings().roller_force(number),
           -stepper_->readings().roller_moment(number));
    }
    largest_load_ = force_.norm();
    for (const FixedNode& held : boundary.fixed_nodes)
      largest_load_ = std::max(largest_load_, stepper_->readings().reaction(held.node).norm());
    largest_moment_ = moment_.norm();
    for (const NodeForce& force : boundary.forces) load(x.col(force.node), force.force);
    for (int i = 0; i < static_cast<int>(rod.nodes()); ++i) {
      const Vec3 velocity = now.velocity.col(i), change = velocity - before.velocity.col(i);
      load(x.col(i),
           rod.mass[i] * (settings_.gravity - change / dt) - settings_.drag * rod.voronoi_length[i] * velocity);
    }
    read_force_ = stepper_->readings().loads().force;
    read_moment_ = stepper_->readings().loads().moment + stepper_->readings().contact().couple;
    load(Vec3::Zero(), Vec3::Zero(), stepper_->readings().contact().couple);
  }

  std::unique_ptr<TimeStep> stepper_;
  StepSettings settings_;
  StepControl control_;
  double time_ = 0.0;
  Energies begin_;
  RodState before_;
  StepWork sum_;
  double gross_ = 0.0, residual_bound_ = 0.0, residual_ = 0.0, largest_load_ = 0.0, largest_moment_ = 0.0;
  Vec3 force_ = Vec3::Zero(), moment_ = Vec3::Zero(), read_force_ = Vec3::Zero(), read_moment_ = Vec3::Zero();
};

}  // namespace knot_utm
