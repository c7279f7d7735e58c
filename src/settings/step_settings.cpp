#include "knot_utm/settings/step_settings.hpp"

#include <algorithm>
#include <cmath>

#include "knot_utm/numeric/pieces.hpp"
#include "knot_utm/settings/accuracy.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/specimen/material.hpp"
#include "knot_utm/specimen/polyline.hpp"
#include "knot_utm/specimen/scales.hpp"

namespace knot_utm {

namespace {

constexpr double kFullResidual = 0.1;        // of the longest step, below which the residual shrinks with the step
constexpr double kResidualOfTension = 2e-6;  // of the largest tension, so that kN loads do not ask for more than digits
constexpr double kNewtonCap = 0.2;           // farthest that an iteration moves a node [h]
constexpr double kMotionLimit = 0.8;         // farthest that a step may move one: then no strand passes another [h]
constexpr double kOverlapLimit = 0.5;        // deepest contact of round sections that a step may begin or end with [h]
constexpr double kCandidateMargin = 1.0;     // gap up to which pairs of segments are watched between searches [h]
constexpr double kUneven = 1e-6;             // by which a sketch may miss its image, before it is made even [h]
constexpr int kMostIterations = 12;          // of Newton's method in a step
// Way over which a rolling contact springs before it bears all of its couple [mu_r h]. Where the half that is left
// behind bears nothing, mu_r h is 4/(3 pi) of the half width a. The contact moves by half of the way, so that it has
// moved by a fourteenth of a: as soon as fibres that stick twenty times as stiffly as they slide let go of what presses
// them.
constexpr double kRollsWithin = 1.0 / 3.0;
constexpr double kResidualAtLittleTension = 1e-3;  // loose knots bear much less than k_b/h^2, and are read too

/// rho_s over h, tied to the width of the contact; where that follows from the pressure, the presliding of friction.
double rolls_within(double resistance, double presliding) { return std::max(kRollsWithin * resistance, presliding); }

/// That of contacts of one material. `presliding`: of friction, in its radius.
RollingResistance rolling_of(const Material& material, double presliding) {
  const double h = material.radius;
  return {material.rolling_resistance, h, rolls_within(material.rolling_resistance, presliding) * h,
          RollingResistance::growth_of_hysteresis(material.rolling_hysteresis, h, material.stretching_stiffness)};
}

}  // namespace

double friction_couple(const Material& material, const PhysicsOptions& physics) {
  return physics.friction_at == FrictionAt::kSurface ? default_friction_couple(material) : 0.0;
}

NormalLaw normal_law(const Material& material, double tolerance) {
  constexpr double kStiffeningDepth = 0.015;  // c: at the kN of a locked knot a rod gives 5 % [h]
  // A cylinder of rubber squeezed by 20 to 50 % of its diameter, in plane strain: within 8 % of finite elements
  // (doc/developers/history.md).
  constexpr double kSoftStiffeningDepth = 0.8;
  const double depth = material.is_soft() ? kSoftStiffeningDepth : kStiffeningDepth;
  return {default_contact_stiffness(material), tolerance, depth * material.radius};
}

double pair_friction(const Material& material, const PhysicsOptions& physics) {
  const double own = material.friction_coefficient, other = material.other->friction_coefficient;
  if (physics.pair_friction) return *physics.pair_friction;
  switch (physics.pair_rule) {
    case PairRule::kMean:
      return 0.5 * (own + other);
    case PairRule::kProduct:
      return own * other;
    case PairRule::kRootOfProduct:
      return std::sqrt(own * other);
    case PairRule::kSmaller:
      break;
  }
  return std::min(own, other);
}

NormalLaw normal_law_between(const Material& a, const Material& b, double tolerance) {
  const NormalLaw of_a = normal_law(a, tolerance), of_b = normal_law(b, tolerance);
  const double softer = 2.0 * of_a.stiffness * of_b.stiffness / (of_a.stiffness + of_b.stiffness);
  return {softer, tolerance, 0.5 * (of_a.stiffening + of_b.stiffening)};
}

RollingResistance rolling_between(const Material& a, const Material& b, double presliding) {
  const double h = 2.0 / (1.0 / a.radius + 1.0 / b.radius), k_a = default_contact_stiffness(a),
               k_b = default_contact_stiffness(b), share_of_a = k_b / (k_a + k_b);
  const auto mean = [&](double of_a, double of_b) { return of_b + share_of_a * (of_a - of_b); };
  const auto soft = [](const Material& of) { return of.radius * of.radius / of.stretching_stiffness; };  // 1/(pi E)
  const double lost = mean(a.rolling_hysteresis, b.rolling_hysteresis), stretching = 2.0 * h * h / (soft(a) + soft(b));
  const double resistance = mean(a.rolling_resistance, b.rolling_resistance);
  return {resistance, h, rolls_within(resistance, presliding) * h,
          RollingResistance::growth_of_hysteresis(lost, h, stretching)};
}

bool friction_rolls(const Material& material, const MachineOptions& machine, const PhysicsOptions& physics) {
  bool rubs = material.friction_coefficient > 0.0 || machine.roller_friction > 0.0;
  if (material.other)
    rubs = rubs || material.other->friction_coefficient > 0.0 || pair_friction(material, physics) > 0.0;
  return rubs && friction_couple(material, physics) > 0.0;
}

StepSettings step_settings(const SpecimenOptions& specimen, const Material& material, const MachineOptions& machine,
                           const PhysicsOptions& physics) {
  const Tolerances tolerance = tolerances(physics, specimen, material);
  const double h = material.radius;
  StepSettings out;
  out.pressure_law = normal_law(material, tolerance.contact_tolerance * h);
  out.friction = Friction::of(physics.friction, {material.friction_coefficient, h, tolerance.presliding});
  out.roller_friction = Friction::of(physics.friction, {machine.roller_friction, h, tolerance.presliding});
  out.friction_couple = friction_couple(material, physics);
  if (out.friction_couple > 0.0) out.rolling = rolling_of(material, tolerance.presliding);
  if (material.other) {
    const Material& other = *material.other;
    const double h_other = other.radius, middle = 0.5 * (h + h_other);
    const auto laws = [&](const NormalLaw& normal, double coefficient, double radius) {
      return PairLaws{normal, Friction::of(physics.friction, {coefficient, radius, tolerance.presliding})};
    };
    const NormalLaw own = normal_law(other, tolerance.contact_tolerance * h_other),
                    between = normal_law_between(material, other, tolerance.contact_tolerance * middle);
    out.others = {laws(between, pair_friction(material, physics), middle),
                  laws(own, other.friction_coefficient, h_other),
                  laws(other.is_soft() ? own.on_rigid() : own, machine.roller_friction, h_other),
                  {},
                  {}};
    if (out.friction_couple > 0.0) {
      out.others->rolling_between = rolling_between(material, other, tolerance.presliding);
      out.others->rolling_own = rolling_of(other, tolerance.presliding);
    }
  }
  // A slow test; and a rod that is free to turn is then the same with twist and without. But where friction rolls
  // strands their spin can jump as they let go, and without inertia no step would be short enough.
  out.spin_inertia = friction_rolls(material, machine, physics);
  out.residual = tolerance.residual * material.bending_stiffness / (h * h);
  if (material.other)
    out.residual = std::min(out.residual, tolerance.residual * specimen_scales(*material.other).force);
  out.residual_from_step = kFullResidual * tolerance.longest_step;
  out.residual_of_tension = kResidualOfTension;
  out.residual_at_little_tension = kResidualAtLittleTension;
  const double thin = thinnest(material);
  out.newton_cap = kNewtonCap * thin;
  out.motion_limit = kMotionLimit * thin;
  out.overlap_limit = (material.is_soft() ? kDeepestSoft : kOverlapLimit) * thin;
  out.candidate_margin = kCandidateMargin * thin;
  out.max_iterations = kMostIterations;
  return out;
}

Centreline specimen_centreline(const SpecimenOptions& specimen, const Material& material, const MachineOptions& machine,
                               const PhysicsOptions& physics) {
  Mounting mounting;
  mounting.rollers = rollers_hold(specimen, machine);
  mounting.clamps = clamps_hold(specimen, machine);
  mounting.roller_diameter = machine.roller_diameter;
  mounting.refinement = tolerances(physics, specimen, material).refinement;
  Centreline out = knot_of(specimen).centreline(specimen, material, mounting);
  const bool can_be_even = out.cuts.empty() && !knot_of(specimen).about().straight && specimen.natural_curvature == 0.0;
  if (physics.symmetry == Symmetry::kOff || !can_be_even) return out;
  out.half_turn = HalfTurn::of(out.points, kUneven * material.radius);
  if (out.half_turn) out.half_turn->mirror(out.points);
  return out;
}

double slack_of(const SpecimenOptions& specimen, const Centreline& centreline) {
  const KnotDescription& knot = knot_of(specimen).about();
  if (!knot.may_hold_a_knot() || knot.loop) return 0.0;
  const Points& x = centreline.points;
  const std::vector<double> at = arclengths(x);
  double slack = 0.0;
  for (const Piece& rope : pieces_between(x.cols(), centreline.cuts)) {
    const Eigen::Index last = rope.end - 1;
    slack += at[static_cast<std::size_t>(last)] - at[static_cast<std::size_t>(rope.begin)] -
             (x.col(last) - x.col(rope.begin)).norm();
  }
  return slack;
}

}  // namespace knot_utm
