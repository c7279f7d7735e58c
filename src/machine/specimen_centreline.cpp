#include "knot_utm/machine/specimen_centreline.hpp"

#include <algorithm>

#include "knot_utm/machine/accuracy.hpp"
#include "knot_utm/rod/invalid_input.hpp"
#include "knot_utm/specimen/centreline_file.hpp"
#include "knot_utm/specimen/fisherman.hpp"
#include "knot_utm/specimen/overhand.hpp"
#include "knot_utm/specimen/tying_rig.hpp"

namespace knot_utm {

namespace {

constexpr double kCoarsening = 1.5;  // of edges on the far side of a loop, which touches nothing but rollers

// By how much tying moves the two knots apart. Fitted so that the four shipped materials end within 5 % of the distance
// that is asked for, with e from 0.11 to 0.19 m: `tied_knot_distance` of config/tighten.yaml with material= and
// specimen.knot_distance= set, and specimen.end_to_end=0.3, which has room for all of them.
constexpr double kGivenUp = 16.6;         // both knots run outwards by what their coils give up as they tighten [h]
constexpr double kGivenUpByStrain = 2.6;  // more by this where the pre-load stretches the rod [h per unit of strain]
constexpr double kRecovered = 0.075;      // of what it stretched between them, which is short again once released [-]
constexpr double kLargestTyingStrain = 1.0;  // beyond it nothing was measured, and the shift stays what it is [-]

double outward_shift(const SpecimenOptions& specimen, const Material& material) {
  const double strain = std::min(tying_load(specimen, material) / material.stretching_stiffness, kLargestTyingStrain);
  return (kGivenUp + kGivenUpByStrain * strain) * material.radius - kRecovered * strain * specimen.knot_distance;
}

/// The grips hold its ends, the last of them in the upper grip, which moves along +z.
Centreline centreline_from_file(const SpecimenOptions& specimen, const Material& material) {
  if (specimen.closed) throw InvalidInput("specimen.closed", "true", "false, since the grips hold the rod's two ends");
  const Points points = read_centreline(specimen.file);
  Centreline out = from_points(points, false, material.radius, specimen.edge_length, specimen.file);
  if (!(out.points.rightCols(1)(2) > out.points.leftCols(1)(2))) {
    throw InvalidInput::sentence(
        "specimen.file", specimen.file,
        "specimen.file " + shown(specimen.file) + ": the last point must be higher than the first one, along z");
  }
  return out;
}

/// What the clamps hold is one edge more at each end, so that `length` is what stretches: the load grows by k_s/length.
Centreline straight_rod(const SpecimenOptions& specimen, const Material& material, const MachineOptions& machine) {
  Centreline out = straight(specimen.length, material.radius, specimen.edge_length);
  if (machine.grips == GripKind::kNodes) return out;
  const double edge = out.length() / static_cast<double>(out.points.cols() - 1);
  out = straight(specimen.length + 2.0 * edge, material.radius, edge);
  out.points.row(2).array() -= edge;
  return out;
}

}  // namespace

double tying_load(const SpecimenOptions& specimen, const Material& material) {
  return specimen.preload.value_or(default_preload(material));
}

Centreline specimen_centreline(const SpecimenOptions& specimen, const Material& material, const MachineOptions& machine,
                               const PhysicsOptions& physics) {
  switch (specimen.knot) {
    case KnotKind::kFisherman: {
      FishermanShape shape;
      shape.radius = material.radius;
      shape.knot_distance = specimen.knot_distance;
      shape.straight =
          specimen.to_be_tied && machine.grips == GripKind::kRollers ? TyingRig::straight_strand(material.radius) : 0.0;
      shape.outward_shift = specimen.to_be_tied ? outward_shift(specimen, material) : 0.0;
      shape.end_to_end = specimen.end_to_end;
      shape.roller_radius = 0.5 * machine.roller_diameter;
      shape.tail = specimen.tail;
      shape.handedness = specimen.handedness;
      shape.edge_length = specimen.edge_length;
      shape.refinement = tolerances(physics, specimen, material).refinement;
      shape.coarsening = kCoarsening;
      return fisherman_loop(shape);
    }
    case KnotKind::kOverhand: {
      OverhandShape shape;
      shape.radius = material.radius;
      shape.turns = specimen.turns;
      shape.length = specimen.length;
      shape.end_to_end = specimen.end_to_end;
      shape.edge_length = specimen.edge_length;
      shape.refinement = tolerances(physics, specimen, material).refinement;
      return overhand(shape);
    }
    case KnotKind::kStraight:
      return straight_rod(specimen, material, machine);
    case KnotKind::kFile:
      break;
  }
  return centreline_from_file(specimen, material);
}

}  // namespace knot_utm
