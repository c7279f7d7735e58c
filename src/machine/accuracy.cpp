#include "knot_utm/machine/accuracy.hpp"

namespace knot_utm {

namespace {

constexpr Tolerances kDraft{0.34, 2e-4, 0.06, 4e-3, 1.3};
constexpr Tolerances kNormal{0.17, 1e-4, 0.015, 2e-3, 2.0};
constexpr Tolerances kFine{0.05, 1e-5, 0.01, 1e-3, 3.0};

// For the loop of a rod that stretches.
constexpr Tolerances kStretchingDraft{0.34, 3e-4, 0.12, 2e-2, 1.0};
constexpr Tolerances kStretchingNormal{0.17, 2e-4, 0.08, 1e-2, 1.0};
constexpr Tolerances kStretchingFine{0.05, 1e-5, 0.01, 1e-3, 2.0};

// What the errors of readings are told in units of.
constexpr double kStep = 0.17, kResidual = 1e-4, kContactTolerance = 0.02, kPresliding = 2e-3;

constexpr double kSolid = 10.0;  // k_s h^2/k_b below which it does; a solid rod's is 4, those of ropes are hundreds

bool stretches(const SpecimenOptions& specimen, const Material& material) {
  const double h = material.radius;
  return specimen.knot == KnotKind::kFisherman &&
         material.stretching_stiffness * h * h < kSolid * material.bending_stiffness;
}

Tolerances of(Accuracy accuracy, bool stretches) {
  switch (accuracy) {
    case Accuracy::kDraft:
      return stretches ? kStretchingDraft : kDraft;
    case Accuracy::kNormal:
      return stretches ? kStretchingNormal : kNormal;
    case Accuracy::kFine:
      break;
  }
  return stretches ? kStretchingFine : kFine;
}

}  // namespace

Tolerances tolerances(const PhysicsOptions& physics, const SpecimenOptions& specimen, const Material& material) {
  Tolerances out = of(physics.accuracy, stretches(specimen, material));
  out.longest_step = physics.max_step.value_or(out.longest_step);
  out.residual = physics.residual.value_or(out.residual);
  out.contact_tolerance = physics.contact_tolerance.value_or(out.contact_tolerance);
  out.presliding = physics.presliding.value_or(out.presliding);
  out.refinement = specimen.refinement.value_or(out.refinement);
  return out;
}

ReadingErrors reading_errors(const SpecimenOptions& specimen, const Material& material, const PhysicsOptions& physics) {
  ReadingErrors out;
  if (specimen.knot == KnotKind::kStraight) out.locked_stiffness = 1e-3;
  const bool studied = specimen.knot == KnotKind::kFisherman && specimen.to_be_tied &&
                       physics.contact_law == ContactLaw::kSmooth && physics.friction_law == FrictionLaw::kMemory;
  if (!studied) return out;
  const Tolerances tolerance = tolerances(physics, specimen, material);
  const double h = material.radius;
  const double edges = 2.0 * specimen.edge_length / (tolerance.refinement * h);
  const double preload = specimen.preload.value_or(default_preload(material)) * h * h / material.bending_stiffness;
  const double step = tolerance.longest_step / kStep;
  out.plateau_force = (0.005 + 0.002 * preload) * edges * edges +
                      (0.005 + 0.00175 * preload) * tolerance.contact_tolerance / kContactTolerance +
                      0.01 * tolerance.presliding / kPresliding + 0.005 * step + 0.003 * tolerance.residual / kResidual;
  out.lock_extension = 0.004 + 0.006 * edges * edges + 0.002 * step;
  out.locked_stiffness = 0.005 + 0.006 * edges * edges;
  return out;
}

}  // namespace knot_utm
