#pragma once

#include <limits>
#include <vector>

#include "knot_utm/contact/friction.hpp"
#include "knot_utm/numeric/lanes.hpp"
#include "knot_utm/numeric/points.hpp"

namespace knot_utm {

/// The pressure law of two strands of radius h: the line pressure p [N/m] as a function of the overlap D = 2h - d [m]
/// of two centrelines at distance d,
///
///     p = K s (1 + (s/c)^4),      s = (D + delta/2)^2 / (2 delta)  for |D| < delta/2,   s = D beyond, 0 before,
///
/// once continuously differentiable. K [N/m^2] and the depth c [m] from which the rod stiffens as it is squeezed belong
/// to the material and do not change with the mesh, the step or the run. The contact tolerance delta only rounds the
/// corner where strands just touch, symmetrically about D = 0. A contact with a pressure above K delta/2 does not
/// depend on it.
///
/// pressure, slope and overlap_at are templates: of a double, or of Lanes for four contacts side by side.
struct NormalLaw {
  double stiffness = 0.0;                                       ///< K [N/m^2]
  double tolerance = 0.0;                                       ///< delta [m]
  double stiffening = std::numeric_limits<double>::infinity();  ///< c [m]

  /// Of one such strand on a body that does not give: it alone is flattened by what two would share, p(2 D).
  NormalLaw on_rigid() const { return {2.0 * stiffness, 0.5 * tolerance, 0.5 * stiffening}; }

  /// Overlap at which the pressure begins, below zero [m].
  double begin() const { return -0.5 * tolerance; }
  double stiffens_at() const { return stiffening; }

  /// `Real`: double, or Lanes for four contacts at once.
  template <typename Real>
  Real pressure(const Real& overlap) const {
    const Real s = squeeze(overlap);
    return select(overlap <= begin(), Real{}, stiffness * s * (1.0 + fourth(s / stiffening)));
  }
  /// dp/dD [N/m^2]
  template <typename Real>
  Real slope(const Real& overlap) const {
    const Real rounded = (overlap - begin()) / tolerance;
    const Real ds = select(rounded < 1.0, rounded, constant<Real>(1.0));
    return select(overlap <= begin(), Real{}, stiffness * ds * (1.0 + 5.0 * fourth(squeeze(overlap) / stiffening)));
  }
  /// The overlap at which the law gives this pressure, p >= 0 [m]
  template <typename Real>
  Real overlap_at(const Real& line_pressure) const {
    // Newton's method on s (1 + (s/c)^4) = p/K, which is convex, so that a start above the root descends to it.
    const Real q = line_pressure / stiffness;
    Real s = select(q < stiffening, q, stiffening * square_root(square_root(q / stiffening)));
    for (int i = 0; i < 6; ++i) {
      const Real t4 = fourth(s / stiffening), excess = s * (1.0 + t4) - q;
      s -= excess / (1.0 + 5.0 * t4);
      if (!any(excess > 1e-9 * q)) break;
    }
    return select(s >= 0.5 * tolerance, s, square_root(2.0 * tolerance * s) + begin());
  }
  /// Energy per length, its derivative is p [N]
  double energy(double overlap) const {
    const double w = overlap - begin();
    if (w <= 0.0) return 0.0;
    // In the corner s = w^2/(2 delta), the integrals of s and s^5 over w are w s/3 and w s^5/11.
    auto corner = [&](double depth) {
      const double s = 0.5 * depth * depth / tolerance;
      return stiffness * depth * s * (1.0 / 3.0 + fourth(s / stiffening) / 11.0);
    };
    auto beyond = [&](double s) { return stiffness * s * s * (0.5 + fourth(s / stiffening) / 6.0); };
    return w <= tolerance ? corner(w) : corner(tolerance) + beyond(overlap) - beyond(0.5 * tolerance);
  }

 private:
  template <typename Real>
  static Real fourth(const Real& x) {
    return x * x * x * x;
  }
  template <typename Real>
  Real squeeze(const Real& overlap) const {
    const Real w = overlap - begin();
    return select(w < tolerance, 0.5 * w * w / tolerance, overlap);
  }
};

/// The laws of contacts between two materials.
struct PairLaws {
  NormalLaw normal;
  Friction friction;
};

/// Those of all pairs of materials, by ContactPoint::pair: of the first rope on itself, of that on another rope, of the
/// other ropes on themselves. A rod of one material has the first alone. All friction laws are of the same kind.
struct ContactLaws {
  PairLaws of[3];

  explicit ContactLaws(const NormalLaw& normal, const Friction& friction)
      : of{{normal, friction}, {normal, friction}, {normal, friction}} {}

  const PairLaws& operator[](int pair) const { return of[pair]; }
  bool rub() const { return of[0].friction.on() || of[1].friction.on() || of[2].friction.on(); }
};

/// A contact between two points of the rod, or between the rod and a roller, in the terms that all contact laws share.
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
  int point = 0;              ///< which of its segment's two integration points a is
  int roller = -1;            ///< number of the roller; -1: between strands
  int pair = 0;               ///< of materials (ContactLaws); on a roller that of the strand with itself
  double c[6] = {};           ///< [-]
  double beta[6] = {};        ///< [-], zero for a
  double arclength_a = 0.0;   ///< [m], at rest
  double arclength_b = 0.0;   ///< [m], at rest; of strands only
  Vec3 x = Vec3::Zero();      ///< a - b [m]
  Vec3 n = Vec3::Zero();      ///< x/d
  double d = 0.0;             ///< [m]
  double overlap = 0.0;       ///< D = h_a + h_b - d, plus o where the strand of b lies outwards of its spline [m]
  double begins = 0.0;        ///< overlap at which the pressure law begins [m]
  double weighting = 1.0;     ///< omega, weighting factor of this side of the contact
  double weight = 0.0;        ///< w: rest length it stands for, times its weighting factor [m]
  double pressure = 0.0;      ///< p [N/m]
  double prediction = -1.0;   ///< predicted pressure, from the last linear solve [N/m]; < 0: none
  Vec3 db = Vec3::Zero();     ///< b' [m]
  double inverse_g = 0.0;     ///< 1/G [1/m^2]; 0 against a roller
  Vec3 axis = Vec3::Zero();   ///< b of the roller (BesideRoller); zero between strands
  double turned = 0.0;        ///< of the roller in this step: 0, as rollers do not turn [rad]
  FrictionMemory memory;      ///< of the last accepted step: xi_n [m], and what the law keeps beside it
  Vec3 slip = Vec3::Zero();   ///< r = xi_n + slip of this step, before projection on the tangent plane [m]
  Vec3 turn = Vec3::Zero();   ///< V = sum_k beta_k (q_k - q_k^n), how b' turned in this step [m]
  Vec3 z = Vec3::Zero();      ///< friction direction, |z| <= 1
  Vec3 z_old = Vec3::Zero();  ///< that of the last trial in this step; 0: there was none
  double zeta_old = 0.0;      ///< the same of SurfacePoint::zeta
  double mu = 0.0;            ///< friction coefficient [-]
  Vec3 force = Vec3::Zero();  ///< g [N]

  /// Not defaulted, because `emplace_back()` would then zero the whole object before its members are initialised.
  ContactPoint() {}

  bool on_roller() const { return roller >= 0; }
  bool touches() const { return overlap > begins; }
  /// Takes part in the next linear solve.
  bool active() const { return overlap > begins || prediction > 0.0; }
};

/// Motion of a contact in a step.
struct ContactMotion {
  Vec3 slip = Vec3::Zero();     ///< of the material points a and b against each other, with its part along n [m]
  Vec3 rolling = Vec3::Zero();  ///< what the sections' turn adds for points of their surfaces (surface_contact.hpp) [m]
  double passed_on = 0.0;       ///< fraction of friction's couple about the gap that the sections take [-]
  double overlap_before = 0.0;  ///< D of point a at the step's beginning [m]
  double weight = 0.0;          ///< of the energy e(D) now, and at the step's beginning [m]
  double weight_before = 0.0;
  double thinning = 0.0;  ///< work of R (SoftPoint) [J]
};

/// The linear model of a contact that Newton's method solves with. Its pressure is the tangent of the pressure law,
///
///     p(D) ~ p(D^) + p'(D^) (D - D^),
///
/// taken at the overlap D^ whose pressure the last linear solve predicted, or at the present overlap where there is no
/// prediction. The law begins with p' = 0. A tangent at the present overlap therefore only halves the overlap of a
/// strand that was pushed in too far, while the predicted one is nearly right at once. As strands move, f = n - mu z
/// turns, too. In the product (p + dp) (f + df) the part (p + dp) df uses the prediction for p + dp, or else the
/// pressure of the tangent. The latter is slower, but the only way where strands creep under `smoothed` friction. At
/// the solution all of these pressures are the same.
///
/// The derivatives of the force g = g(S, u) are taken at a fixed foot and along a sliding one:
///
///     dg = -M S + gamma du,      -df_k/dq_l = c_k c_l M + (beta_k g - c_k gamma) (c_l du_s + beta_l du_r)^T   [N/m]
///
/// and du = (b'.S + x.R)/G as ContactPoint says. The last lanes of vectors and of the columns of M are zero.
struct ContactModel {
  double pressure = 0.0;  ///< of the tangent at the present overlap [N/m]
  double slope = 0.0;     ///< p'(D^) [N/m^2]
  Lanes force = {};       ///< g with that pressure [N]
  Lanes still[3] = {};    ///< M [N/m]
  Lanes slide = {};       ///< gamma [N]
};

/// The same on a roller. What its turn would add is zero, and kept so that the compiler rounds the rest as ever.
struct RollerModel : ContactModel {
  Lanes by_turn = {};  ///< -dg/dpsi with the rod at rest [N/rad]
};

/// How Newton's method wants contacts linearised.
struct ContactLinearisation {
  Linearisation friction = Linearisation::kTangent;
  bool predicts = false;  ///< the terms in which n and z turn use the predicted pressure, else that of the tangent
};

/// Pressure of the terms in which n and z turn: the prediction where there is one, else that of the tangent. Where the
/// start of a step has drawn strands apart, the tangent's pressure is negative, so that contacts would pull and
/// friction would drive the strands. `Real`: double, or Lanes for four contacts at once.
template <typename Real>
Real predicted_pressure(const Real& prediction, const Real& of_tangent) {
  return select(prediction > 0.0, prediction, of_tangent);
}

/// Fills pressure, z, mu and force of the active contacts from overlap, n, slip and weight by the laws of each
/// contact's pair, in a step of length dt [s].
void evaluate_forces(const ContactLaws& laws, double dt, std::vector<ContactPoint>& contacts);

/// The friction law's input for a contact that has been evaluated.
FrictionInput<Vec3> friction_input(const ContactPoint& contact, double dt);
/// What the friction law keeps of that contact once the step is accepted.
FrictionMemory remember(const Friction& friction, const ContactPoint& contact, double dt);

/// The consistent linearisation of `evaluate_forces`, which includes the motion of the foot; the weight w is constant.
/// `models` are those of the active contacts, in order; unused ones may follow.
void linearise(const ContactLaws& laws, double dt, const ContactLinearisation& how,
               const std::vector<ContactPoint>& contacts, std::vector<ContactModel>& models);
void linearise(const ContactLaws& laws, double dt, const ContactLinearisation& how,
               const std::vector<ContactPoint>& contacts, std::vector<RollerModel>& models);

}  // namespace knot_utm
