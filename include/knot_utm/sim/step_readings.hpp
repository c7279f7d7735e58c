#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "knot_utm/contact/contact_point.hpp"
#include "knot_utm/contact/roller_contact.hpp"
#include "knot_utm/sim/centreline_terms.hpp"
#include "knot_utm/sim/contact_force.hpp"
#include "knot_utm/sim/frame_terms.hpp"
#include "knot_utm/sim/scene.hpp"

namespace knot_utm {

/// Of the last accepted step. Contact has an energy from the first one on.
struct Energies {
  double stretching = 0.0, bending = 0.0, twisting = 0.0, contact = 0.0, kinetic = 0.0;  ///< [J]
  double elastic() const { return stretching + bending + twisting; }
  double total() const { return elastic() + contact + kinetic; }

  void state(Archive& archive) { archive(stretching, bending, twisting, contact, kinetic); }
};

struct ContactReading {
  int touching = 0;              ///< points of integration that carry force
  double normal_force = 0.0;     ///< sum of their normal forces [N]
  double largest_overlap = 0.0;  ///< between strands [m]
  /// Sum of (1 - eta) x x g, the couple of friction that the sections do not take (surface_contact.hpp): all of it
  /// where it acts on the centrelines, which are apart by x. Where the strands' surfaces meet there would be none; the
  /// grips feel it. [N m]
  Vec3 couple = Vec3::Zero();

  void state(Archive& archive) { archive(touching, normal_force, largest_overlap, couple); }
};

/// Nodes of the rod from one to another.
struct NodeRange {
  int first = 0, last = -1;

  bool empty() const { return last < first; }
  bool holds(int node) const { return first <= node && node <= last; }
};

/// Sum of the normal forces of contacts between two pieces of the rod [N].
double normal_force_between(const std::vector<ContactPoint>& contacts, const NodeRange& a, const NodeRange& b);

/// Sum of the normal forces of rollers on a piece of the rod [N].
double roller_normal_force(const std::vector<ContactPoint>& contacts, const NodeRange& piece);

/// Of the contacts that a law has evaluated at `position`, those between strands that touch.
std::vector<ContactForce> contact_forces(const std::vector<ContactPoint>& contacts, const Points& position);

/// Where the work of the last accepted step went [J]; an identity of the step's equations, to rounding, in which each
/// term has a formula of its own:
///
///   boundary = change of Energies::total() + friction + drag + numerical + reweighting + residual
///
/// with way x - x_n, E the elastic energies, F the forces of held nodes and rollers on the rod, and for every contact
/// its weight w, pressure p, slip s in the step, overlap D and energy e(D) per length:
///
///   boundary     sum 1/2 (F_n + F) . way, and what slipping grips, forces and gravity do at the end of the step
///   friction     sum w mu p z . s, all that is done against friction: what the presliding spring of a contact at rest
///                could give back, less than mu p w xi_s/2 each, counts as lost until it does
///   drag         sum c lbar |way|^2/dt
///   numerical    that of the implicit Euler step, which takes all forces at its end:
///                  sum 1/2 m |v - v_n|^2 + E_n - E + dE/dx . way + sum w [e(D_n) - e(D) - p n . s]
///                less 1/2 (F - F_n) . way, by which it takes the work of the boundary for too much
///   reweighting  contact energy at the last step's end less sum w e(D_n): weights follow the shape between two steps,
///                feet come and go, and what is stored in them changes without a force; negative where it grows
///   residual     what Newton's method left unbalanced on free nodes, times their way
///
/// A roller that is turned is part of the boundary, by its moment; one that is free has inertia as nodes have.
/// An edge's spin counts as the nodes' motion does, with its own inertia, drag, torques and the regularisation r_j
/// (frame_terms.hpp), whose part is numerical.
struct StepWork {
  double boundary = 0.0;
  double friction = 0.0;
  double drag = 0.0;
  double numerical = 0.0;
  double reweighting = 0.0;
  double residual = 0.0;

  StepWork& operator+=(const StepWork& other) {
    boundary += other.boundary;
    friction += other.friction;
    drag += other.drag;
    numerical += other.numerical;
    reweighting += other.reweighting;
    residual += other.residual;
    return *this;
  }

  void state(Archive& archive) { archive(boundary, friction, drag, numerical, reweighting, residual); }
};

/// Sum of all that acted on the rod in the last accepted step: holders, grips, springs, rollers, forces and weight,
/// and, with the opposite sign, what its inertia and its drag take, those of spin among them. The force is what
/// Newton's method left unbalanced, and so is the moment, but for the couple of friction that sections do not take
/// (ContactReading::couple), which then is what is missing.
struct LoadSum {
  Vec3 force = Vec3::Zero();   ///< [N]
  Vec3 moment = Vec3::Zero();  ///< about the origin [N m]

  void add(const Vec3& place, const Vec3& f) {
    force += f;
    moment += place.cross(f);
  }
  void state(Archive& archive) { archive(force, moment); }
};

/// A step as its equations were solved, before the state moves on.
struct SolvedStep {
  const RodState& start;
  const Points& end;  ///< x [m]
  const Points& way;  ///< x - x_n [m]
  const Boundary& boundary;
  double dt;  ///< [s]
  /// All forces but those of holders, [N] and about an edge's tangent [N m]: what is left unbalanced on what is free,
  /// on what is held the opposite of what holds it.
  const std::vector<Lanes>& force;
  const std::vector<char>& held;  ///< which nodes are
};

/// What can be read off the last accepted step: forces on what holds the rod, energies, contact, and where the work of
/// the step went. One step is `begin`, `add_elastic`, `add_contacts` of strands and of rollers.
class StepReadings {
 public:
  /// Of a rod before its first step; `spin`: kinetic energy of its edges' spin [J].
  StepReadings(const RodProperties& rod, const RodState& state, const StepSettings& settings, double spin);

  void begin(const SolvedStep& step, const RollerContact& rollers);
  void add_elastic(const CentrelineTerms::Energy& centreline, const FrameTerms::Energy& frames);
  template <typename Contacts>
  void add_contacts(const SolvedStep& step, const Contacts& contacts);

  /// What holds a node exerts on it [N]; on an edge's material frame [N m].
  Vec3 reaction(int node) const;
  double reaction_torque(int edge) const { return -force_[static_cast<std::size_t>(edge)][3]; }
  /// Force of the rod on a roller [N], and its moment about the roller's centre [N m]; zero where there is none.
  Vec3 roller_force(int roller) const { return load_on(roller).force; }
  Vec3 roller_moment(int roller) const { return load_on(roller).moment; }
  const Energies& energies() const { return energies_; }
  const ContactReading& contact() const { return contact_; }
  const StepWork& work() const { return work_; }
  const LoadSum& loads() const { return loads_; }

  void state(Archive& archive);

 private:
  /// What the rod does to a roller.
  struct RollerLoad {
    Vec3 force = Vec3::Zero();   // [N]
    Vec3 moment = Vec3::Zero();  // about its centre [N m]
    void state(Archive& archive) { archive(force, moment); }
  };
  RollerLoad load_on(int roller) const;
  void add_work_of_boundary(double at_end, double at_begin);
  void add_work_of_holders(const SolvedStep& step);
  void add_work_of_rollers(const SolvedStep& step, const RollerContact& rollers);
  void add_motion(const SolvedStep& step);
  void add_free_turns(const SolvedStep& step, const RollerContact& rollers);
  void add_loads(const SolvedStep& step);

  const RodProperties& rod_;
  const StepSettings& settings_;
  Energies energies_, before_;  // of this step and the one before
  ContactReading contact_;
  StepWork work_;
  LoadSum loads_;
  bool first_ = true;
  std::vector<Lanes> force_;  // SolvedStep::force
  std::vector<Roller> rollers_;
  std::vector<RollerLoad> roller_load_, load_before_;  // of this step and the one before
};

}  // namespace knot_utm
