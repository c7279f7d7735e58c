#pragma once

#include <utility>
#include <vector>

#include "knot_utm/contact/candidates.hpp"
#include "knot_utm/contact/closest_points.hpp"
#include "knot_utm/contact/contact_point.hpp"
#include "knot_utm/contact/edge_law.hpp"
#include "knot_utm/contact/surface_contact.hpp"
#include "knot_utm/numeric/points.hpp"

namespace knot_utm {

/// The linear model of a contact between edges. Both feet move: with S = sum_k c_k dq_k, and A, R the changes of the
/// edges' directions a' and b' (sum_k beta_k dq_k over the nodes of a, of b),
///
///     dx = S + a' dt - b' du,     H (dt, du) = (-a'.S - x.A,  b'.S + x.R),
///     H = [ |a'|^2 + r   -a'.b' ;  -a'.b'   |b'|^2 + r ],
///
/// and a foot at the end of its edge stays there. The pressure is that of ContactModel.
struct EdgeContactModel {
  Lanes force = {};       ///< g with that pressure [N]
  double pressure = 0.0;  ///< of the tangent at the present overlap [N/m]
  double slope = 0.0;     ///< p'(D^) [N/m^2]
  double c[6], moves[6];  ///< df_k = c_k dg + moves_k g (dt on a, du on b)
  Mat3 force_by[6];       ///< dg/dq_l [N/m]
  Vec3 t_by[6], u_by[6];  ///< dt/dq_l, du/dq_l [1/m]

  /// -df_k/dq_l [N/m]
  Mat3 stiffness(int k, int l) const {
    return -c[k] * force_by[l] - moves[k] * to_vec3(force) * (k < 3 ? t_by[l] : u_by[l]).transpose();
  }
};

/// The pressures of a contact between edges, as in ContactModel.
struct EdgePressure {
  double slope;     ///< p'(D^) [N/m^2]
  double pressure;  ///< of the tangent at the present overlap [N/m]
  double turning;   ///< of the terms in which n and z turn [N/m]
};
EdgePressure pressure_of(const EdgeLaw& normal, const ContactLinearisation& how, const ContactPoint& contact);

/// Self-contact of the rod between its edges, as in the source paper: the edges of each pair press on each other at
/// their closest points (Lumelsky, regularised, see closest_points.hpp) by EdgeLaw, over their mean rest length. Near
/// the ends of edges two pairs see the same contact and both count, as in the paper. The force therefore ripples as
/// strands slide over nodes, and strands side by side are up to three times stiffer than K.
///
/// ContactPoint's stencils take three nodes a strand; an edge fills two of them. Its `beta` holds dc_k/dt on a.
/// Friction's memory belongs to the last accepted step and is found again by the arclengths of both feet, so that it
/// survives as strands slide on from edge to edge.
class EdgeContact {
 public:
  using Model = EdgeContactModel;
  static constexpr bool kSoftens = false;  // whether sections may give

  EdgeContact(const RodProperties& rod, const NormalLaw& normal, const Friction& friction, double margin);

  /// As SmoothContact's.
  void act_at_surface(double couple, const SectionTurns& turns, const RollingLaws& rolling = {}) {
    lever_ = 0.5 * couple;
    rolling_ = rolling;
    turns_ = &turns;
  }
  bool at_surface() const { return turns_ != nullptr; }

  /// From now on the rod is cut at this edge, too.
  void part(int edge) { candidates_.part(edge); }
  /// Pairs of edges that may touch.
  const std::vector<std::pair<int, int>>& pairs() const { return pairs_; }

  /// As SmoothContact's.
  void begin(const Points& start);

  /// All contacts at `position` in a step of length dt from `start`.
  void evaluate(const Points& position, const Points& start, double dt);
  const std::vector<ContactPoint>& contacts() const { return contacts_; }
  std::vector<ContactPoint>& contacts() { return contacts_; }
  /// Where friction acts at the surface: one for each contact.
  const std::vector<SurfacePoint>& surfaces() const { return surfaces_; }

  /// The consistent linearisation of the active contacts, in order.
  void linearise(const ContactLinearisation& how, double dt, std::vector<EdgeContactModel>& models) const;
  /// Where friction acts at the surface, of the next few from number `from` on (linearise_surfaces).
  std::size_t linearise(const ContactLinearisation& how, double dt, std::size_t from, SurfaceModels& models) const {
    return knot_utm::linearise(normal_, friction_, rolling_, dt, how, contacts_, surfaces_, moving_, from, models);
  }

  /// The motion of one of `contacts()` in this step.
  ContactMotion motion(const ContactPoint& contact, const Points& position, const Points& start) const;

  /// The evaluated state becomes the one that the next step remembers.
  void commit(const Points& position);

  /// Energy of the pressure law per length of rod [N]
  double energy(int, double overlap) const { return normal_.energy(overlap); }

  /// Saves or loads what the last accepted step left.
  void state(Archive& archive);

 private:
  template <typename Law>
  void linearise_contact(const ContactPoint& contact, const Law& law, const ContactLinearisation& how, double dt,
                         EdgeContactModel& model) const;

  /// What a contact between edges knows beside its ContactPoint.
  struct Feet {
    int pair;
    Vec3 da;      // a' [m]
    Vec3 turn_a;  // how a' turned in this step [m]
  };
  struct Memory {
    std::pair<int, int> edges;
    double arclength_a, arclength_b;
    FrictionMemory friction;
    double pressure;

    void state(Archive& archive);
  };

  void find_pairs();
  /// Closest points of two edges, drawn slightly towards the middles of the edges.
  ClosestPoints closest(int a, int b, const Points& position) const;
  void add_contact(int pair, const Points& position, const Points& start);
  void add_surface(const ContactPoint& contact, const Feet& feet, int a, int b);
  /// What is remembered of these edges' contact, or else of the nearest one; null where there was none near.
  const Memory* recall(std::pair<int, int> edges, double arclength_a, double arclength_b) const;

  EdgeLaw normal_;
  Friction friction_;
  double dt_ = 0.0;  // of this step [s]
  double diameter_;
  double window_;            // of arclengths within which a contact is the same one [m]
  double reach_;             // of centrelines within which contacts are kept [m]
  double least_prediction_;  // smallest pressure that serves as a prediction [N/m]
  Eigen::VectorXd rest_length_;
  Eigen::VectorXd length_;     // of the edges at the evaluated position [m]
  Eigen::VectorXd arclength_;  // of the nodes
  Candidates candidates_;
  std::vector<std::pair<int, int>> pairs_;
  std::vector<double> prediction_;  // of the pressure of each pair, < 0: none
  std::vector<ContactPoint> contacts_;
  std::vector<Feet> feet_;               // of the contacts
  std::vector<EdgeFeet> moving_;         // of the contacts
  double lever_ = 0.0;                   // lambda of SurfacePoint
  const SectionTurns* turns_ = nullptr;  // where friction acts at the surface
  std::vector<SurfacePoint> surfaces_;
  RollingLaws rolling_;
  std::vector<Memory> memory_;  // ascending in arclength_a
  bool first_evaluation_ = true;
};

}  // namespace knot_utm
