#pragma once

#include <cstddef>
#include <vector>

#include "knot_utm/contact/contact_point.hpp"
#include "knot_utm/numeric/points.hpp"

namespace knot_utm {

struct SoftPoint;

/// Rotations of the edges about their own tangents (spins) in this step. With e_j the edge, s_j the spin that Newton's
/// method solves for and lean_j of frame_terms.hpp, |e_j| psi_j changes by |e_j| (ds_j - pull_j . de_j).
struct SectionTurns {
  std::vector<double> turn;    ///< psi of every edge since the step's beginning [rad]
  std::vector<double> length;  ///< |e| of every edge [m]
  std::vector<Lanes> tangent;  ///< t of every edge
  std::vector<Lanes> pull;     ///< lean - psi t/|e| of every edge [1/m]

  SectionTurns() = default;
  explicit SectionTurns(std::size_t edges) : turn(edges), length(edges), tangent(edges), pull(edges) {}
};

/// The part of a contact beyond its ContactPoint where friction acts at the surfaces of the strands.
///
/// The section of a strand that passes through a contact turns by
///
///     phi = c^ x V + Psi c^,    c^ = c'/|c'|^2,    Psi = sum_j sigma_j |e_j| psi_j,
///
/// c' being the derivative of the centreline there, V how c' changed in this step, psi_j the spins of the two edges
/// next to it, and sigma_j their weights in c' = sum_j sigma_j e_j. A rod that turns as a whole therefore turns its
/// sections with it, however it is bent. The strands' surfaces meet half way between the centrelines, at lambda x from
/// either, lambda = 1/2, x the gap. A soft section transmits only the fraction eta of the couple
/// (material.friction_couple), and its surface moves as if it lay at lambda = eta/2. On a roller of radius R, which
/// does not turn, lambda = eta h/(R + h). Strands of different radii meet at lambda x = eta h_a/(h_a + h_b) x
/// from a and at q lambda x from b, q = h_b/h_a: below, phi_b is to be read as q phi_b in u, and m as q m on b.
/// Material points of the two surfaces slid against each other in this step by
///
///     u = Dx_a - Dx_b - (phi_a + phi_b) x lambda x,
///
/// The elastic slip xi has turned with both sections, so that the friction law gets r = xi + alpha n x xi + u, alpha =
/// n.(phi_a + phi_b)/2 (on a roller phi_a alone, whole).
///
/// u is linear in the increments of nodes and spins in this step, u = sum J_k Dq_k, with J at the end of the step. The
/// force g on the surface of a acts on nodes and spins by J^T, so that their work is exactly g.u for steps of any
/// length:
///
///     on node k of a   c_k g + d_k a^ x m,     on its spins  -s_j a^.m,      m = lambda x x g,   s_j = sigma_j |e_j|,
///     on node k of b   c_k g + beta_k b^ x m,                -s_j b^.m,
///
/// The couple -m acts on both sections. Its part across the strand becomes forces on the nodes, its part along the
/// strand torques on the spins. With eta = 1 forces and couples balance about every point.
/// Source: our own; kinematics of rigid sections along the spline of the centreline.
///
/// Where the contact resists rolling (RollingResistance), the couple C acts on the section of a, and -C on that of b,
/// so that m - C takes the place of m on a, and m + C on b. On a roller, whose own turn about its axis is psi, -C.axis
/// is a torque on it; its rotation is phi_b = psi axis.
// NOLINTNEXTLINE(clang-analyzer-optin.performance.Padding): the order is that of the equations
struct SurfacePoint {
  Vec3 along_a = Vec3::Zero();      ///< a' [m]; b' is ContactPoint::db
  Vec3 turn_a = Vec3::Zero();       ///< V of a [m]; that of b is ContactPoint::turn
  Vec3 bend_b = Vec3::Zero();       ///< b'' [m]
  Vec3 bend_turn_b = Vec3::Zero();  ///< how b'' changed in this step [m]
  double spin_a = 0.0;              ///< Psi of a [m]
  double spin_b = 0.0;              ///< Psi of b [m]
  double spin_slope_b = 0.0;        ///< dPsi_b/du [m]
  double lever = 0.0;               ///< lambda [-]
  double uneven = 1.0;              ///< q [-]
  double d_a[3] = {};               ///< da'/dq_k [-]
  double s_a[2] = {}, s_b[2] = {};  ///< of the spins of edges a0, a0 + 1, and b0, b0 + 1 [m]
  double s_slope_b[2] = {};         ///< ds_b/du [m]
  Lanes on_a = {};                  ///< a^ x m [N]; lane 3: -a^.m [N]
  Lanes on_b = {};                  ///< b^ x m [N]; lane 3: -b^.m [N]; on a roller -C.axis [N m]
  double turned = 0.0;              ///< psi of the roller: 0 [rad]
  double zeta = 0.0;                ///< of RollingResistance [-]
  Vec3 couple = Vec3::Zero();       ///< C [N m]
};

/// Resistance of contacts to rolling: a couple of each contact about its line, the tangent l of the strand that is
/// integrated, against the rotation of the two sections relative to each other,
///
///     C = -w mu_r(p) h p zeta l,   zeta = rho/rho_s, but at most 1 and at least -1,
///     rho = rho_n + h (phi_a - phi_b).l,   l = a'/|a'|.
///
/// C is the first moment of the pressure across a wide line of contact. Its moment along the line is in p(s) already: a
/// strand that advances along its own bend turns about its binormal and rolls over nothing. rho_n = rho_s zeta of the
/// last accepted step is what the contact remembers, one number that nothing has to turn: it first springs, and rolls
/// where the couple reaches mu_r h p. A cylinder on a plane rests up to a slope of mu_r. Where two strands cross, each
/// resists at its own points, which bear half of the force. Source: Iwashita, Oda 1998 and Ai, Chen, Rotter, Ooi 2011
/// (elastic-plastic spring of granular mechanics), on line contacts; Johnson 1985, 9.4.
///
/// mu_r(p) = mu_0 + g sqrt(p). The second part is that of a wide contact whose material loses a fraction of the work
/// that goes into it (growth_of_hysteresis).
struct RollingResistance {
  double coefficient = 0.0;  ///< mu_0 [-]
  double radius = 0.0;       ///< h [m]
  double presliding = 0.0;   ///< rho_s [m]
  double growth = 0.0;       ///< g [sqrt(m/N)]

  bool on() const { return coefficient > 0.0 || growth > 0.0; }

  /// g of solid rods that lie along each other and lose the fraction `lost` of the work that goes into their contact.
  /// Its half width by Hertz is a = sqrt(2 h p/(pi E')), E' = E/(2 (1 - nu^2)) with nu = 1/2, and k_s = pi h^2 E.
  /// The couple lost 2 a p/(3 pi) per length resists rolling, which is mu_r h p:
  ///
  ///     mu_r = lost 2 a/(3 pi h),   a = h sqrt(3 h p/k_s).
  ///
  /// A roller is taken to be as soft and as thick as the rod. Source: Greenwood, Minshall, Tabor 1961; Johnson, Contact
  /// Mechanics, 9.4.
  static double growth_of_hysteresis(double lost, double radius, double stretching_stiffness);
};

/// That of all pairs of materials, by ContactPoint::pair, as ContactLaws.
struct RollingLaws {
  RollingResistance of[3];

  RollingLaws(const RollingResistance& all = {}) : of{all, all, all} {}

  const RollingResistance& operator[](int pair) const { return of[pair]; }
  bool on() const { return of[0].on() || of[1].on() || of[2].on(); }
};

/// What the rotation of its sections adds to the slip of a contact, r - (xi + Dx_a - Dx_b) [m].
Vec3 surface_shift(const ContactPoint& contact, const SurfacePoint& surface);
/// Adds it to the slip r of every active contact.
void add_shifts(std::vector<ContactPoint>& contacts, const std::vector<SurfacePoint>& surfaces);
/// u - (Dx_a - Dx_b) [m]
Vec3 rolling(const ContactPoint& contact, const SurfacePoint& surface);

/// Sets SurfacePoint::on_a and on_b of every active contact, once its force is known, and what resists rolling.
void set_couples(const RollingLaws& rolling, const std::vector<ContactPoint>& contacts,
                 std::vector<SurfacePoint>& surfaces);

/// What the friction law and the resistance to rolling keep of a contact once the step is accepted.
FrictionMemory remember(const Friction& friction, const RollingLaws& rolling, const ContactPoint& contact,
                        const SurfacePoint& surface, double dt);
/// What resistance to rolling takes up in the step: the work against C [J].
double rolling_loss(const ContactPoint& contact, const SurfacePoint& surface);

/// Adds the couples `on_a` and `on_b`, as in SurfacePoint, to the forces on nodes [N] and the torques on spins [N m]
/// (lane 3).
void add_couples(const ContactPoint& contact, const SurfacePoint& surface, const Lanes& on_a, const Lanes& on_b,
                 std::vector<Lanes>& force);

/// The linear model of a contact with friction at the surfaces, by the changes xi on which all its forces depend: S =
/// sum_k c_k dq_k, V_a = sum_k d_k dq_k, V_b = sum_k beta_k dq_k, Psi_a and Psi_b, and the turn of a roller.
struct SurfaceModel {
  static constexpr int kShift = 0, kTurnA = 3, kTurnB = 6, kSpinA = 9, kSpinB = 10, kTurned = 11, kChanges = 12;

  /// Derivatives with respect to one change, and the motion of the foot that goes with it.
  struct Response {
    Lanes force = {};   ///< -dg/dxi
    Lanes on_a = {};    ///< -d(a^ x m)/dxi, lane 3: d(a^.m)/dxi
    Lanes on_b = {};    ///< the same of b; on a roller lane 3: d(C.axis)/dxi
    double foot = 0.0;  ///< du/dxi
  };

  double pressure = 0.0;  ///< of the tangent at the present overlap [N/m]
  double slope = 0.0;     ///< p'(D^) [N/m^2]
  Lanes force = {};       ///< g with that pressure [N]
  Lanes on_a = {};        ///< a^ x m with it; lane 3: -a^.m
  Lanes on_b = {};        ///< b^ x m with it; lane 3: -b^.m, on a roller -C.axis
  Response by[kChanges];
};

/// Models of up to four contacts. They are large and used at once, because those of all contacts would not fit into the
/// caches.
struct SurfaceModels {
  int count = 0;
  std::size_t contact[4] = {};  ///< its number
  SurfaceModel model[4];
};

/// The consistent linearisation of `evaluate_forces` and add_couples, as `linearise` of contact_point.hpp, of the next
/// four active contacts of one pair of materials from number `from` on, or as many as follow each other. `surfaces`:
/// one for each of `contacts`; `soft`: as many, or none where sections are round. Returns the number from which to go
/// on.
std::size_t linearise(const ContactLaws& laws, const RollingLaws& rolling, double dt, const ContactLinearisation& how,
                      const std::vector<ContactPoint>& contacts, const std::vector<SurfacePoint>& surfaces,
                      const std::vector<SoftPoint>& soft, std::size_t from, SurfaceModels& models);

/// Calls visit(number of the contact, its SurfaceModel) for each active contact with friction at the surface, in order.
template <typename Contacts, typename Visit>
void linearise_surfaces(const Contacts& contacts, const ContactLinearisation& how, double dt, Visit visit) {
  SurfaceModels models;
  for (std::size_t from = contacts.linearise(how, dt, 0, models); models.count > 0;
       from = contacts.linearise(how, dt, from, models))
    for (int i = 0; i < models.count; ++i) visit(models.contact[i], models.model[i]);
}

}  // namespace knot_utm
