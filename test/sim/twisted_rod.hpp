#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>

#include "knot_utm/numeric/points.hpp"
#include "knot_utm/rod/frames.hpp"
#include "knot_utm/rod/rod.hpp"
#include "knot_utm/sim/step_control.hpp"
#include "knot_utm/sim/time_step.hpp"

namespace knot_utm {

/// A straight rod of bending stiffness 1 and mass 1 per length along x with its middle at the origin, clamped at both
/// ends (two nodes and the frame of the edge between them). The clamps are brought nearer, each by half, and the far
/// one is turned about x. Twist has no inertia, so it is even at all times.
struct TwistedRod {
  RodProperties rod;
  StepSettings settings;
  Boundary boundary;
  std::unique_ptr<TimeStep> step;
  double shortening = 0.0, turn = 0.0;  // of the ends [m], of the far clamp [rad]

  TwistedRod(double radius, double twisting_stiffness, int edges, double edge_length) {
    RodMaterial material;
    material.radius = radius;
    material.density = 1.0 / (M_PI * radius * radius);
    material.bending_stiffness = 1.0;
    material.twisting_stiffness = twisting_stiffness;
    material.stretching_stiffness = 1e5;
    rod = make_rod(material, Eigen::VectorXd::Constant(edges, edge_length));
    settings.spin_inertia = false;
    settings.pressure_law = NormalLaw{1.0, 0.05 * radius};
    settings.max_iterations = 40;
  }

  /// Begins with a bend in its middle, `amplitude` high and about `size` long; no edge is strained.
  void begin(double amplitude, double size) {
    RodState state;
    const Eigen::Index nodes = rod.nodes();
    const double edge = rod.rest_length[0];
    state.position = Points::Zero(3, nodes);
    for (Eigen::Index i = 2; i + 2 < nodes; ++i) {
      const double s = (edge * static_cast<double>(i) - 0.5 * rod.length()) / size;
      state.position.col(i).tail<2>() = amplitude / std::cosh(s) * Eigen::Vector2d(std::cos(s), std::sin(s));
    }
    for (Eigen::Index i = 1; i < nodes; ++i) {
      const double across2 = (state.position.col(i) - state.position.col(i - 1)).tail<2>().squaredNorm();
      state.position(0, i) = state.position(0, i - 1) + std::sqrt(edge * edge - across2);
    }
    shortening = rod.length() - state.position(0, nodes - 1);
    state.position.row(0).array() -= 0.5 * state.position(0, nodes - 1);
    state.velocity = Points::Zero(3, nodes);
    initialise_frames(&state);
    step = TimeStep::make(rod, state, settings);
    const int last = static_cast<int>(nodes) - 1;
    for (const int node : {0, 1, last - 1, last}) boundary.fixed_nodes.push_back({node, state.position.col(node)});
    boundary.fixed_twists = {{0, 0.0}, {last - 1, 0.0}};
  }

  /// Moves the clamps within `time`, from rest to rest: a sudden start would compress the rod.
  void move_to(double new_shortening, double new_turn, double time, double longest_step, double motion) {
    StepControl::Options options;
    options.longest = longest_step;
    options.motion = motion;
    StepControl control(options);
    const double from = shortening, turned = turn;
    double now = 0.0;
    const std::string gave_up = control.advance(
        *step, now, time,
        [&](double, double to) -> const Boundary& {
          const double t = to / time, way = t * t * (3.0 - 2.0 * t);
          shortening = from + (new_shortening - from) * way;
          turn = turned + (new_turn - turned) * way;
          place_clamps();
          return boundary;
        },
        [](double, double, const StepSummary&) {});
    ASSERT_EQ(gave_up, "");
  }

  /// Force along the rod at the far clamp, and moment about it.
  double tension() const {
    return step->readings().reaction(last_node() - 1).x() + step->readings().reaction(last_node()).x();
  }
  double moment() const { return step->readings().reaction_torque(last_node() - 1); }
  double fastest() const { return step->state().velocity.colwise().norm().maxCoeff(); }

 private:
  int last_node() const { return static_cast<int>(rod.nodes()) - 1; }

  void place_clamps() {
    const double end = 0.5 * (rod.length() - shortening), inner = end - rod.rest_length[0];
    const double places[] = {-end, -inner, inner, end};
    for (std::size_t k = 0; k < 4; ++k) boundary.fixed_nodes[k].position.x() = places[k];
    boundary.fixed_twists[1].angle = turn;
  }
};

}  // namespace knot_utm
