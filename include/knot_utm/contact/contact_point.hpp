#pragma once

#include <vector>

#include "knot_utm/contact/friction.hpp"
#include "knot_utm/contact/pressure_laws.hpp"
#include "knot_utm/numeric/lanes.hpp"
#include "knot_utm/rod/rod.hpp"

namespace knot_utm {

/// A force between two points of the rod, or between the rod and a roller, in the terms every contact law shares.
///
/// Point a stands on nodes a0..a0+2 with weights c_0..c_2; point b on nodes b0..b0+2 with weights -c_3..-c_5, so
/// that the gap vector is x = a - b = sum_k c_k q_k = d n. b is the closest-point projection of a, its foot, which
/// moves along its strand by du as the strands move: with beta_k = -dc_k/du,
///
///     dx = S - b' du,   S = sum_k c_k dq_k,   R = sum_k beta_k dq_k,   du = (b'.S + x.R) / G,
///     G = |b'|^2 - x.b''.
///
/// Force on a: g = w (p n - mu p z); on node k: c_k g. Against a roller there is no b: nodes a only, du = 0.
struct ContactPoint {
  int a0 = 0;
  int b0 = -1;                ///< -1: none, on a roller
  int point = 0;              ///< which of its segment's two points of integration a is
  int roller = -1;            ///< number of the roller; -1: between strands
  double c[6] = {};           ///< [-]
  double beta[6] = {};        ///< [-], zero for a
  double arclength_a = 0.0;   ///< [m], at rest
  double arclength_b = 0.0;   ///< [m], at rest; of strands only
  Vec3 x = Vec3::Zero();      ///< a - b [m]
  Vec3 n = Vec3::Zero();      ///< x/d
  double d = 0.0;             ///< [m]
  double overlap = 0.0;       ///< D, more than 2h - d where the strand of b stands outwards of it [m]
  double begins = 0.0;        ///< overlap at which the pressure law begins [m]
  double weighting = 1.0;     ///< omega, weighting factor of this side of the contact
  double weight = 0.0;        ///< w: rest length it stands for, times its weighting factor [m]
  double pressure = 0.0;      ///< p [N/m]
  double prediction = -1.0;   ///< of the pressure at the solution, from the last linear solve [N/m]; < 0: none
  Vec3 db = Vec3::Zero();     ///< b' [m]
  double inverse_g = 0.0;     ///< 1/G [1/m^2]; 0 against a roller
  Vec3 axis = Vec3::Zero();   ///< of the roller, unit; zero between strands
  double turned = 0.0;        ///< of the roller in this step, times 1 - lambda (RollerContact) [rad]
  FrictionMemory memory;      ///< of the last accepted step: xi_n [m], and what the law keeps beside it
  Vec3 slip = Vec3::Zero();   ///< r = xi_n + slip of this step, before projection on the tangent plane [m]
  Vec3 turn = Vec3::Zero();   ///< V = sum_k beta_k (q_k - q_k^n), how b' turned in this step [m]
  Vec3 z = Vec3::Zero();      ///< friction direction, |z| <= 1
  double mu = 0.0;            ///< friction coefficient [-]
  Vec3 force = Vec3::Zero();  ///< g [N]

  /// Not defaulted: else `emplace_back()` sets all of it to zero before the members' own values do.
  ContactPoint() {}

  bool on_roller() const { return roller >= 0; }
  bool touches() const { return overlap > begins; }
  /// Takes part in the next linear solve.
  bool active() const { return overlap > begins || prediction > 0.0; }
};

/// How a contact came to be where it is in a step.
struct ContactMotion {
  Vec3 slip = Vec3::Zero();     ///< of the material points a and b against each other, across and along n [m]
  Vec3 rolling = Vec3::Zero();  ///< what the sections' turn adds for points of their surfaces (surface_contact.hpp) [m]
  double passed_on = 0.0;       ///< fraction of friction's couple about the gap that the sections take [-]
  double overlap_before = 0.0;  ///< D of point a at the step's beginning [m]
};

/// The linear model of a contact that Newton's method solves with. Its pressure is the tangent of the pressure law,
///
///     p(D) ~ p(D^) + p'(D^) (D - D^),
///
/// taken at the overlap D^ whose pressure is the prediction that the last linear solve gave, and at the present overlap
/// where there is none. The law starts with p' = 0: tangents at the present overlap only halve the overlap of a strand
/// that was pushed in too far, while the prediction has it nearly right at once. As strands move, n and z turn too, and
/// of the product (p + dp) (f + df) the part (p + dp) df takes the prediction for p + dp, or the tangent's p: the
/// slower way, but where strands creep under `smoothed` friction the only one. At the solution all are the same.
///
/// With g = g(S, u) it is the force's derivative where the foot stays, and where it slides on:
///
///     dg = -M S + gamma du,      -df_k/dq_l = c_k c_l M + (beta_k g - c_k gamma) (c_l du_s + beta_l du_r)^T   [N/m]
///
/// and du = (b'.S + x.R)/G as ContactPoint says. Vectors and the columns of M fill registers, their last lanes are
/// zero.
struct ContactModel {
  double pressure = 0.0;  ///< of the tangent at the present overlap [N/m]
  double slope = 0.0;     ///< p'(D^) [N/m^2]
  Lanes force = {};       ///< g with that pressure [N]
  Lanes still[3] = {};    ///< M [N/m]
  Lanes slide = {};       ///< gamma [N]
};

/// On a roller, whose turn about its axis may be an unknown, too (RollerContact).
struct RollerModel : ContactModel {
  Lanes by_turn = {};  ///< -dg/dpsi where the rod stays [N/rad]
};

/// How Newton's method wants contacts linearised.
struct ContactLinearisation {
  Linearisation friction = Linearisation::kTangent;
  bool predicts = false;  ///< it is the predicted pressure that turns with n and z, else that of the tangent
};

/// Of a linear model: the pressure that the change leads to, by its prediction, where there is one, or else by the
/// tangent. Where a prediction has drawn strands apart, the tangent would have them pull, and friction drive them on.
/// `Real`: double, or Lanes for four contacts at once.
template <typename Real>
Real predicted_pressure(const Real& prediction, const Real& of_tangent) {
  return select(prediction > 0.0, prediction, of_tangent);
}

/// Fills z, mu and force of the active contacts from pressure, n, slip and weight, in a step of length dt [s].
void evaluate_forces(const Friction& friction, double dt, std::vector<ContactPoint>& contacts);

/// The same with the pressure from the overlap.
void evaluate_forces(const PressureLaws& normal, const Friction& friction, double dt,
                     std::vector<ContactPoint>& contacts);

/// What friction's law is told of a contact that has been evaluated.
FrictionInput<Vec3> friction_input(const ContactPoint& contact, double dt);
/// What it keeps of that contact.
FrictionMemory remember(const Friction& friction, const ContactPoint& contact, double dt);

/// The consistent linearisation of `evaluate_forces`, movement of the foot included; weight w is held constant.
/// `models`: of the active contacts, in order; some more may follow that mean nothing.
void linearise(const PressureLaws& normal, const Friction& friction, double dt, const ContactLinearisation& how,
               const std::vector<ContactPoint>& contacts, std::vector<ContactModel>& models);
void linearise(const PressureLaws& normal, const Friction& friction, double dt, const ContactLinearisation& how,
               const std::vector<ContactPoint>& contacts, std::vector<RollerModel>& models);

}  // namespace knot_utm
