#pragma once

#include <vector>

#include "knot_utm/contact/roller_contact.hpp"
#include "knot_utm/numeric/points.hpp"
#include "knot_utm/sim/contact_sums.hpp"
#include "knot_utm/sim/solved_step.hpp"
#include "knot_utm/sim/step_account.hpp"

namespace knot_utm {

/// Readings of the last accepted step: forces on the rod's holders, energies, contact, and where the work of the step
/// went. The terms of the step (time_step.cpp) enter their parts into the account that `begin` opens.
class StepReadings {
 public:
  /// The readings of a rod before its first step; `spin` is the kinetic energy of its edges' spin [J].
  StepReadings(const RodProperties& rod, const RodState& state, double spin);

  /// Opens the account of a step and enters the holders of the rod: fixed nodes and frames, and rollers.
  StepAccount& begin(const SolvedStep& step, const RollerContact& rollers);
  /// Kinetic energy and numerical loss of free rollers.
  void add_free_turns(const SolvedStep& step, const RollerContact& rollers);
  /// By how much the elastic energies, all of which must be in the account, have fallen.
  void add_fall_of_elastic_energy();

  /// Force of a node's holder on it [N]; torque of the holder of an edge's material frame [N m].
  Vec3 reaction(int node) const;
  double reaction_torque(int edge) const { return -force_[static_cast<std::size_t>(edge)][3]; }
  /// Force of the rod on a roller [N], and its moment about the roller's centre [N m]; zero where there is none.
  Vec3 roller_force(int roller) const { return load_on(roller).force; }
  Vec3 roller_moment(int roller) const { return load_on(roller).moment; }
  const StepAccount& account() const { return account_; }

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
  void add_rollers(const SolvedStep& step, const RollerContact& rollers);

  StepAccount account_;
  bool first_ = true;
  std::vector<Lanes> force_;  // SolvedStep::force
  std::vector<Roller> rollers_;
  std::vector<RollerLoad> roller_load_, load_before_;  // of this step and the one before
};

}  // namespace knot_utm
