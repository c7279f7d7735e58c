#pragma once

#include <Eigen/Geometry>
#include <limits>
#include <vector>

#include "knot_utm/contact/soft_section.hpp"
#include "knot_utm/numeric/points.hpp"

namespace knot_utm {

struct RodProperties;

/// A cylinder of unlimited length, on which the rod may lie, or a ring, through which it may pass: the round edge of a
/// hole.
struct Roller {
  Vec3 centre = Vec3::Zero();  ///< a point of its axis, or the middle of the ring [m]
  Vec3 axis = Vec3::UnitY();   ///< unit; that of a ring goes through the hole
  double radius = 0.0;         ///< of its section [m]
  double ring = 0.0;           ///< R, of the circle in the middle of a ring's section; 0: a cylinder [m]
  /// Nodes between which the rod may touch it; the rod beyond them lies beside it.
  int first_node = 0, last_node = std::numeric_limits<int>::max();

  void state(Archive& archive) {
    archive(centre, axis, radius, first_node, last_node);
    if (archive.optional_section("RING", ring > 0.0))
      archive(ring);
    else
      ring = 0.0;
  }
};

/// Where a place stands beside a roller.
struct BesideRoller {
  Vec3 x;     ///< from the middle of the nearest section [m]
  Vec3 axis;  ///< b: as the place moves by ds, x changes by ds - b (b.ds)
};
/// Beside a cylinder b is its axis. Beside a ring it is (R/rho)^1/2 t, with t the tangent of the circle at its nearest
/// section, and rho the distance of the place from the ring's axis: the nearest section moves by t (t.ds) R/rho.
BesideRoller beside(const Roller& roller, const Vec3& place);

/// Motion of the roller's surface in this step [m]: none, as rollers do not turn.
inline Vec3 carried_along(const ContactPoint& contact) { return contact.turned * contact.axis.cross(contact.x); }

/// Contact of the rod's smooth centreline with rollers and rings, which move but do not turn: the normal law of the rod
/// with D = r + h - d, d the distance from the middle of the nearest section, and a friction of their own.
class RollerContact {
 public:
  using Model = RollerModel;

  /// `farthest`: the largest motion of a node in an accepted step [m]. Segments that are further from all rollers when
  /// a step begins are left out of that step.
  RollerContact(const RodProperties& rod, const NormalLaw& normal, const Friction& friction, double farthest);

  /// From now on the ropes behind the first one, of another material, have these laws.
  void tell_apart(const PairLaws& others) { laws_.of[2] = others; }

  /// As SmoothContact's.
  void act_at_surface(double couple, const SectionTurns& turns, const RollingLaws& rolling = {}) {
    couple_ = couple;
    rolling_ = rolling;
    turns_ = &turns;
  }
  bool at_surface() const { return turns_ != nullptr; }
  void soften(const Eigen::VectorXd& rest_length) { rest_length_ = &rest_length; }
  bool soft() const { return rest_length_ != nullptr; }

  /// From now on only the first `nodes` of the rod touch, on what `whole` left of the last accepted step.
  void halve(const RollerContact& whole, int nodes) {
    nodes_ = nodes;
    start_ = whole.start_;
    committed_prediction_ = whole.committed_prediction_;
    memory_ = whole.memory_;
  }

  /// Begins a step from `start`, at whose end the rollers stand as `rollers` says: the predicted pressures are those of
  /// the last accepted step.
  void begin(const std::vector<Roller>& rollers, const Points& start);

  /// All contacts at `position` in that step, in which the rollers move from where the last commit left them.
  void evaluate(const std::vector<Roller>& rollers, const Points& position, const Points& start, double dt);
  const std::vector<ContactPoint>& contacts() const { return contacts_; }
  std::vector<ContactPoint>& contacts() { return contacts_; }
  /// Where friction acts at the surface: one for each contact.
  const std::vector<SurfacePoint>& surfaces() const { return surfaces_; }
  const std::vector<SoftPoint>& soft_points() const { return soft_; }

  /// The consistent linearisation of the active contacts, in order; unused models may follow.
  void linearise(const ContactLinearisation& how, double dt, std::vector<RollerModel>& models) const {
    knot_utm::linearise(laws_, dt, how, contacts_, models);
  }
  /// The same where friction acts at the surface, for the next few contacts from number `from` on (linearise_surfaces).
  std::size_t linearise(const ContactLinearisation& how, double dt, std::size_t from, SurfaceModels& models) const {
    return knot_utm::linearise(laws_, rolling_, dt, how, contacts_, surfaces_, soft_, from, models);
  }

  /// From now on the rod is cut at this edge, too, and segments that reach into it touch nothing.
  void part(int edge) { cuts_.push_back(edge); }

  /// The motion of one of `contacts()` in this step.
  ContactMotion motion(const ContactPoint& contact, const Points& position, const Points& start) const;

  /// What the rod does to a roller, as last evaluated: force [N], and moment about the roller's centre [N m].
  Vec3 force_on(int roller) const;
  Vec3 moment_on(const Roller& roller, int number, const Points& position) const;

  void commit(const std::vector<Roller>& rollers);

  /// e(D) of the pressure law [N]
  double energy(int pair, double overlap) const { return laws_[pair].normal.energy(overlap); }

  /// Saves or loads what the last accepted step left.
  void state(Archive& archive);

 private:
  struct Near {
    std::size_t roller;
    int segment;
  };

  bool reaches_into_cut(int segment) const;
  /// Distance of a segment's node from the nearest section beyond which no part of the segment touches [m].
  double limit(const Roller& roller, int segment) const;
  void find_near_segments(const std::vector<Roller>& rollers, const Points& start);
  void add_contacts(const std::vector<Roller>& rollers, std::size_t number, int segment, const Points& position,
                    const Points& start);
  void add_surface(const ContactPoint& contact, const Roller& roller, const Points& position, const Points& start);
  std::size_t index_of(const ContactPoint& contact) const;
  double lever_of(const ContactPoint& contact) const;
  Vec3 couple_of(const ContactPoint& contact) const;  // C of RollingResistance

  /// Of a segment: as ContactPoint::pair [-], and its rope's radius [m].
  int pair_of(int segment) const { return segment < first_of_other_ ? 0 : 2; }
  double radius(int segment) const { return radius_[segment < first_of_other_ ? 0 : 1]; }

  ContactLaws laws_;
  double dt_ = 0.0;     // of this step [s]
  int first_of_other_;  // node of the ropes of another material
  double radius_[2];    // of these materials [m]
  double farthest_;
  std::vector<Near> near_;  // of this step
  std::vector<int> cuts_;   // edges
  Eigen::VectorXd voronoi_;
  int nodes_;  // those that touch
  std::vector<Roller> start_;
  std::vector<ContactPoint> contacts_;
  double couple_ = 0.0;                  // eta: fraction of friction's couple that a section transmits
  const SectionTurns* turns_ = nullptr;  // where friction acts at the surface
  std::vector<SurfacePoint> surfaces_;
  const Eigen::VectorXd* rest_length_ = nullptr;  // of edges, where sections give
  std::vector<SoftPoint> soft_;
  RollingLaws rolling_;
  std::vector<double> prediction_, committed_prediction_;  // of the pressure, < 0: none; indexed as memory_
  std::vector<FrictionMemory> memory_;  // of roller r at point q of segment i: [(r segments + i) 2 + q]
};

}  // namespace knot_utm
