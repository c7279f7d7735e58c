#pragma once

#include <vector>

#include "knot_utm/contact/contact_point.hpp"
#include "knot_utm/contact/roller_contact.hpp"
#include "knot_utm/numeric/points.hpp"
#include "knot_utm/sim/contact_force.hpp"
#include "knot_utm/sim/step_account.hpp"

namespace knot_utm {

/// Nodes of the rod from one to another.
struct NodeRange {
  int first = 0, last = -1;

  bool empty() const { return last < first; }
  bool holds(int node) const { return first <= node && node <= last; }
};

/// Readings of the last accepted step: forces on the rod's holders, energies, contact, and where the work of the step
/// went. The terms of the step (time_step.cpp) enter their parts into the account that `begin` opens.
class StepReadings {
 public:
  /// The readings of a rod before its first step; `spin` is the kinetic energy of its edges' spin [J]. It reads the
  /// contacts of strands and rollers from where they are kept.
  StepReadings(const RodProperties& rod, const RodState& state, double spin, const std::vector<ContactPoint>& strands,
               const RollerContact& rollers);

  /// Opens the account of a step and enters the holders of the rod: fixed nodes and frames, and rollers.
  StepAccount& begin(const SolvedStep& step);
  /// By how much the elastic energies, all of which must be in the account, have fallen.
  void add_fall_of_elastic_energy();

  /// Force of a fixed node's holder on the rod, from the residual of the step's equations there [N].
  Vec3 reaction(int node) const;
  /// Torque about an edge's tangent that the holder of its material frame exerts on the rod [N m].
  double reaction_torque(int edge) const;
  /// Force of the rod on a roller [N], and its moment about the roller's centre [N m]; zero before the first accepted
  /// step, and where there is no such roller.
  Vec3 roller_force(int roller) const { return load_on(roller).force; }
  /// The same of contacts as they were last evaluated [N].
  Vec3 tried_roller_force(int roller) const { return rollers_now_.force_on(roller); }
  Vec3 roller_moment(int roller) const { return load_on(roller).moment; }

  const Energies& energies() const { return account_.energies; }
  const ContactReading& contact() const { return account_.contact; }
  const StepWork& work() const { return account_.work; }
  const LoadSum& loads() const { return account_.loads; }

  // These read the contacts of the last step that was tried: after an accepted step, before the next one is tried.
  /// Of those that touch between strands.
  std::vector<ContactForce> contact_forces() const;
  /// Sum of the normal forces of strands and rollers on each node [N].
  Eigen::VectorXd normal_forces() const;
  Eigen::VectorXd strand_normal_forces() const;  ///< of strands alone
  /// What strands and rollers press on each node with; of contacts as they were last evaluated, in any case.
  Pressing pressing() const;
  /// Sum of the normal forces of strands between two pieces of the rod [N].
  double normal_force_between(const NodeRange& a, const NodeRange& b) const;
  /// Sum of the normal forces of rollers on a piece of the rod [N].
  double roller_normal_force(const NodeRange& piece) const;

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
  void add_holders(const SolvedStep& step);
  void add_rollers(const SolvedStep& step);

  const RodState& state_;
  const std::vector<ContactPoint>& strands_;
  const RollerContact& rollers_now_;
  StepAccount account_;
  bool first_ = true;
  std::vector<Lanes> force_;  // SolvedStep::force
  std::vector<Roller> rollers_;
  std::vector<RollerLoad> roller_load_, load_before_;  // of this step and the one before
};

}  // namespace knot_utm
