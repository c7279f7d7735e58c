#pragma once

#include <vector>

#include "knot_utm/contact/candidates.hpp"
#include "knot_utm/contact/contact_point.hpp"

namespace knot_utm {

/// Self-contact of the rod along its smooth centreline: each strand is integrated by two midpoint points a segment,
/// each of which presses on its feet, the nearest points of the other strands' curves. A pair of points is seen from
/// both sides; the two sides share it by
///
///     omega = g_b^4 / (g_a^4 + g_b^4),   g_b = 1 - x.b''/|b'|^2,   g_a = 1 + x.a''/|a'|^2,
///
/// so that the curved strand is integrated and the straighter one projected on: where a strand coils around another
/// at the distance of contact, the other one stands in its centre of curvature and has no foot on it.
/// omega and the friction's memory belong to the last accepted step: they are carried by the point of integration
/// and found again by the nearest arclength of the foot.
class SmoothContact {
 public:
  SmoothContact(const RodProperties& rod, const NormalLaw& normal, const Friction& friction, double margin);

  /// Rebuilds the candidates where something moved far enough; true if it did.
  bool refresh(const Points& position) { return candidates_.refresh(position); }
  const Candidates& candidates() const { return candidates_; }

  /// Before the first evaluation of a step: estimates of the pressures are those of the last accepted step.
  void begin_step();

  /// All contacts at `position` in a step of length dt from `start`.
  void evaluate(const Points& position, const Points& start, double dt);
  const std::vector<ContactPoint>& contacts() const { return contacts_; }
  std::vector<ContactPoint>& contacts() { return contacts_; }

  void linearise_contact(const ContactPoint& contact, double dt, ContactModel& model) const {
    linearise(normal_, friction_, friction_.scale(dt), contact, model);
  }

  /// The evaluated state becomes the one that the next step remembers. `position` is what was last evaluated.
  void commit(const Points& position);

  const NormalLaw& normal() const { return normal_; }
  const Friction& friction() const { return friction_; }
  void set_friction(const Friction& friction) { friction_ = friction; }

 private:
  struct Memory {
    double arclength_b;
    Vec3 slip;     // xi [m]
    double share;  // omega
    double pressure;
  };
  struct Estimate {
    double arclength_b;
    double pressure;
  };
  static constexpr double kPoints[2] = {0.25, 0.75};

  void find_feet(int segment, int point, const Candidates::Run& run, const Points& position, const Points& start);
  void add_contact(int segment, int point, int foot, double u, const Points& position, const Points& start);
  double share(const ContactPoint& contact, const Points& position) const;

  NormalLaw normal_;
  Friction friction_;
  double diameter_;
  double window_;             // of arclength within which a foot is the same one [m]
  double reach_;              // of centrelines within which contacts are kept [m]
  Eigen::VectorXd arclength_; // of the nodes
  Eigen::VectorXd voronoi_;
  Candidates candidates_;
  std::vector<ContactPoint> contacts_;
  std::vector<Memory> memory_;
  std::vector<int> memory_begin_;  // point of integration 2 segment + point -> first of memory_
  std::vector<Memory> next_memory_;
  std::vector<int> next_begin_;
  std::vector<Estimate> estimate_;
  std::vector<int> estimate_begin_;
  Points edge_middle_, edge_;      // of the evaluated position
  double friction_scale_ = 0.0;
  bool first_evaluation_ = true;
};

}  // namespace knot_utm
