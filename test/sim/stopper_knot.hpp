#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "knot_utm/rod/frames.hpp"
#include "knot_utm/sim/step_control.hpp"
#include "knot_utm/specimen/centreline.hpp"
#include "knot_utm/specimen/overhand.hpp"
#include "knot_utm/specimen/polyline.hpp"
#include "sim/scenes.hpp"

namespace knot_utm {

/// A knot in a soft solid rod that stops the rod in a hole. The strand below the knot runs down through the hole and is
/// pulled by a clamp, which holds its spin; the tail above is free. Lengths are in radii h of the rod, forces in
/// k_b/h^2, times in seconds.
///
/// The hole is square, with round edges: four fixed cylinders in one plane, two along x and two along y. As they only
/// touch the rod, they may run through each other.
struct StopperKnot {
  enum class Kind { kOverhand, kFigureEight };

  struct Options {
    Kind kind = Kind::kFigureEight;
    double edge = 1.0;       ///< length of an edge
    double friction = 0.3;   ///< mu, between strands and on the hole
    double couple = 1.0;     ///< eta
    double twisting = 2.0 / 3.0;  ///< k_t/k_b
    double preload = 1.0;    ///< that tightens the knot before the tail is let go
    double seating = 0.5;    ///< with which it is pressed on the hole before the tail is let go
    double gap = 2.2;        ///< width of the hole
    double rim = 4.0;        ///< radius of the cylinders
    double stretching = 4.0; ///< k_s h^2/k_b
    double speed = 0.5;      ///< of the clamp [1/s]
    double residual = 1e-4;
    double longest = 0.2;    ///< step [s]
    double below = 20.0, above = 20.0, tail = 20.0;  ///< as it is drawn: clamp, middle of the knot, end of the tail over it
  };

  struct Reading {
    double way = 0.0;      ///< of the clamp since the tail was let go
    double force = 0.0;    ///< on the clamp
    double torque = 0.0;   ///< on the clamp
    double drawn = 0.0;    ///< rod that has passed the hole, at rest, since the tail was let go
    double writhe = 0.0;
    double crossings = 0.0;
    double height = 0.0;   ///< of the knot
    double bending = 0.0, twisting = 0.0;
  };

  Options options;
  RodProperties rod;
  Boundary boundary;
  std::unique_ptr<TimeStep> stepper;
  StepControl control;
  double time = 0.0, way = 0.0, passed = 0.0;
  int last = 0;

  explicit StopperKnot(const Options& options_) : options(options_), control(control_options(options_)) {
    Material material;
    material.radius = 1.0;
    material.density = 1e-4 / M_PI;
    material.bending_stiffness = 1.0;
    material.stretching_stiffness = options.stretching;
    material.twisting_stiffness = options.twisting;
    RodState state;
    state.position = drawn();
    last = static_cast<int>(state.position.cols()) - 1;
    rod = make_rod(material, (state.position.rightCols(last) - state.position.leftCols(last)).colwise().norm());
    state.velocity = Points::Zero(3, last + 1);
    initialise_frames(&state);

    StepSettings settings;
    settings.normal = {300.0, 0.02, 0.015};
    settings.friction = MemoryFriction{options.friction, 2e-3};
    settings.roller_friction = MemoryFriction{options.friction, 2e-3};
    settings.friction_couple = options.couple;
    settings.drag = 3e-4;
    settings.residual = options.residual;
    settings.residual_from_step = 0.1 * options.longest;
    settings.residual_of_tension = 2e-6;
    settings.newton_cap = 0.2;
    settings.motion_limit = 0.8;
    settings.overlap_limit = 0.5;
    settings.candidate_margin = 1.0;
    settings.max_iterations = 12;
    stepper = TimeStep::make(rod, state, settings);

    const double off = options.rim + 0.5 * options.gap;
    for (const double side : {-off, off}) {
      boundary.rollers.push_back({Vec3(side, 0.0, 0.0), Vec3::UnitY(), options.rim});
      boundary.rollers.push_back({Vec3(0.0, side, 0.0), Vec3::UnitX(), options.rim});
    }
    boundary.fixed_nodes = {{0, state.position.col(0)}, {1, state.position.col(1)}};
    boundary.fixed_twists = {{0, 0.0}};
  }

  static StepControl::Options control_options(const Options& options) {
    StepControl::Options out;
    out.longest = options.longest;
    out.first = 1e-3;
    out.motion = 0.6;
    out.slip = 0.4;
    return out;
  }

  static constexpr double kDrawn = 0.01;
  Points drawn() const {
    Points points;
    if (options.kind == Kind::kOverhand) {
      OverhandShape shape;
      shape.radius = kDrawn;
      shape.edge_length = kDrawn * options.edge;
      shape.end_to_end = kDrawn * (options.below + options.above + options.tail);
      shape.length = shape.end_to_end + kDrawn * 40.0;
      points = overhand(shape).points / kDrawn;
      points.row(2).array() -= options.below;
      return points;
    }
    Points control_points(3, 29);
    control_points.transpose() << 0, 0, -12, 0, 0, -10, 0, 0, -8.5,  //
        0, 2.4, -6, 0, 0, -3, 1, -2.4, -1, 2.5, 0, 1, 3.2, 0, 3.5,   //
        2, 1.2, 6, 0, 2.4, 6.5, -2, 1.2, 6, -3.2, 0, 3.5, -2.5, -1, 1.8, -1, -2.4, 1,  //
        0, 0, 0, 1, 2.4, -1, 2.5, 1, -1.8, 3.2, 0, -3.5, 2, -1.2, -6, 0, -2.4, -6.5, -2, -1.2, -6,  //
        -3.2, 0, -3.5, -2.5, 0, -1, -1, 2.4, 1, 0, 0, 3, 0, -2.4, 6, 0, 0, 8.5, 0, 0, 10, 0, 0, 12;
    control_points.row(0) *= 2.0;
    control_points.row(2) *= 2.0;
    std::vector<Vec3> path = {Vec3(0.0, 0.0, -options.below)};
    for (int i = 0; i + 3 < control_points.cols(); ++i) {
      for (int k = 0; k < 64; ++k) {
        const double u = k / 64.0, v = 1.0 - u;
        path.emplace_back((v * v * v * control_points.col(i) +
                           (3.0 * u * u * u - 6.0 * u * u + 4.0) * control_points.col(i + 1) +
                           (3.0 * v * v * v - 6.0 * v * v + 4.0) * control_points.col(i + 2) +
                           u * u * u * control_points.col(i + 3)) /
                          6.0);
        path.back()[2] += options.above;
      }
    }
    path.emplace_back(0.0, 0.0, options.above + 24.0 + options.tail);
    Points line(3, static_cast<Eigen::Index>(path.size()));
    for (std::size_t i = 0; i < path.size(); ++i) line.col(static_cast<Eigen::Index>(i)) = path[i];
    return from_points(kDrawn * line, false, kDrawn, kDrawn * options.edge).points / kDrawn;
  }

  using Watch = std::function<bool(StopperKnot&)>;  ///< true: go on

  void advance(double duration, const std::function<void(double)>& to_boundary, const Watch& watch = {}) {
    const double from = time;
    const std::string gave_up = control.advance(
        *stepper, time, from + duration,
        [&](double, double to) -> const Boundary& {
          to_boundary(to - from);
          return boundary;
        },
        [&](double, double, const StepSummary&) {
          if (watch && !watch(*this)) control.halt();
        });
    if (!gave_up.empty()) throw std::runtime_error(gave_up);
  }

  /// Settles; tightens the knot by the preload at the tail's end; seats it in the hole; lets the tail go.
  void tie(const Watch& watch = {}) {
    boundary.extra_drag = 0.03;
    advance(2.0, [&](double t) { boundary.extra_drag = 0.03 * (1.0 - 0.5 * t); }, watch);
    boundary.extra_drag = 0.0;
    SlippingGrip grip;
    grip.node = last;
    grip.stiffness = 10.0;
    grip.slip_force = options.preload;
    grip.place = stepper->state().position(2, last);
    boundary.grips = {grip};
    int slipping = 0;
    const double from = grip.place;
    advance(200.0 / options.speed,
            [&](double t) { boundary.grips[0].place = from + options.speed * t; },
            [&](StopperKnot& self) {
              slipping = boundary.grips[0].slips(stepper->state().position.col(last)) ? slipping + 1 : 0;
              return (!watch || watch(self)) && slipping < 40;
            });
    boundary.grips[0].place += 1e3;  // it goes on slipping, whichever way the tail goes
    pull(200.0, [&](StopperKnot& self) {
      return (!watch || watch(self)) && on_hole() < options.seating;
    });
    const double seated = options.preload;
    advance(8.0, [&](double t) { boundary.grips[0].slip_force = seated * std::max(0.0, 1.0 - t / 6.0); }, watch);
    boundary.grips.clear();
    way = 0.0;
    passed = at_hole();
  }

  /// What the knot presses on the hole with, along the strand.
  double on_hole() const {
    double sum = 0.0;
    for (int i = 0; i < 4; ++i) sum -= stepper->roller_force(i)[2];
    return sum;
  }

  void pull(double by, const Watch& watch) {
    const double from = way;
    const std::vector<FixedNode> held = boundary.fixed_nodes;
    advance(by / options.speed,
            [&](double t) {
              way = from + options.speed * t;
              for (std::size_t i = 0; i < held.size(); ++i) {
                boundary.fixed_nodes[i].position = held[i].position - options.speed * t * Vec3::UnitZ();
              }
            },
            watch);
  }

  /// Arclength at rest of the strand at the hole's narrowest place.
  double at_hole() const {
    const Points& x = stepper->state().position;
    double s = 0.0;
    for (int j = 0; j < last; ++j) {
      if (x(2, j + 1) > 0.0) return s + rod.rest_length[j] * -x(2, j) / (x(2, j + 1) - x(2, j));
      s += rod.rest_length[j];
    }
    return s;
  }

  Reading read() const {
    Reading out;
    const Points& x = stepper->state().position;
    out.way = way;
    out.force = -(stepper->reaction(0) + stepper->reaction(1))[2];
    out.torque = stepper->reaction_torque(0);
    out.drawn = at_hole() - passed;
    double writhe = 0.0, crossings = 0.0;
    for (int i = 0; i < last; ++i) {
      const Vec3 a = 0.5 * (x.col(i) + x.col(i + 1)), ea = x.col(i + 1) - x.col(i);
      for (int j = 0; j < i - 1; ++j) {
        const Vec3 r = a - 0.5 * (x.col(j) + x.col(j + 1));
        const double part = ea.cross(x.col(j + 1) - x.col(j)).dot(r) / (2.0 * M_PI * std::pow(r.norm(), 3.0));
        writhe += part;
        crossings += std::abs(part);
      }
    }
    out.writhe = writhe;
    out.crossings = crossings;
    out.height = x(2, last);
    out.bending = stepper->energies().bending;
    out.twisting = stepper->energies().twisting;
    return out;
  }
};

}  // namespace knot_utm
