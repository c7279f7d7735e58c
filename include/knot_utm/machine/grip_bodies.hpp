#pragma once

#include <vector>

#include "knot_utm/machine/options.hpp"
#include "knot_utm/numeric/points.hpp"
#include "knot_utm/specimen/options.hpp"

namespace knot_utm {

struct Material;

/// A body that holds or bears the specimen, for pictures: a cylinder for a roller or a post, a block for a clamp or
/// another holder of a node.
struct GripBody {
  bool goes_up = false;           ///< moves with the upper grip; else it stands still
  Vec3 from_grip = Vec3::Zero();  ///< of its middle, from the middle of the upper grip, or of the lower one [m]
  double cylinder_radius = 0.0;   ///< 0: a block [m]
  Vec3 axis = Vec3::UnitY();      ///< of a cylinder
  Vec3 half_box(double h) const;  ///< half the edges of its bounding box beside a rod of radius h [m]
  double half_length(double h) const { return 6.0 * h; }  ///< half the length with which a cylinder is drawn [m]
};

/// The lower grip first, then the upper one, then posts other than those that are grips.
std::vector<GripBody> grip_bodies(const SpecimenOptions& specimen, const MachineOptions& machine,
                                  const Material& material);

}  // namespace knot_utm
