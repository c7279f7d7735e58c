#pragma once

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "knot_utm/numeric/points.hpp"
#include "knot_utm/rod/frames.hpp"
#include "knot_utm/rod/rod.hpp"
#include "knot_utm/sim/step_control.hpp"
#include "knot_utm/specimen/centreline.hpp"
#include "knot_utm/specimen/material.hpp"
#include "knot_utm/specimen/overhand.hpp"
#include "knot_utm/specimen/polyline.hpp"

namespace knot_utm {

/// A knot that stops a solid rod in a hole. The strand below the knot runs down through the hole (along -z) to a clamp,
/// which pulls it and holds its spin; the tail above the knot is free. Lengths are in radii h of the rod, forces in
/// k_b/h^2, energies in k_b/h.
///
/// The hole is square and its edges are round: four fixed cylinders in the plane z = 0, two along x and two along y.
/// They touch the rod only, so that they may run through each other.
///
/// The knot *flips* where the force falls by more than a tenth while the clamp moves by h, and where the shape of the
/// rod just above the hole is another one after that: laid onto what it was, its points are more than h away (root mean
/// square). A knot that slips by jerks keeps its shape.
struct StopperKnot {
  enum class Kind { kOverhand, kFigureEight };

  struct Options {
    Kind kind = Kind::kFigureEight;
    bool mirrored = false;
    double edge = 1.0;            ///< length of an edge
    double friction = 0.3;        ///< mu, between strands and on the hole
    double couple = 1.0;          ///< eta
    double twisting = 2.0 / 3.0;  ///< k_t/k_b; that of a solid rod that keeps its volume
    double stretching = 4.0;      ///< k_s h^2/k_b; that of a solid rod
    double preload = 1.0;         ///< at the tail's end, by which the knot is tightened before the tail is let go
    double gap = 2.2;             ///< width of the hole
    double rim = 4.0;             ///< radius of its edges
    double below = 20.0;          ///< from the clamp to the hole, as it is drawn
    double speed = 0.5;           ///< of the clamp [1/s]
    double longest_step = 0.2;    ///< [s]
    double residual = 1e-4;
    double presliding = 2e-3;
    double contact_tolerance = 0.02;
  };

  /// After one time step of the pull.
  struct Reading {
    double way = 0.0;       ///< of the clamp since the tail was let go
    double force = 0.0;     ///< of the clamp
    double torque = 0.0;    ///< of the clamp, about the strand's tangent, which points up
    double passed = 0.0;    ///< rod that has passed the hole since then, at rest
    double twisting = 0.0;  ///< energy
    Points shape;           ///< of the rod from the hole on, every half radius of its rest length
  };

  struct Flip {
    std::size_t before = 0, after = 0;  ///< readings
    double change_of_shape = 0.0;
  };

  static constexpr double kFall = 0.1;         // of the force, by which it falls in a flip
  static constexpr double kWithin = 1.0;       // way of the clamp in which it does
  static constexpr double kOtherShape = 1.0;   // change of shape from which on it is another one
  static constexpr double kTail = 20.0;        // from the end of the knot, as drawn, to that of the tail
  static constexpr double kSeating = 0.5;      // with which the knot is on the hole as the tail is let go
  static constexpr double kKnotLength = 28.0;  // rod above the hole whose shape is looked at
  static constexpr double kDrag = 3e-4;        // fades motion of the whole within a third of a second
  static constexpr double kMass = 1e-4;        // per length: the time h^2 sqrt(m/k_b) is 0.01 s

  Options options;
  RodProperties rod;
  Boundary boundary;
  std::unique_ptr<TimeStep> stepper;
  StepControl control;
  std::vector<Reading> readings;
  double time = 0.0, way = 0.0;
  int last = 0;  // node

  explicit StopperKnot(const Options& options_) : options(options_), control(control_options(options_)) {
    Material material;
    material.radius = 1.0;
    material.density = kMass / M_PI;
    material.bending_stiffness = 1.0;
    material.stretching_stiffness = options.stretching;
    material.twisting_stiffness = options.twisting;
    RodState state;
    state.position = options.kind == Kind::kOverhand ? drawn_overhand() : drawn_figure_eight();
    if (options.mirrored) state.position.row(1) *= -1.0;
    last = static_cast<int>(state.position.cols()) - 1;
    rod = make_rod(material, (state.position.rightCols(last) - state.position.leftCols(last)).colwise().norm());
    state.velocity = Points::Zero(3, last + 1);
    initialise_frames(&state);
    stepper = TimeStep::make(rod, state, settings());
    const double off = options.rim + 0.5 * options.gap;
    for (const double side : {-off, off}) {
      boundary.rollers.push_back({Vec3(side, 0.0, 0.0), Vec3::UnitY(), options.rim});
      boundary.rollers.push_back({Vec3(0.0, side, 0.0), Vec3::UnitX(), options.rim});
    }
    boundary.fixed_nodes = {{0, state.position.col(0)}, {1, state.position.col(1)}};
    boundary.fixed_twists = {{0, 0.0}};
  }

  /// Tightens the knot by the preload, pulls it onto the hole, and lets the tail go.
  void tie() {
    settle();
    tighten();
    seat();
    let_go();
    way = 0.0;
    passed_before_ = at_hole();
    readings = {read()};
  }

  /// Pulls until the knot flips, after it last did, but not beyond that way.
  std::optional<Flip> pull_until_it_flips(double farthest) {
    while (way < farthest) {
      pull_by(1.0);
      if (const std::optional<Flip> flip = first_flip(searched_)) {
        searched_ = flip->after;
        return flip;
      }
    }
    return {};
  }

  void pull_by(double distance) {
    pull_while(distance, [&] {
      readings.push_back(read());
      return true;
    });
  }

  /// Of those after a reading.
  std::optional<Flip> first_flip(std::size_t from) const {
    for (std::size_t i = from; i < readings.size() && readings[i].way + kWithin <= way; ++i) {
      std::size_t end = i;
      double lowest = readings[i].force;
      bool highest = true;
      for (; end + 1 < readings.size() && readings[end + 1].way <= readings[i].way + kWithin; ++end) {
        lowest = std::min(lowest, readings[end + 1].force);
        highest = highest && readings[end + 1].force <= readings[i].force;
      }
      if (!highest || lowest > (1.0 - kFall) * readings[i].force) continue;
      const double change = change_of_shape(readings[i].shape, readings[end].shape);
      if (change > kOtherShape) return Flip{i, end, change};
    }
    return {};
  }

  /// Root mean square of how far points are from where they were, once both shapes are laid onto each other by the best
  /// motion without mirroring: |a - R b|^2 = |a|^2 + |b|^2 - 2 (s1 + s2 +- s3), s the singular values of a b^T.
  static double change_of_shape(const Points& from, const Points& to) {
    const Eigen::Index points = std::min(from.cols(), to.cols());
    const Points a = from.leftCols(points).colwise() - Vec3(from.leftCols(points).rowwise().mean());
    const Points b = to.leftCols(points).colwise() - Vec3(to.leftCols(points).rowwise().mean());
    const Mat3 product = a * b.transpose();
    const Vec3 s = Eigen::JacobiSVD<Mat3>(product).singularValues();
    const double overlap = s[0] + s[1] + (product.determinant() < 0.0 ? -s[2] : s[2]);
    return std::sqrt(std::max(0.0, a.squaredNorm() + b.squaredNorm() - 2.0 * overlap) / static_cast<double>(points));
  }

 private:
  static constexpr double kUnit = 0.01;  // shapes are drawn for a rod of this radius [m]

  double passed_before_ = 0.0;
  std::size_t searched_ = 0;  // up to that reading, for flips

  StepSettings settings() const {
    StepSettings out;
    out.pressure_law = NormalLaw{300.0, options.contact_tolerance, 0.015};
    out.friction = MemoryFriction{options.friction, options.presliding};
    out.roller_friction = out.friction;
    out.friction_couple = options.couple;
    out.drag = kDrag;
    out.residual = options.residual;
    out.residual_from_step = 0.1 * options.longest_step;
    out.residual_of_tension = 2e-6;
    out.newton_cap = 0.2;
    out.motion_limit = 0.8;
    out.overlap_limit = 0.5;
    out.candidate_margin = 1.0;
    out.max_iterations = 12;
    return out;
  }

  static StepControl::Options control_options(const Options& options) {
    StepControl::Options out;
    out.longest = options.longest_step;
    out.first = 1e-3;
    out.motion = 0.6;
    out.slip = 0.4;
    return out;
  }

  Points drawn_overhand() const {
    constexpr double kExcess = 90.0, kMiddle = 30.0;  // length that the loop takes; height of the knot over the hole
    OverhandShape shape;
    shape.radius = kUnit;
    shape.edge_length = kUnit * options.edge;
    shape.end_to_end = kUnit * 2.0 * (options.below + kMiddle);
    shape.length = shape.end_to_end + kUnit * kExcess;
    Points out = overhand(shape).points / kUnit;
    out.row(2).array() -= options.below;
    return out;
  }

  /// A B-spline of third degree. The strand comes up through the lower lobe, goes around the upper one, then around the
  /// lower one, and leaves through the upper one. At the four crossings it goes over (y > 0) and under in turn.
  Points drawn_figure_eight() const {
    constexpr double kMiddle = 20.0;  // height of the knot over the hole
    static const Vec3 kPlaces[] = {
        {0, 0, -24},   {0, 0, -20},    {0, 0, -17},                                     // from below
        {0, 2.4, -12}, {0, 0, -6},     {2, -2.4, -2},  {5, 0, 2},                       // through the lower
        {6.4, 0, 7},   {4, 1.2, 12},   {0, 2.4, 13},   {-4, 1.2, 12},   {-6.4, 0, 7},   // the upper lobe
        {-5, -1, 3.6}, {-2, -2.4, 2},  {0, 0, 0},      {2, 2.4, -2},    {5, 1, -3.6},   // down
        {6.4, 0, -7},  {4, -1.2, -12}, {0, -2.4, -13}, {-4, -1.2, -12}, {-6.4, 0, -7},  // the lower lobe
        {-5, 0, -2},   {-2, 2.4, 2},   {0, 0, 6},      {0, -2.4, 12},                   // through the upper
        {0, 0, 17},    {0, 0, 20},     {0, 0, 24}};                                     // to the tail
    constexpr int kPieces = 64;
    const Vec3 up(0.0, 0.0, kMiddle);
    std::vector<Vec3> line = {Vec3(0.0, 0.0, -options.below)};
    for (std::size_t i = 0; i + 3 < std::size(kPlaces); ++i) {
      for (int k = 0; k < kPieces; ++k) {
        const double u = static_cast<double>(k) / kPieces, v = 1.0 - u;
        const double b1 = 3.0 * u * u * u - 6.0 * u * u + 4.0, b2 = 3.0 * v * v * v - 6.0 * v * v + 4.0;
        line.emplace_back(
            up +
            (v * v * v * kPlaces[i] + b1 * kPlaces[i + 1] + b2 * kPlaces[i + 2] + u * u * u * kPlaces[i + 3]) / 6.0);
      }
    }
    line.emplace_back(0.0, 0.0, kMiddle + 24.0 + kTail);
    Points points(3, static_cast<Eigen::Index>(line.size()));
    for (std::size_t i = 0; i < line.size(); ++i) points.col(static_cast<Eigen::Index>(i)) = kUnit * line[i];
    return from_points(points, false, kUnit, kUnit * options.edge).points / kUnit;
  }

  /// Throws where the physics gives up. `set` sets the boundary as it stands so long after the beginning; `go_on` is
  /// asked after every step.
  void advance(double duration, const std::function<void(double)>& set, const std::function<bool()>& go_on) {
    const double from = time;
    const std::string gave_up = control.advance(
        *stepper, time, from + duration,
        [&](double, double to) -> const Boundary& {
          set(to - from);
          return boundary;
        },
        [&](double, double, const StepSummary&) {
          if (!go_on()) control.halt();
        });
    if (!gave_up.empty()) throw std::runtime_error(gave_up);
  }

  static bool always() { return true; }

  void settle() {
    constexpr double kDuration = 2.0;
    advance(
        kDuration, [&](double t) { boundary.extra_drag = 100.0 * kDrag * (1.0 - t / kDuration); }, always);
    boundary.extra_drag = 0.0;
  }

  /// Until the grip at the tail's end has slipped in that many steps on end.
  void tighten() {
    constexpr int kSteps = 40;
    constexpr double kFarthest = 200.0;
    SlippingGrip grip;
    grip.node = last;
    grip.stiffness = 10.0;
    grip.slip_force = options.preload;
    grip.place = stepper->state().position(2, last);
    boundary.grips = {grip};
    int slipped = 0;
    advance(
        kFarthest / options.speed, [&](double t) { boundary.grips[0].place = grip.place + options.speed * t; },
        [&] {
          slipped = boundary.grips[0].slips(stepper->state().position.col(last)) ? slipped + 1 : 0;
          return slipped < kSteps;
        });
    boundary.grips[0].place += 10.0 * kFarthest;  // from now on it slips, wherever the tail goes
  }

  void seat() {
    pull_while(1000.0, [&] {
      double on_hole = 0.0;
      for (int i = 0; i < static_cast<int>(boundary.rollers.size()); ++i)
        on_hole -= stepper->readings().roller_force(i)[2];
      return on_hole < kSeating;
    });
  }

  void let_go() {
    constexpr double kFading = 6.0, kDuration = 8.0;
    advance(
        kDuration, [&](double t) { boundary.grips[0].slip_force = options.preload * std::max(0.0, 1.0 - t / kFading); },
        always);
    boundary.grips.clear();
  }

  void pull_while(double distance, const std::function<bool()>& go_on) {
    const double from = way;
    const std::vector<FixedNode> held = boundary.fixed_nodes;
    advance(
        distance / options.speed,
        [&](double t) {
          way = from + options.speed * t;
          for (std::size_t i = 0; i < held.size(); ++i)
            boundary.fixed_nodes[i].position = held[i].position - options.speed * t * Vec3::UnitZ();
        },
        go_on);
  }

  /// Rest length from the clamp to the narrowest place of the hole.
  double at_hole() const {
    const auto z = stepper->state().position.row(2);
    double s = 0.0;
    for (int j = 0; j < last; ++j) {
      if (z[j + 1] > 0.0) return s - rod.rest_length[j] * z[j] / (z[j + 1] - z[j]);
      s += rod.rest_length[j];
    }
    return s;
  }

  Reading read() const {
    Reading out;
    out.way = way;
    out.force = -(stepper->readings().reaction(0) + stepper->readings().reaction(1))[2];
    out.torque = stepper->readings().reaction_torque(0);
    out.passed = at_hole() - passed_before_;
    out.twisting = stepper->readings().energies().twisting;
    out.shape = shape_from(at_hole());
    return out;
  }

  Points shape_from(double s) const {
    constexpr double kSpacing = 0.5;
    const Points& x = stepper->state().position;
    const Eigen::VectorXd arclength = rod.arclength();
    Points out(3, static_cast<Eigen::Index>(kKnotLength / kSpacing));
    Eigen::Index j = 0;
    for (Eigen::Index k = 0; k < out.cols(); ++k, s += kSpacing) {
      while (j + 1 < last && arclength[j + 1] < s) ++j;
      const double share = std::min(1.0, (s - arclength[j]) / rod.rest_length[j]);
      out.col(k) = x.col(j) + share * (x.col(j + 1) - x.col(j));
    }
    return out;
  }
};

}  // namespace knot_utm
