#pragma once

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "knot_utm/contact/smooth_contact.hpp"
#include "knot_utm/numeric/points.hpp"
#include "knot_utm/rod/frames.hpp"
#include "knot_utm/rod/rod.hpp"
#include "knot_utm/rod/turning_angle.hpp"
#include "knot_utm/specimen/overhand.hpp"
#include "knot_utm/topology/knot_invariants.hpp"
#include "sim/scenes.hpp"

namespace knot_utm {

struct LooseKnotOptions {
  int turns = 1;
  double eps = 0.1;          // of the drawn shape
  double edge = 0.1;         // where strands may touch [sqrt(h R)]
  double tail = 8.0;         // length of each [R]
  double tolerance = 0.02;   // delta [h]
  double presliding = 1e-3;  // xi_s [h]
  double drag = 1e-4;        // on the whole rod at speed 1 [eps^4/2]
  double residual = 1e-6;    // [eps^4/2]
  double couple = 0.0;       // 1: friction at the surface
};

/// A loose overhand knot in a long thin rod along z whose ends are held by nodes: no moment, no twist. Units: h = 1,
/// B = 1, so that forces are F h^2/B; the unit of time is what drag and speed make of it.
///
/// R = e/(2 pi), e the end shortening; eps = sqrt(h/R).
class LooseKnot {
 public:
  explicit LooseKnot(const LooseKnotOptions& options)
      : options_(options), radius_(1.0 / (options.eps * options.eps)), force_(0.5 / (radius_ * radius_)) {
    const double e = 2.0 * M_PI * radius_, end_to_end = 2.0 * options.tail * radius_ + braid_length();
    RodMaterial material;
    material.radius = 1.0;
    material.bending_stiffness = 1.0;
    material.twisting_stiffness = 2.0 / 3.0;
    // A solid rod's for eps >= 0.1. Softer where the rod is longer: places far from the origin round to forces.
    material.stretching_stiffness = 4.0 * std::min(1.0, std::pow(10.0 * options.eps, 3));
    material.density = 0.02 * options.drag * force_ / (e + end_to_end);  // velocities die away in 0.06
    rod_ = make_rod(material, rest_lengths(e + end_to_end));
    RodState state;
    state.position = resample(draw(e + end_to_end, end_to_end), rod_.arclength());
    state.velocity = Points::Zero(3, rod_.nodes());
    lower_ = state.position.col(0);
    upper_ = state.position.col(last());
    start(state, MemoryFriction{0.0, options.presliding});
  }

  /// Goes on from the present shape with this friction, which remembers nothing yet.
  void set_friction(double mu) { set_friction(MemoryFriction{mu, options_.presliding}); }
  void set_friction(const Friction& friction) {
    RodState state = stepper_->state();
    if (options_.couple > 0.0 && state.twist.size() == 0) initialise_frames(&state);
    start(state, friction);
  }

  /// To rest between ends that stand still, under a drag that fades.
  void settle() { run(40.0, 0.0, 1e4); }

  /// Moves the ends apart by `distance` at speed 1.
  void pull(double distance) { run(distance, 1.0, 0.0); }

  /// Lets go of the ends.
  void release(double duration) {
    released_ = true;
    run(duration, 0.0, 0.0);
  }

  const TimeStep& stepper() const { return *stepper_; }
  double end_shortening() const { return rod_.length() - (upper_ - lower_).norm(); }
  double eps() const { return std::sqrt(2.0 * M_PI / end_shortening()); }
  double force() const { return released_ ? 0.0 : stepper_->readings().reaction(static_cast<int>(last()))[2]; }
  /// Of one strand on the other.
  double normal_force() const { return stepper_->readings().contact().normal_force; }

  /// |Delta(-1)|: 2 turns + 1 for the overhand.
  std::int64_t determinant() const {
    return knot_determinant(alexander_polynomial(closed_far_away(stepper_->state().position, upper_ - lower_)));
  }

  /// Of the present shape, without memory.
  std::vector<ContactPoint> contacts() const {
    const Points& x = stepper_->state().position;
    SmoothContact contact(rod_, settings_.pressure_law, settings_.friction, settings_.candidate_margin);
    contact.begin(x);
    contact.evaluate(x, x, 1.0);
    return contact.contacts();
  }

  /// 1/R as the closed forms mean it. To leading order in eps they take the loop for a circle and the tails for
  /// straight; at any finite eps the curvature varies along both, and each term of the force has its own:
  struct Curvatures {
    /// Where the loop runs across the load axis. n.t + B kappa^2/2 is constant along a rod that touches without
    /// friction; it is F in the tail, and B kappa^2/2 there, since the loop's force n is along the axis: F = B
    /// kappa^2/2.
    double side;
    /// By how much the loop's curvature exceeds the tail's in the middle of the knot: that jump is what the contact
    /// forces make, N h^2/B = sigma (h kappa)^(3/2).
    double jump;
  };
  Curvatures curvatures() const {
    const Points& x = stepper_->state().position;
    const Eigen::Index top = x.cols() / 2;
    const Vec3 axis = (upper_ - lower_).normalized();
    const auto from_axis = [&](Eigen::Index i) -> Vec3 {
      return x.col(i) - lower_ - axis.dot(x.col(i) - lower_) * axis;
    };
    const Vec3 up = from_axis(top).normalized();
    const auto height = [&](Eigen::Index i) { return up.dot(from_axis(i)); };
    const auto rise = [&](Eigen::Index edge) { return axis.dot(x.col(edge + 1) - x.col(edge)); };
    Eigen::Index side = top;
    while (rise(side) * rise(top) > 0.0) ++side;
    // The tangent is across the axis between the middles of two edges.
    const double before = std::abs(rise(side - 1)), after = std::abs(rise(side));
    const double offset = before / (before + after) - 0.5;
    const Eigen::Index next = offset > 0.0 ? side + 1 : side - 1;
    const auto at_side = [&](const auto& f) { return (1.0 - std::abs(offset)) * f(side) + std::abs(offset) * f(next); };
    const double k_side = at_side([&](Eigen::Index i) { return curvature(i); }), k_top = curvature(top);
    const double y_side = at_side(height), y_top = height(top);
    const Eigen::VectorXd s = rod_.arclength();
    const Eigen::Index middle = std::lower_bound(s.data(), s.data() + s.size(), knot_middle()) - s.data();
    const double y_knot = 0.5 * (height(middle) + height(last() - middle));
    // Moments are linear in the distance from a force's line: that of the loop, and that of the tail, the axis.
    const double loop = k_side + (k_side - k_top) * (y_side - y_knot) / (y_top - y_side);
    return {k_side, loop - force() * y_knot};
  }

  /// Length of rod between its two ways through the middle of the knot.
  double loop_length() const { return rod_.length() - 2.0 * knot_middle(); }
  /// Arclength of the middle of the contacts, on the strand of the rod's first half.
  double knot_middle() const {
    double low = rod_.length(), high = 0.0;
    for (const ContactPoint& contact : contacts()) {
      if (!contact.touches()) continue;
      const double s = std::min(contact.arclength_a, contact.arclength_b);
      low = std::min(low, s);
      high = std::max(high, s);
    }
    return 0.5 * (low + high);
  }

 private:
  static constexpr double kMetre = 1e-5;  // as `overhand` draws h

  Eigen::Index last() const { return rod_.nodes() - 1; }
  double braid_length() const {
    return (options_.turns + 0.5) * 2.0 * M_PI * std::pow(12.0, 0.25) * std::sqrt(radius_);
  }
  /// Of the rod that is drawn: a thicker one needs fewer points.
  double drawn_radius() const { return std::clamp(std::pow(0.07 / options_.eps, 2), 1.0, 2.5); }

  Points draw(double length, double end_to_end) const {
    OverhandShape shape;
    shape.radius = kMetre * drawn_radius();
    shape.turns = options_.turns;
    shape.length = kMetre * length;
    shape.end_to_end = kMetre * end_to_end;
    shape.edge_length = 2.0 * shape.radius;
    return overhand(shape).points / kMetre;
  }

  /// Edges that are short in the braid and grow from there into loop and tails.
  Eigen::VectorXd rest_lengths(double length) const {
    const double shortest = options_.edge * std::sqrt(radius_), longest = 0.06 * radius_;
    const double half_braid = 0.5 * std::sqrt(drawn_radius()) * braid_length() + 4.0 * std::sqrt(radius_);
    const double braid = M_PI * radius_ + 0.25 * braid_length();  // its middle, from that of the rod
    std::vector<double> half;
    double s = 0.0;
    while (s < 0.5 * length) {
      const double away = std::max(0.0, std::abs(s - braid) - half_braid);
      half.push_back(std::min(shortest + 0.15 * away, longest));
      s += half.back();
    }
    const auto count = static_cast<Eigen::Index>(half.size());
    Eigen::VectorXd out(2 * count);
    out.tail(count) = Eigen::Map<const Eigen::VectorXd>(half.data(), count) * (0.5 * length / s);
    out.head(count) = out.tail(count).reverse();
    return out;
  }

  static Points resample(const Points& drawn, const Eigen::VectorXd& arclength) {
    Eigen::VectorXd s = Eigen::VectorXd::Zero(drawn.cols());
    for (Eigen::Index i = 1; i < drawn.cols(); ++i) s[i] = s[i - 1] + (drawn.col(i) - drawn.col(i - 1)).norm();
    const double scale = s[s.size() - 1] / arclength[arclength.size() - 1];
    Points out(3, arclength.size());
    Eigen::Index j = 0;
    for (Eigen::Index i = 0; i < arclength.size(); ++i) {
      const double at = scale * arclength[i];
      while (j + 2 < s.size() && s[j + 1] < at) ++j;
      const double t = std::clamp((at - s[j]) / (s[j + 1] - s[j]), 0.0, 1.0);
      out.col(i) = (1.0 - t) * drawn.col(j) + t * drawn.col(j + 1);
    }
    return out;
  }

  double curvature(Eigen::Index i) const {
    const Points& x = stepper_->state().position;
    const Vec3 e = (x.col(i) - x.col(i - 1)).normalized(), f = (x.col(i + 1) - x.col(i)).normalized();
    return turning_angle(e, f) / rod_.voronoi_length[i];
  }

  void start(const RodState& state, const Friction& friction) {
    // Overlaps of about a quarter of the tolerance.
    settings_.pressure_law = NormalLaw{48.0 * force_ / options_.tolerance, options_.tolerance};
    settings_.friction = friction;
    settings_.friction_couple = options_.couple;
    settings_.spin_inertia = false;
    settings_.drag = options_.drag * force_ / rod_.length();
    settings_.residual = options_.residual * force_;
    settings_.newton_cap = 0.5;
    settings_.motion_limit = 1.0;
    settings_.overlap_limit = 0.5;
    settings_.candidate_margin = 1.0;
    settings_.max_iterations = 25;
    stepper_ = TimeStep::make(rod_, state, settings_);
  }

  void run(double duration, double speed, double fading_drag) {
    StepControl::Options control_options;
    control_options.longest = std::max(1.0, 0.1 * duration);
    control_options.shortest = 1e-12;
    control_options.motion = 0.5;
    control_options.easy_iterations = 8;
    control_options.hard_iterations = 16;
    const Vec3 lower = lower_, upper = upper_;
    Boundary boundary;
    double time = 0.0;
    run_to(duration, *stepper_, time, control_options, [&](double to) -> const Boundary& {
      const Vec3 way(0.0, 0.0, 0.5 * speed * to);
      if (!released_) boundary.fixed_nodes = {{0, lower - way}, {static_cast<int>(last()), upper + way}};
      boundary.extra_drag = settings_.drag * fading_drag * std::max(0.0, 1.0 - 2.0 * to / duration);
      return boundary;
    });
    lower_ = stepper_->state().position.col(0);
    upper_ = stepper_->state().position.col(last());
    ASSERT_EQ(determinant(), 2 * options_.turns + 1) << "the rod ran through itself";
  }

  LooseKnotOptions options_;
  double radius_, force_;  // of the drawn shape: R, eps^4/2
  RodProperties rod_;
  StepSettings settings_;
  std::unique_ptr<TimeStep> stepper_;
  Vec3 lower_, upper_;
  bool released_ = false;
};

}  // namespace knot_utm
