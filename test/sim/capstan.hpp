#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "knot_utm/numeric/points.hpp"
#include "knot_utm/rod/rod.hpp"
#include "knot_utm/sim/step_control.hpp"
#include "sim/scenes.hpp"

namespace knot_utm {

/// Capstan with a rod that resists bending: the larger tension over the smaller one, both far from the roller.
///
///     T2 (cos a2 - mu sin a2) = T1 (cos a1 + mu sin a1) exp(mu (phi - a1 - a2)),  cos a_i = 1 - B/(2 T_i rho^2)
///
/// with the angles a_i by which the rod leaves the roller early; rho is the radius of its centreline there.
inline double elastic_capstan(double t1, double mu, double phi) {
  auto angle = [](double t) { return std::acos(1.0 - 0.5 / t); };
  const double a1 = angle(t1);
  double ratio = std::exp(mu * phi);
  for (int i = 0; i < 100; ++i) {
    const double a2 = angle(ratio * t1);
    ratio = (std::cos(a1) + mu * std::sin(a1)) * std::exp(mu * (phi - a1 - a2)) / (std::cos(a2) - mu * std::sin(a2));
  }
  return ratio;
}

/// The same where friction acts at the surface, of curvature 1/rho throughout: T grows as exp(x phi) with eta = h/rho.
/// Friction leaves the shear force Q = -mu p h, so that, with f = mu (1 - eta), T' = f p and p = T/rho + Q', and x
/// solves mu eta x^2 + x = f. Resistance to rolling has no part in it: the sections turn about the shaft's axis, across
/// the line of contact.
inline double surface_exponent(double mu, double eta) {
  const double f = mu * (1.0 - eta);
  return 2.0 * f / (1.0 + std::sqrt(1.0 + 4.0 * mu * eta * f));
}

/// A rod of bending stiffness 1 around a shaft of a radius near 1, pulled at T1 or more.
inline StepSettings capstan_settings(const Material& material, double t1, double tolerance, double residual) {
  StepSettings settings = closed_form_settings(material);
  settings.pressure_law = NormalLaw{2e3 * t1, tolerance};
  settings.residual = residual * t1;
  settings.residual_of_tension = 0.0;
  settings.newton_cap = 0.05;
  settings.motion_limit = 0.5;
  settings.overlap_limit = 0.05;
  return settings;
}

/// A rod in one turn around a fixed roller along x, as a helix of so small a pitch (two diameters of a thin rod) that
/// its two tails, both in the plane y = rho, just pass one another. T1 is a dead load on the first node; the last one
/// is pulled along its tail. Lengths in units of rho = 1, bending stiffness 1.
struct Capstan {
  static constexpr double kRadius = 0.02;  // h
  static constexpr double kPitch = 4.0 * kRadius;
  static constexpr double kMu = 0.3;
  static constexpr double kSpeed = 0.1;

  struct Options {
    double edges_a_turn = 64.0;
    double strides_an_edge = 20.0;  ///< time steps while the rod slides by the length of an edge
    double residual = 1e-7;         ///< [T1]
    double contact_tolerance = 1e-3;
    double presliding = 1e-3;
    bool smoothed = false;                    ///< friction that creeps, else one that remembers
    double slip_tolerance = 0.01 * kSpeed;    ///< smoothed friction
    std::optional<Friction> roller_friction;  ///< another law than these two
  };

  Options options;
  double t1, edge_length;
  Boundary boundary;
  std::unique_ptr<TimeStep> stepper;
  Vec3 pull;
  int last = 0;
  StepControl::Counters counters{};
  double time = 0.0;

  Capstan(double t1_, const Options& options_) : options(options_), t1(t1_) {
    const double turn = std::hypot(2.0 * M_PI, kPitch);
    edge_length = turn / options.edges_a_turn;
    // Tails so long that what bending leaves of the roller's curvature is gone at their ends, and room to slide.
    const int low = static_cast<int>(std::ceil((7.0 / std::sqrt(t1) + 2.0) / edge_length));
    const int high = static_cast<int>(std::ceil((7.0 / std::sqrt(5.0 * t1) + 1.0) / edge_length));
    const int wrapped = static_cast<int>(options.edges_a_turn);
    last = low + wrapped + high;

    Material material;
    material.radius = kRadius;
    material.density = 1.0;
    material.bending_stiffness = 1.0;
    material.stretching_stiffness = 1e4 * t1;
    const RodProperties rod = make_rod(material, Eigen::VectorXd::Constant(last, edge_length));

    // x along the roller; the turn starts and ends at angle 0 on the side of +y.
    auto helix = [&](double angle) {
      return Vec3(kPitch * (angle / (2.0 * M_PI) - 0.5), std::cos(angle), std::sin(angle));
    };
    const double slope = 2.0 * M_PI / turn;
    const Vec3 along(kPitch / turn, 0.0, slope);
    RodState state;
    state.position.resize(3, last + 1);
    state.velocity = Points::Zero(3, last + 1);
    for (int i = 0; i <= last; ++i) {
      const double s = edge_length * (i - low);
      state.position.col(i) = s < 0.0    ? Vec3(helix(0.0) + s * along)
                              : s > turn ? Vec3(helix(2.0 * M_PI) + (s - turn) * along)
                                         : helix(2.0 * M_PI * s / turn);
    }
    pull = along;

    StepSettings settings = capstan_settings(material, t1, options.contact_tolerance, options.residual);
    settings.roller_friction = MemoryFriction{kMu, options.presliding};
    if (options.smoothed) settings.roller_friction = SmoothedFriction{kMu, options.slip_tolerance};
    if (options.roller_friction) settings.roller_friction = *options.roller_friction;
    stepper = TimeStep::make(rod, state, settings);

    Roller roller;
    roller.axis = Vec3::UnitX();
    roller.radius = 1.0 - kRadius;
    boundary.rollers = {roller};
    boundary.forces = {{0, -t1 * along}};
    boundary.fixed_nodes = {{last, state.position.col(last)}};
  }

  /// Pulls the rod by `distance` in steps of no more than `stride`; mean of T2/T1 over their length. Throws where the
  /// physics gives up.
  double pull_by(double distance, double stride) {
    StepControl::Options control_options;
    control_options.longest = stride / kSpeed;
    control_options.motion = 0.5;
    StepControl control(control_options);
    const Vec3 from = boundary.fixed_nodes[0].position;
    double now = 0.0, sum = 0.0;
    const std::string gave_up = control.advance(
        *stepper, now, distance / kSpeed,
        [&](double, double to) -> const Boundary& {
          boundary.fixed_nodes[0].position = from + kSpeed * to * pull;
          return boundary;
        },
        [&](double, double dt, const StepSummary&) {
          sum += kSpeed * dt * stepper->readings().reaction(last).norm() / t1;
        });
    if (!gave_up.empty()) throw std::runtime_error(gave_up);
    counters.steps += control.counters().steps;
    counters.rejected += control.counters().rejected;
    counters.iterations += control.counters().iterations;
    time += now;
    return sum / distance;
  }

  /// T2/T1 while sliding: over the length of an edge, once the rod has slid by rho.
  double ratio() {
    const double stride = edge_length / options.strides_an_edge;
    pull_by(1.0, std::min(0.2 / options.strides_an_edge, 5.0 * stride));
    return pull_by(edge_length, stride);
  }
};

}  // namespace knot_utm
