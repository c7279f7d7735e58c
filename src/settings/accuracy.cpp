#include "knot_utm/settings/accuracy.hpp"

#include <algorithm>
#include <cmath>

#include "knot_utm/breaking/breaking_laws.hpp"
#include "knot_utm/contact/friction.hpp"
#include "knot_utm/rod/bending_laws.hpp"
#include "knot_utm/rod/stretching_laws.hpp"
#include "knot_utm/settings/step_settings.hpp"
#include "knot_utm/specimen/knot.hpp"
#include "knot_utm/specimen/material.hpp"
#include "measured.hpp"

namespace knot_utm {
namespace {

using namespace measured;

/// A loop of a solid rod stretches, while one of a rope lets its knots slide first.
bool stretches(const SpecimenOptions& specimen, const Material& material) {
  return knot_of(specimen).about().loop && is_solid(material);
}

/// F_p h^2/k_b.
double preload_group(const SpecimenOptions& specimen, const Material& material) {
  const double h = material.radius;
  return tying_load(specimen, material) * h * h / material.bending_stiffness;
}

/// By which edges in the knots of a rope that is tied hard are shorter.
double shorter_where_tied_hard(const SpecimenOptions& specimen, const Material& material) {
  if (!knot_of(specimen).about().loop || !specimen.to_be_tied) return 1.0;
  return std::clamp(std::pow(preload_group(specimen, material) / kTiedHard, 0.25), 1.0, kShortestForHard);
}

/// A solid rod between clamps whose knot, or whatever shape a file gives it, is open.
bool is_open(const SpecimenOptions& specimen, const Material& material) {
  const KnotDescription& knot = knot_of(specimen).about();
  return knot.may_hold_a_knot() && !knot.tied_by_ends && !knot.loop && is_solid(material);
}

/// How a specimen takes a load, as far as its tolerances depend on it.
struct Answer {
  bool stretches = false;
  bool rolls = false;  ///< its strands roll on each other
  bool open = false;
};

Answer answer(const PhysicsOptions& physics, const SpecimenOptions& specimen, const Material& material) {
  const bool rolls = friction_couple(material, physics) > 0.0;
  return {stretches(specimen, material), rolls, rolls && is_open(specimen, material)};
}

Tolerances of(Accuracy accuracy, const Answer& rod) {
  switch (accuracy) {
    case Accuracy::kDraft:
      if (rod.open) return kOpenDraft;
      return rod.stretches ? kStretchingDraft : kDraft;
    case Accuracy::kNormal:
      if (rod.open) return kOpenNormal;
      if (rod.stretches) return kStretchingNormal;
      return rod.rolls ? kRollingNormal : kNormal;
    case Accuracy::kFine:
      break;
  }
  return rod.stretches ? kStretchingFine : kFine;
}

Tolerances of(Accuracy accuracy, const PhysicsOptions& physics, const SpecimenOptions& specimen,
              const Material& material) {
  const Answer rod = answer(physics, specimen, material);
  Tolerances out = of(accuracy, rod);
  if (!rod.stretches && accuracy != Accuracy::kDraft) out.refinement *= shorter_where_tied_hard(specimen, material);
  return out;
}

/// By how much the error of a plateau is larger where friction among fibres nearly locks the knots.
double near_locking(const Material& material) {
  const double moment = material.bending.value("friction_moment").value_or(0.0);
  const double near = moment * material.friction_coefficient / kNearLocking;
  return 1.0 + near * near;
}

/// Whether friction and bends go together as in the studies: friction on centrelines with elastic bends, or the whole
/// couple of friction at the surface with fibres that rub.
bool studied_section(const Material& material, const PhysicsOptions& physics) {
  return BendingRegistry::entry(material.bending.law).studied &&
         (friction_couple(material, physics) > 0.0) == remembers_bends(material);
}

/// Round sections were studied with a linear law, soft ones with rubber's.
bool studied_stretching(const Material& material) {
  return StretchingRegistry::entry(material.stretching.law).studied != material.is_soft();
}

/// The error over that at `normal` with edges of one radius. It grows with the square of the edge length, as the method
/// is of second order, and in proportion to all else. `edge`: before refinement [h].
double coarseness(const Tolerances& own, const Tolerances& normal, double edge) {
  const double edges = edge * normal.refinement / own.refinement;
  return kFractionOfEdges * edges * edges +
         kFractionOfContactTolerance * own.contact_tolerance / normal.contact_tolerance +
         kFractionOfPresliding * own.presliding / normal.presliding +
         kFractionOfStep * own.longest_step / normal.longest_step +
         kFractionOfResidual * own.residual / normal.residual;
}

/// The mesh resolves a knot's sharpest bend, and friction decides how the tension falls along it.
std::optional<double> error_of_break_in_bend(const SpecimenOptions& specimen, const Material& material,
                                             const PhysicsOptions& physics) {
  const bool studied = knot_of(specimen).about().may_hold_a_knot() && parts_by_bending(material) &&
                       FrictionRegistry::entry(physics.friction.law).studied;
  if (!studied) return {};
  const bool crushed = material.breaking.number(FibreBreaking::kCrushingShare) > 0.0;
  return (crushed ? kBreakCrushed : kBreakInBend) *
         coarseness(tolerances(physics, specimen, material), of(Accuracy::kNormal, answer(physics, specimen, material)),
                    specimen.edge_length / material.radius);
}

}  // namespace

Tolerances tolerances(const PhysicsOptions& physics, const SpecimenOptions& specimen, const Material& material) {
  Tolerances out = of(physics.accuracy, physics, specimen, material);
  out.longest_step = physics.max_step.value_or(out.longest_step);
  out.residual = physics.residual.value_or(out.residual);
  out.contact_tolerance = physics.contact_tolerance.value_or(out.contact_tolerance);
  out.presliding = physics.friction.value("presliding").value_or(out.presliding);
  const KnotDescription& knot = knot_of(specimen).about();
  const bool as_given = knot.any_shape && !knot.tied_by_ends;  // nobody knows how such a shape should be meshed
  out.refinement = specimen.refinement.value_or(as_given ? 1.0 : out.refinement);
  return out;
}

bool hardly_closed(double plateau_force, const Material& material) {
  const double h = material.radius;
  return plateau_force < kHardlyClosed * material.bending_stiffness / (h * h);
}

RelativeErrors errors_of_hardly_closed(const RelativeErrors& errors) {
  RelativeErrors out;
  if (errors.soft) {
    out = errors;
    if (out.plateau_force) *out.plateau_force *= kSoftHardlyClosed;
    return out;
  }
  out.break_in_bend = errors.break_in_bend;
  if (!errors.rolls) return out;
  out.rolls = true;
  if (errors.plateau_force)
    out.plateau_force = std::max(*errors.plateau_force,
                                 std::min(kHardlyClosedPlateau * *errors.plateau_force, kOppositeRollingPlateau));
  if (errors.lock_extension) out.lock_extension = kHardlyClosedLock * *errors.lock_extension;
  return out;
}

RelativeErrors relative_errors(const SpecimenOptions& specimen, const Material& material, const MachineOptions& machine,
                               const PhysicsOptions& physics) {
  const ErrorStudy study = knot_of(specimen).about().error_study;
  RelativeErrors out;
  if (!studied_stretching(material)) return out;
  if (study == ErrorStudy::kStraight) out.locked_stiffness = kStraightStiffness;
  out.break_in_bend = error_of_break_in_bend(specimen, material, physics);
  const bool studied = specimen.to_be_tied && FrictionRegistry::entry(physics.friction.law).studied &&
                       studied_section(material, physics);
  if (!studied) return out;
  const double h = material.radius, edge = specimen.edge_length / h;
  const Answer rod = answer(physics, specimen, material);
  const bool soft = material.is_soft();
  if (study == ErrorStudy::kSketchedKnot && !material.other && !soft)
    out.largest_load = coarseness(tolerances(physics, specimen, material), of(Accuracy::kNormal, rod), edge) *
                       (is_solid(material) ? kSketchedInSolid : kSketchedInRope);
  if (study != ErrorStudy::kFisherman || machine.roller_friction != 0.0 || !rollers_hold(specimen, machine)) return out;
  const bool solid = rod.stretches, opposite = specimen.handedness == Handedness::kOpposite;
  const Tolerances own = tolerances(physics, specimen, material);
  // Where a rope is tied hard, edges in its knots are shorter, and so is the error there. The strands do not gain by
  // it.
  const double coarse = coarseness(own, of(Accuracy::kNormal, rod), edge),
               of_strands = coarseness(own, of(Accuracy::kNormal, physics, specimen, material), edge);
  const double slippery = std::max(1.0, kSlippery / std::max(material.friction_coefficient, kLeastFriction));
  out.rolls = rod.rolls;
  out.soft = soft;
  const double opposite_plateau = rod.rolls ? kOppositeRollingPlateau : kOppositePlateau,
               opposite_lock = rod.rolls ? kOppositeRollingLock : kOppositeLock;
  out.plateau_force = coarse * (soft        ? kSoftPlateau
                                : opposite  ? opposite_plateau
                                : rod.rolls ? kRollingPlateau * near_locking(material) * slippery
                                            : kPlateau * slippery);
  out.lock_extension = coarse * (soft ? kSoftLock : opposite ? opposite_lock : kLock);
  out.locked_stiffness = of_strands * (rod.rolls && opposite ? kOppositeRollingStiffness
                                       : soft                ? kSoftStiffness
                                       : solid               ? kSolidsStiffnessOfKnots * h / specimen.end_to_end
                                       : rod.rolls           ? kRollingStiffness * slippery
                                                             : kRopesStiffness);
  return out;
}

}  // namespace knot_utm
