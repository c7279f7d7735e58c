#pragma once

#include <memory>
#include <stdexcept>
#include <string>

#include "knot_utm/numeric/points.hpp"
#include "knot_utm/rod/frames.hpp"
#include "knot_utm/rod/rod.hpp"
#include "knot_utm/sim/step_control.hpp"
#include "sim/scenes.hpp"

namespace knot_utm {

/// A short rod lies on the floor as a log, along y. Another one lies across it, along x, presses it down and is dragged
/// along itself like a plank. The log is free. Where friction acts at the surfaces the log rolls on the floor by half
/// of the plank's way, and neither of them slides. Where it acts on the centrelines, the plank slides over the log.
///
/// The two rods are one chain of nodes whose edge between them has parted: the log first.
struct RollingLog {
  static constexpr int kLog = 60, kPlank = 80;  // edges
  static constexpr double kSpeed = 1e-3;
  Material material;
  Boundary boundary;
  std::unique_ptr<TimeStep> stepper;
  Points begin;
  double time = 0.0;

  explicit RollingLog(double couple = 1.0) {
    material = table1(1200.0, 22.15, 5.67e-5, 3.78e-5, 0.0);  // a solid rod: green VPS
    const double h = material.radius, edge = 0.2 * h;
    StepSettings settings = closed_form_settings(material);
    settings.friction = MemoryFriction{0.5, kPresliding * h};
    settings.roller_friction = settings.friction;
    settings.friction_couple = couple;
    settings.gravity = Vec3(0.0, 0.0, -9.81);
    settings.residual = 1e-6;
    const int nodes = RollingLog::nodes();
    RodState state;
    state.position.resize(3, nodes);
    state.velocity = Points::Zero(3, nodes);
    for (int i = 0; i <= kLog; ++i) state.position.col(i) << 0.0, edge * (i - 0.5 * kLog), 0.0;
    const double above = 2.0 * h - 2.0 * kPressed * h;
    for (int i = 0; i <= kPlank; ++i) state.position.col(kLog + 1 + i) << edge * (i - 0.5 * kPlank), 0.0, above;
    initialise_frames(&state);
    begin = state.position;
    const Points edges = begin.rightCols(nodes - 1) - begin.leftCols(nodes - 1);
    stepper = TimeStep::make(make_rod(material, edges.colwise().norm().transpose()), state, settings);
    stepper->part(kLog);
    boundary.rollers = {plane_below(h)};
    boundary.rollers[0].axis = Vec3::UnitY();
    boundary.rollers[0].last_node = kLog;
    for (int i = kLog + 1; i < nodes; ++i) boundary.fixed_nodes.push_back({i, begin.col(i)});
    advance(0.2);
  }

  static constexpr int nodes() { return kLog + kPlank + 2; }
  /// Drags the plank on by `way` in steps of a fiftieth of the radius. Throws where the physics gives up.
  void drag(double way) {
    way_ += way;
    advance(way / kSpeed);
  }

  /// How far the log has gone, and by what angle it has turned.
  double moved() const { return stepper->state().position.row(0).head(kLog + 1).mean(); }
  double turned() const { return stepper->state().twist.head(kLog).mean(); }
  /// How far the two centrelines are apart where they cross.
  double apart() const { return stepper->state().position(2, nodes() - 1) - stepper->state().position(2, kLog / 2); }
  /// By how much the surfaces stick elastically before they slide.
  double presliding() const { return kPresliding * material.radius; }

 private:
  static constexpr double kPressed = 0.005;  // by what the plank presses the log, and the log the floor [h]
  static constexpr double kPresliding = 1e-3;
  double way_ = 0.0, reached_ = 0.0;

  void advance(double duration) {
    StepControl::Options options;
    options.longest = options.first = 0.02 * material.radius / kSpeed;
    options.motion = options.slip = 1.0;
    StepControl control(options);
    const double from = time, begun = reached_, ahead = way_ - reached_;
    const std::string gave_up = control.advance(
        *stepper, time, from + duration,
        [&](double, double to) -> const Boundary& {
          reached_ = begun + ahead * (to - from) / duration;
          for (FixedNode& held : boundary.fixed_nodes) held.position[0] = begin(0, held.node) + reached_;
          return boundary;
        },
        [](double, double, const StepSummary&) {});
    if (!gave_up.empty()) throw std::runtime_error(gave_up);
  }
};

}  // namespace knot_utm
