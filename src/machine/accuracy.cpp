#include "knot_utm/machine/accuracy.hpp"

namespace knot_utm {

namespace {

constexpr Tolerances kDraft{0.34, 1e-4, 0.04, 4e-3, 1.5};
constexpr Tolerances kNormal{0.17, 1e-4, 0.02, 2e-3, 2.0};
constexpr Tolerances kFine{0.05, 1e-5, 0.01, 1e-3, 3.0};

// Refinement of the loop of a rod that stretches as a solid one does.
constexpr double kStretchingDraft = 1.0, kStretchingNormal = 1.0, kStretchingFine = 2.0;
constexpr double kSolid = 10.0;  // k_s h^2/k_b; a solid rod's is 4, those of ropes are hundreds

struct OfAccuracy {
  Tolerances tolerances;
  double refinement_where_it_stretches;
};

OfAccuracy of(Accuracy accuracy) {
  switch (accuracy) {
    case Accuracy::kDraft:
      return {kDraft, kStretchingDraft};
    case Accuracy::kNormal:
      return {kNormal, kStretchingNormal};
    case Accuracy::kFine:
      break;
  }
  return {kFine, kStretchingFine};
}

bool stretches(const Material& material) {
  return material.stretching_stiffness * material.radius * material.radius < kSolid * material.bending_stiffness;
}

}  // namespace

Tolerances tolerances(const PhysicsOptions& physics, const SpecimenOptions& specimen, const Material& material) {
  const OfAccuracy chosen = of(physics.accuracy);
  Tolerances out = chosen.tolerances;
  if (specimen.knot == KnotKind::kFisherman && stretches(material))
    out.refinement = chosen.refinement_where_it_stretches;
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
  const double step = tolerance.longest_step / kNormal.longest_step;
  out.plateau_force = (0.005 + 0.00125 * preload) * edges * edges +
                      (0.005 + 0.00175 * preload) * tolerance.contact_tolerance / kNormal.contact_tolerance +
                      0.01 * tolerance.presliding / kNormal.presliding + 0.005 * step +
                      0.003 * tolerance.residual / kNormal.residual;
  out.lock_extension = 0.004 + 0.006 * edges * edges + 0.002 * step;
  out.locked_stiffness = 0.005 + 0.006 * edges * edges;
  return out;
}

}  // namespace knot_utm
